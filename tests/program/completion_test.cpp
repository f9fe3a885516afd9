// SPDX-License-Identifier: Apache-2.0
/// Completion in real shells offers what the program accepts.
#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "help_words.hpp"
#include "process.hpp"
#include "sanitized.hpp"

#ifdef GLTFX_MANUAL
namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::IsEmpty;
using testing::IsSubsetOf;
using testing::Not;
using testing::UnorderedElementsAre;
using Words = std::set<std::string>;

Words lines_of(const std::string& text) {
  Words lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) lines.insert(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

// The words of a line as bash divides them: at blanks, and around "=".
std::string bash_array(const std::string& line) {
  std::string words = "''";
  bool open = false;
  for (const char c : line) {
    if (c == ' ' || c == '=') {
      if (c == '=') words += " '='";
      open = false;
    } else {
      if (!open) words += " ''";
      words.back() = c;
      words += "'";
      open = true;
    }
  }
  return words.substr(3) + (line.ends_with(' ') ? " ''" : "");
}

// What bash offers at the end of each line.
std::vector<Words> all_in_bash(const std::vector<std::string>& lines,
                               const std::string& folder = {}) {
  std::string script = "source '" GLTFX_MANUAL "/completions/bash/gltfx'\n";
  for (const std::string& line : lines) {
    script += "COMP_LINE='" + line + "'; COMP_POINT=${#COMP_LINE}; COMP_WORDS=(" +
              bash_array(line) +
              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
              "_gltfx; printf '%s\\n' \"${COMPREPLY[@]}\"; echo '#'\n";
  }
  const Outcome outcome = bash(script, {folder, {}, {}});
  EXPECT_EQ(outcome.err, "");
  std::vector<Words> offers;
  for (std::size_t at = 0; at < outcome.out.size();) {
    const std::size_t end = outcome.out.find("#\n", at);
    offers.push_back(lines_of(outcome.out.substr(at, end - at)));
    at = end + 2;
  }
  EXPECT_EQ(offers.size(), lines.size());
  offers.resize(lines.size());
  return offers;
}

Words in_bash(const std::string& line, const std::string& folder = {}) {
  return all_in_bash({line}, folder).front();
}

// An option with a value, as the help has it.
struct Valued {
  std::string verb, name;
};

std::vector<Valued> options_with_values() {
  std::vector<Valued> found;
  const std::regex option("\n +(?:-[A-Za-z],)?(--[a-z][a-z-]*) [A-Zo]");
  for (const std::string& verb : verbs_in(gltfx({"--help"}).out)) {
    const std::string text = gltfx({verb, "--help"}).out;
    for (std::sregex_iterator at(text.begin(), text.end(), option), end; at != end; ++at) {
      found.push_back({verb, (*at)[1]});
    }
  }
  return found;
}

// The choices that the program names when none of them is given; none where it takes anything. It
// runs in a separate folder, because some options write.
Words choices(const Valued& option, const std::string& folder) {
  std::vector<std::string> words{option.verb, "none.gltf", option.name, "no-word"};
  if (option.verb == "rules") words.erase(words.begin() + 1);
  if (option.verb == "explain") words[1] = "UNUSED_OBJECT";
  if (option.verb == "schema") words[1] = "material";
  if (option.verb == "bake" || option.verb == "report") {
    for (const char* word : {"-o", "/nonexistent/page.html"}) words.emplace_back(word);
  }
  const Outcome outcome = gltfx(words, {folder, {}, {}});
  std::smatch found;
  const std::regex listed("is not one of ([^\n]*?)\\.( Did|\n)");
  if (!std::regex_search(outcome.err, found, listed)) return {};
  std::string list = found[1];
  std::replace(list.begin(), list.end(), ',', '\n');
  list.erase(std::remove(list.begin(), list.end(), ' '), list.end());
  return lines_of(list);
}

TEST(Completion, OffersTheVerbs) {
  const auto verbs = verbs_in(gltfx({"--help"}).out);
  EXPECT_EQ(in_bash("gltfx "), Words(verbs.begin(), verbs.end()));
  EXPECT_THAT(in_bash("gltfx val"), UnorderedElementsAre("validate"));
  EXPECT_THAT(in_bash("gltfx --v"), UnorderedElementsAre("--version"));
  EXPECT_THAT(in_bash("gltfx hook "), UnorderedElementsAre("fix", "upgrade", "validate"));
}

TEST(Completion, OffersEveryOptionOfTheHelp) {
  const auto verbs = verbs_in(gltfx({"--help"}).out);
  std::vector<std::string> lines;
  for (const std::string& verb : verbs) lines.push_back("gltfx " + verb + " --");
  const auto offers = all_in_bash(lines);
  for (std::size_t i = 0; i < verbs.size(); ++i) {
    EXPECT_EQ(offers[i], options_in(gltfx({verbs[i], "--help"}).out)) << verbs[i];
  }
  EXPECT_EQ(in_bash("gltfx hook upgrade --in"), Words{"--in-place"});
}

// The error of the program is the other list of these words.
TEST(Completion, OffersWhatTheProgramTakes) {
  // The script that is tested is the same; the program would start for each option.
  if (kSanitized) GTEST_SKIP();
  const container::test::TempFolder folder;
  std::vector<std::string> lines;
  std::vector<Words> wanted;
  for (const Valued& option : options_with_values()) {
    Words words = choices(option, folder.path().native());
    if (words.empty()) continue;
    lines.push_back("gltfx " + option.verb + " " + option.name + " ");
    wanted.push_back(std::move(words));
  }
  EXPECT_GT(lines.size(), 30U);
  const auto offers = all_in_bash(lines);
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(offers[i], wanted[i]) << lines[i];
}

TEST(Completion, OffersCodesAndNames) {
  Words codes;
  const auto rules = nlohmann::json::parse(gltfx({"rules", "--format", "json"}).out);
  for (const auto& rule : rules["rules"]) codes.insert(rule["code"].get<std::string>());
  EXPECT_EQ(in_bash("gltfx explain "), codes);
  EXPECT_EQ(in_bash("gltfx validate --ignore "), codes);
  EXPECT_THAT(in_bash("gltfx schema KHR_materials_io"), UnorderedElementsAre("KHR_materials_ior"));
  EXPECT_THAT(in_bash("gltfx schema mate"), Contains("material"));
}

TEST(Completion, GoesOnBehindCommasAndEqualSigns) {
  EXPECT_THAT(in_bash("gltfx validate --select UNUSED_OBJECT,NODE_LO"),
              UnorderedElementsAre("UNUSED_OBJECT,NODE_LOOP"));
  EXPECT_THAT(in_bash("gltfx bake --layer albedo,d"), UnorderedElementsAre("albedo,depth"));
  EXPECT_THAT(in_bash("gltfx validate --lfs=s"), UnorderedElementsAre("skip"));
  EXPECT_THAT(in_bash("gltfx validate --lfs="), UnorderedElementsAre("skip", "error"));
  EXPECT_THAT(in_bash("gltfx validate --severity NODE_LOO"), UnorderedElementsAre("NODE_LOOP="));
  EXPECT_THAT(in_bash("gltfx validate --severity NODE_LOOP=wa"), UnorderedElementsAre("warning"));
}

class CompletionOfPaths : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a.gltf", "b.GLB", "c.png", "d.json", "e.toml", "two words.gltf",
                             "folder/f.gltf", "g.jsonl"}) {
      folder_.write(name, "");
    }
  }
  Words at(const std::string& line) const { return in_bash(line, folder_.path().native()); }
  container::test::TempFolder folder_;
};

