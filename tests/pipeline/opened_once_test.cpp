// SPDX-License-Identifier: Apache-2.0
// Each verb opens, parses and validates an asset once; what it makes of the asset, once more.
#include <gltfx/pipeline.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

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

// Each input parses them to know what is below them.
TEST(OpenedOnce, ExternalAssetsOfSeveralInputs) {
  const container::test::TempFolder folder;
  const auto text = [](const std::string& uri) {
    return R"({"asset":{"version":"2.1"},"externalAssets":[{"file":0}],"files":[{"uri":")" + uri +
           R"(","mimeType":"model/gltf+json"}]})";
  };
  folder.write("parts/leg.gltf", R"({"asset":{"version":"2.1"},"meshes":7})");
  folder.write("parts/chair.gltf", text("leg.gltf"));
  std::vector<std::string> inputs;
  for (int i = 0; i < 6; ++i) {
    const std::string name = std::to_string(i % 2) + "/" + std::to_string(i) + ".gltf";
    folder.write(name, text("../parts/chair.gltf"));
    inputs.push_back(folder.path() / name);
  }
  ValidateOptions options;
  options.root = folder.path();
  for (const unsigned jobs : {1U, 4U}) {
    std::vector<FileReport> reports;
    const auto validate = [&] {
      validate_files(inputs, options, jobs,
                     [&](FileReport&& report) { reports.push_back(std::move(report)); });
    };
    EXPECT_EQ(work_of(validate).validated, inputs.size() + 2) << jobs;
    ASSERT_EQ(reports.size(), inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      ASSERT_EQ(reports[i].external_assets.size(), 2U);
      const std::string folder_of_input = inputs[i].substr(0, inputs[i].rfind('/') + 1);
      EXPECT_EQ(reports[i].external_assets[0].path, folder_of_input + "../parts/chair.gltf");
      EXPECT_EQ(reports[i].external_assets[0].diagnostics.size(),
                reports[0].external_assets[0].diagnostics.size());
      EXPECT_GT(reports[i].external_assets[1].counts.errors, 0U);
      EXPECT_EQ(reports[i].counts.errors, 1U);
    }
  }
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
