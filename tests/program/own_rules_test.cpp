// SPDX-License-Identifier: Apache-2.0
/// Own rules: --rules, the key of gltfx.toml, and `gltfx rules`.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kExamples = fixture("../examples/house/rules");

std::string page(const std::string& code, const std::string& pattern) {
  const std::string node = R"({"asset": {"version": "2.0"}, "nodes": [{"name": ")";
  return "---\nseverity: error\non: node\nmessage: The node has another name.\nhelp: rename it\n"
         "link: https://example.com/names\n---\n\n# " +
         code +
         "\n\nNode with another name.\n\n## Why it matters\n\nThe loader of ACME needs it.\n\n"
         "## How to fix it\n\nRename it.\n\n## Schema\n\n```json\n"
         R"({"properties": {"name": {"pattern": ")" +
         pattern + "\"}}}\n```\n\n## Bad\n\n```json\n" + node +
         "x\"}]}\n```\n\n## Good\n\n```json\n" + node + "N_a\"}]}\n```\n";
}

class OwnRules : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("house/ACME_NODE_NAME.md", page("ACME_NODE_NAME", "^N_"));
    folder_.write("house/README.md", "# Rules of the house\n");
    folder_.write("a.gltf", asset("door"));
    folder_.write("props/a.gltf", asset("door"));
  }
  static std::string asset(const std::string& name) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"name": ")" +
           name + R"(", "extras": 1}]})";
  }
  Outcome in_folder(std::vector<std::string> arguments) const {
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  Outcome validate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"validate", "--format", "agent", "a.gltf"});
    return in_folder(std::move(arguments));
  }

  TempFolder folder_;
};

TEST_F(OwnRules, FailBesideCodesThatAreIgnored) {
  const Outcome outcome = validate({"--rules", "house", "--ignore", "UNUSED_OBJECT"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("ACME_NODE_NAME"));
}

TEST_F(OwnRules, OfAFolderOrAFileAreChecked) {
  for (const char* const path : {"house", "house/", "house/ACME_NODE_NAME.md"}) {
    const Outcome outcome = validate({"--rules", path});
    EXPECT_EQ(outcome.code, 1) << path;
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("error[ACME_NODE_NAME]"), HasSubstr("The node has another name."),
                      HasSubstr("/nodes/0/name: 'door' does not match '^N_'")));
  }
  EXPECT_EQ(validate({}).code, 0);
}

TEST_F(OwnRules, OfTheConfigurationAreFoundFromItsFolder) {
  folder_.write("gltfx.toml", "rules = [\"house\"]\n");
  EXPECT_THAT(validate({}).out, HasSubstr("error[ACME_NODE_NAME]"));
  const Outcome below =
      gltfx({"validate", "a.gltf"}, {(folder_.path() / "props").native(), {}, {}});
  EXPECT_EQ(below.code, 1);
  EXPECT_EQ(validate({"--isolated"}).code, 0);
  EXPECT_THAT(in_folder({"config"}).out, HasSubstr("house"));
}

TEST_F(OwnRules, AddUpByPath) {
  folder_.write("more/ACME_PROP_NAME.md", page("ACME_PROP_NAME", "^P_"));
  folder_.write("gltfx.toml",
                "rules = [\"house\"]\n[[overrides]]\npaths = [\"props/\"]\nrules = [\"more\"]\n"
                "severity = { ACME_NODE_NAME = \"info\" }\n");
  EXPECT_THAT(validate({}).out,
              AllOf(HasSubstr("error[ACME_NODE_NAME]"), Not(HasSubstr("ACME_PROP_NAME"))));
  EXPECT_THAT(in_folder({"validate", "--format", "agent", "props/a.gltf"}).out,
              AllOf(HasSubstr("info[ACME_NODE_NAME]"), HasSubstr("error[ACME_PROP_NAME]")));
}