TEST_F(CompletionOfPaths, OffersFilesThatFit) {
  const Words assets{"a.gltf", "b.GLB", "two words.gltf", "folder"};
  EXPECT_EQ(at("gltfx validate "), assets);
  EXPECT_EQ(at("gltfx upgrade --in-place "), assets);
  EXPECT_EQ(at("gltfx hook validate "), assets);
  EXPECT_EQ(at("gltfx validate folder/"), Words{"folder/f.gltf"});
  EXPECT_EQ(at("gltfx validate --baseline "), (Words{"d.json", "folder"}));
  EXPECT_EQ(at("gltfx validate --root "), Words{"folder"});
  EXPECT_EQ(at("gltfx merge "), (Words{"g.jsonl", "folder"}));
  EXPECT_EQ(at("gltfx validate --format json=d"), Words{"d.json"});
  EXPECT_EQ(at("gltfx validate --config=e"), Words{"e.toml"});
  EXPECT_THAT(at("gltfx validate --max-triangles "), IsEmpty());
}

bool has(const std::string& program) { return bash("command -v " + program).code == 0; }

// fish prints its offers: a word, a tab, the meaning.
Words in_fish(const std::string& line, const std::string& folder = {}) {
  const Outcome outcome =
      run({"fish", "--no-config", "-c",
           "source '" GLTFX_MANUAL "/completions/fish/gltfx.fish'; complete -C '" + line +
               "' | string replace -r '\\t.*' ''"},
          {folder, {}, {{"HOME", "/nonexistent"}}});
  return lines_of(outcome.out);
}

