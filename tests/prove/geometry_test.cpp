// SPDX-License-Identifier: Apache-2.0
/// Primitives with the same and with different shapes, from vertices in different storage.
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/draco_encoder.hpp"
#include "model/packed_bytes.hpp"
#include "prove/edited_asset.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using test::packed;
using testing::HasSubstr;

/// A primitive whose accessors have separate views.
class OnePrimitive : public test::AssetBuilder {
 public:
  OnePrimitive() {
    json = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {}}]}]})");
  }
  OnePrimitive& attribute(const std::string& name, const char* type, int component,
                          const std::string& values, std::size_t count, bool normalized = false) {
    primitive()["attributes"][name] = accessor(type, component, count, values);
    if (normalized) json["accessors"].back()["normalized"] = true;
    return *this;
  }
  OnePrimitive& positions(const std::vector<float>& values) {
    return attribute("POSITION", "VEC3", 5126, packed(values), values.size() / 3);
  }
  OnePrimitive& target(const std::vector<float>& values) {
    primitive()["targets"].push_back(
        {{"POSITION", accessor("VEC3", 5126, values.size() / 3, packed(values))}});
    return *this;
  }
  template <class T>
  OnePrimitive& indices(const std::vector<T>& values) {
    constexpr int kType = sizeof(T) == 1 ? 5121 : sizeof(T) == 2 ? 5123 : 5125;
    primitive()["indices"] = accessor("SCALAR", kType, values.size(), packed(values));
    return *this;
  }
  OnePrimitive& mode(int mode) {
    primitive()["mode"] = mode;
    return *this;
  }
  OnePrimitive& node(const char* member, const Json& value) {
    json["nodes"][0][member] = value;
    return *this;
  }
  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  EditedAsset asset() const { return EditedAsset::made(json.dump(), bytes); }
};

const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
constexpr std::array<int, 6> kList{0, 1, 2, 0, 2, 3};

OnePrimitive square() {
  return OnePrimitive().positions(kSquare).indices<std::uint16_t>({0, 1, 2, 0, 2, 3});
}

MeaningRequest in_any_order() {
  MeaningRequest request;
  request.order = VertexOrder::free;
  return request;
}

bool same(const OnePrimitive& a, const OnePrimitive& b, const MeaningRequest& request = {}) {
  const Meaning meaning = test::compare(a.asset(), b.asset(), request);
  const Meaning back = test::compare(b.asset(), a.asset(), request);
  EXPECT_EQ(meaning.same(), back.same()) << test::text(meaning) << test::text(back);
  return meaning.same();
}

TEST(GeometryMeaning, IsThatOfCorners) {
  std::vector<float> corners;
  for (const int i : kList) {
    const auto first = kSquare.begin() + i * 3;
    corners.insert(corners.end(), first, first + 3);
  }
  EXPECT_TRUE(same(square(), OnePrimitive().positions(corners)));
  EXPECT_TRUE(
      same(square(), OnePrimitive().positions(kSquare).indices<std::uint8_t>({0, 1, 2, 0, 2, 3})));
  const std::vector<float> other{1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0};
  EXPECT_TRUE(
      same(square(), OnePrimitive().positions(other).indices<std::uint32_t>({1, 0, 3, 1, 3, 2})));
  EXPECT_FALSE(
      same(square(), OnePrimitive().positions(other).indices<std::uint32_t>({1, 0, 3, 1, 3, 0})));
}

// Corners 1 and 2 are equal.
TEST(GeometryMeaning, TrianglesWithoutAreaMayBeginWithAnyCorner) {
  const std::vector<float> points{0, 0, 0, 1, 0, 0, 1, 0, 0};
  const auto triangle = [&](const std::vector<std::uint16_t>& corners) {
    return OnePrimitive().positions(points).indices<std::uint16_t>(corners);
  };
  for (const auto& turned : {std::vector<std::uint16_t>{1, 2, 0}, {2, 0, 1}, {0, 2, 1}}) {
    EXPECT_TRUE(same(triangle({0, 1, 2}), triangle(turned), in_any_order()));
  }
}

TEST(GeometryMeaning, AnEmptyObjectOfExtensionsSaysNothing) {
  OnePrimitive other = square();
  other.primitive()["extensions"] = Json::object();
  EXPECT_TRUE(same(square(), other));
}

