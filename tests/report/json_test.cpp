// SPDX-License-Identifier: Apache-2.0
#include <gltfx/version.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/schema_check.hpp"
#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using nlohmann::json;

FormatOptions options() {
  FormatOptions options;
  options.profile = "default";
  options.pixel_level = "headers";
  return options;
}

std::string json_text(const std::vector<FileReport>& reports) {
  return run(ReportFormat::json, reports, options());
}

TEST(JsonReport, WritesOneLineAFile) {
  const Diagnostic unused = finding("UNUSED_OBJECT", Severity::info, "Unused.", "/nodes/1");
  EXPECT_EQ(json_text({file("a.gltf"), file("b.gltf", {unused})}),
            fmt::format(
                R"({{"gltfx":"{}","format":1,"profile":"default","pixels":"headers","files":[
{{"path":"a.gltf","mimeType":"model/gltf+json","readable":true,"counts":{{"errors":0,"warnings":0,"infos":0,"hints":0}},"truncated":false,"suppressed":0,"leftOut":0,"unchanged":0,"fixable":0,"unverified":0,"imagesWanted":0,"imagesDecoded":0,"findings":[]}},
{{"path":"b.gltf","mimeType":"model/gltf+json","readable":true,"counts":{{"errors":0,"warnings":0,"infos":1,"hints":0}},"truncated":false,"suppressed":0,"leftOut":0,"unchanged":0,"fixable":0,"unverified":0,"imagesWanted":0,"imagesDecoded":0,"findings":[{{"code":"UNUSED_OBJECT","severity":"info","message":"Unused.","pointer":"/nodes/1"}}]}}
],"summary":{{"files":2,"filesWithErrors":0,"unreadable":0,"fixable":0,"unverified":0,"suppressed":0,"leftOut":0,"imagesWanted":0,"imagesDecoded":0,"unchanged":0,"errors":0,"warnings":0,"infos":1,"hints":0}}}}
)",
                version()));
}

TEST(JsonReport, OfNoFilesIsStillAnObject) {
  EXPECT_EQ(json::parse(json_text({}))["files"], json::array());
}

TEST(JsonReport, SaysAllThatIsKnownOfAFinding) {
  const json parsed = json::parse(json_text({file("leaf.gltf", {wrong_type()})}));
  EXPECT_EQ(parsed["files"][0]["findings"][0], json::parse(R"({
    "code": "TYPE_MISMATCH", "severity": "error",
    "message": "'metallicFactor' is a string; a number is expected.",
    "help": "write the number without quotes: 0.5",
    "pointer": "/materials/0/pbrMetallicRoughness/metallicFactor",
    "location": {"line": 7, "column": 27, "endLine": 7, "endColumn": 32, "byte": 138, "length": 5},
    "object": "Leaf", "count": 42,
    "lastPointer": "/materials/44/pbrMetallicRoughness/metallicFactor"})"));
}

TEST(JsonReport, GivesOffsetOrPointerOrNeither) {
  const json files = json::parse(json_text(sample_run()))["files"];
  EXPECT_EQ(files[2]["findings"][0]["offset"], 12);
  EXPECT_FALSE(files[2]["findings"][0].contains("pointer"));
  EXPECT_FALSE(files[3]["findings"][0].contains("pointer")) << "the file was never opened";
  EXPECT_FALSE(files[3]["readable"]);
  EXPECT_EQ(files[4]["findings"][0]["pointer"], "/nodes/1");
}

TEST(JsonReport, NamesTheLimitThatAFindingIsAbout) {
  const json parsed = json::parse(json_text({file("leaf.gltf", {over_budget()})}));
  EXPECT_EQ(parsed["files"][0]["findings"][0]["measure"], json::parse(R"({
    "name": "triangles", "on": "mesh", "value": 1250, "op": "max", "limit": 1000,
    "from": "gltfx.toml:8"})"));
}

TEST(JsonReport, ListsTheRequirements) {
  FileReport report = file("leaf.gltf");
  EXPECT_FALSE(json::parse(json_text({report}))["files"][0].contains("requirements"));
  report.requirements = requirements();
  report.unlisted_requirements = 12;
  const json parsed = json::parse(json_text({report}))["files"][0];
  EXPECT_EQ(parsed["unlistedRequirements"], 12);
  EXPECT_EQ(parsed["requirements"], json::parse(R"-([
    {"measure": "triangles", "on": "mesh", "value": 1250, "op": "max", "limit": 1000,
     "from": "gltfx.toml:8", "pointer": "/meshes/0", "object": "Body", "verdict": "fail",
     "severity": "error"},
    {"measure": "size-y", "on": "asset", "value": 0.25, "op": "min", "limit": 0.01, "unit": "m",
     "from": "preset shop/mobile (1.0.0, 2020-10-20)", "verdict": "pass", "severity": "error"},
    {"measure": "root-transform", "on": "asset", "value": false, "op": "equal", "limit": true,
     "from": "preset shop/mobile (1.0.0, 2020-10-20)", "verdict": "fail", "severity": "warning"},
    {"measure": "name", "on": "mesh", "value": "Body", "op": "match", "limit": "^SM_",
     "from": "gltfx.toml:20", "pointer": "/meshes/0", "verdict": "fail", "severity": "error"},
    {"measure": "extensions", "on": "asset", "value": ["KHR_a", "KHR_b"], "op": "allow",
     "limit": ["KHR_*"], "from": "gltfx.toml:7", "verdict": "pass", "severity": "error"},
    {"measure": "value-max", "on": "image", "value": null, "op": "max", "limit": 243,
     "from": "preset shop/mobile (1.0.0, 2020-10-20)", "pointer": "/images/0",
     "verdict": "not-measured", "severity": "error"},
    {"measure": "hard-edges", "on": "mesh", "value": null, "op": "max", "limit": 90,
     "from": "gltfx.toml:9", "parameters": "angle 30 deg", "verdict": "not-applicable",
     "severity": "error"}])-"));
}

