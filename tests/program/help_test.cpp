// SPDX-License-Identifier: Apache-2.0
/// --help, --version, explain and rules: texts about the program.
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "help_words.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

struct Verb {
  std::string name;
  std::vector<std::string> options;
};

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> kVerbs{
      {"validate",
       words("PATH --format --min-severity --group-by --statistics --fail-on --profile --select "
             "--ignore --severity --rules "
             "--inline-suppressions --diff-base --config --isolated --unsandboxed-decoders "
             "--max-issues --pixels --preset --budget --product --max-texture-size "
             "--max-total-pixels --max-triangles "
             "--max-draw-calls --max-file-size --quiet --target --target-file --root --schema "
             "--schema-dir "
             "--lfs "
             "--files-from --shard --exclude --no-ignore --allow-empty --sarif-notes --timings "
             "--cache --cache-key "
             "--baseline --write-baseline --jobs --color")},
      {"upgrade",
       words("PATH --format --restore --in-place --output --backup --check --diff --raw "
             "--unsafe --strict --only --to "
             "--ior --pack --prune --verify --generation --gltf --target --target-file --root "
             "--schema --schema-dir --config "
             "--files-from --shard --exclude --no-ignore --allow-empty --isolated "
             "--unsandboxed-decoders --quiet "
             "--jobs --color")},
      {"edit",
       words("PATH --delete --cascade --format --restore --in-place --output --backup --check "
             "--diff --raw "
             "--root --schema --schema-dir --config --files-from --shard --exclude --no-ignore "
             "--allow-empty --isolated --unsandboxed-decoders --quiet --jobs --color")},
      {"convert",
       words("PATH --to --glb --compress --quantize --images --quality --texture-size --dedup "
             "--prune "
             "--weld "
             "--reorder --resample --shrink --simplify --center --scale --rebase --target "
             "--target-file --gltf --flatten --verify "
             "--partial --format --restore --in-place --output --backup --check --diff "
             "--raw "
             "--root --schema --schema-dir --config --files-from --shard --exclude --no-ignore "
             "--allow-empty --isolated --unsandboxed-decoders --quiet --jobs --color")},
      {"compare",
       words("OLD NEW --allow --bounds --drawn --ignore --count --format --output --pictures "
             "--picture-url --size --all --git --git-driver --setup-git --global "
             "--root --schema --schema-dir --config --isolated "
             "--unsandboxed-decoders --jobs --color")},
      {"hook", words("VERB")},
      {"bake",
       words(
           "PATH --output --format --sheet --size --turntable --clip --fps --layout --layer "
           "--overlay --embed "
           "--compare --camera --projection --interior --frame --lights --environment "
           "--rotate-environment --background --exposure --tone-map --scene "
           "--animation --time "
           "--variant --if-present --strict --quality --samples --bounces --seed --denoise --noise "
           "--time-budget "
           "--shader --root --schema --schema-dir --quiet --config --isolated "
           "--unsandboxed-decoders --jobs --color --files-from --shard --exclude --no-ignore "
           "--allow-empty --cache "
           "--cache-key")},
      {"report",
       words("PATH --output --title --previous --no-thumbnails --thumbnail-size --quality "
             "--quality --fail-on "
             "--profile "
             "--select --ignore --severity --rules --inline-suppressions --config --isolated "
             "--unsandboxed-decoders --max-issues --pixels --preset --budget --product "
             "--max-texture-size "
             "--max-total-pixels --max-triangles --max-draw-calls --max-file-size --quiet "
             "--target --target-file --root --schema --schema-dir --lfs --files-from --shard "
             "--exclude --no-ignore "
             "--allow-empty --cache "
             "--cache-key --baseline --jobs --color")},
      {"inspect",
       words("PATH --format --top --pixels --exclude --no-ignore --allow-empty --root --schema "
             "--schema-dir --quiet --config "
             "--isolated --jobs --color")},
      {"merge",
       words("REPORT --output --format --min-severity --group-by --statistics --sarif-notes "
             "--fail-on --rules --config --isolated --quiet --color")},
      {"explain", words("CODE --rules --config --isolated --color")},
      {"rules", words("--format --rules --test --new --on --config --isolated --color")},
      {"targets", words("NAME[@VERSION] --format --target --target-file --color")},
      {"schema", words("NAME --format --status --new --check --test --schema --schema-dir --config "
                       "--isolated --color")},
      {"measures", words("NAME --format --color")},
      {"presets", words("ID --format --color")},
      {"config", words("PATH --config --isolated --color")},
  };
  return kVerbs;
}

TEST(Help, OfTheProgramListsEveryVerbExamplesAndExitCodes) {
  const Outcome outcome = gltfx({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const Verb& verb : verbs()) EXPECT_THAT(outcome.out, HasSubstr("\n  " + verb.name));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Examples:"), HasSubstr("Exit codes"),
                                 HasSubstr("  3  an input cannot be read\n")));
}

