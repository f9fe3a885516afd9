// SPDX-License-Identifier: Apache-2.0
/// `gltfx compare --format markdown`: what a reviewer reads first, names that attack, the limit.
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class CompareMarkdownOutput : public testing::Test {
 protected:
  // An asset with nodes of that name, at that place.
  void put(const std::string& path, const std::string& name, double x, int nodes = 1,
           int indent = -1) const {
    nlohmann::json asset = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    for (int i = 0; i < nodes; ++i) {
      asset["scenes"][0]["nodes"].push_back(i);
      asset["nodes"].push_back(
          {{"name", i == 0 ? name : name + " " + std::to_string(i)}, {"translation", {x, i, 0}}});
    }
    folder_.write(path, asset.dump(indent));
  }
  void put_pair(const std::string& path, const std::string& name, double x, int nodes = 1) const {
    put("old/" + path, name, 0, nodes);
    put("new/" + path, name, x, nodes);
  }
  std::string compare() const {
    const Outcome outcome =
        gltfx({"compare", at("old"), at("new"), "--format", "markdown", "--allow", "differs"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }
  std::string at(const std::string& path) const { return (folder_.path() / path).native(); }
  static std::size_t count(std::string_view text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t i = text.find(part); i != text.npos; i = text.find(part, i + 1)) ++found;
    return found;
  }

  container::test::TempFolder folder_;
};

TEST_F(CompareMarkdownOutput, TellsFirstWhatChangedInEachAsset) {
  put_pair("a/same.gltf", "Door", 0);
  put("old/b/stored.gltf", "Door", 0);
  put("new/b/stored.gltf", "Door", 0, 1, 2);
  put("new/c/come.gltf", "Door", 0);
  put_pair("d/moved.gltf", "Door", 2);
  put_pair("e/many.gltf", "Door", 1, 3);
  const std::string text = compare();
  EXPECT_THAT(text, StartsWith("**5 assets: 2 differ, 1 added, 1 only stored differently, "
                               "1 identical**\n\n"
                               "| asset | what changed |\n|---|---|\n"
                               "| c/come\\.gltf | added |\n"
                               "| d/moved\\.gltf | 'Door' moved by 2 along x |\n"
                               "| e/many\\.gltf | 3 node.moved |\n\n"
                               "### c/come\\.gltf\n\n**added**\n"));
  EXPECT_THAT(text, HasSubstr("### e/many\\.gltf\n\n**differs: 3 node.moved**\n\n"
                              "| change | place | kind |\n|---|---|---|\n"
                              "| 'Door' moved by 1 along x \\(position 50\\%\\) | "
                              "/nodes/0/translation | node.moved |\n"));
  EXPECT_THAT(text, HasSubstr("<details><summary>1 asset only stored differently</summary>\n\n"
                              "- b/stored\\.gltf: files "));
  EXPECT_THAT(text, Not(HasSubstr("same")));
}

TEST_F(CompareMarkdownOutput, OfOnePairHasNoTotals) {
  put_pair("a.gltf", "Door", 2);
  EXPECT_THAT(compare(), StartsWith("### a\\.gltf\n\n**differs**\n\n| change | place | kind |\n"));
}

TEST_F(CompareMarkdownOutput, HasNoMarkupLinksOrMentionsOfNames) {
  const std::pair<std::string, std::string> names[] = {
      {"@user #12 !13 GH-14 a@b.example :smile:",
       R"(@&#8203;user \#&#8203;12 \!&#8203;13 GH\-&#8203;14 a@&#8203;b\.example \:&#8203;smile\:)"},
      {"https://example.org www.d.example 50%",
       R"(https\:&#8203;//example\.org www\.&#8203;d\.example 50\%)"},
      {"![e](f) [g](javascript:h) <img src=i> <!--",
       R"(\!\[e\]\(f\) \[g\]\(javascript\:&#8203;h\) &lt;img src=i&gt; &lt;\!\-\-)"},
      {"`j` | k **l** \xE2\x80\xAE m\n# n &amp;",
       R"(\`j\` &#124; k \*\*l\*\* \\u202e m\\u000a\# n &amp;&#8203;amp;)"}};
  for (const auto& [name, shown] : names) put_pair(std::to_string(shown.size()) + ".gltf", name, 2);
  const std::string text = compare();
  for (const auto& [name, shown] : names) {
    EXPECT_THAT(text, HasSubstr("| '" + shown + "' moved by 2 along x"));
  }
}

TEST_F(CompareMarkdownOutput, OfManyPairsEndsAtARowAndCountsTheRest) {
  for (int i = 0; i < 300; ++i) {
    put_pair(std::string(100, '_') + std::to_string(i) + ".gltf", std::string(10'000, '*'), 2);
  }
  const std::string text = compare();
  EXPECT_LE(text.size(), 60'000U);
  EXPECT_GE(text.size(), 40'000U);
  EXPECT_THAT(text, StartsWith("**300 assets: 300 differ**\n\n"));
  const std::size_t listed = count(text, "\n### ");
  EXPECT_GT(listed, 20U);
  EXPECT_THAT(text,
              HasSubstr("\n" + std::to_string(300 - listed) + " more pairs are not listed.\n"));
  EXPECT_EQ(count(text, "<details>"), count(text, "</details>"));
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    ASSERT_NE(end, text.npos);
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    EXPECT_EQ(line.starts_with('|'), line.ends_with('|')) << line;
    begin = end + 1;
  }
}

TEST_F(CompareMarkdownOutput, OfManyChangesFoldsAndCounts) {
  put_pair("a.gltf", "Door", 2, 2'000);
  put_pair("b.gltf", "Gate", 2, 30);
  const std::string text = compare();
  EXPECT_LE(text.size(), 60'000U);
  const std::size_t next = text.find("### b\\.gltf");
  ASSERT_NE(next, text.npos) << "a long section leaves room for the others";
  const std::string first = text.substr(0, next);
  const std::size_t rows = count(first, " | node.moved |\n");
  EXPECT_THAT(
      first,
      AllOf(HasSubstr("<summary>" + std::to_string(rows - 20) + " more changes</summary>"),
            HasSubstr("\n" + std::to_string(2'000 - rows) + " more changes are not listed.\n")));
  EXPECT_EQ(count(text.substr(next), " | node.moved |\n"), 30U);
}

}  // namespace
}  // namespace gltfx::program
