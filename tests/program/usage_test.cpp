// SPDX-License-Identifier: Apache-2.0
/// Messages about an invalid command: exit code 2, one sentence, a hint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Mistake {
  std::vector<std::string> arguments;
  std::string said;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  for (const std::string& word : mistake.arguments) *out << word << ' ';
}

class Usage : public testing::TestWithParam<Mistake> {};

TEST_P(Usage, IsToldOnStandardErrorWithExitCodeTwo) {
  const Outcome outcome = gltfx(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().said));
  EXPECT_THAT(outcome.err, StartsWith("gltfx: "));
}

INSTANTIATE_TEST_SUITE_P(
    Words, Usage,
    testing::Values(Mistake{{"valdate", "a.gltf"},
                            "unknown verb 'valdate'. Did you mean 'validate'?"},
                    Mistake{{"model.gltf"}, "Did you mean 'gltfx validate model.gltf'?"},
                    Mistake{{"--verison"}, "unknown option '--verison'. Did you mean '--version'?"},
                    Mistake{{"validate", "a.gltf", "--formt", "json"}, "Did you mean '--format'?"},
                    Mistake{{"validate", "a.gltf", "--formt=json"}, "unknown option '--formt'."},
                    Mistake{{"validate", "a.gltf", "-x"}, "unknown option '-x'."},
                    Mistake{{"validate", "-leaf.gltf"},
                            "unknown option '-leaf.gltf'. Write './-leaf.gltf' for a file."},
                    Mistake{{"validate"}, "name at least one file"},
                    Mistake{{"bake"}, "name at least one file"},
                    Mistake{{"validate", "a.gltf", "--format"}, "--format"},
                    Mistake{{"validate", "a.gltf", "--format="}, "has no value"},
                    Mistake{{"validate", "--root=", "a.gltf"}, "has no value"},
                    Mistake{{"validate", "a.gltf", "--format", "jsn"}, "Did you mean 'json'?"},
                    Mistake{{"validate", "a.gltf", "--format", "json="}, "names no file"},
                    Mistake{{"validate", "a.gltf", "--format", "json", "--format", "text"},
                            "json and text both write to standard output"},
                    Mistake{{"validate", "a.gltf", "--format", "json=x", "--format", "github=x"},
                            "both write to 'x'"},
                    Mistake{{"validate", "a.gltf", "--format", "json=x", "--format", "text=./x"},
                            "both write to 'x'"},
                    Mistake{{"validate", "a.gltf", "--format", "json=x", "--write-baseline", "./x"},
                            "--write-baseline: './x' is where --format json writes."},
                    Mistake{{"bake", "a.gltf", "-o", "a.png", "--sheet", "./a.png"},
                            "is a picture of 'a.gltf', too; name another file."},
                    Mistake{{"bake", "a.gltf", "b.gltf", "-o", "a.png"},
                            "'a.png' looks like one picture, but there may be several assets"},
                    Mistake{{"rules", "UNUSED_OBJECT"}, "unexpected argument 'UNUSED_OBJECT'"},
                    Mistake{{"schema", "material", "node"}, "one extension or core type at a time"},
                    Mistake{{"rules", "--format", "github"}, "'github' is not one of text, json."},
                    Mistake{{"explain"}, "name a code"},
                    Mistake{{"hook", "validate", "--shard", "1/2"}, "leave out --files-from"},
                    Mistake{{"hook", "upgrade", "--files-from", "list"}, "the commit says"}));

