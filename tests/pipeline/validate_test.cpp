// SPDX-License-Identifier: Apache-2.0
// The calls a program makes: one file, many files, bytes, files that cannot be read.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace gltfx {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, removed with it.
class Validate : public ::testing::Test {
 protected:
  Validate() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) /
              ("gltfx_pipeline_" + std::string(test->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~Validate() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  static std::vector<std::string> codes(const FileReport& report) {
    std::vector<std::string> found;
    for (const Diagnostic& one : report.diagnostics) found.emplace_back(one.code);
    return found;
  }

  fs::path folder_;
};

using testing::ElementsAre;
using Codes = std::vector<std::string>;

const std::string kMinimal = R"({"asset": {"version": "2.0"}})";

// An asset with one buffer of four bytes at `uri`.
std::string with_buffer(const std::string& uri) {
  return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": ")" + uri +
         R"(", "extras": {}}], "bufferViews": [{"buffer": 0, "byteLength": 4}],
 "scenes": [{"extras": {"icon": 0}}], "images": [{"bufferView": 0, "mimeType": "image/png"}]})";
}

bool has(const FileReport& report, const std::string& code) {
  return std::any_of(report.diagnostics.begin(), report.diagnostics.end(),
                     [&](const Diagnostic& one) { return one.code == code; });
}

TEST_F(Validate, AFileThatIsNotThereIsUnreadable) {
  const FileReport report = validate_file((folder_ / "none.gltf").string());
  EXPECT_FALSE(report.readable);
  EXPECT_EQ(codes(report), Codes{"IO_ERROR"});
  EXPECT_EQ(report.counts.errors, 1U);
}

TEST_F(Validate, AFolderIsNoFile) { EXPECT_FALSE(validate_file(folder_.string()).readable); }

TEST_F(Validate, NamesTheFileAsItWasGiven) {
  const std::string path = write("a.gltf", kMinimal);
  const FileReport report = validate_file(path);
  EXPECT_EQ(report.path, path);
  EXPECT_EQ(report.mime_type, "model/gltf+json");
  EXPECT_TRUE(report.diagnostics.empty());
}

TEST_F(Validate, FindsBuffersBesideTheAsset) {
  write("data.bin", "1234");
  EXPECT_FALSE(has(validate_file(write("a.gltf", with_buffer("data.bin"))), "IO_ERROR"));
  EXPECT_TRUE(has(validate_file(write("b.gltf", with_buffer("other.bin"))), "IO_ERROR"));
}

TEST_F(Validate, OpensNothingOutsideTheFolderUnlessARootIsNamed) {
  write("data.bin", "1234");
  const std::string path = write("models/a.gltf", with_buffer("../data.bin"));
  EXPECT_TRUE(has(validate_file(path), "URI_OUTSIDE_ROOT"));
  ValidateOptions options;
  options.root = folder_.string();
  const FileReport report = validate_file(path, options);
  EXPECT_FALSE(has(report, "URI_OUTSIDE_ROOT"));
  EXPECT_FALSE(has(report, "IO_ERROR"));
}

TEST_F(Validate, BytesWithoutARootLookNothingUp) {
  const FileReport report = validate_bytes(with_buffer("data.bin"), "-");
  EXPECT_TRUE(has(report, "RESOURCE_NOT_CHECKED"));
  EXPECT_EQ(report.counts.errors, 0U) << codes(report).front();
}

TEST_F(Validate, AnAssetInMemoryHasItsResourcesFromAFunction) {
  std::vector<std::string> asked;
  const ReadResource read = [&](const std::string& uri) -> std::optional<std::string> {
    if (asked.empty() || asked.back() != uri) asked.push_back(uri);  // the dry run of a fix repeats
    if (uri == "some%20data.bin") return "1234";
    return std::nullopt;
  };
  ValidateOptions options;
  options.jobs = 1;
  const auto validated = [&](const std::string& uri) {
    return validate_bytes({with_buffer(uri), "a.gltf", AssetFormat::detect, read}, options);
  };
  EXPECT_FALSE(has(validated("some data.bin"), "IO_ERROR"));
  EXPECT_TRUE(has(validated("https://example.org/a.bin"), "IO_ERROR"));
  EXPECT_TRUE(has(validated("../../data.bin"), "IO_ERROR"));
  EXPECT_THAT(asked, ElementsAre("some%20data.bin", "https://example.org/a.bin", "../../data.bin"));
  EXPECT_FALSE(has(validated("data:application/octet-stream;base64,AAAAAA=="), "IO_ERROR"));
  EXPECT_EQ(asked.size(), 3U);
}

