// SPDX-License-Identifier: Apache-2.0
// Accessors with new elements in buffer views of any layout.
#include <numeric>

#include <gmock/gmock.h>

#include "geometry_support.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;
using test::AssetText;
using test::bytes_of;
using test::OrderedJson;

constexpr std::size_t kEqualVertices = 63;

// Equal vertices, which welding merges into one. Elements of the attributes overlap.
AssetText overlapping() {
  AssetText asset;
  const std::vector<float> values(kEqualVertices * 4 + 1, 0.5F);
  const std::size_t view = asset.view(bytes_of(values), {{"byteStride", 16}, {"target", 34962}});
  const OrderedJson bound = OrderedJson::array({0.5, 0.5, 0.5});
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] =
      asset.accessor_at(view, kEqualVertices, 5126, "VEC3", {{"min", bound}, {"max", bound}});
  primitive["attributes"]["_OTHER"] =
      asset.accessor_at(view, kEqualVertices, 5126, "VEC3", {{"byteOffset", 8}});
  std::vector<std::uint16_t> indices(kEqualVertices);
  std::iota(indices.begin(), indices.end(), std::uint16_t{0});
  primitive["indices"] = asset.accessor(indices, 5123, "SCALAR", 1);
  asset.mesh(primitive);
  return asset;
}

ConvertReport welded(const TempFolder& folder) {
  ConvertOptions options = test::options_to(folder.path() / "out" / "a.gltf");
  options.weld = true;
  return convert_file((folder.path() / "a.gltf").native(), options);
}

TEST(AccessorContents, KeepOverlappingElements) {
  TempFolder folder;
  AssetText asset = overlapping();
  asset.write(folder);
  const ConvertReport report = welded(folder);
  ASSERT_TRUE(report.written) << report.error;  // compared with the input
  EXPECT_EQ(test::step_of(report, "weld").what, "62 vertices merged in 1 primitive");
}

// The index of the view becomes that of the buffer that the step adds.
TEST(AccessorContents, DoNotGiveBytesToAViewWithoutABuffer) {
  TempFolder folder;
  AssetText asset = overlapping();
  asset.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 8}});
  asset.write(folder);
  const ConvertReport report = welded(folder);
  EXPECT_FALSE(report.written);
  EXPECT_EQ(report.error,
            "/bufferViews/2/buffer refers to a buffer that does not exist (see 'gltfx fix')");
}

}  // namespace
}  // namespace gltfx
