// SPDX-License-Identifier: Apache-2.0
// `gltfx fix` is about the findings of `gltfx validate`, and fails for those of the same
// severities.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using testing::HasSubstr;

// A hint, fixed by a target for the view of the positions.
const std::string kHint = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

class FixOptionsOf : public testing::Test {
 protected:
  Outcome run_here(std::vector<std::string> words) {
    return gltfx(std::move(words), {folder_.path().native(), {}, {}});
  }
  // Both verbs, with the same options.
  void expect_codes(const std::vector<std::string>& options, int code) {
    std::vector<std::string> validate{"validate", "a.gltf"}, fix{"fix", "a.gltf", "--check"};
    validate.insert(validate.end(), options.begin(), options.end());
    fix.insert(fix.end(), options.begin(), options.end());
    EXPECT_EQ(run_here(validate).code, code) << testing::PrintToString(options);
    EXPECT_EQ(run_here(fix).code, code) << testing::PrintToString(options);
  }

  container::test::TempFolder folder_;
};

TEST_F(FixOptionsOf, CheckAgreesWithValidate) {
  folder_.write("a.gltf", kHint);
  expect_codes({}, 0);
  expect_codes({"--profile", "strict", "--fail-on", "warning"}, 0);
  const std::string loud = "BUFFER_VIEW_TARGET_MISSING=warning";
  expect_codes({"--severity", loud, "--fail-on", "warning"}, 1);
  expect_codes({"--severity", loud, "--fail-on", "error"}, 0);
  expect_codes({"--severity", loud, "--fail-on", "never"}, 0);
  expect_codes({"--severity", loud, "--ignore", "BUFFER_VIEW_TARGET_MISSING", "--fail-on", "info"},
               0);
}

TEST_F(FixOptionsOf, CheckFailsForAnyFixUnlessToldOtherwise) {
  folder_.write("a.gltf", kHint);
  EXPECT_EQ(run_here({"fix", "a.gltf", "--check", "--profile", "strict"}).code, 1);
  EXPECT_EQ(run_here({"fix", "a.gltf", "--check", "--only", "BUFFER_VIEW_TARGET_MISSING"}).code, 1);
  EXPECT_EQ(run_here({"fix", "a.gltf", "--profile", "strict"}).code, 0);
}

TEST_F(FixOptionsOf, TheConfigurationHoldsForBothVerbs) {
  folder_.write("a.gltf", kHint);
  folder_.write("gltfx.toml",
                "profile = \"strict\"\nfail-on = \"warning\"\n"
                "[[overrides]]\npaths = [\"b/**\"]\nignore = [\"BUFFER_VIEW_TARGET_MISSING\"]\n");
  folder_.write("b/a.gltf", kHint);
  expect_codes({}, 0);
  EXPECT_THAT(run_here({"fix", "a.gltf"}).out, HasSubstr("1 finding can be fixed"));
  EXPECT_THAT(run_here({"fix", "b/a.gltf"}).out, HasSubstr("nothing to fix"));
}

}  // namespace
}  // namespace gltfx::program
