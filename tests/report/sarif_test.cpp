// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/file_uri.hpp"
#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr std::array<RuleDescription, 2> kSarifRules{{{.code = "TYPE_MISMATCH",
                                                       .severity = Severity::error,
                                                       .summary = "A value has the wrong type",
                                                       .why = "Readers refuse it.",
                                                       .help = "Write the right type.",
                                                       .section = "glTF 2.0, Accessors",
                                                       .link = "https://example.org/gltf#accessors",
                                                       .bad = "{\"a\": 1}",
                                                       .good = "",
                                                       .fix_does = "",
                                                       .fixed = "",
                                                       .group = ""},
                                                      {.code = "UNUSED_OBJECT",
                                                       .severity = Severity::info,
                                                       .summary = "Nothing uses an object",
                                                       .why = "It costs space.",
                                                       .help = "Remove it.",
                                                       .section = "",
                                                       .link = "",
                                                       .bad = "",
                                                       .good = "",
                                                       .fix_does = "",
                                                       .fixed = "",
                                                       .group = ""}}};

FormatOptions sarif_options() {
  FormatOptions sarif_options;
  sarif_options.profile = "default";
  sarif_options.pixel_level = "headers";
  sarif_options.rules = kSarifRules;
  sarif_options.folder = "/home/anna b/assets";
  sarif_options.sarif_notes = true;
  return sarif_options;
}

json sarif_run(const std::vector<FileReport>& reports,
               const FormatOptions& with = sarif_options()) {
  const json log = json::parse(run(ReportFormat::sarif, reports, with));
  EXPECT_EQ(log["version"], "2.1.0");
  EXPECT_EQ(log["runs"].size(), 1U);
  return log["runs"][0];
}

json result(const Diagnostic& finding, std::string mime_type = "model/gltf+json") {
  return sarif_run({file("a.gltf", {finding}, std::move(mime_type))})["results"][0];
}

json place(const json& result) { return result["locations"][0]["physicalLocation"]; }

TEST(Sarif, ResultNamesRuleLevelPlaceAndRepeats) {
  const json one = sarif_run({file("models/leaf.gltf", {wrong_type()})})["results"][0];
  EXPECT_EQ(one["ruleId"], "TYPE_MISMATCH");
  EXPECT_EQ(one["ruleIndex"], 0);
  EXPECT_EQ(one["level"], "error");
  EXPECT_EQ(one["message"]["text"],
            "'metallicFactor' is a string; a number is expected. Help: write the number without "
            "quotes: 0.5.");
  EXPECT_EQ(place(one)["artifactLocation"],
            json::parse(R"({"uri": "models/leaf.gltf", "uriBaseId": "SRCROOT", "index": 0})"));
  EXPECT_EQ(place(one)["region"], json::parse(R"({"startLine": 7, "startColumn": 27, "endLine": 7,
      "endColumn": 32, "byteOffset": 138, "byteLength": 5})"));
  EXPECT_EQ(one["locations"][0]["logicalLocations"][0]["fullyQualifiedName"], kMetallic);
  EXPECT_EQ(one["occurrenceCount"], 42);
  EXPECT_EQ(one["relatedLocations"][0]["logicalLocations"][0]["fullyQualifiedName"],
            "/materials/44/pbrMetallicRoughness/metallicFactor");
  EXPECT_EQ(one["partialFingerprints"]["codeAndPlace/v2"],
            "TYPE_MISMATCH at /materials/*/pbrMetallicRoughness/metallicFactor ('Leaf')");
  EXPECT_EQ(one["properties"]["object"], "Leaf");
}

TEST(Sarif, AResultNamesTheLimitThatItIsAbout) {
  EXPECT_EQ(result(over_budget())["properties"], json::parse(R"({"object": "Body", "measure": {
      "name": "triangles", "on": "mesh", "value": 1250, "op": "max", "limit": 1000,
      "from": "gltfx.toml:8"}})"));
  EXPECT_FALSE(result(wrong_type())["properties"].contains("measure"));
}

