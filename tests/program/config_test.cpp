// SPDX-License-Identifier: Apache-2.0
/// gltfx.toml: the search for it, precedence of values, and mistakes.
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Config : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("faulty.gltf", kFaulty);
    folder_.write("props/faulty.gltf", kFaulty);
    folder_.write("props/info.gltf", kInfo);
  }
  void configure(std::string_view text) const { folder_.write("gltfx.toml", text); }
  Outcome in(const std::string& where, std::vector<std::string> arguments) const {
    return gltfx(std::move(arguments), {(folder_.path() / where).native(), {}, {}});
  }
  Outcome validate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"validate", "--format", "agent"});
    return in("", std::move(arguments));
  }
  /// The messages about a configuration with mistakes.
  std::string said(std::string_view text) const {
    configure(text);
    const Outcome outcome = validate({"faulty.gltf"});
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  }

  TempFolder folder_;
};

TEST_F(Config, OfTheWorkingFolderHolds) {
  configure("severity = { VALUE_NOT_IN_RANGE = \"info\" }\n");
  const Outcome outcome = validate({"faulty.gltf"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, StartsWith("info[VALUE_NOT_IN_RANGE]"));
}

TEST_F(Config, OfAFolderAboveHolds) {
  configure("ignore = [\"value_not_in_range\"]\n");
  EXPECT_EQ(in("props", {"validate", "faulty.gltf"}).code, 0);
}

TEST_F(Config, TheNearestHoldsAlone) {
  configure("ignore = [\"VALUE_NOT_IN_RANGE\"]\n");
  folder_.write("props/gltfx.toml", "max-issues = 3\n");
  EXPECT_EQ(in("props", {"validate", "faulty.gltf"}).code, 1);
}

// A folder of assets from elsewhere must not switch off its own checks.
TEST_F(Config, InTheFolderOfAnAssetChangesNothing) {
  const Outcome before = validate({".", "props/faulty.gltf"});
  folder_.write("props/gltfx.toml",
                "ignore = [\"VALUE_NOT_IN_RANGE\"]\nfail-on = \"never\"\nroot = \"/\"\n");
  folder_.write("props/.gltfx.toml", "this is no TOML");
  const Outcome after = validate({".", "props/faulty.gltf"});
  EXPECT_EQ(after.code, 1);
  EXPECT_EQ(after.out, before.out);
  EXPECT_EQ(validate({(folder_.path() / "props").native()}).code, 1);
  EXPECT_EQ(in("props", {"validate", "faulty.gltf"}).code, 0) << "of the working folder";
  EXPECT_EQ(validate({"props", "--config", "props/gltfx.toml"}).code, 0) << "named";
}

TEST_F(Config, IsLeftOutWhenIsolated) {
  configure("this is no TOML");
  EXPECT_EQ(validate({"faulty.gltf", "--isolated"}).code, 1);
  EXPECT_THAT(validate({"faulty.gltf", "--isolated", "--config", "gltfx.toml"}).err,
              HasSubstr("are mutually exclusive"));
  EXPECT_THAT(validate({"faulty.gltf", "--config", "no.toml"}).err,
              HasSubstr("cannot read 'no.toml'"));
}

TEST_F(Config, ThatIsNoRegularFileIsNone) {
  ASSERT_EQ(bash("mkfifo gltfx.toml", {folder_.path().native(), {}, {}}).code, 0);
  EXPECT_EQ(validate({"faulty.gltf"}).code, 1);
}

TEST_F(Config, StandsBehindTheCommandLine) {
  configure(
      "profile = \"strict\"\nfail-on = \"never\"\nignore = [\"VALUE_NOT_IN_RANGE\"]\n"
      "[severity]\nUNUSED_OBJECT = \"error\"\n");
  EXPECT_THAT(validate({"faulty.gltf", "--profile", "default"}).out, HasSubstr("profile default"));
  EXPECT_EQ(validate({"props/info.gltf"}).code, 0);
  EXPECT_EQ(validate({"props/info.gltf", "--fail-on", "error"}).code, 1);
  EXPECT_EQ(
      validate({"props/info.gltf", "--fail-on", "error", "--severity", "UNUSED_OBJECT=hint"}).code,
      0);
  EXPECT_THAT(validate({"faulty.gltf", "--select", "VALUE_NOT_IN_RANGE"}).out,
              HasSubstr("error[VALUE_NOT_IN_RANGE]"));
}

TEST_F(Config, OverridesHoldForTheirPathsAndTheLastOneWins) {
  configure(
      "[[overrides]]\npaths = [\"props/**/*.gltf\"]\nignore = [\"UNUSED_OBJECT\"]\n"
      "severity = { VALUE_NOT_IN_RANGE = \"info\" }\n"
      "[[overrides]]\npaths = [\"props/\"]\nseverity = { VALUE_NOT_IN_RANGE = \"warning\" }\n");
  const std::string out = validate({"."}).out;
  EXPECT_THAT(out, HasSubstr("error[VALUE_NOT_IN_RANGE] ./faulty.gltf"));
  EXPECT_THAT(out, HasSubstr("warning[VALUE_NOT_IN_RANGE] ./props/faulty.gltf"));
  EXPECT_THAT(out, Not(HasSubstr("UNUSED_OBJECT")));
  EXPECT_THAT(in("props", {"validate", "--format", "agent", "."}).out,
              HasSubstr("warning[VALUE_NOT_IN_RANGE] ./faulty.gltf"));
}

TEST_F(Config, PathsInItAreTakenFromItsFolder) {
  folder_.write("schemas/ACME_leaf.schema.json",
                read_file(fixture("schemas/ACME_leaf.schema.json")));
  configure("schemas = [\"schemas\"]\nroot = \".\"\nbaseline = \"known.json\"\n");
  ASSERT_EQ(
      in("", {"validate", "faulty.gltf", "--isolated", "--write-baseline", "known.json"}).code, 0);
  EXPECT_EQ(in("props", {"schema", "ACME_leaf"}).code, 0);
  EXPECT_EQ(in("props", {"schema", "ACME_leaf", "--isolated"}).code, 2);
  EXPECT_EQ(in("props", {"validate", "info.gltf"}).code, 0);
  EXPECT_EQ(in("", {"validate", "faulty.gltf"}).code, 0);
  EXPECT_EQ(in("props", {"upgrade", "info.gltf"}).code, 0);
}

TEST_F(Config, WishesOfAssetsAreHeardWhereItSaysSo) {
  const std::string wish =
      R"("extras": {"gltfx": {"ignore": [{"code": "VALUE_NOT_IN_RANGE", "reason": "r"}]}}, )";
  for (const char* name : {"own/a.gltf", "vendor/a.gltf"}) {
    folder_.write(name, "{" + wish + kFaulty.substr(1));
  }
  EXPECT_EQ(validate({"own"}).code, 1);
  const Outcome asked = validate({"own", "--inline-suppressions"});
  EXPECT_EQ(asked.code, 0);
  EXPECT_THAT(asked.out, HasSubstr("1 finding left out, as the assets ask"));
  configure("[[overrides]]\npaths = [\"own/\"]\ninline-suppressions = true\n");
  EXPECT_EQ(validate({"own"}).code, 0);
  EXPECT_EQ(validate({"vendor"}).code, 1);
}

TEST_F(Config, MistakesAreNamedWithTheirLine) {
  EXPECT_THAT(said("\nprofil = \"strict\"\n"),
              HasSubstr("\ngltfx.toml:2: there is no key 'profil'. Did you mean 'profile'?\n"));
  const std::string unknown = said("flavour = 1\nwidth = 2\n");
  EXPECT_THAT(unknown, HasSubstr("\nthe keys are overrides, extends, profile, pixels, "));
  EXPECT_THAT(unknown, HasSubstr(", budgets, "));
  EXPECT_EQ(unknown.find("the keys are"), unknown.rfind("the keys are"));
  EXPECT_THAT(said("profile = 3\n"), Not(HasSubstr("the keys are")));
  EXPECT_THAT(said("profile = \"strct\"\n"),
              HasSubstr("gltfx.toml:1: profile: 'strct' is not one of"));
  EXPECT_THAT(
      said("ignore = [\n\"UNUSED_OBJEC\"]\n"),
      HasSubstr(
          "gltfx.toml:2: ignore: there is no rule 'UNUSED_OBJEC'. Did you mean 'UNUSED_OBJECT'?"));
  EXPECT_THAT(said("ignore = \"UNUSED_OBJECT\"\n"),
              HasSubstr("ignore: a list of strings is expected"));
  EXPECT_THAT(said("ignore = [\"UNUSED_OBJECT,EMPTY_ENTITY\"]\n"), HasSubstr("is not a value"));
  EXPECT_THAT(said("[severity]\nUNUSED_OBJECT = \"loud\"\n"),
              HasSubstr("gltfx.toml:2: severity: "));
  EXPECT_THAT(said("max-issues = -1\n"), HasSubstr("'-1' is not a whole number"));
  EXPECT_THAT(said("inline-suppressions = \"yes\"\n"), HasSubstr("true or false is expected"));
  EXPECT_THAT(said("a = [\n"), HasSubstr("gltfx.toml:"));
}

TEST_F(Config, ManyMistakesAreToldInBoundedText) {
  std::string text = "ignore = [";
  for (int i = 0; i < 20'000; ++i) text += "\"UNUSED_OBJEC" + std::to_string(i) + "\",\n";
  const std::string told = said(text + "]\n");
  EXPECT_THAT(told, HasSubstr("gltfx.toml:100: ignore"));
  EXPECT_THAT(told, HasSubstr("the rest of the file was not read"));
  EXPECT_LT(told.size(), std::size_t{1} << 15U);
  std::string yaml = "ignore:\n";
  for (int i = 0; i < 20'000; ++i) yaml += "  - NO_SUCH_CODE\n";
  folder_.write("khronos.yaml", yaml);
  EXPECT_LT(in("", {"config", "import", "khronos.yaml"}).err.size(), std::size_t{1} << 15U);
}

TEST_F(Config, KeysThatBeginWithAnythingAreAMistake) {
  for (const char* const text : {"[{severity]\n", "[\n", "[[=]]\n", "a.{ = 1\n", "a = {,}\n"}) {
    EXPECT_THAT(said(text), HasSubstr("gltfx.toml:1")) << text;
  }
}

TEST_F(Config, TablesInTablesWithoutEndAreAMistake) {
  std::string keys;
  for (int i = 0; i < 100'000; ++i) keys += "a.";
  EXPECT_THAT(said(keys + "a = 1\n"), HasSubstr("gltfx.toml:1"));
  EXPECT_THAT(said("a = " + std::string(100'000, '[')), HasSubstr("gltfx.toml:1"));
  EXPECT_THAT(said("[" + keys + "a]\n"), HasSubstr("gltfx.toml:1"));
  EXPECT_THAT(said("\n# ]\nx = \"\"\"\n[\\\"\"\"\"\ny = '''['''''\n" + keys + "a = 1\n"),
              HasSubstr("gltfx.toml:6: this is nested"));
}

TEST_F(Config, MistakesInOverridesAreNamedAndAllAtOnce) {
  EXPECT_THAT(said("overrides = 3\n"), HasSubstr("write [[overrides]]"));
  EXPECT_THAT(said("[[overrides]]\nignore = []\n"),
              HasSubstr("gltfx.toml:1: an override names its 'paths'"));
  EXPECT_THAT(said("[[overrides]]\npaths = [\"*\"]\nprofile = \"strict\"\nselekt = []\n"),
              AllOf(HasSubstr("gltfx.toml:3: 'profile' applies to all paths"),
                    HasSubstr("gltfx.toml:4: there is no key 'selekt'. Did you mean 'select'?"),
                    HasSubstr("\nthe keys of an override are paths, select, ignore, ")));
}

TEST_F(Config, TextOfTheFileCannotDriveTheTerminal) {
  EXPECT_EQ(said("\"\\u001b[2J\" = 1\nprofile = \"\\u001b\"\n").find('\x1b'), std::string::npos);
}

TEST_F(Config, IsShownWithValueLineAndReason) {
  configure(
      "profile = \"strict\"\nignore = [\"UNUSED_OBJECT\"]\n[[overrides]]\npaths = [\"*.glb\"]\n"
      "ignore = [\"EMPTY_ENTITY\"]\n");
  const std::string all = in("props", {"config"}).out;
  EXPECT_THAT(all, StartsWith("configuration: ../gltfx.toml\n"));
  EXPECT_THAT(all, testing::ContainsRegex("profile +strict +../gltfx.toml:1\n"));
  EXPECT_THAT(all, testing::ContainsRegex("lfs +skip +default\n"));
  EXPECT_THAT(all, Not(HasSubstr("EMPTY_ENTITY")));
  const std::string one = in("props", {"config", "a/b.glb"}).out;
  EXPECT_THAT(one, HasSubstr("for 'a/b.glb'\n"));
  EXPECT_THAT(one, testing::ContainsRegex("\n +EMPTY_ENTITY +../gltfx.toml:5, for '\\*.glb'\n"));
  EXPECT_THAT(in("props", {"config", "--isolated"}).out,
              StartsWith("configuration: none (--isolated)"));
}

TEST_F(Config, ExcludesPathsFromItsFolderAndNamesAnywhere) {
  folder_.write("props/old/x.gltf", kInfo);
  folder_.write("props/new/x.gltf", kInfo);
  folder_.write("props/new/y.draft.gltf", kInfo);
  configure("exclude = [\"props/old/\", \"*.draft.gltf\"]\n");
  const auto files = [&](const std::string& folder, const std::vector<std::string>& words) {
    return in(folder, words).out;
  };
  for (const auto& [folder, path] : std::vector<std::pair<std::string, std::string>>{
           {"", "props"}, {"props", "."}, {"", (folder_.path() / "props").native()}}) {
    const std::string out = files(folder, {"validate", path, "--format", "github"});
    EXPECT_THAT(out, HasSubstr("new/x.gltf")) << path;
    EXPECT_THAT(out, Not(HasSubstr("old/x.gltf"))) << path;
    EXPECT_THAT(out, Not(HasSubstr("draft"))) << path;
  }
  EXPECT_EQ(in("", {"inspect", "props/old"}).code, 2);
  EXPECT_EQ(in("", {"upgrade", "props/old"}).code, 2);
}

// Editors complete gltfx.toml by it.
TEST_F(Config, TheSchemaForEditorsHasEveryKey) {
  const auto schema =
      nlohmann::json::parse(read_file(GLTFX_SOURCE_DIR "/schema/meta/gltfx.toml.schema.json"));
  std::set<std::string> described;
  for (const auto& [key, value] : schema["properties"].items()) {
    if (key != "overrides" && key != "extends") described.insert(key);
  }
  std::set<std::string> shown;
  std::istringstream lines(in("", {"config", "--isolated"}).out);
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(" default")) shown.insert(line.substr(0, line.find(' ')));
  }
  EXPECT_EQ(described, shown);
}

TEST_F(Config, OfTheKhronosValidatorIsImported) {
  folder_.write(
      "a.yaml",
      "---\n# comment\nmax-issues: 100 # more\nignore:\n- UNUSED_OBJECT\n  - 'EMPTY_ENTITY'\n"
      "only: [TYPE_MISMATCH, \"NOT_OURS\"]\noverride:\n  IMAGE_NPOT_DIMENSIONS: 3\n");
  const Outcome outcome = in("", {"config", "import", "a.yaml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out,
              HasSubstr("\nmax-issues = 100\nselect = [\n  \"TYPE_MISMATCH\",\n]\nignore = [\n  "
                        "\"UNUSED_OBJECT\",\n  \"EMPTY_ENTITY\",\n]\n\n[severity]\n"
                        "IMAGE_NPOT_DIMENSIONS = \"hint\"\n"));
  EXPECT_EQ(outcome.err, "gltfx: note: a.yaml:7: gltfx has no rule 'NOT_OURS': left out\n");
  configure(outcome.out);
  EXPECT_EQ(validate({"faulty.gltf"}).code, 0);
}

TEST_F(Config, ImportTakesTheLastOfSeveralLevels) {
  folder_.write("khronos.yaml", "override:\n  NODE_EMPTY: 0\n  NODE_EMPTY: 1\n");
  const Outcome imported = in("", {"config", "import", "khronos.yaml"});
  EXPECT_THAT(imported.out, HasSubstr("NODE_EMPTY = \"warning\""));
  folder_.write("gltfx.toml", imported.out);
  EXPECT_EQ(in("", {"config"}).code, 0);
}

TEST_F(Config, ImportSaysWhatItDoesNotUnderstand) {
  const auto import = [&](std::string_view text) {
    folder_.write("a.yaml", text);
    const Outcome outcome = in("", {"config", "import", "a.yaml"});
    EXPECT_EQ(outcome.code, 2) << text;
    return outcome.err;
  };
  EXPECT_THAT(import("\nignor: []\n"),
              HasSubstr("a.yaml:2: 'ignor' is not a key of the Khronos validator; its keys are "));
  EXPECT_THAT(import("ignor: []\n"), HasSubstr("Did you mean 'ignore'?"));
  EXPECT_THAT(import("override: {UNUSED_OBJECT: 4}\n"), HasSubstr("up to 3"));
  EXPECT_THAT(import("override: [UNUSED_OBJECT]\n"), HasSubstr("a map is expected"));
  EXPECT_THAT(import("max-issues: many\n"), HasSubstr("whole number"));
  EXPECT_THAT(import("- A\n"), HasSubstr("more of YAML"));
  EXPECT_THAT(import("ignore: &a\n"), HasSubstr("a list is expected"));
  EXPECT_THAT(import("just text\n"), HasSubstr("key: value"));
  EXPECT_THAT(in("", {"config", "import"}).err, HasSubstr("import takes one file"));
  EXPECT_THAT(in("", {"config", "a", "b"}).err, HasSubstr("one path at a time"));
  EXPECT_THAT(in("", {"config", "import", "no.yaml"}).err, HasSubstr("cannot read"));
}

// The patterns that match the path, detected by the effect of an override.
TEST_F(Config, PatternsFitAsIsSaid) {
  const auto fits = [&](const std::string& pattern, const std::string& path) {
    configure("[[overrides]]\npaths = [\"" + pattern + "\"]\nlfs = \"error\"\n");
    return in("", {"config", path}).out.find(", for '") != std::string::npos;
  };
  EXPECT_TRUE(fits("*.glb", "a/b/c.glb"));
  EXPECT_FALSE(fits("*.glb", "a/b/c.gltf"));
  EXPECT_TRUE(fits("a/*.glb", "a/c.glb"));
  EXPECT_FALSE(fits("a/*.glb", "a/b/c.glb"));
  EXPECT_TRUE(fits("a/**/*.glb", "a/c.glb"));
  EXPECT_TRUE(fits("a/**/*.glb", "a/b/d/c.glb"));
  EXPECT_FALSE(fits("a/**/*.glb", "b/a/c.glb"));
  EXPECT_TRUE(fits("b/", "a/b/c.glb"));
  EXPECT_FALSE(fits("b/", "a/b"));
  EXPECT_TRUE(fits("**/b/c.?lb", "./a/../a/b/c.glb"));
  EXPECT_FALSE(fits("a/b", "a/b/c.glb"));
  EXPECT_TRUE(fits("**/elsewhere/*", "/tmp/elsewhere/c.glb"));
}

}  // namespace
}  // namespace gltfx::program