TEST(GeometryMeaning, StripsAndFansAreLists) {
  const OnePrimitive fan = OnePrimitive().positions(kSquare).mode(6);
  EXPECT_TRUE(same(square(), fan));
  const OnePrimitive strip =
      OnePrimitive().positions(kSquare).indices<std::uint8_t>({1, 2, 0, 3}).mode(5);
  EXPECT_FALSE(same(square(), strip)) << "begins with another corner";
  EXPECT_TRUE(same(square(), strip, in_any_order()));
  EXPECT_FALSE(same(square(), OnePrimitive().positions(kSquare).mode(2), in_any_order()));
}

TEST(GeometryMeaning, OrderMayBeFree) {
  const OnePrimitive turned =
      OnePrimitive().positions(kSquare).indices<std::uint16_t>({2, 3, 0, 1, 2, 0});
  EXPECT_FALSE(same(square(), turned));
  EXPECT_TRUE(same(square(), turned, in_any_order()));
  const OnePrimitive flipped =
      OnePrimitive().positions(kSquare).indices<std::uint16_t>({2, 3, 0, 2, 1, 0});
  EXPECT_FALSE(same(square(), flipped, in_any_order())) << "turns the other way";
  const OnePrimitive twice =
      OnePrimitive().positions(kSquare).indices<std::uint16_t>({0, 1, 2, 0, 2, 3, 0, 2, 3});
  EXPECT_FALSE(same(square(), twice, in_any_order()));
  const OnePrimitive lines = OnePrimitive().positions(kSquare).mode(3);
  const OnePrimitive pairs =
      OnePrimitive().positions(kSquare).indices<std::uint8_t>({3, 2, 0, 1, 2, 1}).mode(1);
  EXPECT_TRUE(same(lines, pairs, in_any_order()));
}

TEST(GeometryMeaning, TrianglesOfEqualCornersAreNone) {
  std::vector<float> corners;  // the last triangle is a line, by vertices of its own
  for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U, 0U, 1U, 1U}) {
    for (std::size_t k = 0; k < 3; ++k) corners.push_back(kSquare[i * 3 + k]);
  }
  const OnePrimitive apart = OnePrimitive().positions(corners);
  const OnePrimitive merged =
      OnePrimitive().positions(kSquare).indices<std::uint8_t>({0, 1, 2, 0, 2, 3, 0, 1, 1});
  EXPECT_TRUE(same(apart, merged, in_any_order()));
  EXPECT_TRUE(same(apart, square(), in_any_order()));
}

TEST(GeometryMeaning, NumbersAreComparedAsDecoded) {
  const auto colored = [](const std::string& bytes, int component, bool normalized) {
    return square().attribute("COLOR_0", "VEC4", component, bytes, 4, normalized);
  };
  std::vector<std::uint8_t> small;
  std::vector<float> floats;
  for (int i = 0; i < 16; ++i) {
    small.push_back(static_cast<std::uint8_t>(i * 17));
    floats.push_back(static_cast<float>(i * 17 / 255.0));
  }
  EXPECT_TRUE(same(colored(packed(small), 5121, true), colored(packed(floats), 5126, false)));
  EXPECT_FALSE(same(colored(packed(small), 5121, true), colored(packed(small), 5121, false)));
  floats[7] = std::nextafter(floats[7], 1.0F);
  EXPECT_FALSE(same(colored(packed(small), 5121, true), colored(packed(floats), 5126, false)));
}

TEST(GeometryMeaning, ToleranceIsByMeaning) {
  std::vector<float> moved = kSquare;
  moved[4] = 0.25F;
  const OnePrimitive other =
      OnePrimitive().positions(moved).indices<std::uint16_t>({0, 1, 2, 0, 2, 3});
  const Meaning meaning = test::compare(square().asset(), other.asset());
  ASSERT_EQ(meaning.differences.size(), 1U);
  EXPECT_EQ(meaning.differences[0].pointer, "/meshes/0/primitives/0/attributes/POSITION");
  EXPECT_EQ(meaning.differences[0].what, "POSITION of corner 1 is 0.25 away");
  EXPECT_EQ(meaning.differences[0].amount, 0.25);
  MeaningRequest request;
  request.tolerance.position = 0.25;
  const Meaning near = test::compare(square().asset(), other.asset(), request);
  EXPECT_TRUE(near.same());
  ASSERT_EQ(near.measured.size(), 1U);
  EXPECT_EQ(near.measured[0].greatest, 0.25);
  request.tolerance.position = 0.2499;
  EXPECT_FALSE(same(square(), other, request));
}

