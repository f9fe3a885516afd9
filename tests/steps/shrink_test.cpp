// SPDX-License-Identifier: Apache-2.0
// Steps do not hinder each other.
#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::OrderedJson;

constexpr std::size_t kSoupSide = 12;  // cells per side of a grid

// Corners of all triangles of a grid, without indices.
std::vector<float> soup_corners(float height) {
  std::vector<float> positions;
  for (std::size_t cell = 0; cell < kSoupSide * kSoupSide; ++cell) {
    const auto x = static_cast<float>(cell % kSoupSide);
    const auto y = static_cast<float>(cell / kSoupSide);
    for (const auto& [right, up] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}})
      positions.insert(positions.end(),
                       {x + static_cast<float>(right), y + static_cast<float>(up), height});
  }
  return positions;
}

// Each primitive has its own accessors, with equal indices. The first two have equal positions, but
// only the first one has texture coordinates that let vertices merge.
std::string triangle_soup() {
  MadeAsset made;
  std::vector<std::uint16_t> numbers(kSoupSide * kSoupSide * 6);
  std::vector<float> distinct;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = static_cast<std::uint16_t>(i);
    distinct.insert(distinct.end(), {static_cast<float>(i), 0});
  }
  const auto add = [&](float height, const std::vector<float>& texcoords) {
    OrderedJson primitive;
    primitive["attributes"]["POSITION"] = made.accessor(soup_corners(height), "VEC3", true);
    primitive["attributes"]["TEXCOORD_0"] = made.accessor(texcoords, "VEC2");
    primitive["indices"] = made.accessor(numbers, "SCALAR");
    made.mesh(primitive);
  };
  add(0, std::vector<float>(distinct.size(), 0));
  add(0, distinct);
  add(1, std::vector<float>(distinct.size(), 0));
  return made.glb();
}

// The times are equal. All keys of the second curve are needed.
std::string equal_clips() {
  MadeAsset made;
  made.json["nodes"].push_back(OrderedJson::object());
  std::vector<float> times, still, moving;
  for (int i = 0; i < 60; ++i) {
    times.push_back(static_cast<float>(i));
    still.insert(still.end(), {1, 2, 3});
    moving.insert(moving.end(), {static_cast<float>(i * i % 17), 0, 0});
  }
  for (const std::vector<float>* values : {&still, &moving}) {
    OrderedJson sampler{{"input", made.accessor(times, "SCALAR", true)},
                        {"output", made.accessor(*values, "VEC3")}};
    OrderedJson target{{"node", 0}, {"path", values == &still ? "scale" : "translation"}};
    OrderedJson animation;
    animation["samplers"] = OrderedJson::array({sampler});
    animation["channels"] = OrderedJson::array({{{"sampler", 0}, {"target", target}}});
    made.json["animations"].push_back(animation);
  }
  return made.glb();
}

class Shrink : public test::ConvertMade {
 protected:
  Shrink() : ConvertMade({}) {}

  std::size_t size_of(const std::string& glb, bool dedup) {
    options_.prune = options_.weld = options_.resample = options_.reorder = true;
    options_.dedup = dedup;
    const ConvertReport report = run(glb);
    EXPECT_TRUE(report.written) << report.error;
    for (const ConvertStep& step : report.steps) EXPECT_TRUE(step.left.empty()) << step.step;
    return std::filesystem::file_size(output());
  }
};

TEST_F(Shrink, IsSmallestWithDedup) {
  for (const std::string& glb : {triangle_soup(), equal_clips()}) {
    const std::size_t without = size_of(glb, false);
    EXPECT_LT(without, glb.size());
    EXPECT_LE(size_of(glb, true), without);
  }
}

}  // namespace
}  // namespace gltfx
