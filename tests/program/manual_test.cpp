// SPDX-License-Identifier: Apache-2.0
/// The manual pages that the build makes, as man and mandoc read them.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "help_words.hpp"
#include "process.hpp"

#ifdef GLTFX_MANUAL
namespace gltfx::program {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

std::vector<std::string> pages() {
  std::vector<std::string> found;
  for (const char* folder : {"/man1", "/man5"}) {
    for (const auto& entry : fs::directory_iterator(GLTFX_MANUAL + std::string(folder))) {
      found.push_back(entry.path().native());
    }
  }
  return found;
}

// As it is read in a terminal.
std::string page(const std::string& name) {
  return bash("mandoc -T ascii -O width=100 '" GLTFX_MANUAL "/" + name +
              "'* | LC_ALL=C sed 's/.\\x08//g'")
      .out;
}

class Manual : public testing::Test {
 protected:
  void SetUp() override {
    if (bash("command -v mandoc").code != 0) GTEST_SKIP() << "mandoc is not installed";
  }
};

TEST_F(Manual, HasAPageForTheProgramEachVerbAndTheConfiguration) {
  EXPECT_EQ(pages().size(), verbs_in(gltfx({"--help"}).out).size() + 2);
}

TEST_F(Manual, IsCleanForItsReaders) {
  const bool has_man = bash("command -v man && command -v groff").code == 0;
  for (const std::string& path : pages()) {
    EXPECT_EQ(bash("mandoc -T lint -W style '" + path + "'").out, "");
    if (has_man) {
      EXPECT_EQ(
          bash("MANROFFSEQ= MANWIDTH=80 LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l -Tutf8 -Z '" +
               path + "' 2>&1 >/dev/null")
              .out,
          "");
    }
  }
}

TEST_F(Manual, TellsEveryOptionAndExample) {
  for (const std::string& verb : verbs_in(gltfx({"--help"}).out)) {
    const std::string help = gltfx({verb, "--help"}).out;
    const std::string text = page("man1/gltfx-" + verb + ".1");
    for (const std::string& option : options_in(help)) {
      EXPECT_THAT(text, ContainsRegex("\n +(-[a-z], )?" + option + "( |\n)")) << verb;
    }
    for (const char* title : {"SYNOPSIS", "DESCRIPTION", "EXAMPLES", "EXIT STATUS", "SEE ALSO"}) {
      EXPECT_THAT(text, HasSubstr(title)) << verb;
    }
    EXPECT_THAT(text, ContainsRegex("EXAMPLES\n +gltfx " + verb)) << "its first example";
  }
}

TEST_F(Manual, KeepsWhatRoffWouldTakeForItself) {
  const std::string validate = page("man1/gltfx-validate.1");
  EXPECT_THAT(validate, HasSubstr("gltfx validate assets/ 'props/**/*.glb' --fail-on warning"));
  EXPECT_THAT(validate, HasSubstr("Add each *.schema.json of a folder"));
  EXPECT_THAT(page("man5/gltfx.toml.5"), HasSubstr("paths = [\"props/**/*.glb\", \"old/\""));
  EXPECT_THAT(page("man1/gltfx-bake.1"), HasSubstr("--output FILE|DIR"));
}

TEST_F(Manual, NamesEveryKeyOfTheConfiguration) {
  const std::string text = page("man5/gltfx.toml.5");
  for (const char* key : {"profile (string)", "budgets (table of MEASURE = LIMIT)",
                          "severity (table of CODE = \"LEVEL\")", "inline-suppressions"}) {
    EXPECT_THAT(text, HasSubstr(key));
  }
  EXPECT_THAT(text, Not(HasSubstr(". .")));
  EXPECT_THAT(text, HasSubstr("As --budget of gltfx-validate(1)."));
  EXPECT_THAT(text, HasSubstr("As --target of gltfx-validate(1)."));
}

}  // namespace
}  // namespace gltfx::program
#endif