TEST(Sarif, ColumnsAreUtf16CodeUnits) {
  const std::string_view text = "{\"\U0001F342\U0001F342é\": 1}";
  const json one = result(on(finding("X", Severity::error, "M."), text, "1"));
  EXPECT_EQ(place(one)["region"]["startColumn"], 11);
  EXPECT_EQ(place(one)["region"]["endColumn"], 12);
  EXPECT_EQ(sarif_run({})["columnKind"], "utf16CodeUnits");
}

TEST(Sarif, ABinaryFileHasBytesAndItsFirstLine) {
  const Diagnostic inside =
      on(finding("X", Severity::error, "M.", "/scene"), "{\"scene\":7}", "7", 20);
  EXPECT_EQ(place(result(inside, "model/gltf-binary"))["region"],
            json::parse(R"({"startLine": 1, "byteOffset": 29, "byteLength": 1})"));
  EXPECT_EQ(place(result(bad_chunk(), "model/gltf-binary"))["region"],
            json::parse(R"({"startLine": 1, "byteOffset": 12, "byteLength": 0})"));
}

TEST(Sarif, AFindingOnTheFileStandsAtItsStart) {
  EXPECT_EQ(place(result(finding("X", Severity::error, "M.")))["region"]["startLine"], 1);
}

TEST(Sarif, LevelsAreThoseOfTheStandard) {
  EXPECT_EQ(result(finding("X", Severity::warning, "M."))["level"], "warning");
  EXPECT_EQ(result(finding("X", Severity::info, "M."))["level"], "note");
  EXPECT_EQ(result(finding("X", Severity::hint, "M."))["level"], "note");
}

TEST(Sarif, ListsTheRulesThatWereMetOnce) {
  const json driver = sarif_run(
      {file("a", {out_of_range(), wrong_type()}), file("b", {wrong_type()})})["tool"]["driver"];
  EXPECT_EQ(driver["name"], "gltfx");
  ASSERT_EQ(driver["rules"].size(), 2U);
  EXPECT_EQ(driver["rules"][0], json::parse(R"({"id": "VALUE_NOT_IN_RANGE",
      "defaultConfiguration": {"level": "warning"}})"));
  const json& rule = driver["rules"][1];
  EXPECT_EQ(rule["id"], "TYPE_MISMATCH");
  EXPECT_EQ(rule["name"], "TypeMismatch");
  EXPECT_EQ(rule["shortDescription"]["text"], "A value has the wrong type.");
  EXPECT_EQ(rule["help"]["text"], "Write the right type.");
  EXPECT_THAT(rule["help"]["markdown"].get<std::string>(), HasSubstr("```json\n{\"a\": 1}\n```"));
  EXPECT_THAT(rule["helpUri"].get<std::string>(), ::testing::StartsWith("https://"));
  EXPECT_EQ(rule["defaultConfiguration"]["level"], "error");
}

TEST(Sarif, SaysHowTheRunWent) {
  const json run = sarif_run(sample_run());
  EXPECT_EQ(run["artifacts"].size(), 5U);
  EXPECT_EQ(run["artifacts"][2]["mimeType"], "model/gltf-binary");
  const json& invocation = run["invocations"][0];
  EXPECT_EQ(invocation["executionSuccessful"], false);  // one file could not be read
  EXPECT_FALSE(invocation.contains("exitCode"));
  const json& notes = invocation["toolExecutionNotifications"];
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0]["message"]["text"], "3 more findings are not listed (--max-issues).");
  EXPECT_EQ(notes[0]["locations"][0]["physicalLocation"]["artifactLocation"]["index"], 4);
  EXPECT_EQ(run["properties"], json::parse(R"({"profile": "default", "pixels": "headers"})"));
}

TEST(Sarif, NamesTheExitCodeWhereItIsKnown) {
  const auto writer = make_report_writer(ReportFormat::sarif, {});
  std::string out;
  writer->begin(out);
  RunSummary summary;
  summary.exit_code = 1;
  writer->end(summary, out);
  const json run = json::parse(out)["runs"][0];
  EXPECT_EQ(run["invocations"][0], json::parse(R"({"executionSuccessful": true, "exitCode": 1})"));
  EXPECT_FALSE(run.contains("originalUriBaseIds"));
}