TEST_F(OwnRules, HaveCodesLikeOthers) {
  EXPECT_EQ(validate({"--rules", "house", "--ignore", "acme_node_name"}).code, 0);
  EXPECT_THAT(validate({"--rules", "house", "--severity", "ACME_NODE_NAME=warning"}).out,
              HasSubstr("warning[ACME_NODE_NAME]"));
  EXPECT_EQ(validate({"--rules", "house", "--select", "UNUSED_OBJECT"}).code, 0);
  const Outcome unknown = validate({"--rules", "house", "--ignore", "ACME_NODE_NAM"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("'ACME_NODE_NAME'"));
  EXPECT_EQ(validate({"--ignore", "ACME_NODE_NAME"}).code, 2);
}

TEST_F(OwnRules, OfTheConfigurationMayBeNamedThere) {
  folder_.write("gltfx.toml", "ignore = [\"ACME_NODE_NAME\"]\nrules = [\"house\"]\n");
  EXPECT_EQ(validate({}).code, 0);
  EXPECT_EQ(in_folder({"fix", "--check", "a.gltf"}).code, 0);
  EXPECT_EQ(in_folder({"bake", "--help"}).code, 0);
}

TEST_F(OwnRules, CanBeRecordedInABaseline) {
  EXPECT_EQ(validate({"--rules", "house", "--write-baseline", "known.json"}).code, 0);
  EXPECT_EQ(validate({"--rules", "house", "--baseline", "known.json"}).code, 0);
}

TEST_F(OwnRules, AreExplainedAndListed) {
  EXPECT_THAT(in_folder({"explain", "ACME_NODE_NAME", "--rules", "house"}).out,
              AllOf(HasSubstr("The loader of ACME needs it."), HasSubstr("https://example.com"),
                    HasSubstr("'x' does not match"), HasSubstr("an own rule")));
  EXPECT_THAT(
      in_folder({"rules", "--rules", "house"}).out,
      AllOf(HasSubstr("ACME_NODE_NAME"), HasSubstr("NODE_EMPTY"), HasSubstr("1 of them own")));
  folder_.write("gltfx.toml", "rules = [\"house\"]\n");
  const json listed = json::parse(in_folder({"rules", "--format", "json"}).out);
  std::size_t own = 0;
  for (const json& rule : listed.at("rules")) own += rule.at("own").get<bool>() ? 1U : 0U;
  EXPECT_EQ(own, 1U);
}

TEST_F(OwnRules, AreDescribedInSarif) {
  const json log =
      json::parse(in_folder({"validate", "a.gltf", "--rules", "house", "--format", "sarif"}).out);
  const json& driver = log.at("runs").at(0).at("tool").at("driver");
  ASSERT_EQ(driver.at("rules").size(), 1U);
  const json& rule = driver.at("rules").at(0);
  EXPECT_EQ(rule.at("id"), "ACME_NODE_NAME");
  EXPECT_EQ(rule.at("helpUri"), "https://example.com/names");
  EXPECT_EQ(rule.at("shortDescription").at("text"), "Node with another name.");
  EXPECT_EQ(log.at("runs").at(0).at("results").at(0).at("ruleId"), "ACME_NODE_NAME");
}

TEST_F(OwnRules, AreInReportsThatAreMergedAndOnThePage) {
  EXPECT_EQ(validate({"--rules", "house", "--format", "jsonl=part.jsonl"}).code, 1);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, std::vector<std::string>{"--rules", "house"}}) {
    std::vector<std::string> merge{"merge", "part.jsonl", "--format", "agent"};
    merge.insert(merge.end(), options.begin(), options.end());
    EXPECT_THAT(in_folder(merge).out, HasSubstr("error[ACME_NODE_NAME]"));
  }
  EXPECT_EQ(
      in_folder({"report", "a.gltf", "--rules", "house", "--no-thumbnails", "-o", "page.html"})
          .code,
      1);
  EXPECT_THAT(read_file((folder_.path() / "page.html").native()),
              HasSubstr("The loader of ACME needs it."));
}

// The key of the cache has the pages: neither an old verdict nor an old message is used again.
TEST_F(OwnRules, AreCheckedAgainWhenAPageChanges) {
  const auto cached = [&] { return validate({"--rules", "house", "--cache", "cache"}); };
  EXPECT_EQ(cached().code, 1);
  EXPECT_EQ(cached().code, 1);
  EXPECT_EQ(validate({"--cache", "cache"}).code, 0);
  folder_.write("house/ACME_NODE_NAME.md", page("ACME_NODE_NAME", "^[dN]"));
  EXPECT_EQ(cached().code, 0);
}

// The same bytes under the same name, in another folder.
TEST_F(OwnRules, AreCheckedAgainInAnotherPlace) {
  std::string text = page("ACME_NODE_NAME", "^props/");
  const std::string name = R"("name": {"pattern": "^props/"})";
  text.replace(text.find(name), name.size(),
               R"("gltfx": {"properties": {"path": {"pattern": "^props/"}}})");
  folder_.write("house/ACME_NODE_NAME.md", text);
  const auto code = [&](const std::string& path) {
    return in_folder({"validate", path, "--rules", "house", "--cache", "cache"}).code;
  };
  EXPECT_EQ(code("a.gltf"), 1);
  EXPECT_EQ(code("props/a.gltf"), 0);
  EXPECT_EQ(code("./props/../props/a.gltf"), 0) << "the path without its detours";
  EXPECT_EQ(code("a.gltf"), 1);
}

TEST_F(OwnRules, MistakesInPagesEndTheRun) {
  std::string text = page("ACME_NODE_NAME", "^N_");
  text.replace(text.find("\"pattern\""), 9, "\"patern\"");
  folder_.write("house/ACME_NODE_NAME.md", text);
  const Outcome outcome = validate({"--rules", "house"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("\nhouse/ACME_NODE_NAME.md:24: "), HasSubstr("'pattern'")));
  folder_.write("gltfx.toml", "\nrules = [\"house\"]\n");
  EXPECT_THAT(validate({}).err,
              AllOf(HasSubstr("gltfx.toml:2: rules: "), HasSubstr("house/ACME_NODE_NAME.md:24: ")));
  EXPECT_EQ(validate({"--isolated", "--rules", "nowhere"}).code, 2);
  EXPECT_EQ(validate({"--isolated", "--rules", "props"}).code, 2);
}

