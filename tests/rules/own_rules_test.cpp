// SPDX-License-Identifier: Apache-2.0
/// Rules of users, as a library runs them.
#include <gltfx/own_rules.hpp>
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/own_rule.hpp"
#include "rules/selected.hpp"
#include "rules/verdict.hpp"

namespace gltfx::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> mistakes_in(const std::string& file, const std::string& text) {
  return read_own_rules(std::vector<OwnRulePage>{{file, text}}).mistakes;
}

// Objects of each kind, none of which is broken.
const std::string kAll = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0, "children": [1]}, {"camera": 0}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0},
                             {"attributes": {"POSITION": 0}}]}],
  "materials": [{}], "textures": [{"sampler": 0, "source": 0}], "samplers": [{}],
  "images": [{"bufferView": 0, "mimeType": "image/png"}],
  "skins": [{"joints": [0]}],
  "animations": [{"samplers": [{"input": 1, "output": 2}],
                  "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
  "buffers": [{"byteLength": 400, "uri": "b.bin"}],
  "bufferViews": [{"buffer": 0, "byteLength": 40}],
  "accessors": [
    {"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [1]},
    {"componentType": 5126, "count": 3, "type": "VEC3"}]})";

TEST(OwnRules, CheckEachKindOfObject) {
  const std::string never = R"({"not": {}})";
  const auto places = [&](const std::string& on) { return verdict(kAll, with_rule(on, never)); };
  EXPECT_THAT(places("glTF"), ElementsAre("ACME_RULE "));
  EXPECT_THAT(places("asset"), ElementsAre("ACME_RULE /asset"));
  EXPECT_THAT(places("scene"), ElementsAre("ACME_RULE /scenes/0"));
  EXPECT_THAT(places("camera"), ElementsAre("ACME_RULE /cameras/0"));
  EXPECT_THAT(places("mesh"), ElementsAre("ACME_RULE /meshes/0"));
  EXPECT_THAT(places("primitive"), ElementsAre("ACME_RULE /meshes/0/primitives/0 x2"));
  EXPECT_THAT(places("material"), ElementsAre("ACME_RULE /materials/0"));
  EXPECT_THAT(places("texture"), ElementsAre("ACME_RULE /textures/0"));
  EXPECT_THAT(places("sampler"), ElementsAre("ACME_RULE /samplers/0"));
  EXPECT_THAT(places("image"), ElementsAre("ACME_RULE /images/0"));
  EXPECT_THAT(places("skin"), ElementsAre("ACME_RULE /skins/0"));
  EXPECT_THAT(places("animation"), ElementsAre("ACME_RULE /animations/0"));
  EXPECT_THAT(places("accessor"), ElementsAre("ACME_RULE /accessors/0 x3"));
  EXPECT_THAT(places("bufferView"), ElementsAre("ACME_RULE /bufferViews/0"));
  EXPECT_THAT(places("buffer"), ElementsAre("ACME_RULE /buffers/0"));
}

TEST(OwnRules, FindTheObjectAndSayWhatDoesNotFit) {
  ValidateOptions options = with_rule("node", R"({"properties": {"name": {"pattern": "^N_"}}})");
  const FileReport report =
      validate_bytes(asset_with(R"("nodes": [{"name": "N_a"}, {"name": "b"}])"), "a.gltf", options);
  ASSERT_THAT(report.diagnostics, SizeIs(1));
  const Diagnostic& finding = report.diagnostics[0];
  EXPECT_EQ(finding.code, "ACME_RULE");
  EXPECT_EQ(finding.pointer, "/nodes/1");
  EXPECT_EQ(finding.message, "It does not fit.");
  EXPECT_EQ(finding.help, "/nodes/1/name: 'b' does not match '^N_'");
  EXPECT_EQ(finding.object_name, "b");
  EXPECT_EQ(finding.location.line, 1U);
}

TEST(OwnRules, SeeWhatTheTextOfAnObjectDoesNotSay) {
  const std::string asset = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"name": "top", "children": [1, 2]}, {"name": "mid", "mesh": 0, "children": [3]},
                {"mesh": 1}, {"name": "low"}],
      "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                     "max": [1, 1, 0]}],
      "meshes": [{"name": "door", "primitives": [{"attributes": {"POSITION": 0}}]},
                 {"primitives": [{"attributes": {"POSITION": 0}}]}]})";
  const auto found = [&](const std::string& on, const std::string& members) {
    const ValidateOptions options = with_rule(
        on, R"({"not": {"properties": {"gltfx": )" + members + R"(}, "required": ["gltfx"]}})");
    Lines lines;
    for (const Diagnostic& one :
         validate_bytes(asset, "./x/../rooms/hall.old.gltf", options).diagnostics) {
      lines.push_back(one.pointer + (one.count > 1 ? " x" + std::to_string(one.count) : ""));
    }
    return lines;
  };
  const auto equals = [](const std::string& name, const std::string& value) {
    return R"({"required": [")" + name + R"("], "properties": {")" + name + R"(": {"const": )" +
           value + "}}}";
  };
  EXPECT_EQ(found("node", equals("index", "2")), Lines{"/nodes/2"});
  EXPECT_EQ(found("node", equals("mesh", "\"door\"")), Lines{"/nodes/1"});
  EXPECT_EQ(found("node", equals("mesh", "\"\"")), Lines{"/nodes/2"});
  EXPECT_EQ(found("node", equals("parent", "\"mid\"")), Lines{"/nodes/3"});
  EXPECT_EQ(found("node", R"({"not": {"required": ["parent"]}})"), Lines{"/nodes/0"});
  EXPECT_EQ(found("node", equals("root", "\"top\"")), Lines{"/nodes/0 x4"});
  EXPECT_EQ(found("primitive", equals("mesh", "\"door\"")), Lines{"/meshes/0/primitives/0"});
  EXPECT_EQ(found("asset", equals("stem", "\"hall.old\"")), Lines{"/asset"});
  EXPECT_EQ(found("glTF", equals("path", "\"rooms/hall.old.gltf\"")), Lines{""});
}

