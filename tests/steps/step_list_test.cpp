// SPDX-License-Identifier: Apache-2.0
// docs/convert.md lists the steps with their descriptions.
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "container/temp_folder.hpp"
#include "steps/file_names.hpp"
#include "steps/step.hpp"
#include "target/embedded.hpp"
#include "target/target_file.hpp"

namespace gltfx::steps {
namespace {

using testing::HasSubstr;

TEST(Steps, AreDocumentedInOrder) {
  const std::string page =
      container::test::content_of(std::string(GLTFX_SOURCE_DIR) + "/docs/convert.md");
  std::string rows;
  for (const StepDescription& step : steps()) {
    rows += fmt::format("| {} | {} | {} | {} |\n", step.name, step.summary, step.keeps, step.loses);
  }
  EXPECT_THAT(page, HasSubstr(rows + "\n"));
}

TEST(Steps, AreSelectedByOptions) {
  ConvertOptions options;
  for (const StepDescription& step : steps()) EXPECT_FALSE(step.asked(options)) << step.name;
  options.to = StoredAs::glb;
  EXPECT_TRUE(steps().back().asked(options));
}

TEST(Steps, MakeEachRepairThatFeaturesName) {
  // The container is chosen by these.
  std::set<target::Repair> made{target::Repair::one_file, target::Repair::no_data_uris};
  for (const StepDescription& step : steps()) made.insert(step.repairs.begin(), step.repairs.end());
  EXPECT_EQ(made.size(), target::kRepairCount);
  const auto named = target::read_repairs(target::embedded_features());
  ASSERT_TRUE(named) << named.error().message;
  std::set<target::Repair> wanted;
  for (const auto& [feature, repair] : *named) wanted.insert(repair);
  EXPECT_EQ(wanted, made);
}

TEST(FileNames, AreCutBetweenCodePoints) {
  std::string name;
  for (int i = 0; i < 100; ++i) name += "\xF0\x9F\x8C\xBF";
  EXPECT_EQ(clean_name(name), name.substr(0, 4 * 56));
}

TEST(FileNames, AreUniqueIgnoringCase) {
  FileNames names({"Wood.png"});
  EXPECT_EQ(names.take("wood", ".png"), "wood-2.png");
  EXPECT_EQ(names.take("WOOD.PNG", ".png"), "WOOD-3.png");
  EXPECT_EQ(names.take("wood.jpeg", ".jpg"), "wood.jpg");
}

TEST(FileNames, HaveTheEndingOfTheirContent) {
  const auto bytes = [](std::string_view text) {
    return container::Bytes::from_string(std::string(text));
  };
  EXPECT_EQ(image_ending(bytes("\x89PNG\r\n\x1a\n......"), "image/jpeg"), ".png");
  EXPECT_EQ(image_ending(bytes("\xFF\xD8\xFF\xE0..........."), ""), ".jpg");
  EXPECT_EQ(image_ending(bytes("GIF89a.........."), "image/png"), ".gif");
  EXPECT_EQ(image_ending(bytes("something else"), "image/x-foo"), ".foo");
  EXPECT_EQ(image_ending(bytes("something else"), "image/../../a"), "");
}

}  // namespace
}  // namespace gltfx::steps
