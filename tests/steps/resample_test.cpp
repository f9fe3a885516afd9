// SPDX-License-Identifier: Apache-2.0
// Keyframes that interpolation reproduces are removed.
#include <cmath>

#include <gmock/gmock.h>

#include "made_asset.hpp"
#include "model/keyframe_choice.hpp"

namespace gltfx {
namespace {

using model::choose_keyframes;
using model::CurveKind;
using model::KeyedCurve;
using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::Lt;
using testing::SizeIs;

ConvertOptions resample_options() {
  ConvertOptions options;
  options.resample = true;
  return options;
}

// Times that single precision represents exactly.
std::vector<float> moments(std::size_t count) {
  std::vector<float> times;
  for (std::size_t i = 0; i < count; ++i) times.push_back(static_cast<float>(i) / 64);
  return times;
}

// Repeats values for all keyframes.
std::vector<float> repeated(const std::vector<float>& value, std::size_t count) {
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) values.insert(values.end(), value.begin(), value.end());
  return values;
}

std::vector<float> turning(std::size_t count, double angle) {
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double half = angle * static_cast<double>(i) / static_cast<double>(count - 1) / 2;
    for (const double each : {0.6 * std::sin(half), 0.0, 0.8 * std::sin(half), std::cos(half)})
      values.push_back(static_cast<float>(each));
  }
  return values;
}

/// An animation with a node for each sampler.
struct Clip {
  explicit Clip(std::size_t keys) : times(moments(keys)) {
    input = made.accessor(times, "SCALAR", true);
  }
  // Returns the accessor of the values.
  template <class T>
  std::size_t add(const std::string& path, const std::vector<T>& values, const std::string& type,
                  const std::string& interpolation = "LINEAR", bool bounds = false) {
    const std::size_t output = made.accessor(values, type, bounds);
    OrderedJson& animation = made.json["animations"][0];
    animation["samplers"].push_back(
        {{"input", input}, {"interpolation", interpolation}, {"output", output}});
    made.json["nodes"].push_back({{"name", path}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1},
         {"target", {{"node", made.json["nodes"].size() - 1}, {"path", path}}}});
    return output;
  }
  OrderedJson& sampler() { return made.json["animations"][0]["samplers"][0]; }
  OrderedJson& channel() { return made.json["animations"][0]["channels"][0]; }

  MadeAsset made;
  std::vector<float> times;
  std::size_t input;
};

class Resample : public test::ConvertMade {
 protected:
  Resample() : ConvertMade(resample_options()) {}
};

TEST_F(Resample, KeepsOnlyTheEndsOfALine) {
  Clip clip(100);
  std::vector<float> line;
  for (std::size_t i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i);
    line.insert(line.end(), {x, 2 * x - 7, 0.1F});
  }
  const std::size_t output = clip.add("translation", line, "VEC3", "LINEAR", true);
  const StoredAsset now = converted_twice(clip.made.glb());
  EXPECT_THAT(numbers_of(now, clip.input), ElementsAre(0, 99.0 / 64));
  EXPECT_THAT(numbers_of(now, output), ElementsAre(0, -7, 0.1F, 99, 191, 0.1F));
  EXPECT_EQ(now.json()["accessors"][clip.input]["max"].dump(), "[1.546875]");
  EXPECT_EQ(now.json()["accessors"][output]["min"].dump(),
            clip.made.json["accessors"][output]["min"].dump());
  EXPECT_EQ(row_.what, "98 of 100 keyframes removed");
  EXPECT_LT(row_.bytes_after, row_.bytes_before);
}

TEST_F(Resample, KeepsCorners) {
  Clip clip(41);
  std::vector<float> values;
  for (std::size_t i = 0; i < 41; ++i)
    values.insert(values.end(), {static_cast<float>(std::min<std::size_t>(i, 20)), 0, 0});
  const std::size_t output = clip.add("translation", values, "VEC3");
  const StoredAsset now = converted_twice(clip.made.glb());
  EXPECT_THAT(numbers_of(now, clip.input), ElementsAre(0, 20.0 / 64, 40.0 / 64));
  EXPECT_THAT(numbers_of(now, output), ElementsAre(0, 0, 0, 20, 0, 0, 20, 0, 0));
}

