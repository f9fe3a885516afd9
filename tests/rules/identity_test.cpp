// SPDX-License-Identifier: Apache-2.0
// Files of other versions or formats than glTF 2.0 get one finding that names the format.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rules/verdict.hpp"
#include "sanitized.hpp"

namespace gltfx {
namespace {

using Lines = std::vector<std::string>;

TEST(Identity, NamesVersion1AndSaysNothingElse) {
  EXPECT_EQ(test::verdict(R"({"asset": {"version": "1.0"}, "nodes": {"a": {}}})"),
            Lines{"GLTF_VERSION_1 "});
}

TEST(Identity, NamesVersion1WithoutAnAssetObject) {
  EXPECT_EQ(test::verdict(R"({"meshes": {"a": {}}, "techniques": {"t": {}}, "scene": "s"})"),
            Lines{"GLTF_VERSION_1 "});
}

TEST(Identity, NamesVersion1WrittenAsANumber) {
  for (const std::string version : {"1", "1.0", "1.1"}) {
    EXPECT_EQ(test::verdict(R"({"asset": {"version": )" + version + R"(}, "nodes": {"a": {}}})"),
              Lines{"GLTF_VERSION_1 "});
  }
  EXPECT_EQ(test::verdict(R"({"asset": {"version": 2.0}})"), Lines{"TYPE_MISMATCH /asset/version"});
  EXPECT_EQ(test::verdict(R"({"asset": {"version": 0.9}})"), Lines{"TYPE_MISMATCH /asset/version"});
}

TEST(Identity, NamesTheDraftOf21AndChecksOn) {
  const Lines wanted{"GLTF_VERSION_2_1_DRAFT /asset/version", "UNEXPECTED_PROPERTY /a"};
  EXPECT_EQ(test::verdict(R"({"asset": {"version": "2.1"}, "a": 1})"), wanted);
}

const std::string kPointer =
    "version https://git-lfs.github.com/spec/v1\n"
    "oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\n"
    "size 12345\n";

// Three bytes each, with many times as much memory; a large asset may have more.
TEST(Identity, MoreObjectsThanTextForThemAreOneFinding) {
  const auto nodes = [](std::size_t count, const std::string& node) {
    std::string text = R"({"asset": {"version": "2.0"}, "nodes": [)" + node;
    text.reserve(text.size() + (node.size() + 1) * count);
    for (std::size_t i = 1; i < count; ++i) text.append(1, ',').append(node);
    return text + "]}";
  };
  EXPECT_EQ(test::verdict(nodes(1'200'000, "{}")), Lines{"TOO_MANY_OBJECTS "});
  EXPECT_EQ(test::verdict(nodes(1'200'000, "0")), Lines{"TOO_MANY_OBJECTS "});
  if (kSanitized) return;  // the following part takes ten times as long there
  EXPECT_NE(test::verdict(nodes(900'000, "0")), Lines{"TOO_MANY_OBJECTS "});
  const std::string real = R"({"extras":"0123456789012345678901"})";
  EXPECT_NE(test::verdict(nodes(1'200'000, real)), Lines{"TOO_MANY_OBJECTS "});
  // The Khronos validator has no such limit: all objects are checked.
  ValidateOptions options;
  options.profile = Profile::khronos;
  options.select = {"UNRESOLVED_REFERENCE"};
  const std::string broken = R"({"mesh":0})";
  EXPECT_EQ(validate_bytes(nodes(1, broken), "test", options).counts.errors, 1U);
  EXPECT_EQ(validate_bytes(nodes(1'200'000, "{}").insert(30, R"("scene": 7, )"), "test", options)
                .counts.errors,
            1U);
}

TEST(Identity, NamesAGitLfsPointer) {
  const FileReport report = validate_bytes(kPointer, "model.glb");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].code, "GIT_LFS_POINTER");
  EXPECT_EQ(report.diagnostics[0].severity, Severity::info);
  EXPECT_EQ(report.unverified, 1U);
}

TEST(Identity, GitLfsPointerIsAnErrorOnRequest) {
  ValidateOptions options;
  options.lfs = LfsPolicy::error;
  EXPECT_EQ(validate_bytes(kPointer, "model.gltf", options).counts.errors, 1U);
}

TEST(Identity, AnEmptyFileIsNoAsset) { EXPECT_EQ(test::verdict(""), Lines{"INVALID_JSON "}); }

TEST(Identity, JsonUnderTheNameOfAGlbIsToldSo) {
  const FileReport report = validate_bytes(R"({"asset": {"version": "2.0"}})", "a.glb");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].code, "GLB_INVALID_MAGIC");
  EXPECT_NE(report.diagnostics[0].help.find(".gltf"), std::string::npos);
}

}  // namespace
}  // namespace gltfx
