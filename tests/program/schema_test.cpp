// SPDX-License-Identifier: Apache-2.0
/// Schemas of the user, and `gltfx schema`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"
#include "sanitized.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kLeafSchema = fixture("schemas/ACME_leaf.schema.json");

std::string leaf(const std::string& extensions) {
  return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_leaf", "KHR_materials_unlit"],
 "materials": [{"name": "oak", "extensions": {)" +
         extensions + R"(}}, {"name": "plain", "extensions": {"KHR_materials_unlit": {}}}]})";
}

class UserSchema : public testing::Test {
 protected:
  Outcome check(const std::string& extensions, const std::vector<std::string>& options) const {
    folder_.write("leaf.gltf", leaf(extensions));
    std::vector<std::string> arguments{"validate", "leaf.gltf", "--ignore", "UNUSED_OBJECT"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return gltfx(arguments, {folder_.path().native(), {}, {}});
  }
  Outcome with_leaf(const std::string& extensions) const {
    return check(extensions, {"--schema", kLeafSchema});
  }

  TempFolder folder_;
};

TEST_F(UserSchema, AnUnknownExtensionIsNamedAsSuch) {
  EXPECT_THAT(check(R"("ACME_leaf": {"age": 99})", {}).out, HasSubstr("UNSUPPORTED_EXTENSION"));
}

TEST_F(UserSchema, AKnownOneIsCheckedLikeAnyOther) {
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {"age": 9})").out, HasSubstr("no problems"));
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {"age": 10})").out, HasSubstr("VALUE_NOT_IN_RANGE"));
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {"age": 0})").out, HasSubstr("VALUE_NOT_IN_RANGE"));
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {"age": "old"})").out, HasSubstr("TYPE_MISMATCH"));
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {})").out, HasSubstr("UNDEFINED_PROPERTY"));
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {"age": 1, "aeg": 2})").out,
              AllOf(HasSubstr("UNEXPECTED_PROPERTY"), HasSubstr("age")));
  EXPECT_THAT(with_leaf(R"("ACME_leaf": {"age": 1, "veins": {"index": 3}})").out,
              HasSubstr("UNRESOLVED_REFERENCE"));
}

TEST_F(UserSchema, ItsExclusionsHold) {
  const Outcome outcome = with_leaf(R"("ACME_leaf": {"age": 1}, "KHR_materials_unlit": {})");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("EXTENSION_EXCLUDED"), HasSubstr("'ACME_leaf'"),
                                 HasSubstr("'KHR_materials_unlit'"), HasSubstr("a leaf is lit.")));
}

TEST_F(UserSchema, AFolderOfSchemasIsTakenWhole) {
  folder_.write("schemas/ACME_leaf.schema.json", read_file(kLeafSchema));
  folder_.write("schemas/notes.json", "not a schema");
  EXPECT_THAT(check(R"("ACME_leaf": {"age": 10})", {"--schema-dir", "schemas"}).out,
              HasSubstr("VALUE_NOT_IN_RANGE"));
}

