// SPDX-License-Identifier: Apache-2.0
// All good fixtures are converted for all built-in targets: each result is accepted, or what
// remains is named.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>

#include "targets_support.hpp"

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> good_fixtures() {
  std::vector<fs::path> assets;
  for (const auto& entry : fs::directory_iterator(fs::path(GLTFX_SOURCE_DIR) / "fixtures/good")) {
    const std::string ending = entry.path().extension().native();
    if (ending == ".gltf" || ending == ".glb") assets.push_back(entry.path());
  }
  std::sort(assets.begin(), assets.end());
  return assets;
}

std::uint64_t refusals(const std::string& path, const TargetChoice& choice) {
  ValidateOptions options;
  options.targets = {choice};
  options.select = {"TARGET_REFUSES"};
  return validate_file(path, options).counts.errors;
}

TEST(TargetFixtures, AreAcceptedOrNamed) {
  container::test::TempFolder folder;
  std::uint64_t converted = 0;
  for (const fs::path& fixture : good_fixtures()) {
    for (const auto& target : builtin_targets()) {
      const TargetChoice choice{target, target->versions.size() - 1};
      const std::string place = target->name + "/" + fixture.stem().native();
      ConvertOptions options = options_to(folder.path() / place / fixture.filename());
      options.targets = {choice};
      const ConvertReport report = convert_file(fixture.native(), options);
      const bool named = std::any_of(report.remaining.begin(), report.remaining.end(),
                                     [](const ConvertRemainder& each) { return each.refused; });
      if (named) {
        EXPECT_EQ(report.problem, EditProblem::refused) << place;
        EXPECT_FALSE(report.written) << place;
        continue;
      }
      EXPECT_TRUE(report.written) << place << ": " << report.error;
      if (!report.changes) continue;
      ++converted;
      EXPECT_EQ(refusals(options.output, choice), 0U) << place;
      // A second conversion has nothing to do.
      ConvertOptions again;
      again.targets = {choice};
      EXPECT_FALSE(convert_file(options.output, again).changes) << place;
    }
  }
  EXPECT_GT(converted, 0U);
}

// A smaller encoding is chosen among those that the target reads, and what it does not read goes
// even if the rest is larger.
TEST(TargetFixtures, AreAcceptedIfTheyShrink) {
  container::test::TempFolder folder;
  for (const char* name : {"leaf-basis.gltf", "kelp.gltf", "pebble.gltf"}) {
    const fs::path fixture = fs::path(GLTFX_SOURCE_DIR) / "fixtures/good" / name;
    for (const auto& target : builtin_targets()) {
      const std::string place = target->name + "/" + name;
      ConvertOptions options = options_to(folder.path() / place);
      options.targets = {{target, target->versions.size() - 1}};
      ConvertOptions plain = options;
      plain.output.clear();
      const bool accepted = convert_file(fixture.native(), plain).problem == EditProblem::none;
      options.shrink = true;
      const ConvertReport report = convert_file(fixture.native(), options);
      EXPECT_EQ(report.problem == EditProblem::none, accepted) << place << ": " << report.error;
    }
  }
}

}  // namespace
}  // namespace gltfx::test
