// SPDX-License-Identifier: Apache-2.0
/// The data of the report page. Its rendering in a browser is tested in tests/page.
#include <gltfx/page.hpp>

#include <algorithm>
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support.hpp"

namespace gltfx::report {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::array<RuleDescription, 2> kRules{{{.code = "A_RULE",
                                                  .severity = Severity::error,
                                                  .summary = "It is <b>so",
                                                  .why = "why",
                                                  .help = "what to do",
                                                  .section = "",
                                                  .link = "",
                                                  .bad = "{}",
                                                  .good = "{}",
                                                  .fix_does = "",
                                                  .fixed = ""},
                                                 {.code = "OTHER_RULE",
                                                  .severity = Severity::info,
                                                  .summary = "other",
                                                  .why = "why",
                                                  .help = "what to do",
                                                  .section = "",
                                                  .link = "",
                                                  .bad = "{}",
                                                  .good = "{}",
                                                  .fix_does = "",
                                                  .fixed = ""}}};

std::string page_of(const std::vector<PageAsset>& assets) {
  PageOptions options;
  options.title = "</title><script>";
  options.profile = "default";
  options.pixel_level = "headers";
  options.rules = kRules;
  PageWriter writer(options);
  std::string out;
  RunSummary summary;
  writer.begin(out);
  for (const PageAsset& asset : assets) {
    writer.asset(asset, out);
    summary.add(asset.report);
  }
  writer.end(summary, out);
  return out;
}

std::string data_of(const std::string& page) {
  const std::string begin = R"(<script id="data" type="application/json">)";
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

PageAsset hostile() {
  const std::string text = "{\"a\": \"</script><img src=x onerror=alert(1)>\"}";
  PageAsset asset;
  asset.report = testing::file(
      "<img>.gltf\xff\x01",
      {testing::on(testing::finding("A_RULE", Severity::error, "<!--<script>", "/a"), text,
                   "\"</script><img src=x onerror=alert(1)>\""),
       testing::times(testing::finding("A_RULE", Severity::error, "more", "/b/0"), 3, "/b/2")});
  asset.inspection.path = asset.report.path;
  AssetFacts facts;
  facts.mime_type = "model/gltf+json";
  facts.generator = "\xE2\x80\xAE</script\xE2\x80\xA8";
  facts.meshes.resize(40);
  asset.inspection.facts = facts;
  asset.inspection.upgrade.resize(60);
  asset.picture.problem = "it is <b>dark";
  asset.upgraded.emplace().uri = "data:image/webp;base64,AAAA";
  return asset;
}

TEST(Page, ListsTheTargetsOfAllAssetsOnce) {
  PageAsset first, second;
  first.targets = {"three.js 0.187.0", "<Engine> 1"};
  second.targets = {"Blender 3.4.1", "three.js 0.187.0"};
  const Json data = Json::parse(data_of(page_of({first, second})));
  EXPECT_EQ(data["targets"], Json({"<Engine> 1", "Blender 3.4.1", "three.js 0.187.0"}));
}

TEST(Page, TextOfAssetsStaysInsideTheData) {
  const std::string page = page_of({hostile()});
  EXPECT_EQ(count(page, "<script"), 2U);
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_THAT(data_of(page), AllOf(Not(HasSubstr("<")), Not(HasSubstr("\xE2\x80\xA8"))));
  const Json data = Json::parse(data_of(page));
  EXPECT_EQ(data["title"], "</title><script>");
  const Json& asset = data["assets"][0];
  EXPECT_EQ(asset["path"], "<img>.gltf\xEF\xBF\xBD\x01");
  EXPECT_EQ(asset["findings"][0]["excerpt"]["text"],
            "{\"a\": \"</script><img src=x onerror=alert(1)>\"}");
  EXPECT_EQ(asset["findings"][0]["column"], 7);
  EXPECT_EQ(asset["findings"][1]["count"], 3);
  EXPECT_EQ(asset["findings"][1]["lastPointer"], "/b/2");
  EXPECT_EQ(asset["facts"]["generator"], "\xE2\x80\xAE</script\xE2\x80\xA8");
}

TEST(Page, LongListsAreCutAndSaySo) {
  const Json asset = Json::parse(data_of(page_of({hostile()})))["assets"][0];
  EXPECT_EQ(asset["facts"]["meshes"].size(), 12U);
  EXPECT_EQ(asset["facts"]["counts"]["meshes"], 40);
  EXPECT_EQ(asset["upgrade"].size(), 50U);
  EXPECT_EQ(asset["upgradeOmitted"], 10);
}

TEST(Page, HasPicturesOrTheReasonWhyNot) {
  const Json asset = Json::parse(data_of(page_of({hostile()})))["assets"][0];
  EXPECT_EQ(asset["picture"], Json::parse(R"({"problem": "it is <b>dark"})"));
  EXPECT_EQ(asset["upgraded"]["src"], "data:image/webp;base64,AAAA");
}

TEST(Page, ExplainsTheRulesThatFoundSomething) {
  PageAsset unreadable;
  unreadable.report = testing::file("gone.gltf");
  unreadable.report.readable = false;
  const Json data = Json::parse(data_of(page_of({hostile(), unreadable})));
  EXPECT_EQ(data["rules"].size(), 1U);
  EXPECT_EQ(data["rules"]["A_RULE"]["summary"], "It is <b>so");
  EXPECT_EQ(data["summary"]["files"], 2);
  EXPECT_EQ(data["summary"]["unreadable"], 1);
  EXPECT_EQ(data["summary"]["errors"], 4);
  EXPECT_EQ(data["assets"][1]["readable"], false);
  EXPECT_EQ(Json::parse(data_of(page_of({})))["assets"].size(), 0U);
}

// Nothing is fetched, and nothing runs but the page's own script.
TEST(Page, AllowsNothingFromOutside) {
  const std::string page = page_of({hostile()});
  EXPECT_THAT(page, HasSubstr("default-src 'none'; img-src data:; style-src 'sha256-"));
  EXPECT_THAT(page,
              AllOf(Not(HasSubstr("src=\"http")), Not(HasSubstr("@import")), Not(HasSubstr("url(")),
                    Not(HasSubstr("<link")), Not(HasSubstr("innerHTML")), Not(HasSubstr("@STYLE")),
                    Not(HasSubstr("@SCRIPT")), Not(HasSubstr("@DATA"))));
  EXPECT_EQ(page, page_of({hostile()}));
}

}  // namespace
}  // namespace gltfx::report
