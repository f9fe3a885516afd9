// SPDX-License-Identifier: Apache-2.0
#include "report/baseline.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

std::string baseline_of(const std::vector<FileReport>& reports) {
  BaselineWriter writer;
  for (const FileReport& report : reports) writer.add(report);
  return writer.text();
}

Baseline parsed(const std::string& text) {
  auto baseline = Baseline::parse(text);
  EXPECT_TRUE(baseline) << text;
  return baseline ? *baseline : Baseline();
}

FileReport after(const std::vector<FileReport>& known, FileReport report) {
  parsed(baseline_of(known)).apply(report);
  return report;
}

Diagnostic unused(std::string pointer) {
  return finding("UNUSED_OBJECT", Severity::info, "Nothing uses this.", std::move(pointer));
}

TEST(Baseline, IsSortedWithOneFindingALine) {
  const std::string expected = R"({
  "gltfx-baseline": 1,
  "findings": [
    {"path": "models/leaf.gltf", "code": "TYPE_MISMATCH", "pointer": "/materials/*/pbrMetallicRoughness/metallicFactor", "count": 42},
    {"path": "models/leaf.gltf", "code": "VALUE_NOT_IN_RANGE", "pointer": "/materials/*/pbrMetallicRoughness/roughnessFactor", "count": 1},
    {"path": "tree.glb", "code": "GLB_CHUNK_TOO_BIG", "pointer": "", "count": 1}
  ]
}
)";
  const FileReport leaf = file("models/leaf.gltf", {out_of_range(), wrong_type()});
  const FileReport tree = file("tree.glb", {bad_chunk()});
  EXPECT_EQ(baseline_of({leaf, tree}), expected);
  EXPECT_EQ(baseline_of({tree, leaf}), expected) << "the order of files does not matter";
}

TEST(Baseline, OfNothingIsEmptyAndReadsBack) {
  EXPECT_EQ(baseline_of({}), "{\n  \"gltfx-baseline\": 1,\n  \"findings\": []\n}\n");
  FileReport report = file("a.gltf", {unused("/nodes/0")});
  parsed(baseline_of({})).apply(report);
  EXPECT_EQ(report.diagnostics.size(), 1u);
}

TEST(Baseline, RepeatsStayWithTheFindingsThatStay) {
  FileReport report = file("a.gltf", {unused("/nodes/0"), unused("/meshes/0")});
  keep_repeat(report, unused("/meshes/5"));
  const FileReport left = after({file("a.gltf", {unused("/nodes/0")})}, report);
  ASSERT_EQ(left.repeats.size(), 1U);
  EXPECT_EQ(left.repeats[0].finding, 0U);
  EXPECT_EQ(left.repeats[0].pointer, "/meshes/5");
  EXPECT_TRUE(after({file("a.gltf", {unused("/meshes/0")})}, report).repeats.empty())
      << "it is unclear which of the two is known";
}

TEST(Baseline, SilencesWhatItWasMadeOf) {
  for (const FileReport& report : sample_run()) {
    if (!report.readable || report.truncated) continue;
    const FileReport left = after({report}, report);
    EXPECT_TRUE(left.diagnostics.empty()) << report.path;
    EXPECT_EQ(left.counts.at_least(Severity::hint), 0u);
    EXPECT_EQ(left.suppressed, report.counts.at_least(Severity::hint));
  }
}

TEST(Baseline, SurvivesAnObjectThatMoves) {
  const FileReport left = after({file("a.gltf", {unused("/nodes/1"), unused("/nodes/4")})},
                                file("a.gltf", {unused("/nodes/2"), unused("/nodes/5")}));
  EXPECT_TRUE(left.diagnostics.empty());
}

TEST(Baseline, ReportsAnotherCodePlaceOrFile) {
  const std::vector<FileReport> known{file("a.gltf", {unused("/nodes/1")})};
  EXPECT_EQ(after(known, file("b.gltf", {unused("/nodes/1")})).diagnostics.size(), 1u);
  EXPECT_EQ(after(known, file("a.gltf", {unused("/meshes/1")})).diagnostics.size(), 1u);
  const Diagnostic other = finding("NODE_EMPTY", Severity::info, "Empty.", "/nodes/1");
  EXPECT_EQ(after(known, file("a.gltf", {other})).diagnostics.size(), 1u);
}