TEST(JsonReport, CarriesWhatWasLeftOut) {
  const json parsed = json::parse(json_text(sample_run()));
  const json& big = parsed["files"][4];
  EXPECT_EQ(big["truncated"], true);
  EXPECT_EQ(big["suppressed"], 5);
  EXPECT_EQ(big["unverified"], 1);
  EXPECT_EQ(big["imagesWanted"], 5);
  EXPECT_EQ(big["imagesDecoded"], 5);
  EXPECT_EQ(parsed["summary"], json::parse(R"({"files": 5, "filesWithErrors": 3, "unreadable": 1,
      "fixable": 0, "unverified": 1, "suppressed": 5, "leftOut": 0, "imagesWanted": 5, "imagesDecoded": 5, "unchanged": 0,
      "errors": 44, "warnings": 1, "infos": 4, "hints": 0})"));
}

TEST(JsonReport, ReplacesWhatIsNotUtf8) {
  const json parsed = json::parse(
      json_text({file("b\xff.gltf", {finding("X", Severity::error, "\xe2\x82 \xed\xa0\x80")})}));
  EXPECT_EQ(parsed["files"][0]["path"], "b\uFFFD.gltf");
  const std::string message = parsed["files"][0]["findings"][0]["message"];
  EXPECT_THAT(message, ::testing::StartsWith("\uFFFD"));
}

TEST(JsonReport, CanBeTakenAwayAfterEachFile) {
  const auto writer = make_report_writer(ReportFormat::json, options());
  RunSummary summary;
  std::string whole, part;
  const auto flush = [&] {
    whole += part;
    part.clear();
  };
  writer->begin(part);
  flush();
  for (const FileReport& report : sample_run()) {
    writer->file(report, part);
    summary.add(report);
    flush();
  }
  writer->end(summary, part);
  flush();
  EXPECT_EQ(whole, json_text(sample_run()));
}

// A run in which every member occurs.
json full_run() {
  std::vector<FileReport> reports = sample_run();
  AssetInfo info;
  info.version = info.min_version = "2.0";
  info.generator = "a tool";
  info.extensions_used = info.extensions_required = {"KHR_a"};
  ResourceInfo image{"/images/0", "image/png", "external", "a.png", 7, ResourceInfo::Image{}};
  image.image = ResourceInfo::Image{4, 8, 16, "rgba", "srgb", "linear"};
  info.resources = {image, ResourceInfo{"/buffers/0", "", "", "", {}, {}}};
  reports[0].info = info;
  reports[0].diagnostics.push_back(over_budget());
  reports[0].requirements = requirements();
  reports[0].unlisted_requirements = 12;
  return json::parse(json_text(reports));
}

SchemaCheck published_schema() { return SchemaCheck(json::parse(json_report_schema())); }

TEST(JsonReportSchema, AcceptsWhatIsWritten) {
  EXPECT_THAT(published_schema().errors(full_run()), ::testing::IsEmpty());
  EXPECT_THAT(published_schema().errors(json::parse(run(ReportFormat::json, {}))),
              ::testing::IsEmpty());
}

TEST(JsonReportSchema, DescribesEveryMember) {
  // additionalProperties is false throughout, so a member that is not described is refused.
  json report = full_run();
  for (const char* pointer :
       {"", "/summary", "/files/0", "/files/0/counts", "/files/0/info", "/files/0/findings/0",
        "/files/0/findings/0/location", "/files/0/findings/2/measure", "/files/0/requirements/0",
        "/files/0/info/resources/0", "/files/0/info/resources/0/image"}) {
    json changed = report;
    changed[json::json_pointer(pointer)]["surprise"] = 1;
    EXPECT_THAT(published_schema().errors(changed),
                ::testing::ElementsAre(std::string(pointer) + "/surprise: additionalProperties"));
  }
}

TEST(JsonReportSchema, RefusesWrongValues) {
  const std::vector<std::pair<const char*, json>> wrong{
      {"/format", 2},
      {"/files/0/mimeType", "text/plain"},
      {"/files/0/readable", "yes"},
      {"/files/0/findings/0/severity", "fatal"},
      {"/files/0/findings/0/count", 1},
      {"/files/0/findings/0/location/line", 0},
      {"/files/2/findings/0/offset", -1},
      {"/files/0/info/resources/0/storage", "cloud"},
      {"/files/0/findings/2/measure/op", "about"},
      {"/files/0/requirements/0/verdict", "good"},
      {"/files/0/requirements/0/value", json::object()},
      {"/files/0/requirements/0/limit", nullptr},
      {"/files/0/requirements/4/value/0", 1},
      {"/files/0/unlistedRequirements", 0},
      {"/summary/errors", 1.5}};
  for (const auto& [pointer, value] : wrong) {
    json changed = full_run();
    changed[json::json_pointer(pointer)] = value;
    EXPECT_EQ(published_schema().errors(changed).size(), 1u) << pointer;
  }
}

}  // namespace
}  // namespace gltfx::report::testing