INSTANTIATE_TEST_SUITE_P(
    Values, Usage,
    testing::Values(
        Mistake{{"validate", "a.gltf", "--fail-on", "warnings"}, "Did you mean 'warning'?"},
        Mistake{{"validate", "a.gltf", "--profile", "kronos"}, "Did you mean 'khronos'?"},
        Mistake{{"validate", "a.gltf", "--lfs", "ignore"}, "'ignore' is not one of skip, error."},
        Mistake{{"validate", "a.gltf", "--pixels", "some"}, "not one of headers, needed, all"},
        Mistake{{"validate", "a.gltf", "--max-triangles", "1k"}, "whole number"},
        Mistake{{"validate", "a.gltf", "--color", "yes"}, "not one of auto, always, never"},
        Mistake{{"validate", "a.gltf", "--jobs", "0"}, "at least 1"},
        Mistake{{"validate", "a.gltf", "--jobs", "-1"}, "'-1' is not a whole number"},
        Mistake{{"validate", "a.gltf", "--jobs", "two"}, "'two' is not a whole number"},
        Mistake{{"validate", "a.gltf", "--jobs", "1.5"}, "'1.5' is not a whole number"},
        Mistake{{"explain", "TYPE_MISMATCH", "--jobs", "2"}, "unknown option '--jobs'"},
        Mistake{{"rules", "--jobs", "2"}, "unknown option '--jobs'"},
        Mistake{{"targets", "--jobs", "2"}, "unknown option '--jobs'"},
        Mistake{{"config", "--jobs", "2"}, "unknown option '--jobs'"},
        Mistake{{"merge", "a.jsonl", "--jobs", "2"}, "unknown option '--jobs'"},
        Mistake{{"schema", "--jobs", "2"}, "unknown option '--jobs'"},
        Mistake{{"validate", "a.gltf", "--max-issues", "-3"}, "at least 0"},
        Mistake{{"validate", "a.gltf", "--max-issues", "99999999999999999999"}, "whole number"},
        Mistake{{"validate", "a.gltf", "--select", "TYPE_MISMACH"},
                "Did you mean 'TYPE_MISMATCH'?"},
        Mistake{{"validate", "a.gltf", "--ignore", "UNUSED_OBJECT,NOPE"}, "no rule 'NOPE'"},
        Mistake{{"validate", "a.gltf", "--severity", "NOPE=error"}, "no rule 'NOPE'"},
        Mistake{{"validate", "a.gltf", "--severity", ","}, "--severity: ',' names no rule."},
        Mistake{{"validate", "a.gltf", "--select", ","}, "--select: ',' names no rule."},
        Mistake{{"validate", "a.gltf", "--ignore", ",,"}, "--ignore: ',,' names no rule."},
        Mistake{{"bake", "a.gltf", "-o", "a.png", "--size", ","}, "'' is neither N nor WxH"},
        Mistake{{"validate", "a.gltf", "--severity", "UNUSED_OBJECT"}, "should read"},
        Mistake{{"validate", "a.gltf", "--severity", "UNUSED_OBJECT=loud"}, "should read"},
        Mistake{{"validate", "a.gltf", "--root", "no/such/folder"}, "is not a folder"},
        Mistake{{"validate", "a.gltf", "--schema", "no.schema.json"}, "cannot read"},
        Mistake{{"validate", "a.gltf", "--schema-dir", "no/such/folder"}, "cannot list"},
        Mistake{{"validate", "a.gltf", "--baseline", "no.json"}, "cannot read 'no.json'"},
        Mistake{{"explain", "type_mismach"}, "Did you mean 'TYPE_MISMATCH'?"},
        Mistake{{"schema", "KHR_materials_iro"}, "Did you mean 'KHR_materials_ior'?"}));

TEST(UsageText, PointsToTheHelpOfTheVerb) {
  EXPECT_THAT(gltfx({"validate", "--nope"}).err, HasSubstr("See 'gltfx validate --help'."));
  EXPECT_THAT(gltfx({"nope"}).err, HasSubstr("See 'gltfx --help'."));
}

TEST(UsageText, WithoutAVerbTheHelpIsShown) {
  const Outcome outcome = gltfx({});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("Usage: gltfx"));
}

TEST(UsageText, WhatTheUserTypedCannotDriveTheTerminal) {
  const Outcome outcome = gltfx({"val\x1b[2Jidate"});
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
}

TEST(UsageText, TheLastOfRepeatedValuesCounts) {
  EXPECT_EQ(
      gltfx({"validate", fixture("tour/lamp.gltf"), "--fail-on", "error", "--fail-on", "never"})
          .code,
      0);
}

}  // namespace
}  // namespace gltfx::program