TEST(OwnRules, SeeAllOfALongText) {
  const std::string asset = R"({"asset": {"version": "2.0"}, "meshes": [{"name": ")" +
                            std::string(5000, 'a') +
                            R"(", "primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                     "max": [1, 1, 0]}]})";
  const auto ends_in = [](const std::string& sign) {
    return with_rule("mesh", R"({"properties": {"gltfx": {"required": ["name"],
        "properties": {"name": {"pattern": ")" +
                                 sign + R"($"}}}}})");
  };
  EXPECT_THAT(verdict(asset, ends_in("a")), IsEmpty());
  EXPECT_THAT(verdict(asset, ends_in("b")), ElementsAre("ACME_RULE /meshes/0"));
}

TEST(OwnRules, LeaveBrokenObjectsOut) {
  const std::string never = R"({"not": {}})";
  const auto places = [&](const std::string& on, const std::string& asset) {
    return verdict(asset_with(asset), with_rule(on, never));
  };
  EXPECT_THAT(places("node", R"("nodes": [{"name": 1}, {"mesh": 7}, {}, 5, {"scale": [1]}])"),
              ElementsAre("ACME_RULE /nodes/2"));
  EXPECT_THAT(places("mesh", R"("meshes": [{"primitives": [{"attributes": {"POSITION": 3}}]}])"),
              IsEmpty());
  // An error in one of its elements does not make the whole asset broken.
  EXPECT_THAT(places("glTF", R"("nodes": [{"name": 1}])"), ElementsAre("ACME_RULE "));
  EXPECT_THAT(places("glTF", R"("scene": "a", "nodes": [{}])"), IsEmpty());
}

// What is left of an error in the report does not matter.
TEST(OwnRules, LeaveBrokenObjectsOutWhateverIsReported) {
  ValidateOptions options = with_rule("node", R"({"not": {}})");
  options.select.clear();
  options.ignore = {"TYPE_MISMATCH", "UNUSED_OBJECT", "NODE_EMPTY"};
  EXPECT_THAT(verdict(asset_with(R"("nodes": [{"name": 1}])"), options), IsEmpty());
  options.ignore.clear();
  options.severity = {{"TYPE_MISMATCH", Severity::hint}};
  options.select = {"ACME_RULE"};
  EXPECT_THAT(verdict(asset_with(R"("nodes": [{"name": 1}])"), options), IsEmpty());
}

