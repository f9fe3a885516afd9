// SPDX-License-Identifier: Apache-2.0
// Each verb opens, parses and validates an asset once; what it makes of the asset, once more.
#include <gltfx/pipeline.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "base/work_count.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

struct Work {
  std::uint64_t opened = 0, parsed = 0, validated = 0;
  bool operator==(const Work&) const = default;
};

void PrintTo(const Work& work, std::ostream* out) {
  *out << work.opened << " opened, " << work.parsed << " parsed, " << work.validated
       << " validated";
}

Work so_far() {
  return {work_count.opened.load(), work_count.parsed.load(), work_count.validated.load()};
}

Work work_of(const std::function<void()>& verb) {
  const Work before = so_far();
  verb();
  const Work after = so_far();
  return {after.opened - before.opened, after.parsed - before.parsed,
          after.validated - before.validated};
}

std::string copied_fixture(const std::string& name) {
  return std::string(GLTFX_SOURCE_DIR) + "/fixtures/" + name;
}

// Legacy textures: the upgrade looks for images that are left over, and adds some to the GLB.
const std::string kLegacyText = copied_fixture("legacy/shop.gltf");
const std::string kLegacyBinary = copied_fixture("legacy/lantern.glb");
const std::string kCurrent = copied_fixture("good/poster.glb");

PageAsset page_of(const std::string& path, ValidateOptions options = {}) {
  options.jobs = 1;
  const ValidateInput input{path, &options};
  PageAsset page;
  report_files({&input, 1}, {true, 32, {}}, 1, [&](PageAsset&& asset) { page = std::move(asset); });
  EXPECT_TRUE(page.inspection.facts) << page.inspection.error;
  EXPECT_FALSE(page.picture.uri.empty()) << page.picture.problem;
  return page;
}

TEST(OpenedOnce, ByThePageOfAReport) {
  EXPECT_EQ(work_of([] { EXPECT_FALSE(page_of(kCurrent).upgraded); }), (Work{1, 1, 1}));
  for (const std::string& path : {kLegacyText, kLegacyBinary}) {
    EXPECT_EQ(work_of([&] { EXPECT_TRUE(page_of(path).upgraded); }), (Work{1, 2, 2})) << path;
  }
}

TEST(OpenedOnce, ByThePageOfAnotherProfile) {
  ValidateOptions options;
  options.profile = Profile::khronos;
  EXPECT_EQ(work_of([&] { page_of(kCurrent, options); }), (Work{1, 1, 1}));
  options.profile = Profile::standard;
  options.ignore = {"UNUSED_OBJECT"};
  EXPECT_EQ(work_of([&] { page_of(kCurrent, options); }), (Work{1, 1, 1}));
}

TEST(OpenedOnce, ByValidation) {
  ValidateOptions options;
  EXPECT_EQ(work_of([&] { validate_file(kCurrent, options); }), (Work{1, 1, 1}));
  options.propose_fixes = true;  // judged by the text that they make
  EXPECT_EQ(work_of([&] { validate_file(kLegacyText, options); }), (Work{1, 2, 2}));
}

TEST(OpenedOnce, ByInspection) {
  EXPECT_EQ(work_of([] { inspect_file(kCurrent); }), (Work{1, 1, 1}));
  EXPECT_EQ(work_of([] { inspect_file(kLegacyBinary); }), (Work{1, 2, 2}));
}

TEST(OpenedOnce, ByAnUpgrade) {
  EXPECT_EQ(work_of([] { upgrade_file(kCurrent); }), (Work{1, 1, 0}));
  EXPECT_EQ(work_of([] { upgrade_file(kLegacyText); }), (Work{1, 2, 2}));
  const container::test::TempFolder folder;
  UpgradeOptions options;
  options.output = folder.path() / "new.glb";
  const auto write = [&] { EXPECT_TRUE(upgrade_file(kLegacyBinary, options).written); };
  EXPECT_EQ(work_of(write), (Work{1, 2, 2})) << "what is written was proven before";
  options.verify = true;
  EXPECT_EQ(work_of(write), (Work{1, 2, 2})) << "and drawn without another look";
}

TEST(OpenedOnce, ByBaking) {
  BakeOptions options;
  options.sizes = {{8, 8}};
  options.samples = 1;
  const auto bake = [&] { EXPECT_EQ(bake_file(kCurrent, options).problem, BakeProblem::none); };
  EXPECT_EQ(work_of(bake), (Work{1, 1, 1}));
}

}  // namespace
}  // namespace gltfx
