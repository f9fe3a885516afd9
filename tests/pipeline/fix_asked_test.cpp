// SPDX-License-Identifier: Apache-2.0
// Which findings are fixed: those that validation reports, with what it is asked for.
#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

// A hint: the view of the positions has no target. An info: the rotation of the matrix does
// nothing.
const std::string kQuietFindings = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[0,0,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"a.bin"}]})";

TEST(FixAsked, FixesWhatValidationReports) {
  const TempFolder folder;
  folder.write("a.bin", std::string(36, '\0'));
  const auto path = folder.write("a.gltf", kQuietFindings);
  const auto fixed_with = [&path](const auto& ask) {
    ValidateOptions asked;
    ask(asked);
    FixOptions options;
    options.validation = [&asked](const std::string& of) {
      EXPECT_TRUE(of.ends_with("a.gltf"));
      return asked;
    };
    const FixReport report = fix_file(path.native(), options);
    EXPECT_EQ(validate_file(path.native(), asked).fixable, report.fixed());
    std::vector<std::string> codes;
    for (const FixAction& action : report.actions) {
      if (action.done) codes.emplace_back(action.code);
    }
    return codes;
  };
  using Codes = std::vector<std::string>;
  const std::string hint = "BUFFER_VIEW_TARGET_MISSING", info = "NODE_MATRIX_DEFAULT";
  EXPECT_EQ(fixed_with([](ValidateOptions&) {}), Codes{info});
  EXPECT_EQ(fixed_with([](ValidateOptions& o) { o.profile = Profile::strict; }),
            (Codes{hint, info}));
  EXPECT_EQ(fixed_with([&](ValidateOptions& o) { o.select = {hint}; }), Codes{hint});
  EXPECT_EQ(fixed_with([&](ValidateOptions& o) { o.ignore = {info}; }), Codes{});
  EXPECT_EQ(fixed_with([&](ValidateOptions& o) {
              o.severity = {{hint, Severity::warning}};
            }),
            (Codes{hint, info}));
  EXPECT_EQ(fixed_with([&](ValidateOptions& o) {
              o.severity = {{info, Severity::hint}};
            }),
            Codes{});
}

TEST(FixAsked, FixesAHintThatIsNamed) {
  const TempFolder folder;
  folder.write("a.bin", std::string(36, '\0'));
  const auto path = folder.write("a.gltf", kQuietFindings);
  FixOptions options;
  options.only = {"BUFFER_VIEW_TARGET_MISSING"};
  const FixReport report = fix_file(path.native(), options);
  ASSERT_EQ(report.actions.size(), 1U);
  EXPECT_TRUE(report.actions[0].done);
  EXPECT_EQ(report.actions[0].severity, Severity::hint);
}

TEST(FixAsked, LeavesAloneWhatAnAssetMaySuppress) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[],
"extras":{"gltfx":{"ignore":[{"code":"EMPTY_ENTITY","reason":"a test"}]}}})");
  ValidateOptions asked;
  FixOptions options;
  options.validation = [&asked](const std::string&) { return asked; };
  EXPECT_TRUE(fix_file(path.native(), options).changes);
  asked.inline_suppressions = true;
  EXPECT_FALSE(fix_file(path.native(), options).changes);
}

}  // namespace
}  // namespace gltfx
