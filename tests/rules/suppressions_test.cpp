// SPDX-License-Identifier: Apache-2.0
// Findings that an asset suppresses, and findings outside the changed lines.
#include <string>

#include <gtest/gtest.h>

#include "rules/selected.hpp"

namespace gltfx::test {
namespace {

ValidateOptions enabled() {
  ValidateOptions options;
  options.inline_suppressions = true;
  return options;
}

// Three unused materials, one of which has extras.
std::string materials(const std::string& extras) {
  return R"({"asset": {"version": "2.0"}, "materials": [{"name": "a"}, {"name": "b", "extras": )" +
         extras + R"(}, {"name": "c"}]})";
}

std::string wish(const std::string& entries) {
  return R"({"gltfx": {"ignore": [)" + entries + "]}}";
}

const std::string kUnused = R"({"code": "UNUSED_OBJECT", "reason": "by name"})";

TEST(Suppressions, AreNotHeardUnasked) {
  EXPECT_EQ(verdict(materials(wish(kUnused))), Lines{"UNUSED_OBJECT /materials/0 x3"});
  ValidateOptions khronos = enabled();
  khronos.profile = Profile::khronos;
  EXPECT_EQ(verdict(materials(wish(kUnused)), khronos).size(), 3U);
}

TEST(Suppressions, LeaveOutWhatIsFoundOnTheObjectBeforeRepeatsAreFolded) {
  EXPECT_EQ(verdict(materials(wish(kUnused)), enabled()), Lines{"UNUSED_OBJECT /materials/0 x2"});
  EXPECT_EQ(validate_bytes(materials(wish(kUnused)), "a", enabled()).left_out, 1U);
}

TEST(Suppressions, ReachWhatLiesBelowAndNothingBeside) {
  const std::string wrong = R"({"asset": {"version": "2.0"},
      "nodes": [{"camera": 0, "rotation": [0, 0, 0, 3], "extras": )" +
                            wish(R"({"code": "VALUE_NOT_IN_RANGE", "reason": "r"})") +
                            R"(}, {"camera": 0, "rotation": [0, 0, 0, 3]}],
      "scene": 0, "scenes": [{"nodes": [0, 1]}],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})";
  ValidateOptions options = enabled();
  options.select = {"VALUE_NOT_IN_RANGE"};
  EXPECT_EQ(verdict(wrong, options), Lines{"VALUE_NOT_IN_RANGE /nodes/1/rotation/3"});
}

TEST(Suppressions, OfTheRootReachEverything) {
  const std::string text = R"({"asset": {"version": "2.0"}, "extras": )" + wish(kUnused) +
                           R"(, "materials": [{}], "nodes": [{"name": "n", "extras": {}}]})";
  EXPECT_EQ(verdict(text, enabled()), Lines{});
}

TEST(Suppressions, KeysAreReadAsTheyAreMeant) {
  EXPECT_EQ(verdict(materials(R"({"\u0067ltfx": {"ignore": [)" + kUnused + "]}}"), enabled()),
            Lines{"UNUSED_OBJECT /materials/0 x2"});
  // Not directly in extras: the member of another program.
  EXPECT_EQ(verdict(materials(R"({"a": {"gltfx": {"ignore": [3]}}})"), enabled()),
            Lines{"UNUSED_OBJECT /materials/0 x3"});
}

TEST(Suppressions, ThatLeaveNothingOutAreNamed) {
  const std::string text = R"({"asset": {"version": "2.0", "extras": )" + wish(kUnused) + "}}";
  EXPECT_EQ(verdict(text, enabled()), Lines{"SUPPRESSION_UNUSED /asset/extras/gltfx/ignore/0"});
  // The rule is not enabled anyway.
  ValidateOptions options = enabled();
  options.ignore = {"UNUSED_OBJECT"};
  EXPECT_EQ(verdict(text, options), Lines{});
}

TEST(Suppressions, ForOtherRunsThanThisOneAreNoMistake) {
  for (const char* code : {"BUDGET_TRIANGLES", "NORMAL_MAP_INWARD"}) {
    if (find_rule(code) == nullptr) continue;
    const std::string text = R"({"asset": {"version": "2.0", "extras": )" +
                             wish(R"({"code": ")" + std::string(code) + R"(", "reason": "r"})") +
                             "}}";
    EXPECT_EQ(verdict(text, enabled()), Lines{}) << code;
  }
}

TEST(Suppressions, WithoutAReasonCountButAreNamed) {
  EXPECT_EQ(verdict(materials(wish(R"({"code": "UNUSED_OBJECT", "reason": ""})")), enabled()),
            (Lines{"UNUSED_OBJECT /materials/0 x2",
                   "SUPPRESSION_WITHOUT_REASON /materials/1/extras/gltfx/ignore/0"}));
}

TEST(Suppressions, ThatAreNotUnderstoodAreNamed) {
  ValidateOptions options = enabled();
  options.select = {"SUPPRESSION_INVALID"};
  for (const char* extras :
       {R"({"gltfx": 3})", R"({"gltfx": {}})", R"({"gltfx": {"ignore": "UNUSED_OBJECT"}})",
        R"({"gltfx": {"ignore": [1, 2]}})"}) {
    EXPECT_EQ(verdict(materials(extras), options),
              Lines{"SUPPRESSION_INVALID /materials/1/extras/gltfx"})
        << extras;
  }
  EXPECT_EQ(
      verdict(materials(wish(R"("UNUSED_OBJECT", {}, {"code": "NOPE"}, {"code": 3})")), options),
      Lines{"SUPPRESSION_INVALID /materials/1/extras/gltfx/ignore/0 x4"});
}

TEST(Suppressions, DoNotReachThemselves) {
  const std::string text =
      materials(wish(kUnused + R"(, {"code": "SUPPRESSION_UNUSED", "reason": "r"})"));
  EXPECT_EQ(verdict(text, enabled()), (Lines{"UNUSED_OBJECT /materials/0 x2"}));
}

Lines on_lines(std::vector<LineRange> lines, const std::string& text) {
  ValidateOptions options;
  options.changed_lines = std::move(lines);
  return verdict(text, options);
}

TEST(ChangedLines, KeepWhatIsFoundOnThem) {
  // Contains all three kinds of line ends.
  const std::string text =
      "{\"asset\": {\"version\": \"2.0\"},\n\"materials\": [{\"name\": \"a\"},\r\n{\"name\": "
      "\"b\"},\r{\"name\": \"c\"}]}";
  EXPECT_EQ(on_lines({{1, 9}}, text), Lines{"UNUSED_OBJECT /materials/0 x3"});
  EXPECT_EQ(on_lines({{3, 3}}, text), Lines{"UNUSED_OBJECT /materials/1"});
  EXPECT_EQ(on_lines({{4, 4}, {2, 2}}, text), Lines{"UNUSED_OBJECT /materials/0 x2"});
  EXPECT_EQ(on_lines({{3, 3}, {3, 4}}, text), Lines{"UNUSED_OBJECT /materials/1 x2"});
  EXPECT_EQ(on_lines({{1, 1}}, text), Lines{});
  EXPECT_EQ(on_lines({{5, 7}}, text), Lines{});
  EXPECT_EQ(on_lines({}, text), Lines{});
}

TEST(ChangedLines, KeepErrorsOfTheTextAtItsEnd) {
  const std::string text = "{\"asset\": {\"version\": \"2.0\"}\n";
  EXPECT_EQ(on_lines({{1, 2}}, text).size(), 1U);
  EXPECT_EQ(on_lines({}, text).size(), 0U);
}

TEST(ChangedLines, KeepWhatHasNoPlaceWhenAnythingChanged) {
  EXPECT_EQ(on_lines({{1, 1}}, "").size(), 1U);
  EXPECT_EQ(on_lines({}, "").size(), 0U);
}

}  // namespace
}  // namespace gltfx::test