TEST(Sarif, AFixIsGivenAsReplacements) {
  Diagnostic d = wrong_type();
  ProposedFix fix{"Write a number.", {{d.location, "0.5"}}};
  d.fix = std::make_shared<const ProposedFix>(fix);
  const json change = result(d)["fixes"][0]["artifactChanges"][0];
  EXPECT_EQ(change["artifactLocation"]["uri"], "a.gltf");
  EXPECT_EQ(change["replacements"][0]["deletedRegion"]["startColumn"], 27);
  EXPECT_EQ(change["replacements"][0]["insertedContent"]["text"], "0.5");
  EXPECT_FALSE(result(d, "model/gltf-binary").contains("fixes"));
}

// The fingerprints of a file's results, in their order.
std::vector<std::string> fingerprints(const FileReport& report, const std::string& name) {
  std::vector<std::string> all;
  const json run = sarif_run({report});
  for (const json& result : run["results"]) {
    all.push_back(result["partialFingerprints"][name]);
  }
  return all;
}

Diagnostic at_node(std::size_t index, std::string name) {
  Diagnostic d = finding("UNUSED_OBJECT", Severity::warning, fmt::format("Node {}.", index),
                         fmt::format("/nodes/{}", index));
  d.object_name = std::move(name);
  return d;
}

TEST(Sarif, EachRepeatIsAResultOfItsOwn) {
  FileReport report = file("a.gltf", {at_node(0, "Oak")});
  keep_repeat(report, at_node(3, "Elm"));
  const json results = sarif_run({report})["results"];
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[1]["message"]["text"], "Node 3.");
  EXPECT_EQ(results[1]["level"], "warning");
  EXPECT_EQ(results[1]["locations"][0]["logicalLocations"][0]["fullyQualifiedName"], "/nodes/3");
  EXPECT_EQ(results[1]["properties"]["object"], "Elm");
  for (const json& result : results) EXPECT_FALSE(result.contains("occurrenceCount"));
  EXPECT_EQ(fingerprints(report, "codeAndPlace/v2"),
            (std::vector<std::string>{"UNUSED_OBJECT at /nodes/* ('Oak')",
                                      "UNUSED_OBJECT at /nodes/* ('Elm')"}));
}

TEST(Sarif, RepeatsThatWereNotKeptStayWithTheFinding) {
  FileReport report = file("a.gltf", {at_node(0, "Oak")});
  keep_repeat(report, at_node(3, "Elm"));
  report.diagnostics[0].count = 10;
  report.diagnostics[0].last_pointer = "/nodes/90";
  const json results = sarif_run({report})["results"];
  EXPECT_EQ(results[0]["occurrenceCount"], 9);
  EXPECT_EQ(results[0]["relatedLocations"][0]["logicalLocations"][0]["fullyQualifiedName"],
            "/nodes/90");
}

TEST(Sarif, FingerprintsSurviveAnInsertedNode) {
  const char* const kGitHub = "primaryLocationLineHash";
  const FileReport before = file("a.gltf", {at_node(0, "Oak"), at_node(1, ""), at_node(2, "")});
  const FileReport after = file("a.gltf", {at_node(1, "Oak"), at_node(2, ""), at_node(3, "")});
  const std::vector<std::string> prints = fingerprints(before, kGitHub);
  EXPECT_EQ(prints, fingerprints(after, kGitHub));
  EXPECT_EQ(std::set<std::string>(prints.begin(), prints.end()).size(), 3U);
  EXPECT_THAT(prints[1], ::testing::MatchesRegex("[0-9a-f]{16}:1"));
  EXPECT_THAT(prints[2], ::testing::MatchesRegex("[0-9a-f]{16}:2"));
}