TEST_F(Validate, AFunctionOfPathsIsAskedForThoseBelowTheAssetAlone) {
  std::vector<std::string> asked;
  const auto validated = [&](const std::string& uri) {
    MemoryAsset asset{with_buffer(uri), "a.gltf", AssetFormat::detect, {}};
    asset.names = MemoryAsset::Names::paths;
    asset.read = [&](const std::string& path) -> std::optional<std::string> {
      asked.push_back(path);
      return "1234";
    };
    ValidateOptions options;
    options.jobs = 1;
    return validate_bytes(std::move(asset), options);
  };
  EXPECT_FALSE(has(validated("sub/../some%20data.bin"), "IO_ERROR"));
  EXPECT_THAT(asked, ElementsAre("some data.bin"));
  for (const char* uri :
       {"../a", "sub/../../a", "%2e%2e/a", "%2E%2E%2Fa", "%2Fdev/zero", "..%5Ca", "a//../../b"}) {
    EXPECT_TRUE(has(validated(uri), "URI_OUTSIDE_ROOT")) << uri;
  }
  for (const char* uri :
       {"/dev/zero", "//host/a", "file:///dev/zero", "https://example.org/a", "C:/a"}) {
    EXPECT_GT(validated(uri).counts.errors + validated(uri).counts.warnings, 0U) << uri;
  }
  EXPECT_EQ(asked.size(), 1U) << asked.back();
}

TEST_F(Validate, AnAssetInMemoryIsWhatItIsSaidToBe) {
  const auto validated = [](AssetFormat format) {
    return validate_bytes({kMinimal, "a", format, {}});
  };
  EXPECT_EQ(validated(AssetFormat::detect).counts.errors, 0U);
  EXPECT_EQ(validated(AssetFormat::gltf).counts.errors, 0U);
  EXPECT_TRUE(has(validated(AssetFormat::glb), "GLB_INVALID_MAGIC"));
  EXPECT_EQ(validated(AssetFormat::glb).mime_type, "model/gltf-binary");
}

TEST_F(Validate, ManyFilesComeBackInOrderWhateverTheThreads) {
  std::vector<std::string> paths;
  for (int i = 0; i < 200; ++i) {
    paths.push_back(write(std::to_string(i) + ".gltf", i % 3 == 0 ? "{" : kMinimal));
  }
  for (const unsigned jobs : {1U, 2U, 8U}) {
    std::vector<std::string> seen;
    std::uint64_t errors = 0;
    validate_files(paths, {}, jobs, [&](FileReport&& report) {
      seen.push_back(report.path);
      errors += report.counts.errors;
    });
    EXPECT_EQ(seen, paths) << jobs;
    EXPECT_EQ(errors, 67U) << jobs;
  }
}

// Errors of all phases in a text that is large enough for several threads.
std::string large_asset() {
  std::string nodes, accessors;
  for (int i = 0; i < 30000; ++i) {
    if (i > 0) nodes += ',';
    nodes += R"({"children": [)";
    nodes += std::to_string(i + 1);
    nodes += R"(], "scale": [1, 1, "x"]})";
    if (i % 30 != 0) continue;
    if (i > 0) accessors += ',';
    accessors += R"({"bufferView": 7, "count": 0})";
  }
  return R"({"asset": {"version": "2.0"}, "nodes": [)" + nodes + R"(], "accessors": [)" +
         accessors + R"(], "images": [{"uri": "none.png"}], "scenes": [{"nodes": [0, 5]}]})";
}

TEST_F(Validate, ALargeFileGivesTheSameReportWhateverTheThreads) {
  const std::string path = write("large.gltf", large_asset());
  ASSERT_GT(fs::file_size(path), std::uintmax_t{1} << 20U);
  std::vector<std::string> first;
  for (const unsigned jobs : {1U, 2U, 0U, 2U}) {
    ValidateOptions options;
    options.profile = Profile::khronos;
    options.jobs = jobs;
    std::vector<std::string> found;
    for (const Diagnostic& one : validate_file(path, options).diagnostics) {
      found.push_back(std::string(one.code) + " " + one.pointer);
    }
    EXPECT_GT(found.size(), 30000U);
    if (first.empty()) first = found;
    EXPECT_EQ(found, first) << jobs;
  }
}

TEST_F(Validate, NoFilesAreNoWork) {
  validate_files({}, {}, 2, [](FileReport&&) { FAIL(); });
}

}  // namespace
}  // namespace gltfx