TEST(Help, OfEachVerbListsEveryOptionExamplesAndExitCodes) {
  for (const Verb& verb : verbs()) {
    const Outcome outcome = gltfx({verb.name, "--help"});
    EXPECT_EQ(outcome.code, 0);
    for (const std::string& option : verb.options) {
      EXPECT_THAT(outcome.out, HasSubstr(option)) << verb.name;
    }
    EXPECT_THAT(outcome.out,
                AllOf(HasSubstr("Examples:\n  gltfx " + verb.name), HasSubstr("Exit codes"),
                      HasSubstr("Usage: gltfx " + verb.name)));
    EXPECT_EQ(gltfx({verb.name, "-h"}).out, outcome.out);
  }
}

TEST(Help, ListsTheFormatsOfReports) {
  const std::string list = "Formats: ";
  for (const char* const verb : {"validate", "merge"}) {
    const std::string text = gltfx({verb, "--help"}).out;
    const std::size_t begin = text.find(list) + list.size();
    std::vector<std::string> names = words(text.substr(begin, text.find('\n', begin) - begin));
    EXPECT_EQ(names.size(), 10U);
    for (std::string& name : names) {
      name.pop_back();  // a comma, or the full stop
      EXPECT_EQ(gltfx({"validate", fixture("good/stone.gltf"), "--format", name}).code, 0) << name;
    }
  }
}

TEST(Help, EveryOptionIsInTheTableAbove) {
  for (const Verb& verb : verbs()) {
    std::set<std::string> listed{"--help"};
    for (const std::string& option : verb.options) {
      if (option.front() == '-') listed.insert(option);
    }
    EXPECT_EQ(options_in(gltfx({verb.name, "--help"}).out), listed) << verb.name;
  }
}

TEST(Help, FitsATerminalOfEightyColumns) {
  for (const Verb& verb : verbs()) {
    const std::string text = gltfx({verb.name, "--help"}).out;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      EXPECT_LE(end - at, 80U) << text.substr(at, end - at);
      at = end + 1;
    }
  }
}

TEST(Version, NamesEverythingItWasBuiltWith) {
  const Outcome outcome = gltfx({"--version"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* name :
       {"gltfx 0.", "CLI11 2.", "fmt ", "nlohmann_json 3.", "simdjson 3.", "TBB 20",
        "tomlplusplus 3.", "meshoptimizer 0.", "Draco 1.", "libpng 1.", "libjpeg ", "libwebp 1.",
        "OpenEXR 3.", "zstd 1.", "libavif ", "compiled by "}) {
    EXPECT_THAT(outcome.out, HasSubstr(name));
  }
}

TEST(Explain, TellsWhyAndHowWithTheRealReport) {
  const Outcome outcome = gltfx({"explain", "Value_Not_In_Range"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, AllOf(testing::StartsWith("VALUE_NOT_IN_RANGE (error): "),
                                 HasSubstr("Why it matters"), HasSubstr("How to fix it"),
                                 HasSubstr("error[VALUE_NOT_IN_RANGE]: "),
                                 HasSubstr(" --> example.gltf:"), HasSubstr("Good\n")));
}

TEST(Explain, TakesSeveralCodes) {
  const Outcome outcome = gltfx({"explain", "TYPE_MISMATCH", "UNUSED_OBJECT"});
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("TYPE_MISMATCH (error)"), HasSubstr("UNUSED_OBJECT (")));
}

TEST(Rules, TextHasALineForEachRule) {
  const Outcome text = gltfx({"rules"});
  const json rules = json::parse(gltfx({"rules", "--format", "json"}).out)["rules"];
  EXPECT_GE(rules.size(), 100U);
  for (const json& rule : rules) {
    EXPECT_THAT(text.out, HasSubstr(rule["code"].get<std::string>() + " "));
    const std::string group =
        rule.contains("group") ? " (" + rule["group"].get<std::string>() + ")" : "";
    EXPECT_THAT(text.out, HasSubstr(rule["summary"].get<std::string>() + group + "\n"));
  }
}

TEST(Rules, EachHasAllThatExplainNeeds) {
  const json rules = json::parse(gltfx({"rules", "--format", "json"}).out)["rules"];
  std::string codes;
  for (const json& rule : rules) {
    for (const char* key : {"code", "severity", "summary", "why", "help", "fix"}) {
      EXPECT_FALSE(rule[key].get<std::string>().empty()) << rule["code"] << ' ' << key;
    }
    codes += " " + rule["code"].get<std::string>();
  }
  const Outcome outcome = bash("\"$GLTFX\" explain" + codes);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace gltfx::program