TEST(OwnRules, AddToTheFindingsOfGltfx) {
  const std::string asset = asset_with(R"("nodes": [{"camera": 4}], "materials": [{}])");
  ValidateOptions with = with_rule("material", R"({"required": ["name"]})");
  with.select.clear();
  Lines expected = verdict(asset);
  expected.push_back("ACME_RULE /materials/0");
  EXPECT_EQ(verdict(asset, with), expected);
}

TEST(OwnRules, FollowTheOptionsForCodes) {
  const std::string asset = asset_with(R"("nodes": [{}])");
  ValidateOptions options = with_rule("node", R"({"required": ["name"]})");
  const auto severity = [&] {
    const FileReport report = validate_bytes(asset, "a.gltf", options);
    return report.diagnostics.empty()
               ? std::string()
               : std::string(severity_name(report.diagnostics.front().severity));
  };
  EXPECT_EQ(severity(), "error");
  options.severity = {{"ACME_RULE", Severity::info}};
  EXPECT_EQ(severity(), "info");
  options.ignore = {"ACME_RULE"};
  EXPECT_EQ(severity(), "");
  options.ignore.clear();
  options.profile = Profile::khronos;
  EXPECT_EQ(severity(), "");
}

TEST(OwnRules, ThatHintAreOptIn) {
  ValidateOptions options;
  options.own_rules =
      rules_of({{"ACME_RULE.md", page("ACME_RULE", "asset", "false", "severity: hint\n")}});
  const std::string asset = asset_with(R"("extras": {"a": 1})");
  EXPECT_THAT(verdict(asset, options), IsEmpty());
  options.profile = Profile::strict;
  EXPECT_THAT(verdict(asset, options), ElementsAre("ACME_RULE /asset"));
}

TEST(OwnRules, CanBeSuppressedInTheAsset) {
  ValidateOptions options = with_rule("node", R"({"required": ["name"]})");
  options.inline_suppressions = true;
  const std::string ignored = R"({"gltfx": {"ignore": [{"code": "ACME_RULE", "reason": "r"}]}})";
  EXPECT_THAT(
      verdict(asset_with(R"("nodes": [{"extras": )" + ignored + R"(}, {"extras": 1}])"), options),
      ElementsAre("ACME_RULE /nodes/1"));
  options.select.insert("SUPPRESSION_UNUSED");
  EXPECT_THAT(
      verdict(asset_with(R"("nodes": [{"name": "a", "extras": )" + ignored + "}]"), options),
      ElementsAre("SUPPRESSION_UNUSED /nodes/0/extras/gltfx/ignore/0"));
}

