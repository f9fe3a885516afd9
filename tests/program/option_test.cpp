// SPDX-License-Identifier: Apache-2.0
/// Every option of every verb in every wrong form: the message is that of gltfx, names the option
/// and what is expected.
#include <algorithm>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "help_words.hpp"
#include "process.hpp"
#include "sanitized.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Option {
  std::string short_name, name;
  std::string type;  ///< empty: it takes no value
};

bool needs_value(const Option& option) {
  return !option.type.empty() && !option.type.starts_with('[');
}

// Lines as "  -f,--format NAME[=FILE] ... text".
std::vector<Option> options_of(const std::string& help) {
  const std::regex line(
      "\n +(?:(-[A-Za-z]),)?(--[a-z][a-z-]*)(?: ([^ \n]+)(?: \\.\\.\\.)?)?(?= |\n)");
  std::vector<Option> options;
  for (std::sregex_iterator at(help.begin(), help.end(), line), end; at != end; ++at) {
    options.push_back({(*at)[1], (*at)[2], (*at)[3]});
  }
  return options;
}

// Under sanitizers some of them, as each takes a run.
std::vector<Option> some_of(const std::vector<Option>& options) {
  constexpr std::size_t kStep = kSanitized ? 4 : 1;
  std::vector<Option> some;
  for (std::size_t i = 0; i < options.size(); i += kStep) some.push_back(options[i]);
  return some;
}

class OptionForm : public testing::TestWithParam<std::string> {
 protected:
  OptionForm() : options_(some_of(options_of(gltfx(words({"--help"})).out))) {}

  std::vector<std::string> words(std::vector<std::string> more) const {
    if (!GetParam().empty()) more.insert(more.begin(), GetParam());
    return more;
  }
  void expect_said(const std::vector<std::string>& more, const std::string& said) const {
    const Outcome outcome = gltfx(words(more));
    EXPECT_EQ(outcome.code, 2) << said;
    EXPECT_EQ(outcome.out, "");
    const std::string help = GetParam().empty() ? "gltfx" : "gltfx " + GetParam();
    EXPECT_EQ(outcome.err, "gltfx: " + said + "\nSee '" + help + " --help'.\n");
  }

  const std::vector<Option> options_;
};

TEST_P(OptionForm, AFlagTakesNoValue) {
  for (const Option& option : options_) {
    if (!option.type.empty()) continue;
    expect_said({option.name + "=0"}, option.name + " takes no value; '0' was given.");
    if (option.short_name.empty()) continue;
    expect_said({option.short_name + "=x"}, option.short_name + " takes no value; 'x' was given.");
  }
}

TEST_P(OptionForm, AnOptionNeedsItsValue) {
  for (const Option& option : options_) {
    if (!needs_value(option)) continue;
    const std::string& name = option.name;
    expect_said({name}, name + " needs a value: " + option.type + ".");
    if (option.short_name.empty()) continue;
    expect_said({option.short_name}, name + " needs a value: " + option.type + ".");
    expect_said({option.short_name + "=x"},
                "a short option has no '='; write " + option.short_name + " x or " + name + "=x.");
  }
}

// Invalid values, for one option of each verb: the parser treats options alike.
TEST_P(OptionForm, WhatLooksLikeNoValueIsNone) {
  const auto option = std::find_if(options_.begin(), options_.end(), needs_value);
  if (option == options_.end()) return;
  const std::string& name = option->name;
  expect_said({name, "--", "a.gltf"}, name + " needs a value: " + option->type + ".");
  expect_said({name + "="}, name + " has no value after '='; " + option->type + " is expected.");
  expect_said({name, ""}, "the value of " + name + " is empty; " + option->type + " is expected.");
  expect_said({name, "--help"},
              name + " needs a value, but '--help' is an option; to use it as the value, write " +
                  name + "=--help.");
}

TEST_P(OptionForm, AnArgumentIsNotEmpty) {
  expect_said({""}, "an argument is empty; is a variable of the shell unset?");
  if (!GetParam().empty()) {
    expect_said({"--", ""}, "an argument is empty; is a variable of the shell unset?");
  }
}

// Without the hook, which has the options of the verb after it; the empty one is the program.
const std::vector<std::string> kVerbs{"validate", "fix",    "upgrade", "edit",    "convert",
                                      "compare",  "bake",   "report",  "inspect", "merge",
                                      "explain",  "rules",  "targets", "schema",  "measures",
                                      "presets",  "config", ""};

INSTANTIATE_TEST_SUITE_P(Verbs, OptionForm, testing::ValuesIn(kVerbs),
                         [](const testing::TestParamInfo<std::string>& tested) {
                           return tested.param.empty() ? "program" : tested.param;
                         });

TEST(OptionForms, OfEveryVerbAreTestedAbove) {
  std::vector<std::string> all = verbs_in(gltfx({"--help"}).out);
  std::erase(all, "hook");
  all.emplace_back();
  EXPECT_EQ(all, kVerbs);
  for (const std::string& verb : kVerbs) {
    const std::string help = verb.empty() ? gltfx({"--help"}).out : gltfx({verb, "--help"}).out;
    EXPECT_EQ(options_of(help).size(), options_in(help).size()) << verb;
  }
}

TEST(OptionForms, OfAHookAreThoseOfItsVerb) {
  EXPECT_THAT(gltfx({"hook", "upgrade", "--in-place=x"}).err,
              StartsWith("gltfx: --in-place takes no value; 'x' was given."));
}

TEST(OptionForms, OfSeveralShortOnesInAWord) {
  EXPECT_THAT(gltfx({"validate", "-qf"}).err, StartsWith("gltfx: --format needs a value"));
  EXPECT_THAT(gltfx({"validate", "-qfjsn", "a.gltf"}).err, HasSubstr("Did you mean 'json'?"));
  EXPECT_THAT(gltfx({"validate", "-qx", "a.gltf"}).err, HasSubstr("unknown option '-x'."));
}

TEST(OptionForms, ValuesMayLookLikeOptionsOfOthers) {
  EXPECT_THAT(gltfx({"bake", "a.gltf", "-o", "a.png", "--exposure", "-"}).err,
              HasSubstr("--exposure: '-' is not a number"));
  EXPECT_THAT(gltfx({"validate", "a.gltf", "--select", "{}"}).err, HasSubstr("no rule '{}'"));
  EXPECT_THAT(gltfx({"validate", "a.gltf", "--select", "[X]"}).err, HasSubstr("no rule '[X]'"));
}

TEST(OptionForms, WhatIsGivenCannotDriveTheTerminal) {
  EXPECT_THAT(gltfx({"upgrade", "--in-place=\x1b[2J"}).err,
              AllOf(Not(HasSubstr("\x1b")), HasSubstr("takes no value")));
}

}  // namespace
}  // namespace gltfx::program
