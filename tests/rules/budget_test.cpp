// SPDX-License-Identifier: Apache-2.0
// Limits set by the user.
#include <string>

#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

Lines against(const Budgets& budgets, const std::string& asset) {
  ValidateOptions options;
  options.budgets = budgets;
  options.select = {"BUDGET_DRAW_CALLS", "BUDGET_FILE_SIZE", "BUDGET_TEXTURE_SIZE",
                    "BUDGET_TOTAL_PIXELS", "BUDGET_TRIANGLES"};
  return verdict(asset, options);
}

std::string image_of(std::uint32_t width, std::uint32_t height) {
  return png({}, {width, height, 8, 2, 0});
}

std::string two_images() { return Textured{base_color(), {image_of(4, 2), image_of(2, 8)}}.text(); }

std::string two_primitives() {
  return asset_with(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}},
      {"attributes": {"POSITION": 0}}]}], "accessors": [{"componentType": 5126, "type": "VEC3",
      "count": 9, "min": [0, 0, 0], "max": [0, 0, 0]}])");
}

Budgets budget(std::uint64_t Budgets::*member, std::uint64_t value) {
  Budgets budgets;
  budgets.*member = value;
  return budgets;
}

TEST(Budget, NoneByDefault) {
  EXPECT_EQ(against({}, two_images()), Lines{});
  EXPECT_EQ(against({}, two_primitives()), Lines{});
}

TEST(Budget, OfTheLongerSideOfAnImage) {
  EXPECT_EQ(against(budget(&Budgets::texture_size, 8), two_images()), Lines{});
  EXPECT_EQ(against(budget(&Budgets::texture_size, 7), two_images()),
            Lines{"BUDGET_TEXTURE_SIZE /images/1"});
  EXPECT_EQ(against(budget(&Budgets::texture_size, 3), two_images()),
            Lines{"BUDGET_TEXTURE_SIZE /images/0 x2"});
}

TEST(Budget, OfAllPixels) {
  EXPECT_EQ(against(budget(&Budgets::total_pixels, 24), two_images()), Lines{});
  EXPECT_EQ(against(budget(&Budgets::total_pixels, 23), two_images()),
            Lines{"BUDGET_TOTAL_PIXELS /images"});
}

TEST(Budget, OfTrianglesAndDrawCalls) {
  EXPECT_EQ(against(budget(&Budgets::triangles, 6), two_primitives()), Lines{});
  EXPECT_EQ(against(budget(&Budgets::triangles, 5), two_primitives()),
            Lines{"BUDGET_TRIANGLES /meshes"});
  EXPECT_EQ(against(budget(&Budgets::draw_calls, 2), two_primitives()), Lines{});
  EXPECT_EQ(against(budget(&Budgets::draw_calls, 1), two_primitives()),
            Lines{"BUDGET_DRAW_CALLS /meshes"});
}

TEST(Budget, OfBytes) {
  const std::string asset = two_primitives();
  EXPECT_EQ(against(budget(&Budgets::file_size, asset.size()), asset), Lines{});
  EXPECT_EQ(against(budget(&Budgets::file_size, asset.size() - 1), asset),
            Lines{"BUDGET_FILE_SIZE "});
}

TEST(Budget, OfBytesIncludesFilesOnce) {
  const container::test::TempFolder folder;
  const std::string asset = asset_with(
      R"("buffers": [{"byteLength": 8, "uri": "a.bin"}, {"byteLength": 8, "uri": "./a.bin"}])");
  folder.write("a.gltf", asset);
  folder.write("a.bin", "12345678");
  ValidateOptions options;
  options.select = {"BUDGET_FILE_SIZE"};
  const auto found = [&](std::uint64_t limit) {
    options.budgets.file_size = limit;
    return validate_file((folder.path() / "a.gltf").string(), options).diagnostics.size();
  };
  EXPECT_EQ(found(asset.size() + 8), 0U);
  EXPECT_EQ(found(asset.size() + 7), 1U);
}

}  // namespace
}  // namespace gltfx::test