TEST(OwnRules, MistakesHaveTheLineOfThePage) {
  const auto mistake = [](const std::string& text) {
    const auto all = mistakes_in("house/ACME_RULE.md", text);
    EXPECT_THAT(all, SizeIs(1));
    return all.empty() ? std::string() : all.front();
  };
  const std::string good = page("ACME_RULE", "node", "{}");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return mistake(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(changed("# ACME_RULE", "# ACME_RUL"), "house/ACME_RULE.md:7: expected '# ACME_RULE'");
  EXPECT_THAT(changed("on: node", "on: noed"),
              AllOf(HasSubstr("ACME_RULE.md:3: "), HasSubstr("did you mean 'node'")));
  EXPECT_THAT(changed("severity: error", "severity: fatal"), HasSubstr("ACME_RULE.md:2: expected"));
  EXPECT_THAT(changed("severity: error\n", ""), HasSubstr("expected 'severity: error'"));
  EXPECT_THAT(changed("message:", "mesage:"), HasSubstr("did you mean 'message'"));
  EXPECT_THAT(changed("It does not fit.", "\"\""), HasSubstr("expected 'message: "));
  EXPECT_THAT(changed("It does not fit.", "\" \""), HasSubstr("expected 'message: "));
  EXPECT_THAT(changed("## Schema", "## Shema"), HasSubstr("expected '## Schema'"));
  EXPECT_THAT(changed("{}\n```\n\n## Bad", "{\n\"typ\": 1}\n```\n\n## Bad"),
              HasSubstr("ACME_RULE.md:23: 'typ' is no keyword of JSON Schema; did you mean"));
  EXPECT_THAT(mistake(""), HasSubstr("ACME_RULE.md:1: expected '---'"));
  EXPECT_THAT(mistake(std::string(300 << 10, ' ')), HasSubstr("bytes"));
}

TEST(OwnRules, NameMembersThatObjectsCanHave) {
  const auto mistakes = [](const std::string& on, const std::string& schema) {
    return mistakes_in("ACME_RULE.md", page("ACME_RULE", on, schema));
  };
  EXPECT_THAT(
      mistakes("mesh", R"({"properties": {
"gltfx": {"properties": {"open-edgs": {"maximum": 0}}}}})"),
      ElementsAre(AllOf(HasSubstr("ACME_RULE.md:23: "), HasSubstr("did you mean 'open-edges'"))));
  EXPECT_THAT(mistakes("mesh", R"({"properties": {"gltfx": {"required": ["uv-overlap"]}}})"),
              ElementsAre(HasSubstr("gltfx has no member 'uv-overlap'")));
  EXPECT_THAT(mistakes("mesh", R"({"properties": {"gltfx": {"required": ["parent"]}}})"),
              SizeIs(1));
  EXPECT_THAT(mistakes("node", R"({"properties": {"gltfx": {"required": ["parent"]}}})"),
              IsEmpty());
  EXPECT_THAT(mistakes("material", R"({"if": {"required": ["alphamode"]}, "then": false})"),
              ElementsAre(HasSubstr("did you mean 'alphaMode'")));
  // Extensions and extras have any members.
  EXPECT_THAT(mistakes("material", R"({"properties": {"extras": {"required": ["acme"]},
    "extensions": {"properties": {"KHR_materials_ior": {"required": ["ior"]}}}}})"),
              IsEmpty());
}

TEST(OwnRules, SayWhatCannotBeMeasured) {
  const std::string asset = asset_with(R"("buffers": [{"byteLength": 36, "uri": "missing.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])");
  ValidateOptions options =
      with_rule("mesh", R"({"properties": {"gltfx": {"properties": {"open-edges":
        {"maximum": 0}}}}})");
  options.select.insert("BUDGET_NOT_MEASURED");
  EXPECT_THAT(verdict(asset, options), ElementsAre("BUDGET_NOT_MEASURED /meshes/0"));
  options = with_rule("mesh", R"({"properties": {"name": {"type": "string"}}})");
  options.select.insert("BUDGET_NOT_MEASURED");
  EXPECT_THAT(verdict(asset, options), IsEmpty());
}

TEST(OwnRules, SeeTheDeviationFromTheProduct) {
  const std::string asset(find_measure("product-deviation")->example);
  ValidateOptions options = with_rule("glTF", R"({"properties": {"gltfx": {"properties":
    {"product-deviation": {"type": "number", "maximum": 3}}}}})");
  auto products = std::make_shared<ProductList>();
  products->others = {1, 0, 0};
  options.products = products;
  EXPECT_THAT(verdict(example_bytes(asset), options), ElementsAre("ACME_RULE "));
  products->others = {2, 0, 0};
  EXPECT_THAT(verdict(example_bytes(asset), options), IsEmpty());
}

TEST(OwnRules, CodesAreTheNamesOfTheirFilesAndNewOnes) {
  const auto about = [](const std::string& file, const std::string& code) {
    const auto all = mistakes_in(file, page(code, "node", "{}"));
    return all.empty() ? std::string() : all.front();
  };
  EXPECT_EQ(about("x/ACME_1.md", "ACME_1"), "");
  EXPECT_THAT(about("x/Acme_Rule.md", "Acme_Rule"), HasSubstr("is not a code"));
  EXPECT_THAT(about("x/ACME.md", "ACME"), HasSubstr("is not a code"));
  EXPECT_THAT(about("x/NODE_EMPTY.md", "NODE_EMPTY"), HasSubstr("is a rule of gltfx"));
  const std::string text = page("ACME_RULE", "node", "{}");
  const auto twice =
      read_own_rules(std::vector<OwnRulePage>{{"a/ACME_RULE.md", text}, {"b/ACME_RULE.md", text}});
  EXPECT_EQ(twice.rules, nullptr);
  EXPECT_THAT(twice.mistakes, ElementsAre(HasSubstr("another page has the code")));
}