TEST(GeometryMeaning, DirectionsAreAngles) {
  const auto with_normals = [](float x, float z) {
    std::vector<float> normals;
    for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {x, 0, z});
    return square().attribute("NORMAL", "VEC3", 5126, packed(normals), 4);
  };
  MeaningRequest request;
  request.tolerance.direction = 30.01;
  EXPECT_TRUE(same(with_normals(0, 1), with_normals(0.5F, 0.8660254F), request));
  EXPECT_FALSE(same(with_normals(0, 1), with_normals(0.52F, 0.854F), request));
  EXPECT_FALSE(same(with_normals(0, 1), with_normals(0, 0.5F)));
  EXPECT_TRUE(same(with_normals(0, 1), with_normals(0, 0.5F), request)) << "the same direction";
}

TEST(GeometryMeaning, AVectorWithoutDirectionIsFarFromOneWithDirection) {
  const auto with_normal = [](float z) {
    const std::vector<float> normals{0, 0, z, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    return square().attribute("NORMAL", "VEC3", 5126, packed(normals), 4);
  };
  MeaningRequest request;
  request.tolerance.direction = 180;
  EXPECT_TRUE(same(with_normal(1), with_normal(-1), request));
  EXPECT_FALSE(same(with_normal(1), with_normal(0), request));
  EXPECT_TRUE(same(with_normal(0), with_normal(-0.0F)));
}

TEST(GeometryMeaning, TheSignOfATangentIsExact) {
  const auto with_tangents = [](float x, float w) {
    std::vector<float> tangents;
    for (int i = 0; i < 4; ++i) tangents.insert(tangents.end(), {x, 0, 1, w});
    return square().attribute("TANGENT", "VEC4", 5126, packed(tangents), 4);
  };
  MeaningRequest request;
  request.tolerance.direction = 5;
  EXPECT_TRUE(same(with_tangents(0, 1), with_tangents(0.05F, 1), request));
  EXPECT_FALSE(same(with_tangents(0, 1), with_tangents(0, -1), request));
}

TEST(GeometryMeaning, ARestartIsNoVertex) {
  const std::vector<float> row{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0};
  const auto strips = [&](const std::vector<std::uint16_t>& indices) {
    OnePrimitive made = OnePrimitive().positions(row).indices(indices).mode(5);
    made.json["extensionsUsed"] = {"EXT_mesh_primitive_restart"};
    return made;
  };
  const OnePrimitive two = strips({0, 1, 2, 0xFFFF, 3, 4, 5});
  EXPECT_TRUE(same(two, two));
  EXPECT_FALSE(same(two, strips({0, 1, 2, 3, 3, 4, 5})));
}

// What nothing stores may be read for a few million elements in all: more would be left out.
TEST(GeometryMeaning, SharedAccessorsAreComparedOnce) {
  OnePrimitive zeros;
  zeros.json["accessors"].push_back(
      {{"componentType", 5126}, {"count", 1000000}, {"type", "VEC3"}});
  zeros.primitive()["attributes"]["POSITION"] = 0;
  zeros.primitive()["mode"] = 0;
  const Json primitive = zeros.primitive();
  for (int i = 0; i < 20; ++i) zeros.json["meshes"][0]["primitives"].push_back(primitive);
  const EditedAsset asset = zeros.asset();
  EXPECT_THAT(test::compare(asset, asset).unread, testing::IsEmpty());
}

TEST(GeometryMeaning, OfTheSceneAllowsOtherTransforms) {
  std::vector<float> half = kSquare;
  for (float& value : half) value /= 2;
  const OnePrimitive scaled = OnePrimitive()
                                  .positions(half)
                                  .indices<std::uint16_t>({0, 1, 2, 0, 2, 3})
                                  .node("scale", {2, 2, 2});
  MeaningRequest request;
  EXPECT_FALSE(same(square(), scaled, request));
  request.in_world = true;
  EXPECT_TRUE(same(square(), scaled, request));
  OnePrimitive off = scaled;
  off.node("translation", {0, 0, 0.125});
  const Meaning meaning = test::compare(square().asset(), off.asset(), request);
  ASSERT_EQ(meaning.differences.size(), 1U);
  EXPECT_EQ(meaning.differences[0].pointer, "/nodes/0");
  EXPECT_EQ(meaning.differences[0].amount, 0.125);
}

TEST(GeometryMeaning, OfMorphTargets) {
  const std::vector<float> up{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  std::vector<float> less = up;
  less[2] = 0.5F;
  EXPECT_TRUE(same(square().target(up), square().target(up)));
  EXPECT_FALSE(same(square().target(up), square().target(less)));
  EXPECT_FALSE(same(square().target(up), square().target(less), in_any_order()));
  EXPECT_FALSE(same(square().target(up), square()));
}

// A grid and its encoded bitstream.
OnePrimitive packed(const test::DracoSource& source, std::size_t corners, std::size_t points) {
  OnePrimitive made;
  const std::size_t view = made.view(test::draco_bytes(source));
  made.json["accessors"] = {{{"componentType", 5126}, {"count", points}, {"type", "VEC3"}},
                            {{"componentType", 5125}, {"count", corners}, {"type", "SCALAR"}}};
  made.primitive() = Json::parse(R"({"attributes": {"POSITION": 0}, "indices": 1})");
  made.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  made.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  made.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return made;
}

TEST(GeometryMeaning, OfBitstreamsIsThatOfTheirGeometry) {
  test::DracoSource grid = test::draco_grid(9);
  std::vector<float> positions(grid.points * std::size_t{3});
  std::memcpy(positions.data(), grid.attributes[0].bytes.data(), positions.size() * sizeof(float));
  const OnePrimitive plain = OnePrimitive().positions(positions).indices(grid.indices);
  EXPECT_TRUE(same(plain, packed(grid, grid.indices.size(), grid.points)));
  grid.edgebreaker = true;
  EXPECT_TRUE(same(plain, packed(grid, grid.indices.size(), grid.points), in_any_order()));
  EXPECT_FALSE(same(plain, packed(grid, grid.indices.size(), grid.points)));
  grid.attributes[0].bits = 4;
  EXPECT_FALSE(same(plain, packed(grid, grid.indices.size(), grid.points), in_any_order()));
  grid.indices.resize(grid.indices.size() - 3);
  grid.attributes[0].bits = 0;
  EXPECT_FALSE(same(plain, packed(grid, grid.indices.size(), grid.points), in_any_order()));
}

TEST(GeometryMeaning, OfMorphTargetsIsNotThatOfABitstream) {
  const test::DracoSource grid = test::draco_grid(3);
  std::vector<float> positions(grid.points * std::size_t{3});
  std::memcpy(positions.data(), grid.attributes[0].bytes.data(), positions.size() * sizeof(float));
  std::vector<float> moved(positions.size(), 0.25F);
  OnePrimitive plain = OnePrimitive().positions(positions).indices(grid.indices).target(moved);
  OnePrimitive coded = packed(grid, grid.indices.size(), grid.points).target(moved);
  EXPECT_TRUE(same(plain, coded));
  moved[4] = 0.5F;
  coded = packed(grid, grid.indices.size(), grid.points).target(moved);
  EXPECT_FALSE(same(plain, coded));
}

TEST(GeometryMeaning, OfABitstreamThatCannotBeRead) {
  const test::DracoSource grid = test::draco_grid(3);
  const OnePrimitive sound = packed(grid, grid.indices.size(), grid.points);
  EditedAsset broken = sound.asset();
  broken.files["buffer0.bin"][20] ^= 0x55;
  broken.files["buffer0.bin"].resize(24);
  const Meaning before = test::compare(broken, sound.asset());
  EXPECT_TRUE(before.same()) << test::text(before);
  EXPECT_FALSE(before.unread.empty());
  EXPECT_THAT(test::text(test::compare(sound.asset(), broken)), HasSubstr("can no longer be read"));
}

}  // namespace
}  // namespace gltfx::prove