TEST(Sarif, NotesAreForThoseWhoAskForThem) {
  const std::vector<FileReport> reports{
      file("a.gltf", {finding("X", Severity::warning, "M."), finding("Y", Severity::info, "M."),
                      finding("Z", Severity::hint, "M."), finding("Z", Severity::hint, "N.")})};
  const auto codes = [&](const FormatOptions& with) {
    std::string all;
    const json run = sarif_run(reports, with);
    for (const json& result : run["results"]) {
      all += result["ruleId"].get<std::string>();
    }
    return all;
  };
  EXPECT_EQ(codes(sarif_options()), "XYZZ");
  FormatOptions quiet = sarif_options();
  quiet.sarif_notes = false;
  EXPECT_EQ(codes(quiet), "X");
  const json run = sarif_run(reports, quiet);
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"],
            "3 notes not listed (--sarif-notes lists them).");
  EXPECT_EQ(run["tool"]["driver"]["rules"].size(), 1U);
  quiet.fail_on = Severity::info;
  EXPECT_EQ(codes(quiet), "XY") << "what fails the run is listed";
}

TEST(Sarif, ListsWhatServicesTakeTheMostSevereFirst) {
  std::vector<Diagnostic> many;
  for (int i = 0; i < 6000; ++i) {
    const bool late_error = i >= 5990;
    many.push_back(finding(late_error ? "E" : "W", late_error ? Severity::error : Severity::warning,
                           "M.", fmt::format("/nodes/{}", i)));
  }
  const json run = sarif_run({file("a.gltf", many)});
  ASSERT_EQ(run["results"].size(), 5000U);
  EXPECT_EQ(run["results"][0]["locations"][0]["logicalLocations"][0]["fullyQualifiedName"],
            "/nodes/0");
  EXPECT_EQ(run["results"][4989]["ruleId"], "W");
  EXPECT_EQ(run["results"][4990]["ruleId"], "E");
  EXPECT_EQ(run["results"][4999]["ruleId"], "E");
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"],
            "Only 5000 results are listed, as many as code-scanning services show; left out: 0 "
            "errors, 1000 warnings, 0 notes.");
}

TEST(Sarif, SaysHowManyFindingsLieOnLinesThatDidNotChange) {
  FileReport report = file("a.gltf");
  report.unchanged = 7;
  EXPECT_EQ(
      sarif_run({report})["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"],
      "7 findings not shown, on lines that did not change (--diff-base).");
}

TEST(Sarif, AssetTextIsNoPlaceholderAndNoLink) {
  const json one = result(finding("X", Severity::error, "see {0} [here](https://h/) a[1]"));
  EXPECT_EQ(one["message"]["text"], "see {{0}} [here\\](https://h/) a[1]");
}

TEST(FileUri, IsRelativeBelowTheFolderAndEncoded) {
  const std::string folder = "/home/anna b";
  EXPECT_EQ(file_uri("./a//b c#%.gltf", folder).text, "a/b%20c%23%25.gltf");
  EXPECT_EQ(file_uri("a:b.gltf", folder).text, "a%3Ab.gltf");
  EXPECT_EQ(file_uri("\xff::error::\n", folder).text, "%FF%3A%3Aerror%3A%3A%0A");
  EXPECT_EQ(file_uri("/home/anna b/x/y.glb", folder).text, "x/y.glb");
  EXPECT_TRUE(file_uri("/home/anna b/x/y.glb", folder).relative);
}

TEST(FileUri, IsAbsoluteElsewhere) {
  const FileUri uri = file_uri("../c d/x.glb", "/home/anna b");
  EXPECT_EQ(uri.text, "file:///home/c%20d/x.glb");
  EXPECT_FALSE(uri.relative);
  EXPECT_EQ(file_uri("/x.glb", "").text, "file:///x.glb");
  EXPECT_EQ(file_uri("../x.glb", "").text, "../x.glb");
  EXPECT_EQ(folder_uri("/home/anna b"), "file:///home/anna%20b/");
  EXPECT_EQ(folder_uri("/"), "file:///");
}

}  // namespace
}  // namespace gltfx::report::testing
