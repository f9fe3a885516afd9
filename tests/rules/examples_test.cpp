// SPDX-License-Identifier: Apache-2.0
// The examples of `explain` are correct: every rule's bad example has that finding, its good one
// has none.
#include <gltfx/pipeline.hpp>
#include <gltfx/validate.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "rules/context.hpp"

namespace gltfx {
namespace {

// Codes that cannot occur alone, with the codes that accompany them and the reason.
const std::map<std::string_view, std::set<std::string_view>>& companions() {
  static const std::map<std::string_view, std::set<std::string_view>> table{
      // An element outside a bound makes the bound wrong.
      {"URI_NOT_ENCODED", {"IO_ERROR"}},
      {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", {"ACCESSOR_MIN_MISMATCH"}},
      {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", {"ACCESSOR_MAX_MISMATCH"}},
      // The repaired file has data, but the broken one has none.
      {"DATA_URI_GLB", {"URI_GLB"}},
      {"URI_GLB", {"NON_RELATIVE_URI"}},
      // A type is only unknown on a chunk before the BIN chunk.
      {"GLB_UNEXPECTED_BIN_CHUNK", {"GLB_UNKNOWN_CHUNK_TYPE"}},
      // The declared length is less than that of the chunk, and so of the file.
      {"GLB_CHUNK_TOO_BIG", {"GLB_LENGTH_MISMATCH"}},
      // The image gets a hint regardless of its users.
      {"TEXTURE_NOT_8_BIT", {"IMAGE_16_BIT"}},
      // Decoding stops because of an earlier finding.
      {"DRACO_NOT_CHECKED", {"DRACO_LIMIT_EXCEEDED"}},
      // An extension with an invalid name is unknown.
      {"INVALID_EXTENSION_NAME_FORMAT", {"UNSUPPORTED_EXTENSION"}},
      // Rules about an archived or draft extension, which is reported for every use.
      {"AUDIO_DISTANCE_ORDER", {"EXTENSION_DRAFT"}},
      {"AUDIO_EMITTER_NOT_GLOBAL", {"EXTENSION_DRAFT"}},
      {"AUDIO_MIME_TYPE_INVALID", {"EXTENSION_DRAFT"}},
      {"TECHNIQUE_SEMANTIC_UNKNOWN", {"EXTENSION_ARCHIVED"}},
      {"TECHNIQUE_VALUE_MISSING", {"EXTENSION_ARCHIVED"}},
      {"TECHNIQUE_VALUE_UNKNOWN", {"EXTENSION_ARCHIVED"}},
      {"GLB_TOO_MANY_CHUNKS", {"GLB_UNKNOWN_CHUNK_TYPE"}},
      // The BIN chunk would be the placeholder, so the streams are stored elsewhere.
      {"MESHOPT_FALLBACK_FIRST_IN_GLB", {"DATA_URI_GLB", "URI_GLB"}},
  };
  return table;
}

class Examples : public ::testing::TestWithParam<RuleDescription> {
 protected:
  static std::set<std::string> codes(Example example) {
    std::set<std::string> found;
    for (const Diagnostic& one : validate_example(GetParam(), example).diagnostics) {
      found.emplace(one.code);
    }
    // Every asset of a draft has it.
    if (GetParam().code != kDraftOfGltf) found.erase(std::string(kDraftOfGltf));
    return found;
  }
  static constexpr std::string_view kDraftOfGltf = "GLTF_VERSION_2_1_DRAFT";
};

TEST_P(Examples, BadRaisesTheRuleAndNothingElse) {
  const RuleDescription& rule = GetParam();
  std::set<std::string> found = codes(Example::bad);
  EXPECT_EQ(found.erase(std::string(rule.code)), 1U) << rule.bad;
  const auto along = companions().find(rule.code);
  if (along != companions().end()) {
    for (const std::string_view code : along->second) found.erase(std::string(code));
  }
  EXPECT_TRUE(found.empty()) << "also raises " << *found.begin() << "\n" << rule.bad;
}

// Examples use the profile `strict`, except for one code.
Severity expected_severity(const RuleDescription& rule) {
  if (rule.code == "INCOMPLETE_EXTENSION_SUPPORT") return rule.khronos_severity;
  // The page describes a case that is an error, which the fix corrects.
  if (rule.code == "NON_RELATIVE_URI") return Severity::error;
  const auto position = static_cast<std::size_t>(&rule - rules().data());
  return validate::strict_severity(static_cast<Code>(position));
}

TEST_P(Examples, BadHasTheSeverityOfThePage) {
  const RuleDescription& rule = *find_rule(GetParam().code);
  const auto found = validate_example(rule, Example::bad).diagnostics;
  const auto one = std::find_if(found.begin(), found.end(),
                                [&](const Diagnostic& each) { return each.code == rule.code; });
  ASSERT_NE(one, found.end());
  EXPECT_EQ(severity_name(one->severity), severity_name(expected_severity(rule)));
}

TEST_P(Examples, GoodRaisesNothing) {
  std::set<std::string> found = codes(Example::good);
  if (GetParam().code.substr(0, 10) == "TECHNIQUE_") found.erase("EXTENSION_ARCHIVED");
  if (GetParam().code.substr(0, 6) == "AUDIO_") found.erase("EXTENSION_DRAFT");
  EXPECT_TRUE(found.empty()) << "raises " << *found.begin() << "\n" << GetParam().good;
}

TEST_P(Examples, TextIsComplete) {
  const RuleDescription& rule = GetParam();
  EXPECT_FALSE(rule.summary.empty());
  EXPECT_NE(rule.summary.back(), '.');
  EXPECT_FALSE(rule.why.empty());
  EXPECT_FALSE(rule.help.empty());
}

INSTANTIATE_TEST_SUITE_P(Rules, Examples, ::testing::ValuesIn(rules().begin(), rules().end()),
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