TEST(Baseline, ReportsWhatComesOnTop) {
  const std::vector<FileReport> known{file("a.gltf", {unused("/nodes/1"), unused("/nodes/2")})};
  const FileReport left =
      after(known, file("a.gltf", {unused("/nodes/1"), unused("/nodes/2"), unused("/nodes/3")}));
  ASSERT_EQ(left.diagnostics.size(), 1u);
  EXPECT_EQ(left.diagnostics[0].pointer, "/nodes/3");
  EXPECT_EQ(left.counts.infos, 1u);
  EXPECT_EQ(left.suppressed, 2u);
}

TEST(Baseline, KeepsTheNewPartOfAFoldedFinding) {
  const std::vector<FileReport> known{file("a.gltf", {times(unused("/nodes/1"), 3, "/nodes/5")})};
  const FileReport left = after(known, file("a.gltf", {times(unused("/nodes/1"), 5, "/nodes/9")}));
  ASSERT_EQ(left.diagnostics.size(), 1u);
  EXPECT_EQ(left.diagnostics[0].count, 2u);
  EXPECT_EQ(left.diagnostics[0].help,
            "the baseline knows 3 of the 5 like this, from /nodes/1 to /nodes/9");
  EXPECT_EQ(left.diagnostics[0].last_pointer, "/nodes/9");
  EXPECT_EQ(left.counts.infos, 2u);
  EXPECT_EQ(left.suppressed, 3u);
}

TEST(Baseline, NamesNoLastRepeatWhenOnlyOneIsNew) {
  Diagnostic now = times(unused("/nodes/1"), 4, "/nodes/7");
  now.help = "remove it";
  const FileReport left =
      after({file("a.gltf", {times(unused("/nodes/1"), 3, "/nodes/5")})}, file("a.gltf", {now}));
  ASSERT_EQ(left.diagnostics.size(), 1u);
  EXPECT_EQ(left.diagnostics[0].count, 1u);
  EXPECT_EQ(left.diagnostics[0].last_pointer, "");
  EXPECT_EQ(left.diagnostics[0].help,
            "remove it; the baseline knows 3 of the 4 like this, from /nodes/1 to /nodes/7");
}

TEST(Baseline, LeavesNewFindingsAsTheyAre) {
  const FileReport left = after({file("a.gltf", {unused("/nodes/1")})},
                                file("a.gltf", {times(unused("/meshes/1"), 2, "/meshes/3")}));
  ASSERT_EQ(left.diagnostics.size(), 1u);
  EXPECT_EQ(left.diagnostics[0].help, "");
  EXPECT_EQ(left.diagnostics[0].count, 2u);
  EXPECT_EQ(left.diagnostics[0].last_pointer, "/meshes/3");
  EXPECT_EQ(left.suppressed, 0u);
}

TEST(Baseline, TakesFromTheCountOfTheRightSeverity) {
  FileReport report =
      file("a.gltf", {finding("A", Severity::error, "M."), finding("B", Severity::warning, "M."),
                      finding("C", Severity::hint, "M.")});
  const FileReport left = after({file("a.gltf", {report.diagnostics[1]})}, report);
  EXPECT_EQ(left.counts.errors, 1u);
  EXPECT_EQ(left.counts.warnings, 0u);
  EXPECT_EQ(left.counts.hints, 1u);
}

// Made when the asset broke a warning tier only: the error tier is new.
TEST(Baseline, KnowsTheMildestFindingsFirst) {
  const Diagnostic mild = finding("A", Severity::warning, "M.", "/meshes/0");
  const Diagnostic bad = finding("A", Severity::error, "M.", "/meshes/0");
  const FileReport left = after({file("a.gltf", {mild})}, file("a.gltf", {bad, mild}));
  ASSERT_EQ(left.diagnostics.size(), 1U);
  EXPECT_EQ(left.diagnostics[0].severity, Severity::error);
  EXPECT_EQ(left.counts.errors, 1U);
  EXPECT_EQ(left.counts.warnings, 0U);
}

TEST(Baseline, KnowsAPathHoweverItIsWritten) {
  const FileReport known = file("models/a.gltf", {unused("/nodes/1")});
  for (const std::string path : {"./models/a.gltf", "models//a.gltf", "x/../models/./a.gltf"}) {
    EXPECT_TRUE(after({known}, file(path, {unused("/nodes/1")})).diagnostics.empty()) << path;
  }
}

