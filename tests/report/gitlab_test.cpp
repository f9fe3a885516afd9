// SPDX-License-Identifier: Apache-2.0
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/schema_check.hpp"
#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using nlohmann::json;

FormatOptions in_folder(std::string folder, std::string repository = {}) {
  FormatOptions options;
  options.folder = std::move(folder);
  options.repository = std::move(repository);
  return options;
}

std::string gitlab(const std::vector<FileReport>& reports, const FormatOptions& options = {}) {
  return run(ReportFormat::gitlab, reports, options);
}

json gitlab_finding(const Diagnostic& finding, const std::string& mime_type = "model/gltf+json") {
  return json::parse(gitlab({file("a.gltf", {finding}, mime_type)}))[0];
}

std::string path_of(const std::string& path, const FormatOptions& options) {
  return json::parse(gitlab({file(path, {out_of_range()})}, options))[0]["location"]["path"];
}

std::string fingerprint(const Diagnostic& finding) {
  return gitlab_finding(finding)["fingerprint"];
}

TEST(Gitlab, WritesALineAFinding) {
  EXPECT_EQ(gitlab({file("models/leaf.gltf", {wrong_type(), out_of_range()}), file("clean.gltf"),
                    file("tree.glb", {bad_chunk()}, "model/gltf-binary")}),
            R"([
{"description":"'metallicFactor' is a string; a number is expected. Help: write the number without quotes: 0.5. Found at /materials/0/pbrMetallicRoughness/metallicFactor ('Leaf'). Note: repeated 41 more times, last at /materials/44/pbrMetallicRoughness/metallicFactor.","check_name":"TYPE_MISMATCH","fingerprint":"83121d9e0b45aff516eed5e690d23df2","severity":"major","location":{"path":"models/leaf.gltf","lines":{"begin":7}}},
{"description":"'roughnessFactor' is 1.75; 0 to 1 is allowed. Found at /materials/0/pbrMetallicRoughness/roughnessFactor.","check_name":"VALUE_NOT_IN_RANGE","fingerprint":"d6ba1f18e2b8b62a03b445117cfb5853","severity":"minor","location":{"path":"models/leaf.gltf","lines":{"begin":8}}},
{"description":"The chunk ends after the file.","check_name":"GLB_CHUNK_TOO_BIG","fingerprint":"8b7354a0aba2223ab6010b93d9f906da","severity":"major","location":{"path":"tree.glb","lines":{"begin":1}}}
]
)");
}

TEST(Gitlab, WithoutFindingsIsAnEmptyArray) {
  EXPECT_EQ(gitlab({}), "[]\n");
  EXPECT_EQ(gitlab({file("clean.gltf")}), "[]\n");
}

// The members that the documentation of GitLab asks for, and no others.
TEST(Gitlab, HasTheShapeThatIsDocumented) {
  SchemaCheck schema(json::parse(R"({
    "type": "array",
    "items": {
      "type": "object",
      "required": ["description", "check_name", "fingerprint", "severity", "location"],
      "properties": {
        "description": {"type": "string"},
        "check_name": {"type": "string"},
        "fingerprint": {"type": "string"},
        "severity": {"enum": ["info", "minor", "major", "critical", "blocker"]},
        "location": {
          "type": "object",
          "required": ["path", "lines"],
          "properties": {
            "path": {"type": "string"},
            "lines": {
              "type": "object",
              "required": ["begin"],
              "properties": {"begin": {"type": "integer", "minimum": 1}},
              "additionalProperties": false
            }
          },
          "additionalProperties": false
        }
      },
      "additionalProperties": false
    }
  })"));
  EXPECT_THAT(schema.errors(json::parse(gitlab(sample_run()))), ::testing::IsEmpty());
}

TEST(Gitlab, HasASeverityForEachOfOurs) {
  EXPECT_EQ(gitlab_finding(finding("X", Severity::error, "M."))["severity"], "major");
  EXPECT_EQ(gitlab_finding(finding("X", Severity::warning, "M."))["severity"], "minor");
  EXPECT_EQ(gitlab_finding(finding("X", Severity::info, "M."))["severity"], "info");
  EXPECT_EQ(gitlab_finding(finding("X", Severity::hint, "M."))["severity"], "info");
  FileReport gone = file("gone.gltf", {finding("IO_ERROR", Severity::error, "No such file.")}, "");
  gone.readable = false;
  EXPECT_EQ(json::parse(gitlab({gone}))[0]["severity"], "critical");
}

TEST(Gitlab, LinesAreThoseOfTheFile) {
  const Diagnostic inside = on(finding("X", Severity::error, "M."), "{\n\"scene\":7}", "7", 20);
  EXPECT_EQ(gitlab_finding(inside)["location"]["lines"]["begin"], 2);
  EXPECT_EQ(gitlab_finding(inside, "model/gltf-binary")["location"]["lines"]["begin"], 1);
  EXPECT_EQ(gitlab_finding(finding("X", Severity::error, "M."))["location"]["lines"]["begin"], 1);
}

TEST(Gitlab, PathsStartAtTheRepository) {
  EXPECT_EQ(path_of("./a//b/../leaf.gltf", {}), "a/leaf.gltf");
  EXPECT_EQ(path_of("./leaf.gltf", in_folder("/repo")), "leaf.gltf");
  EXPECT_EQ(path_of("/repo/models/leaf.gltf", in_folder("/repo")), "models/leaf.gltf");
  EXPECT_EQ(path_of("leaf.gltf", in_folder("/repo/models", "/repo")), "models/leaf.gltf");
  EXPECT_EQ(path_of("../props/leaf.gltf", in_folder("/repo/models", "/repo")), "props/leaf.gltf");
  EXPECT_EQ(path_of("/else/leaf.gltf", in_folder("/repo/models", "/repo")), "/else/leaf.gltf");
  EXPECT_EQ(path_of("-", in_folder("/repo")), "-");
}

TEST(Gitlab, AFingerprintStaysWhereLinesAndIndicesChange) {
  Diagnostic moved = out_of_range();
  moved.location.line = 70;
  moved.pointer = "/materials/3/pbrMetallicRoughness/roughnessFactor";
  moved.message = "Other words.";
  EXPECT_EQ(fingerprint(moved), fingerprint(out_of_range()));
  moved.object_name = "Stem";
  EXPECT_NE(fingerprint(moved), fingerprint(out_of_range()));
  EXPECT_NE(fingerprint(wrong_type()), fingerprint(out_of_range()));
}

TEST(Gitlab, NoTwoFindingsHaveOneFingerprint) {
  FileReport twice = file("leaf.gltf", {out_of_range(), out_of_range()});
  keep_repeat(twice, out_of_range());
  FileReport other = twice;
  other.path = "stem.gltf";
  const json findings = json::parse(gitlab({twice, other, twice}));
  std::set<std::string> fingerprints;
  for (const json& one : findings) fingerprints.insert(one["fingerprint"]);
  EXPECT_EQ(findings.size(), 9U);
  EXPECT_EQ(fingerprints.size(), 9U);
}

}  // namespace
}  // namespace gltfx::report::testing
