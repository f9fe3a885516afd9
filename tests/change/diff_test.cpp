// SPDX-License-Identifier: Apache-2.0
#include "change/diff.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gltfx::change {
namespace {

std::string diff(const std::string& text, const std::vector<json::Edit>& edits) {
  std::string all = unified_diff(text, edits, "a.gltf");
  const std::string head = "--- a/a.gltf\n+++ b/a.gltf\n";
  EXPECT_EQ(all.substr(0, head.size()), all.empty() ? "" : head);
  return all.empty() ? all : all.substr(head.size());
}

TEST(Diff, OfNothingIsEmpty) { EXPECT_EQ(diff("a\nb\n", {}), ""); }

TEST(Diff, ShowsALineWithThreeAroundIt) {
  EXPECT_EQ(diff("1\n2\n3\n4\n5\n6\n7\n8\n9\n", {{{8, 9}, "five"}}),
            "@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n");
}

TEST(Diff, ARemovedLineLeavesItsNeighbourAlone) {
  EXPECT_EQ(diff("{\n  1,\n  2\n}\n", {{{4, 9}, ""}}), "@@ -1,4 +1,3 @@\n {\n-  1,\n   2\n }\n");
}

TEST(Diff, CloseChangesShareAHunkAndDistantOnesDoNot) {
  const std::string text = "0\n1\n2\n3\n4\n5\n6\n7\n8\n9\n";
  EXPECT_EQ(diff(text, {{{0, 1}, "a"}, {{14, 15}, "b"}}),
            "@@ -1,10 +1,10 @@\n-0\n+a\n 1\n 2\n 3\n 4\n 5\n 6\n-7\n+b\n 8\n 9\n");
  EXPECT_EQ(diff(text, {{{0, 1}, "a\nb"}, {{16, 17}, "c"}}),
            "@@ -1,4 +1,5 @@\n-0\n+a\n+b\n 1\n 2\n 3\n@@ -6,5 +7,5 @@\n 5\n 6\n 7\n-8\n+c\n 9\n");
}

TEST(Diff, SaysWhereTheLastLineHasNoEnd) {
  EXPECT_EQ(diff("{}", {{{1, 1}, "\"a\":1"}}),
            "@@ -1,1 +1,1 @@\n-{}\n\\ No newline at end of file\n+{\"a\":1}\n"
            "\\ No newline at end of file\n");
}

TEST(Diff, NamesAreQuotedAsGitQuotesThem) {
  const auto header = [](const std::string& name) {
    const std::string all = unified_diff("1\n", std::vector<json::Edit>{{{0, 1}, "2"}}, name);
    return all.substr(0, all.find('\n'));
  };
  EXPECT_EQ(header("deep/-'a'.gltf"), "--- a/deep/-'a'.gltf");
  EXPECT_EQ(header("a b.gltf"), "--- a/a b.gltf\t");
  EXPECT_EQ(header("a \"b\\\t\n\x01\x7f\xC3\xA4"), R"(--- "a/a \"b\\\t\n\001\177\303\244")");
}

TEST(Diff, AMarkStandsBeforeEveryLine) {
  EXPECT_EQ(unified_diff("1\n", std::vector<json::Edit>{{{0, 1}, "2"}}, "a", "# "),
            "# --- a/a\n# +++ b/a\n# @@ -1,1 +1,1 @@\n# -1\n# +2\n");
}

// Applies a diff in which all lines have line breaks.
std::string patched(const std::string& text, const std::string& diff) {
  std::istringstream old_lines(text);
  std::istringstream lines(diff);
  std::string out;
  std::string old;
  std::size_t at = 1;
  for (std::string line; std::getline(lines, line);) {
    if (line.substr(0, 2) == "@@") {
      for (const std::size_t begin = std::stoul(line.substr(4)); at < begin; ++at) {
        std::getline(old_lines, old);
        out += old + '\n';
      }
      continue;
    }
    if (line[0] != '+') {
      std::getline(old_lines, old);
      EXPECT_EQ(old, line.substr(1));
      ++at;
    }
    if (line[0] != '-') out += line.substr(1) + '\n';
  }
  while (std::getline(old_lines, old)) out += old + '\n';
  return out;
}

TEST(Diff, OfRandomEditsLeadsToTheNewText) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    std::string text;
    for (int i = 0; i < 60; ++i)
      text += std::string(random() % 4, static_cast<char>('a' + i % 26)) + '\n';
    std::vector<json::Edit> edits;
    for (std::uint32_t at = 0; at + 12 < text.size();) {
      at += static_cast<std::uint32_t>(1 + random() % 40);
      const auto end = at + static_cast<std::uint32_t>(random() % 8);
      if (end >= text.size()) break;
      edits.push_back({{at, end}, random() % 2 == 0 ? "X\nY" : ""});
      at = end + 1;
    }
    ASSERT_EQ(patched(text, diff(text, edits)), json::apply_edits(text, edits)) << text;
  }
}

}  // namespace
}  // namespace gltfx::change