// One unit in the last place is a large part of a small scene that moves far away.
TEST_F(Resample, IsVerifiedFarFromTheOrigin) {
  options_.verify = true;
  Clip clip(61);
  std::vector<float> line;
  for (std::size_t i = 0; i < 61; ++i)
    line.insert(line.end(), {1000 + 0.1F * static_cast<float>(i), 0, 0});
  clip.add("translation", line, "VEC3");
  const std::size_t positions =
      clip.made.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", true);
  OrderedJson& json = clip.made.json;
  json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  json["nodes"][0]["mesh"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  const ConvertReport report = run(clip.made.glb());
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_TRUE(report.changes);
}

TEST_F(Resample, RemovesKeyframesWithinABound) {
  options_.resample = false;
  options_.quantize.emplace();
  options_.quantize->animation = 0.01;
  Clip clip(41);
  std::vector<float> values;
  for (std::size_t i = 0; i < 41; ++i)
    values.insert(values.end(), {static_cast<float>(i), i % 2 == 0 ? 0.3F : 0, 7});
  clip.add("translation", values, "VEC3");
  const StoredAsset now = converted_twice(clip.made.glb());
  EXPECT_THAT(numbers_of(now, clip.input), ElementsAre(0, 40.0 / 64));
  ASSERT_THAT(row_.losses, SizeIs(1));
  EXPECT_EQ(row_.losses[0].quantity, "animations");
  EXPECT_NEAR(row_.losses[0].measured, 0.75, 1e-4);
  EXPECT_EQ(row_.losses[0].bound, 1);
}

TEST_F(Resample, KeepsEachChangeOfASteppedCurve) {
  Clip clip(8);
  const std::vector<float> values{1, 1, 1, 5, 5, 1, 1, 1};
  std::vector<float> scales;
  for (const float value : values) scales.insert(scales.end(), {value, value, value});
  clip.add("scale", scales, "VEC3", "STEP");
  EXPECT_THAT(numbers_of(converted_twice(clip.made.glb()), clip.input),
              ElementsAre(0, 3.0 / 64, 5.0 / 64, 7.0 / 64));
}

TEST_F(Resample, InterpolatesRotationsAlongTheShorterArc) {
  Clip clip(200);
  const std::size_t output = clip.add("rotation", turning(200, 1.5), "VEC4");
  const StoredAsset now = converted_twice(clip.made.glb());
  EXPECT_THAT(numbers_of(now, clip.input), ElementsAre(0, 199.0 / 64));
  EXPECT_THAT(numbers_of(now, output), SizeIs(8));
}

TEST_F(Resample, KeepsSeveralTurns) {
  Clip clip(2000);
  const std::size_t output = clip.add("rotation", turning(2000, 100), "VEC4");
  const StoredAsset now = converted_twice(clip.made.glb());
  const auto values = numbers_of(now, output);
  EXPECT_THAT(values, SizeIs(Lt(4 * 200U)));
  for (std::size_t i = 4; i < values.size(); i += 4) {
    double cosine = 0;
    for (std::size_t k = 0; k < 4; ++k) cosine += values[i + k] * values[i + k - 4];
    EXPECT_GT(cosine, 0.1) << "the shorter arc is the one that was taken";
  }
}

// Linear interpolation of components gives this curve, but readers use slerp.
TEST_F(Resample, KeepsRotationsThatAreLinearInTheirComponents) {
  Clip clip(3);
  const double half = std::sqrt(0.5);
  std::vector<float> values{0, 0, 0, 1};
  const double length = std::sqrt(0.75 * 0.75 + half * half * 0.0625);
  for (const double each : {half * 0.25 / length, 0.0, 0.0, 0.75 / length})
    values.push_back(static_cast<float>(each));
  values.insert(values.end(), {static_cast<float>(half), 0, 0, static_cast<float>(half)});
  clip.add("rotation", values, "VEC4");
  EXPECT_FALSE(row_of(clip.made.glb()).changes);
}

TEST_F(Resample, InterpolatesNormalizedIntegers) {
  Clip clip(50);
  const std::size_t output = clip.add(
      "rotation",
      [] {
        std::vector<std::int16_t> values;
        for (int i = 0; i < 50; ++i) values.insert(values.end(), {0, 0, 23170, 23170});
        return values;
      }(),
      "VEC4");
  clip.made.json["accessors"][output]["normalized"] = true;
  EXPECT_THAT(numbers_of(converted_twice(clip.made.glb()), output),
              ElementsAre(0, 0, 23170, 23170, 0, 0, 23170, 23170));
}

TEST_F(Resample, ComparesAllWeightsOfAKeyframe) {
  Clip clip(5);
  // The second of two weights bends at the third keyframe.
  const std::size_t output =
      clip.add("weights", std::vector<float>{0, 0, 1, 0, 2, 0, 3, 1, 4, 2}, "SCALAR");
  const std::size_t at = clip.made.accessor(std::vector<float>(9, 0), "VEC3", true);
  clip.made.mesh(
      {{"attributes", {{"POSITION", at}}}, {"targets", {{{"POSITION", at}}, {{"POSITION", at}}}}});
  clip.made.json["nodes"][0]["mesh"] = 0;
  const StoredAsset now = converted_twice(clip.made.glb());
  EXPECT_THAT(numbers_of(now, output), ElementsAre(0, 0, 2, 0, 4, 2));
  EXPECT_THAT(numbers_of(now, clip.input), ElementsAre(0, 2.0 / 64, 4.0 / 64));
}

TEST_F(Resample, RemovesAKeyframeOnlyFromAllSamplers) {
  Clip clip(5);
  clip.add("translation", std::vector<float>{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 9, 0, 0}, "VEC3");
  const std::size_t other = clip.add(
      "scale", std::vector<float>{1, 1, 1, 9, 1, 1, 3, 1, 1, 4, 1, 1, 5, 1, 1}, "VEC3", "STEP");
  clip.made.json["animations"].push_back(clip.made.json["animations"][0]);
  const auto same = row_of(clip.made.glb());
  EXPECT_FALSE(same.changes);
  clip.made.json["accessors"][other]["bufferView"] = 1;  // the same view as the translations
  for (OrderedJson& animation : clip.made.json["animations"])
    animation["samplers"][1]["interpolation"] = "LINEAR";
  const StoredAsset now = converted_twice(clip.made.glb());
  EXPECT_THAT(numbers_of(now, clip.input), ElementsAre(0, 3.0 / 64, 4.0 / 64));
  EXPECT_THAT(numbers_of(now, other), ElementsAre(0, 0, 0, 3, 0, 0, 9, 0, 0));
}

TEST_F(Resample, AllowsOneUnitInTheLastPlace) {
  const auto kept = [](int units) {
    const float value = 0.7F;
    KeyedCurve curve{CurveKind::linear, 1, {value, value, value}};
    for (int i = 0; i < units; ++i) curve.values[1] = std::nextafter(curve.values[1], 1.F);
    return choose_keyframes(moments(3), {{curve}}).size();
  };
  EXPECT_EQ(kept(0), 2U);
  EXPECT_EQ(kept(1), 2U);
  EXPECT_EQ(kept(2), 3U);
}

// Noise in the last place is at the bound everywhere.
TEST_F(Resample, ChangesNothingTheSecondTime) {
  for (const CurveKind kind : {CurveKind::linear, CurveKind::rotation}) {
    std::uint32_t state = 1;
    KeyedCurve curve{kind, 4, {}};
    for (int i = 0; i < 4 * 3000; ++i) {
      state = state * 1664525 + 1013904223;
      const double noise = (static_cast<double>(state >> 8U) / (1 << 24) - 0.5) * 1.5e-7;
      curve.values.push_back(static_cast<float>(0.5 + noise));
    }
    const auto times = moments(3000);
    const auto kept = choose_keyframes(times, {{curve}});
    EXPECT_GT(kept.size(), 100U);
    EXPECT_LT(kept.size(), 2900U);
    KeyedCurve again{kind, 4, {}};
    std::vector<float> left;
    for (const std::uint32_t key : kept) {
      left.push_back(times[key]);
      for (std::size_t k = 0; k < 4; ++k) again.values.push_back(curve.values[key * 4 + k]);
    }
    EXPECT_THAT(choose_keyframes(left, {{again}}), SizeIs(kept.size()));
  }
}

// One curve is always split near its end; the other one is a long straight line.
TEST_F(Resample, HandlesLongCurvesInFewPasses) {
  constexpr std::size_t kKeys = 200000;
  std::vector<float> growing, straight;
  for (std::size_t i = 0; i < kKeys; ++i) {
    growing.push_back(static_cast<float>(std::exp(static_cast<double>(i) / 4000)) *
                      (i % 2 == 0 ? 1.F : -1.F));
    straight.push_back(static_cast<float>(i));
  }
  EXPECT_THAT(choose_keyframes(moments(kKeys), {{{CurveKind::linear, 1, growing}}}), SizeIs(kKeys));
  EXPECT_THAT(choose_keyframes(moments(kKeys), {{{CurveKind::linear, 1, straight}}}), SizeIs(2));
}

TEST_F(Resample, LeavesOtherCurves) {
  Clip spline(2);
  spline.add("translation", std::vector<float>(18, 1), "VEC3", "CUBICSPLINE");
  expect_left(spline.made, "shares its times with CUBICSPLINE, which does not change");
  Clip pointer(9);
  pointer.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  pointer.made.json["extensionsUsed"] = {"KHR_animation_pointer"};
  pointer.channel()["target"] = {
      {"path", "pointer"},
      {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/translation"}}}}}};
  expect_left(pointer.made, "animates a property that an extension defines");
  Clip idle(9);
  idle.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  idle.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  idle.made.json["animations"][0]["channels"].erase(1);
  expect_left(idle.made, "has no channel");
  Clip both(9);
  both.add("rotation", repeated({0, 0, 0, 1}, 9), "VEC4");
  both.made.json["animations"][0]["channels"].push_back(
      {{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}});
  expect_left(both.made, "animates both rotations and other properties");
}

TEST_F(Resample, LeavesAccessorsWithOtherUsers) {
  Clip times(9);
  times.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  times.made.mesh({{"attributes", {{"POSITION", 1}, {"_TIME", times.input}}}});
  const ConvertStep row = row_of(times.made.glb());
  EXPECT_FALSE(row.changes);
  ASSERT_THAT(row.left, SizeIs(1));
  EXPECT_EQ(row.left[0].reason, "shares its times with objects other than samplers");
  Clip values(9);
  const std::size_t output = values.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  values.made.mesh({{"attributes", {{"POSITION", output}}}});
  expect_left(values.made, "shares its values with other objects");
  Clip inputs(9);
  inputs.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  inputs.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  OrderedJson& samplers = inputs.made.json["animations"][0]["samplers"];
  samplers[1]["input"] = inputs.made.accessor(moments(9), "SCALAR", true);
  samplers[1]["output"] = samplers[0]["output"];
  EXPECT_FALSE(row_of(inputs.made.glb()).changes);
}

TEST_F(Resample, LeavesBrokenCurves) {
  Clip back(9);
  back.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  back.sampler()["input"] = back.made.accessor<float>({0, 1, 2, 3, 3, 5, 6, 7, 8}, "SCALAR", true);
  expect_left(back.made, "has times that do not increase");
  Clip nothing(9);
  nothing.add("translation", repeated({1, std::nanf(""), 3}, 9), "VEC3");
  expect_left(nothing.made, "has values that are not finite");
  Clip few(9);
  few.add("translation", repeated({1, 2, 3}, 7), "VEC3");
  expect_left(few.made, "has a number of values that does not match its times");
  Clip flat(9);
  flat.add("rotation", repeated({1, 2, 3}, 9), "VEC3");
  expect_left(flat.made, "has rotations that are not quaternions");
  Clip whole(9);
  whole.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  whole.sampler()["input"] =
      whole.made.accessor<std::uint16_t>({0, 1, 2, 3, 4, 5, 6, 7, 8}, "SCALAR", true);
  expect_left(whole.made, "has times that are not single-precision numbers");
  Clip sparse(9);
  const std::size_t output = sparse.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  sparse.made.json["accessors"][output]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
      {"values", {{"bufferView", 1}}}};
  expect_left(sparse.made, "has a sparse accessor");
}

TEST_F(Resample, RefusesIfIndicesAreUnknown) {
  Clip clip(9);
  clip.add("translation", repeated({1, 2, 3}, 9), "VEC3");
  clip.made.json["extensionsUsed"] = {"ACME_ref"};
  clip.made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = 0;
  expect_refused(clip.made, "",
                 "/nodes/0/extensions/ACME_ref may hold indices of accessors "
                 "(describe it with --schema)");
}

}  // namespace
}  // namespace gltfx
