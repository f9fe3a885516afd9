// SPDX-License-Identifier: Apache-2.0
/// Where reports go and that the same run gives the same bytes.
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
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class OutputTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("sound.gltf", kSound);
    folder_.write("faulty.gltf", kFaulty);
  }
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "validate");
    return gltfx(std::move(arguments), setting());
  }
  Outcome shell(const std::string& line) const { return bash(line, setting()); }
  Setting setting() const { return {folder_.path().native(), {}, {}}; }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      found.push_back(entry.path().filename());
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  TempFolder folder_;
};

TEST_F(OutputTest, TextNamesPlaceMessageAndSummary) {
  const Outcome outcome = here({"faulty.gltf"});
  EXPECT_THAT(outcome.out, HasSubstr("error[VALUE_NOT_IN_RANGE]"));
  EXPECT_THAT(outcome.out, HasSubstr("faulty.gltf:2:26"));
  EXPECT_THAT(outcome.out, HasSubstr("1 file checked: 1 error"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(OutputTest, QuietLeavesOutAllButFindings) {
  EXPECT_EQ(here({"sound.gltf", "--quiet"}).out, "");
  const Outcome outcome = here({"faulty.gltf", "-q"});
  EXPECT_THAT(outcome.out, HasSubstr("VALUE_NOT_IN_RANGE"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("checked")));
}

TEST_F(OutputTest, EachFormatIsWhatItsReadersTake) {
  const json own = json::parse(here({"faulty.gltf", "--format", "json"}).out);
  EXPECT_EQ(own["files"][0]["findings"][0]["code"], "VALUE_NOT_IN_RANGE");
  const json one = json::parse(here({"faulty.gltf", "--format", "khronos"}).out);
  EXPECT_EQ(one["issues"]["numErrors"], 1);
  const json many = json::parse(here({".", "--format", "khronos"}).out);
  EXPECT_EQ(many.size(), 2U);
  EXPECT_THAT(here({"faulty.gltf", "--format", "github"}).out,
              testing::StartsWith("::error file=faulty.gltf,line=2"));
}

TEST_F(OutputTest, SeveralFormatsEachGoToTheirPlace) {
  const Outcome outcome = here(
      {"faulty.gltf", "--format", "json=a.json", "--format", "text", "--format=khronos=b.json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("error[VALUE_NOT_IN_RANGE]"));
  EXPECT_TRUE(json::parse(content("a.json")).contains("files"));
  EXPECT_TRUE(json::parse(content("b.json")).contains("issues"));
  EXPECT_EQ(here({"faulty.gltf", "--format", "json=-"}).out, content("a.json"));
}

TEST_F(OutputTest, WithAFileOnlyNothingIsPrinted) {
  EXPECT_EQ(here({"faulty.gltf", "--format", "json=a.json"}).out, "");
}

TEST_F(OutputTest, AFileAppearsWholeAndKeepsItsMode) {
  folder_.write("old.json", "old");
  std::filesystem::permissions(folder_.path() / "old.json", std::filesystem::perms{0640});
  folder_.link("link.json", "old.json");
  here({"faulty.gltf", "--format", "json=link.json"});
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path() / "link.json"));
  EXPECT_TRUE(json::accept(content("old.json")));
  EXPECT_EQ(std::filesystem::status(folder_.path() / "old.json").permissions(),
            std::filesystem::perms{0640});
  EXPECT_THAT(names(), ElementsAre("faulty.gltf", "link.json", "old.json", "sound.gltf"));
}

TEST_F(OutputTest, ACommandThatIsRefusedLeavesFilesAlone) {
  folder_.write("old.json", "old");
  EXPECT_EQ(here({"sound.gltf", "--format", "json=old.json", "--format", "json=no/x.json"}).code,
            4);
  EXPECT_EQ(content("old.json"), "old");
  EXPECT_THAT(names(), ElementsAre("faulty.gltf", "old.json", "sound.gltf"));
}

TEST_F(OutputTest, AProgramThatIsEndedLeavesNoHalfFile) {
  const Outcome outcome = shell(
      "mkfifo in; \"$GLTFX\" validate - --format json=a.json < in & exec 3> in; "
      "until ls | grep -q part; do sleep 0.01; done; kill $!; wait $!; echo $?; ls");
  EXPECT_EQ(outcome.out, "143\nfaulty.gltf\nin\nsound.gltf\n");
}

TEST_F(OutputTest, AReaderThatGoesAwayIsNoError) {
  std::filesystem::create_directory(folder_.path() / "many");
  for (int i = 0; i < 600; ++i) folder_.write("many/" + std::to_string(i) + ".gltf", kFaulty);
  const Outcome outcome = shell("\"$GLTFX\" validate many | head -1; echo \"${PIPESTATUS[0]}\"");
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, testing::EndsWith("\n1\n"));
}

TEST_F(OutputTest, AReaderThatGoesAwayDoesNotCutTheFiles) {
  const Outcome outcome =
      shell("\"$GLTFX\" validate . --format text --format json=a.json | true; cat a.json");
  EXPECT_TRUE(json::accept(outcome.out));
}

TEST_F(OutputTest, AFullDeviceIsTold) {
  const Outcome outcome = shell("\"$GLTFX\" validate . > /dev/full");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("cannot write to standard output"));
}

TEST_F(OutputTest, AClosedOutputDoesNoHarm) {
  EXPECT_EQ(shell("\"$GLTFX\" validate faulty.gltf >&- 2>&- <&-").code, 1);
  EXPECT_EQ(content("faulty.gltf"), kFaulty);
}

TEST_F(OutputTest, AnyNumberOfThreadsGivesTheSameBytes) {
  for (int i = 0; i < 200; ++i) {
    folder_.write("many/" + std::to_string(i) + ".gltf", i % 3 == 0 ? kFaulty : kWarning);
  }
  for (const char* format : {"text", "json", "khronos", "github"}) {
    const Outcome one = here({".", "--format", format, "--jobs", "1"});
    const Outcome four = here({".", "--format", format, "--jobs", "4"});
    EXPECT_GT(one.out.size(), 1000U) << format;
    EXPECT_EQ(one.out, four.out) << format;
    EXPECT_EQ(one.code, four.code) << format;
  }
}

TEST_F(OutputTest, ColoursAreForTerminalsOrOnRequest) {
  const std::string escape = "\x1b[";
  EXPECT_THAT(here({"faulty.gltf"}).out, Not(HasSubstr(escape)));
  EXPECT_THAT(here({"faulty.gltf", "--color", "always"}).out, HasSubstr(escape));
  EXPECT_THAT(here({"faulty.gltf", "--color", "always", "--format", "json"}).out,
              Not(HasSubstr(escape)));
  EXPECT_THAT(gltfx({"explain", "TYPE_MISMATCH", "--color", "always"}).out, HasSubstr(escape));
  EXPECT_THAT(gltfx({"rules", "--color", "always"}).out, HasSubstr(escape));
  EXPECT_THAT(gltfx({"schema", "--color", "always"}).out, HasSubstr(escape));
}

// script(1) gives the program a new terminal.
TEST_F(OutputTest, NoColorTurnsColoursOffOnATerminal) {
  if (shell("command -v script").code != 0) GTEST_SKIP() << "script(1) is not installed";
  const std::string command = "script -qec \"'$GLTFX' validate faulty.gltf";
  EXPECT_THAT(shell("unset NO_COLOR; " + command + "\" /dev/null").out, HasSubstr("\x1b["));
  EXPECT_THAT(shell("NO_COLOR=1 " + command + "\" /dev/null").out, Not(HasSubstr("\x1b[")));
  EXPECT_THAT(shell("NO_COLOR=1 " + command + " --color always\" /dev/null").out,
              HasSubstr("\x1b["));
  EXPECT_THAT(shell("NO_COLOR= " + command + " --color never\" /dev/null").out,
              Not(HasSubstr("\x1b[")));
}

TEST_F(OutputTest, AnOutputNeverTakesThePlaceOfAnInput) {
  folder_.write("asset.gltf", kFaulty);
  folder_.link("alias.gltf", "asset.gltf");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"asset.gltf", "--format", "json=asset.gltf"},
        {"asset.gltf", "--format", "json=./alias.gltf"},
        {".", "--write-baseline", "asset.gltf"}}) {
    const Outcome outcome = here(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("is an input of this run"));
    EXPECT_EQ(content("asset.gltf"), kFaulty);
  }
}

}  // namespace
}  // namespace gltfx::program