TEST_F(CompletionOfPaths, FishOffersTheSame) {
  if (!has("fish")) GTEST_SKIP() << "fish is not installed";
  const auto here = [&](const std::string& line) { return in_fish(line, folder_.path().native()); };
  EXPECT_EQ(in_fish("gltfx "), in_bash("gltfx "));
  EXPECT_THAT(in_fish("gltfx validate --"),
              testing::IsSupersetOf(options_in(gltfx({"validate", "--help"}).out)));
  EXPECT_EQ(in_fish("gltfx validate --lfs "), (Words{"skip", "error"}));
  EXPECT_EQ(in_fish("gltfx hook upgrade --generation "), in_bash("gltfx upgrade --generation "));
  EXPECT_EQ(in_fish("gltfx validate --severity NODE_LOOP="),
            (Words{"NODE_LOOP=error", "NODE_LOOP=warning", "NODE_LOOP=info", "NODE_LOOP=hint"}));
  EXPECT_EQ(in_fish("gltfx bake --layer albedo,d"), Words{"albedo,depth"});
  EXPECT_EQ(in_fish("gltfx explain NODE_LOO"), Words{"NODE_LOOP"});
  EXPECT_EQ(here("gltfx validate "), (Words{"a.gltf", "b.GLB", "two words.gltf", "folder/"}));
  EXPECT_EQ(here("gltfx validate --root "), Words{"folder/"});
}

// zsh completes in a terminal only: a new one, in which a function writes the offers.
Words in_zsh(const std::string& line, const std::string& folder = {}) {
  const Outcome outcome = run({"zsh", "-f", GLTFX_SOURCE_DIR "/tests/program/capture.zsh",
                               GLTFX_MANUAL "/completions/zsh", line},
                              {folder, {}, {}});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return lines_of(outcome.out);
}

TEST_F(CompletionOfPaths, ZshOffersTheSame) {
  if (!has("zsh")) GTEST_SKIP() << "zsh is not installed";
  const auto here = [&](const std::string& line) { return in_zsh(line, folder_.path().native()); };
  EXPECT_EQ(in_zsh("gltfx "), in_bash("gltfx "));
  EXPECT_EQ(in_zsh("gltfx validate --"), options_in(gltfx({"validate", "--help"}).out));
  EXPECT_EQ(in_zsh("gltfx validate --lfs="), (Words{"skip", "error"}));
  EXPECT_EQ(in_zsh("gltfx hook upgrade --generation "), in_bash("gltfx upgrade --generation "));
  EXPECT_EQ(in_zsh("gltfx validate --severity NODE_LOOP="),
            (Words{"error", "warning", "info", "hint"}));
  EXPECT_EQ(in_zsh("gltfx bake --layer albedo,d"), Words{"depth"});
  EXPECT_EQ(here("gltfx validate "), (Words{"a.gltf", "b.GLB", "two\\ words.gltf", "folder"}));
  EXPECT_EQ(here("gltfx validate --root "), Words{"folder"});
}

}  // namespace
}  // namespace gltfx::program
#endif
