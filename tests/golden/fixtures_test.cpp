// SPDX-License-Identifier: Apache-2.0
// Each asset under fixtures/ has its verdict beside it: one line "CODE /pointer" (or "CODE @byte")
// a finding, " xN" where N were folded, and nothing at all for a good one. What pixels tell beyond
// headers stands in files of its own, named by the level.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gltfx {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(GLTFX_SOURCE_DIR) / "fixtures"; }

bool is_asset(const fs::path& file) {
  return file.extension() == ".gltf" || file.extension() == ".glb";
}

std::vector<std::string> assets() {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder())) {
    if (is_asset(entry.path())) files.push_back(fs::relative(entry.path(), folder()).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Where more than headers is looked at, `level` is how far.
fs::path expectation(const std::string& asset, const std::string& level = {}) {
  return folder() / (asset + ".expect" + (level.empty() ? "" : "-") + level);
}

std::vector<std::string> expected(const std::string& asset, const std::string& level = {}) {
  std::vector<std::string> lines;
  std::ifstream in(expectation(asset, level));
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> found(const std::string& asset, Profile profile,
                               PixelLevel pixels = PixelLevel::headers) {
  ValidateOptions options;
  options.profile = profile;
  if (profile == Profile::standard) options.pixels = pixels;
  // Assets of that folder refer to each other.
  const std::string together = "gltf-2.1/";
  if (asset.starts_with(together)) options.root = (folder() / together).string();
  std::vector<std::string> lines;
  for (const Diagnostic& one : validate_file((folder() / asset).string(), options).diagnostics) {
    std::string line(one.code);
    if (one.offset) line += " @" + std::to_string(*one.offset);
    if (!one.pointer.empty()) line += " " + one.pointer;
    if (one.count > 1) line += " x" + std::to_string(one.count);
    lines.push_back(line);
  }
  return lines;
}

class Fixture : public testing::TestWithParam<std::string> {};

TEST_P(Fixture, YieldsWhatStandsBesideIt) {
  ASSERT_TRUE(fs::exists(expectation(GetParam())));
  EXPECT_EQ(found(GetParam(), Profile::standard), expected(GetParam()));
}

TEST_P(Fixture, YieldsMoreWherePixelsAreLookedAt) {
  for (const PixelLevel pixels : {PixelLevel::needed, PixelLevel::all}) {
    const std::string level(pixel_level_name(pixels));
    if (!fs::exists(expectation(GetParam(), level))) continue;
    EXPECT_EQ(found(GetParam(), Profile::standard, pixels), expected(GetParam(), level)) << level;
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Fixture, testing::ValuesIn(assets()), test_name);

TEST(Fixtures, ThereAreGoodModelsAndBadOnes) {
  const std::vector<std::string> all = assets();
  const auto good = std::count_if(all.begin(), all.end(),
                                  [](const std::string& asset) { return expected(asset).empty(); });
  EXPECT_GE(all.size(), 25U);
  EXPECT_GE(good, 10);
  EXPECT_GE(static_cast<std::ptrdiff_t>(all.size()) - good, 10);
}

// A hint on a model that is meant as an example would teach the wrong thing, unless it is what the
// example is about.
TEST(Fixtures, GoodModelsRaiseNoHintEither) {
  for (const std::string& asset : assets()) {
    if (expected(asset).empty()) {
      EXPECT_EQ(found(asset, Profile::strict), expected(asset, "strict")) << asset;
    }
  }
}

}  // namespace
}  // namespace gltfx