TEST_F(UserSchema, AFolderWithoutSchemasIsAMistake) {
  folder_.write("schemas/notes.json", "{}");
  const Outcome outcome = check("", {"--schema-dir", "schemas"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no file named *.schema.json"));
}

TEST_F(UserSchema, ErrorsAreToldWithFileLineAndColumn) {
  std::string text = read_file(kLeafSchema);
  text.replace(text.find("\"minimum\""), 9, "\"minimun\"");
  folder_.write("bad.schema.json", text);
  const Outcome outcome = check("", {"--schema", "bad.schema.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("\nbad.schema.json:2:40: "), HasSubstr("'minimun'"),
                                 HasSubstr("'minimum'")));
}

TEST_F(UserSchema, BrokenJsonIsToldTheSameWay) {
  folder_.write("bad.schema.json", "{\n  \"type\": \n}");
  const Outcome outcome = check("", {"--schema", "bad.schema.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("\nbad.schema.json:"));
}

TEST(SchemaVerb, ListsExtensionsAndCoreTypes) {
  const Outcome text = gltfx({"schema"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("KHR_materials_volume"), HasSubstr("ratified"),
                              HasSubstr("mesh.primitive")));
  const json list = json::parse(gltfx({"schema", "--format", "json"}).out);
  EXPECT_GE(list["extensions"].size(), 61U);
  for (const json& extension : list["extensions"]) {
    EXPECT_FALSE(extension["status"].get<std::string>().empty()) << extension["extension"];
  }
  EXPECT_GE(list["coreTypes"].size(), 25U);
}

TEST(SchemaVerb, ListsThoseOfAStatus) {
  const Outcome drafts = gltfx({"schema", "--status", "draft"});
  EXPECT_EQ(drafts.code, 0);
  EXPECT_THAT(drafts.out, AllOf(HasSubstr("KHR_physics_rigid_bodies"), Not(HasSubstr("VRMC_vrm")),
                                Not(HasSubstr("KHR_materials_ior"))));
  const Outcome two = gltfx({"schema", "--status", "vendor", "--status", "draft"});
  EXPECT_THAT(two.out, AllOf(HasSubstr("KHR_physics_rigid_bodies"), HasSubstr("VRMC_vrm")));
  const Outcome wrong = gltfx({"schema", "--status", "drafts"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("draft"));
  EXPECT_EQ(gltfx({"schema", "material", "--status", "draft"}).code, 2);
}

TEST(SchemaVerb, EachExtensionSaysWhereItStands) {
  const json list = json::parse(gltfx({"schema", "--format", "json"}).out);
  for (const json& extension : list["extensions"]) {
    EXPECT_TRUE(extension.contains("spec")) << extension["extension"];
    EXPECT_EQ(extension["status"] == "draft", extension.contains("revision"))
        << extension["extension"];
  }
}

TEST(SchemaVerb, TellsWhatIsKnownOfAnExtension) {
  const Outcome text = gltfx({"schema", "KHR_materials_volume"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("status        ratified"), HasSubstr("material"),
                              HasSubstr("excludes      KHR_materials_unlit: "),
                              HasSubstr("thicknessTexture"), HasSubstr("reads G (linear)"),
                              HasSubstr("default [1, 1, 1]"), HasSubstr("animatable as float"),
                              HasSubstr("https://github.com/KhronosGroup/glTF")));
  const json volume = json::parse(gltfx({"schema", "KHR_materials_volume", "--format=json"}).out);
  EXPECT_EQ(volume["on"], json({"material"}));
  EXPECT_GE(volume["excludes"].size(), 1U);
  const json& properties = volume["objects"][0]["properties"];
  ASSERT_EQ(properties.size(), 4U);
  EXPECT_EQ(properties[0]["name"], "thicknessFactor");
  EXPECT_EQ(properties[0]["minimum"], 0);
  EXPECT_EQ(properties[1]["slot"]["channels"], "g");
}

TEST(SchemaVerb, TellsWhatIsKnownOfACoreType) {
  EXPECT_THAT(gltfx({"schema", "material"}).out,
              AllOf(HasSubstr("alphaMode"), HasSubstr("\"OPAQUE\", \"MASK\" or \"BLEND\"")));
  const json type = json::parse(gltfx({"schema", "accessor", "--format", "json"}).out);
  EXPECT_EQ(type["type"], "accessor");
}

TEST(SchemaVerb, EveryNameOfTheListIsKnown) {
  const json list = json::parse(gltfx({"schema", "--format", "json"}).out);
  std::vector<std::string> names = list["coreTypes"];
  for (const json& extension : list["extensions"]) names.push_back(extension["extension"]);
  std::string line;  // under sanitizers, which start slowly, each eighth
  for (std::size_t i = 0; i < names.size(); i += kSanitized ? 8 : 1) line += " " + names[i];
  const Outcome outcome =
      bash("for name in" + line +
           "; do \"$GLTFX\" schema $name > /dev/null || exit 9; "
           "\"$GLTFX\" schema $name --format json | grep -q type || echo $name; "
           "done");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST(SchemaVerb, ShowsTheUsersOwn) {
  const Outcome outcome = gltfx({"schema", "ACME_leaf", "--schema", kLeafSchema});
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 to 9; required"), HasSubstr("reads A (linear)")));
}

class OwnSchema : public testing::Test {
 protected:
  Outcome schema(std::vector<std::string> words) const {
    words.insert(words.begin(), "schema");
    words.push_back("--isolated");
    return gltfx(words, {folder_.path().native(), {}, {}});
  }
  // The start, with its tests replaced.
  void write_with_tests(const std::string& tests) const {
    std::string text = schema({"--new", "ACME_leaf"}).out;
    const std::size_t begin = text.find("\"tests\":");
    text = text.substr(0, begin) + "\"tests\": " + tests + "\n  }\n}\n";
    folder_.write("a.schema.json", text);
  }

  container::test::TempFolder folder_;
};

TEST_F(OwnSchema, TheStartHasNoMistakesAndPassesItsTests) {
  const Outcome start = schema({"--new", "ACME_leaf"});
  EXPECT_EQ(start.code, 0);
  folder_.write("a.schema.json", start.out);
  const Outcome outcome = schema({"--check", "a.schema.json", "--test", "a.schema.json"});
  EXPECT_EQ(outcome.out, "a.schema.json: no mistakes\na.schema.json: 2 passed, 0 failed\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string name : {"leaf", "acme_leaf", "ACME_", "_leaf", "ACME_a b"}) {
    EXPECT_EQ(schema({"--new", name}).code, 2) << name;
  }
}

TEST_F(OwnSchema, MistakesListTheAllowedWords) {
  write_with_tests("{}");
  std::string text = read_file((folder_.path() / "a.schema.json").native());
  text.replace(text.find("\"status\""), 8, "\"zzzzzzzz\"");
  folder_.write("a.schema.json", text);
  const Outcome outcome = schema({"--check", "a.schema.json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("'zzzzzzzz' is not a member of"));
  EXPECT_THAT(outcome.err, HasSubstr("Allowed: extension, on, status,"));
}

TEST_F(OwnSchema, EachTestThatFailsIsNamedWithItsReason) {
  const auto said = [&](const std::string& tests) {
    write_with_tests(tests);
    const Outcome outcome = schema({"--test", "a.schema.json"});
    EXPECT_EQ(outcome.code, 1) << tests;
    return outcome.out;
  };
  const std::string bare = R"({"asset": {"version": "2.0"}})";
  const std::string used =
      R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_leaf"],
 "materials": [{"extensions": {"ACME_leaf": {"amount": 3}}}]})";
  EXPECT_THAT(said("{\"good\": [" + bare + ", " + used + "]}"),
              AllOf(HasSubstr("tests/good/1: error[VALUE_NOT_IN_RANGE] at "),
                    HasSubstr(": 1 passed, 1 failed\n")));
  EXPECT_THAT(said(R"({"bad": [{"finding": "NODE_EMPTY", "asset": )" + used + "}, 3]}"),
              AllOf(HasSubstr("tests/bad/0: 'NODE_EMPTY' is not found, but: "),
                    HasSubstr("VALUE_NOT_IN_RANGE"), HasSubstr("tests/bad/1: needs an 'asset'")));
  EXPECT_THAT(said(R"({"upgrade": [{"before": )" + bare + R"(, "after": {}}, {}]})"),
              AllOf(HasSubstr("tests/upgrade/0: the upgraded asset differs:"),
                    HasSubstr("tests/upgrade/1: needs 'before' and 'after'")));
  EXPECT_THAT(said(R"({"goood": []})"), HasSubstr("tests/goood: not good, bad or upgrade"));
  EXPECT_THAT(said(R"({"good": 1})"), HasSubstr("tests/good: not an array"));
}

// An asset of the user may be called as those of the test.
TEST_F(OwnSchema, WithoutAFolderForTemporaryFilesNothingIsWritten) {
  write_with_tests(R"({"upgrade": [{"before": {}, "after": {}}]})");
  folder_.write("before.gltf", "mine");
  const Outcome outcome =
      gltfx({"schema", "--test", "a.schema.json", "--isolated"},
            {folder_.path().native(), {}, {{"TMPDIR", (folder_.path() / "none").native()}}});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("tests/upgrade/0: there is no folder for temporary files"));
  EXPECT_EQ(read_file((folder_.path() / "before.gltf").native()), "mine");
}

}  // namespace
}  // namespace gltfx::program
