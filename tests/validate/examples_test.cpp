// SPDX-License-Identifier: Apache-2.0
// What `explain` shows is true: every rule's bad example raises that rule, its good one raises nothing.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include <gltfx/pipeline.hpp>
#include <gltfx/validate.hpp>

namespace gltfx {
namespace {

// Codes that cannot come alone, with those that come along and why.
const std::map<std::string_view, std::set<std::string_view>>& companions() {
  static const std::map<std::string_view, std::set<std::string_view>> table{
      // What lies outside a bound makes it wrong.
      {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", {"ACCESSOR_MIN_MISMATCH"}},
      {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", {"ACCESSOR_MAX_MISMATCH"}},
      // The repaired file has data where the broken one has none.
      {"DATA_URI_GLB", {"URI_GLB"}},
      {"URI_GLB", {"NON_RELATIVE_URI"}},
      // A type is only unknown on a chunk that stands before the BIN chunk.
      {"GLB_UNEXPECTED_BIN_CHUNK", {"GLB_UNKNOWN_CHUNK_TYPE"}},
      {"GLB_TOO_MANY_CHUNKS", {"GLB_UNKNOWN_CHUNK_TYPE"}},
  };
  return table;
}

// The ending of a file name decides what some faults are.
std::string name_for(std::string_view code) {
  if (code == "FILE_EXTENSION_MISMATCH") return "example.gltf";
  return code.substr(0, 4) == "GLB_" ? "example.glb" : "example";
}

class Examples : public ::testing::TestWithParam<RuleDescription> {
 protected:
  Examples() {
    options_.profile = Profile::strict;
    // What that profile leaves out is only left out there.
    if (GetParam().code == "INCOMPLETE_EXTENSION_SUPPORT") options_.profile = Profile::khronos;
    // Resources are looked up in an empty folder, but for the rule about not looking them up.
    if (GetParam().code != "RESOURCE_NOT_CHECKED") options_.root = folder();
  }

  static std::string folder() {
    const auto path = std::filesystem::path(::testing::TempDir()) / "gltfx_examples";
    std::filesystem::create_directories(path);
    return path.string();
  }

  std::set<std::string> codes(std::string_view example, const std::string& name) const {
    std::set<std::string> found;
    for (const Diagnostic& one : validate_bytes(example_bytes(example), name, options_).diagnostics) {
      found.emplace(one.code);
    }
    return found;
  }

  ValidateOptions options_;
};

TEST_P(Examples, BadRaisesTheRuleAndNothingElse) {
  const RuleDescription& rule = GetParam();
  std::set<std::string> found = codes(rule.bad, name_for(rule.code));
  EXPECT_EQ(found.erase(std::string(rule.code)), 1U) << rule.bad;
  const auto along = companions().find(rule.code);
  if (along != companions().end()) {
    for (const std::string_view code : along->second) found.erase(std::string(code));
  }
  EXPECT_TRUE(found.empty()) << "also raises " << *found.begin() << "\n" << rule.bad;
}

TEST_P(Examples, GoodRaisesNothing) {
  const std::set<std::string> found = codes(GetParam().good, "example");
  EXPECT_TRUE(found.empty()) << "raises " << *found.begin() << "\n" << GetParam().good;
}

TEST_P(Examples, TextIsComplete) {
  const RuleDescription& rule = GetParam();
  EXPECT_FALSE(rule.summary.empty());
  EXPECT_NE(rule.summary.back(), '.');
  EXPECT_FALSE(rule.why.empty());
  EXPECT_FALSE(rule.remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(Rules, Examples,
                         ::testing::ValuesIn(rules().begin(), rules().end()),
                         [](const auto& tested) { return std::string(tested.param.code); });

TEST(Rules, EveryCodeStandsOnce) {
  const auto all = rules();
  const auto repeat = std::adjacent_find(
      all.begin(), all.end(),
      [](const RuleDescription& a, const RuleDescription& b) { return a.code == b.code; });
  EXPECT_EQ(repeat, all.end()) << repeat->code;
}

}  // namespace
}  // namespace gltfx