TEST(Baseline, FindsNamesAgainThatAreNotUtf8) {
  const FileReport report = file("b\xff.gltf", {unused("/extras/\xe2\x82/\x1b\"")});
  EXPECT_TRUE(after({report}, report).diagnostics.empty());
  EXPECT_TRUE(nlohmann::json::accept(baseline_of({report})));
}

TEST(Baseline, NeverHidesThatAFileCannotBeRead) {
  FileReport gone = file("a.gltf", {finding("IO_ERROR", Severity::error, "No such file.")}, "");
  gone.readable = false;
  EXPECT_EQ(baseline_of({gone}), baseline_of({}));
  FileReport readable = gone;
  readable.readable = true;
  EXPECT_EQ(after({readable}, gone).diagnostics.size(), 1u);
}

TEST(Baseline, AddsUpEntriesAfterAMerge) {
  const std::string entry = R"({"path":"a.gltf","code":"UNUSED_OBJECT","pointer":"/nodes/*",)";
  const Baseline baseline = parsed(R"({"gltfx-baseline":1,"findings":[)" + entry +
                                   R"("count":1},)" + entry + R"("count":1}]})");
  FileReport report = file("a.gltf", {times(unused("/nodes/0"), 2, "/nodes/1")});
  baseline.apply(report);
  EXPECT_TRUE(report.diagnostics.empty());
}

TEST(Baseline, DoesNotOverflowWhenCountsAreAbsurd) {
  const std::string entry =
      R"({"path":"a.gltf","code":"UNUSED_OBJECT","pointer":"/nodes/*","count":18446744073709551615})";
  const Baseline baseline =
      parsed(R"({"gltfx-baseline":1,"findings":[)" + entry + "," + entry + "]}");
  FileReport report = file("a.gltf", {unused("/nodes/0")});
  baseline.apply(report);
  EXPECT_TRUE(report.diagnostics.empty());
}

TEST(Baseline, IsSpentAnewForEachReport) {
  const Baseline baseline = parsed(baseline_of({file("a.gltf", {unused("/nodes/1")})}));
  for (int i = 0; i < 2; ++i) {
    FileReport report = file("a.gltf", {unused("/nodes/1")});
    baseline.apply(report);
    EXPECT_TRUE(report.diagnostics.empty());
  }
}

std::string parse_error(std::string_view text) {
  const auto baseline = Baseline::parse(text);
  return baseline ? "no error" : baseline.error().message;
}

TEST(BaselineParse, SaysWhatIsWrongWithAFile) {
  using ::testing::HasSubstr;
  EXPECT_THAT(parse_error("<<<<<<< ours"), HasSubstr("--write-baseline"));
  EXPECT_THAT(parse_error(""), HasSubstr("not valid JSON"));
  EXPECT_THAT(parse_error("[]"), HasSubstr("not a baseline"));
  EXPECT_THAT(parse_error(R"({"asset":{}})"), HasSubstr("not a baseline"));
  EXPECT_THAT(parse_error(R"({"gltfx-baseline":2,"findings":[]})"), HasSubstr("does not know"));
  EXPECT_THAT(parse_error(R"({"gltfx-baseline":1})"), HasSubstr("'findings'"));
  EXPECT_THAT(parse_error(R"({"gltfx-baseline":1,"findings":{}})"), HasSubstr("'findings'"));
}

TEST(BaselineParse, NamesTheEntryThatIsWrong) {
  const std::string good = R"({"path":"a","code":"B","pointer":"","count":1})";
  for (const std::string bad :
       {R"({"code":"B","pointer":"","count":1})", R"({"path":"a","pointer":"","count":1})",
        R"({"path":"a","code":"B","count":1})", R"({"path":"a","code":"B","pointer":""})",
        R"({"path":"a","code":"B","pointer":"","count":0})",
        R"({"path":"a","code":"B","pointer":"","count":-1})",
        R"({"path":"a","code":"B","pointer":"","count":1.5})",
        R"({"path":"a","code":"B","pointer":7,"count":1})", "null", "[]"}) {
    const std::string text = R"({"gltfx-baseline":1,"findings":[)" + good + "," + bad + "]}";
    EXPECT_THAT(parse_error(text), ::testing::StartsWith("findings[1] of the baseline")) << bad;
  }
}

}  // namespace
}  // namespace gltfx::report::testing
