// SPDX-License-Identifier: Apache-2.0
// What a person reads after a typical mistake, word for word. Each asset in cases/ has the text
// beside it that the program prints for it. After a wanted change of words run the test with
// GLTFX_UPDATE_GOLDEN=1 and read the difference before it is committed.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gltfx {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(GLTFX_SOURCE_DIR) / "tests/golden/cases"; }

bool is_asset(const fs::path& file) {
  return file.extension() == ".gltf" || file.extension() == ".glb";
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (is_asset(entry.path())) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// The text format for one file, as a user in the asset's folder sees it in a pipe.
std::string printed(const std::string& name) {
  const FileReport report = validate_file(name);
  RunSummary summary;
  summary.add(report);
  FormatOptions options;
  options.command = "gltfx";
  const auto writer = make_report_writer(ReportFormat::text, options);
  std::string out;
  writer->begin(out);
  writer->file(report, out);
  writer->end(summary, out);
  return out;
}

// The report names files as they were given: relative names keep the golden files free of paths.
class InCasesFolder {
 public:
  InCasesFolder() : before_(fs::current_path()) { fs::current_path(folder()); }
  ~InCasesFolder() { fs::current_path(before_); }
  InCasesFolder(const InCasesFolder&) = delete;
  InCasesFolder& operator=(const InCasesFolder&) = delete;

 private:
  fs::path before_;
};

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, TextIsAsWritten) {
  const InCasesFolder here;
  const std::string text = printed(GetParam());
  const fs::path expected = fs::path(GetParam()).replace_extension(".expected.txt");
  if (std::getenv("GLTFX_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(expected, std::ios::binary) << text;
  }
  EXPECT_EQ(text, read(expected)) << "GLTFX_UPDATE_GOLDEN=1 rewrites " << expected;
}

// "01-trailing-comma.gltf" as the name of a test.
std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = fs::path(info.param).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-'; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(TypicalMistakes, Golden, testing::ValuesIn(case_names()), test_name);

TEST(GoldenFiles, ThereAreAtLeastTwentyMistakes) { EXPECT_GE(case_names().size(), 20U); }

TEST(GoldenFiles, NoTextIsLeftBehindWithoutItsAsset) {
  const std::vector<std::string> names = case_names();
  for (const auto& entry : fs::directory_iterator(folder())) {
    const std::string file = entry.path().filename().string();
    const std::size_t suffix = file.find(".expected.txt");
    if (suffix == std::string::npos) continue;
    const std::string stem = file.substr(0, suffix);
    const bool found = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return fs::path(name).stem() == stem;
    });
    EXPECT_TRUE(found) << file;
  }
}

}  // namespace
}  // namespace gltfx