TEST_F(OwnRules, CannotTakeTheNameOfARuleOfGltfx) {
  folder_.write("house/TYPE_MISMATCH.md", page("TYPE_MISMATCH", "^N_"));
  const Outcome outcome = validate({"--rules", "house"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("TYPE_MISMATCH is a rule of gltfx"));
}

// A file in place of a core schema would silently switch its checks off.
TEST_F(OwnRules, AreWhatReplacesASchemaOfCore) {
  folder_.write("mesh.schema.json",
                R"({"$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "gltfx:core/mesh", "title": "Mesh", "description": "d", "type": "object"})");
  const Outcome outcome = validate({"--schema", "mesh.schema.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("mesh.schema.json:2:"), HasSubstr("gltfx rules --new")));
  folder_.write("gltfx.toml", "schemas = [\"mesh.schema.json\"]\n");
  EXPECT_EQ(validate({}).code, 2);
}

TEST_F(OwnRules, AreTestedByTheirExamples) {
  const Outcome good = in_folder({"rules", "--test", "house"});
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("1 rule: 2 examples passed, 0 failed"));
  folder_.write("house/ACME_NODE_NAME.md", page("ACME_NODE_NAME", "^x"));
  const Outcome bad = in_folder({"rules", "--test", "house"});
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.out, AllOf(HasSubstr("ACME_NODE_NAME.md:30: bad example"),
                             HasSubstr("good example"), HasSubstr("0 examples passed, 2 failed")));
  folder_.write("house/ACME_NODE_NAME.md", "");
  EXPECT_EQ(in_folder({"rules", "--test", "house"}).code, 2);
}

// The configuration may name a folder before it has a page, and other pages may have mistakes.
TEST_F(OwnRules, AreWrittenAndTestedWithoutTheConfiguration) {
  folder_.write("gltfx.toml", "rules = [\"more\"]\n");
  EXPECT_EQ(in_folder({"rules"}).code, 2);
  folder_.write("more/README.md", "");
  EXPECT_EQ(in_folder({"rules"}).code, 2);
  EXPECT_EQ(in_folder({"rules", "--new", "more/ACME_TITLE", "--on", "mesh"}).code, 0);
  EXPECT_EQ(in_folder({"rules"}).code, 0);
  folder_.write("more/ACME_BROKEN.md", "");
  const Outcome outcome = in_folder({"rules", "--test", "more/ACME_TITLE.md"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(in_folder({"rules", "--test", "more"}).code, 2);
}

TEST_F(OwnRules, OfTheExamplesPassTheirTests) {
  const Outcome outcome = in_folder({"rules", "--test", kExamples});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("6 rules: 12 examples passed"), Not(HasSubstr("note:"))));
}

TEST_F(OwnRules, WorkWithLimitsAndAPresetInTheExample) {
  const std::string house = fixture("../examples/house/gltfx.toml");
  const Outcome outcome =
      in_folder({"validate", fixture("good/triangle.gltf"), "--config", house, "--format", "json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("ACME_MESH_NAME"), HasSubstr("BUDGET_OPEN_EDGES"),
                                 HasSubstr("preset khronos-3d-commerce/desktop-web")));
}

TEST_F(OwnRules, ThatAreNewPassTheirTest) {
  for (const char* const kind : {"node", "mesh", "glTF", "animation"}) {
    const std::string code = std::string("ACME_") + (kind[0] == 'g' ? "WHOLE" : "OF") + "_1";
    std::filesystem::remove(folder_.path() / (code + ".md"));
    const Outcome made = in_folder({"rules", "--new", code, "--on", kind});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(in_folder({"rules", "--test", code + ".md"}).code, 0) << kind;
  }
}

TEST_F(OwnRules, ThatAreNewReplaceNothing) {
  const std::string before = read_file((folder_.path() / "house/ACME_NODE_NAME.md").native());
  const Outcome outcome = in_folder({"rules", "--new", "house/ACME_NODE_NAME", "--on", "mesh"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("exists"));
  EXPECT_EQ(read_file((folder_.path() / "house/ACME_NODE_NAME.md").native()), before);
  EXPECT_EQ(in_folder({"rules", "--new", "acme"}).code, 2);
  EXPECT_EQ(in_folder({"rules", "--new", "NODE_EMPTY"}).code, 2);
  const Outcome kind = in_folder({"rules", "--new", "ACME_X", "--on", "nodes"});
  EXPECT_EQ(kind.code, 2);
  EXPECT_THAT(kind.err, HasSubstr("'node'"));
}

}  // namespace
}  // namespace gltfx::program