TEST(OwnRules, AreAThousandAtMost) {
  std::vector<OwnRulePage> pages;
  for (int i = 0; i < 1005; ++i) {
    const std::string code = "ACME_" + std::to_string(i);
    pages.push_back({code + ".md", page(code, "node", "{}")});
  }
  EXPECT_THAT(read_own_rules(pages).mistakes,
              ElementsAre("ACME_1000.md:1: there are more than 1000 pages"));
  pages.resize(1000);
  EXPECT_EQ(rules(rules_of(pages).get()).size(), rules().size() + 1000);
}

TEST(OwnRules, AreListedWithThoseOfGltfx) {
  const auto own = rules_of({{"ACME_RULE.md", page("ACME_RULE", "node", "{}")}});
  EXPECT_EQ(rules(own.get()).size(), rules().size() + 1);
  EXPECT_TRUE(std::is_sorted(rules(own.get()).begin(), rules(own.get()).end(),
                             [](const auto& a, const auto& b) { return a.code < b.code; }));
  const RuleDescription* const rule = find_rule("ACME_RULE", own.get());
  ASSERT_NE(rule, nullptr);
  EXPECT_TRUE(rule->own);
  EXPECT_EQ(rule->summary, "Summary");
  EXPECT_EQ(find_rule("ACME_RULE", nullptr), nullptr);
  EXPECT_NE(find_rule("NODE_EMPTY", own.get()), nullptr);
}

// Reports outlive the rules.
TEST(OwnRules, ReportsKeepTheirCodes) {
  FileReport report;
  {
    const ValidateOptions options = with_rule("asset", "false");
    report = validate_bytes(asset_with(R"("extras": 1)"), "a.gltf", options);
  }
  ASSERT_THAT(report.diagnostics, SizeIs(1));
  EXPECT_EQ(report.diagnostics[0].code, "ACME_RULE");
}

class OwnRuleTemplates : public testing::TestWithParam<std::string_view> {};

TEST_P(OwnRuleTemplates, PassTheirOwnTest) {
  const auto own = rules_of({{"ACME_NEW.md", own_rule_template("ACME_NEW", GetParam())}});
  const OwnRuleTests tests = test_own_rules(own);
  EXPECT_EQ(tests.examples, 2U);
  EXPECT_THAT(tests.failures, IsEmpty());
  EXPECT_THAT(tests.notes, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Scopes, OwnRuleTemplates,
                         testing::ValuesIn(own_rule_scopes().begin(), own_rule_scopes().end()),
                         [](const auto& scope) { return std::string(scope.param); });

TEST(OwnRuleTemplates, AreOnlyMadeForCodesAndKinds) {
  EXPECT_EQ(own_rule_template("acme", "node"), "");
  EXPECT_EQ(own_rule_template("ACME_NEW", "nodes"), "");
}

TEST(OwnRuleTests, NameExamplesThatAreNotAsTheyShouldBe) {
  const std::string text = page("ACME_RULE", "node", R"({"required": ["name"]})");
  const auto with = [&](const std::string& bad, const std::string& good) {
    std::string changed = text;
    changed.replace(changed.rfind("{}"), 2, good);
    changed.replace(changed.rfind("{}", changed.find("## Good")), 2, bad);
    return test_own_rules(rules_of({{"house/ACME_RULE.md", changed}})).failures;
  };
  const std::string named = asset_with(R"("nodes": [{"name": "a"}])");
  const std::string unnamed = asset_with(R"("nodes": [{}])");
  EXPECT_THAT(with(unnamed, named), IsEmpty());
  EXPECT_THAT(with(named, named),
              ElementsAre("house/ACME_RULE.md:28: bad example: ACME_RULE does not report it"));
  EXPECT_THAT(with(unnamed, unnamed),
              ElementsAre(HasSubstr("house/ACME_RULE.md:34: good example: ACME_RULE reports it")));
  EXPECT_THAT(with(unnamed, "{"), ElementsAre(HasSubstr("is not an asset that can be checked")));
}

}  // namespace
}  // namespace gltfx::test
