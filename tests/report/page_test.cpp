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
                                                  .fixed = "",
                                                  .group = ""},
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
                                                  .fixed = "",
                                                  .group = ""}}};

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

PageAsset with_requirements() {
  PageAsset asset;
  asset.report = testing::file("leaf.gltf");
  asset.report.requirements = testing::requirements();
  return asset;
}

// Three meshes with that many triangles, of which a limit allows 100.
std::vector<Requirement> of_meshes(std::array<double, 3> triangles) {
  std::vector<Requirement> all;
  for (const double value : triangles) {
    Requirement one;
    one.measure = "triangles";
    one.on = "mesh";
    one.op = "max";
    one.limit = 100.0;
    one.from = "gltfx.toml:3";
    one.value = value;
    one.pointer = "/meshes/" + std::to_string(all.size());
    one.verdict = value > 100 ? Verdict::fail : Verdict::pass;
    all.push_back(one);
  }
  return all;
}

Json requirements_on_page(const PageAsset& asset) {
  return Json::parse(data_of(page_of({asset})))["assets"][0]["requirements"];
}

TEST(Page, ListsTheRequirements) {
  const Json all = requirements_on_page(with_requirements());
  ASSERT_EQ(all.size(), 7U);
  EXPECT_EQ(
      all[0],
      Json::parse(
          R"({"key": "mesh triangles max 1000", "measure": "triangles", "on": "mesh", "op": "max",
      "limit": 1000, "from": "gltfx.toml:8", "severity": "error", "value": 1250, "verdict": "fail",
      "failed": 1, "elements": [{"pointer": "/meshes/0", "object": "Body", "value": 1250}]})"));
  EXPECT_EQ(all[1]["unit"], "m");
  EXPECT_EQ(all[1]["verdict"], "pass");
  EXPECT_FALSE(all[1].contains("failed"));
  EXPECT_EQ(all[5]["verdict"], "not-measured");
  EXPECT_EQ(all[5]["notMeasured"], 1);
  EXPECT_EQ(all[5]["value"], nullptr);
  EXPECT_EQ(all[6]["verdict"], "not-applicable");
  EXPECT_EQ(all[6]["parameters"], "angle 30 deg");
  EXPECT_EQ(all[6]["key"], "mesh hard-edges max 90 (angle 30 deg)");
}

TEST(Page, LimitsThatDifferInParametersAreTwoRequirements) {
  PageAsset asset = with_requirements();
  asset.report.requirements = of_meshes({90, 30, 95});
  for (Requirement other : of_meshes({90, 300, 95})) {
    other.parameters = "weld 0.001 m";
    asset.report.requirements.push_back(other);
  }
  asset.previous = asset.report.requirements;
  const Json all = requirements_on_page(asset);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NE(all[0]["key"], all[1]["key"]);
  EXPECT_EQ(all[0]["before"]["value"], 95);
  EXPECT_EQ(all[1]["before"]["value"], 300);
}

TEST(Page, KeysOfLongLimitsAreShortAndDiffer) {
  PageAsset asset = with_requirements();
  asset.report.requirements = of_meshes({1, 1, 1});
  for (std::size_t i = 0; i < 3; ++i) {
    asset.report.requirements[i].limit = std::string(5000, 'a') + std::to_string(i % 2);
  }
  const Json all = requirements_on_page(asset);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NE(all[0]["key"], all[1]["key"]);
  EXPECT_LT(all[0]["key"].get<std::string>().size(), 300U);
}

TEST(Page, ALimitOnManyElementsIsOneRequirement) {
  PageAsset asset = with_requirements();
  asset.report.requirements = of_meshes({90, 300, 120});
  const Json all = requirements_on_page(asset);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]["value"], 300) << "the one furthest beyond the limit";
  EXPECT_EQ(all[0]["failed"], 2);
  EXPECT_EQ(all[0]["elements"].size(), 2U);
  asset.report.requirements = of_meshes({90, 30, 95});
  const Json held = requirements_on_page(asset);
  EXPECT_EQ(held[0]["value"], 95) << "the one nearest to the limit";
  EXPECT_FALSE(held[0].contains("elements"));
}

TEST(Page, ElementsBeyondALimitAreCutAfterTheFirst) {
  PageAsset asset = with_requirements();
  asset.report.requirements.clear();
  for (int i = 0; i < 10; ++i) {
    for (const Requirement& one : of_meshes({200, 20, 300})) {
      asset.report.requirements.push_back(one);
    }
  }
  const Json all = requirements_on_page(asset);
  EXPECT_EQ(all[0]["failed"], 20);
  EXPECT_EQ(all[0]["elements"].size(), 10U);
}

TEST(Page, HasTheValuesOfAnEarlierRun) {
  PageAsset asset = with_requirements();
  asset.report.requirements = of_meshes({90, 300, 120});
  asset.previous = of_meshes({80, 150, 70});
  EXPECT_EQ(requirements_on_page(asset)[0]["before"],
            Json::parse(R"({"value": 150, "verdict": "fail", "failed": 1})"));
  // The limit was another one, or there was none.
  for (Requirement& one : asset.previous) one.limit = 1000.0;
  EXPECT_EQ(requirements_on_page(asset)[0]["before"]["value"], 150);
  for (Requirement& one : asset.previous) one.measure = "vertices";
  EXPECT_FALSE(requirements_on_page(asset)[0].contains("before"));
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
TEST(Page, ListsExternalAssetsBesideTheCounts) {
  PageAsset asset;
  asset.report = testing::file("main.gltf", {});
  std::vector<Diagnostic> many(60, testing::finding("OTHER_RULE", Severity::info, "told", "/a"));
  asset.report.external_assets = {
      testing::file("parts/a.gltf", {testing::finding("A_RULE", Severity::error, "bad", "/b")}),
      testing::file("parts/b.gltf", std::move(many))};
  const Json data = Json::parse(data_of(page_of({asset})));
  const Json& listed = data["assets"][0]["externalAssets"];
  ASSERT_EQ(listed.size(), 2U);
  EXPECT_EQ(listed[0]["path"], "parts/a.gltf");
  EXPECT_EQ(listed[0]["counts"]["errors"], 1);
  EXPECT_EQ(listed[0]["findings"][0]["message"], "bad");
  EXPECT_EQ(listed[1]["findings"].size(), 50U);
  EXPECT_EQ(listed[1]["findingsOmitted"], 10);
  EXPECT_EQ(data["assets"][0]["counts"]["errors"], 0);
  EXPECT_EQ(data["summary"]["errors"], 0);
  EXPECT_TRUE(data["rules"].contains("A_RULE"));
  EXPECT_FALSE(Json::parse(data_of(page_of({hostile()})))["assets"][0].contains("externalAssets"));
}

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
