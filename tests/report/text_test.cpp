// SPDX-License-Identifier: Apache-2.0
// The text format. The texts are golden: a change of a blank is a change for every user.
#include <gmock/gmock.h>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string text(const std::vector<FileReport>& reports, bool quiet = true) {
  FormatOptions options;
  options.quiet = quiet;
  return run(ReportFormat::text, reports, options);
}

TEST(Text, ShowsTheLineAndMarksWhatIsWrong) {
  EXPECT_EQ(text({file("models/leaf.gltf", {wrong_type()})}),
            R"(error[TYPE_MISMATCH]: 'metallicFactor' is a string; a number is expected.
 --> models/leaf.gltf:7:27 at /materials/0/pbrMetallicRoughness/metallicFactor ('Leaf')
  |
7 |         "metallicFactor": "0.5",
  |                           ^^^^^
  = help: write the number without quotes: 0.5
  = note: repeated 41 more times, last at /materials/44/pbrMetallicRoughness/metallicFactor

)");
}

TEST(Text, AlignsTheGutterWithLongLineNumbers) {
  Diagnostic d = out_of_range();
  d.location.line = 12345;
  d.help = "write 1";
  EXPECT_EQ(text({file("a.gltf", {d})}),
            R"(warning[VALUE_NOT_IN_RANGE]: 'roughnessFactor' is 1.75; 0 to 1 is allowed.
     --> a.gltf:12345:28 at /materials/0/pbrMetallicRoughness/roughnessFactor
      |
12345 |         "roughnessFactor": 1.75
      |                            ^^^^
      = help: write 1

)");
}

TEST(Text, NamesTheByteOfAContainerFinding) {
  EXPECT_EQ(text({file("tree.glb", {bad_chunk()}, "model/gltf-binary")}),
            "error[GLB_CHUNK_TOO_BIG]: The chunk ends after the file.\n"
            " --> tree.glb: byte 12\n\n");
}

TEST(Text, NamesLineAndByteOfAFindingInTheJsonChunk) {
  const std::string_view chunk = R"({"asset":{"version":"2.0"},"scene":7})";
  const Diagnostic d =
      on(finding("UNRESOLVED_REFERENCE", Severity::error, "There is no scene 7.", "/scene"), chunk,
         "7", 20);
  EXPECT_EQ(text({file("tree.glb", {d}, "model/gltf-binary")}),
            R"(error[UNRESOLVED_REFERENCE]: There is no scene 7.
 --> tree.glb:1:36 (JSON chunk, byte 55) at /scene
  |
1 | {"asset":{"version":"2.0"},"scene":7}
  |                                    ^

)");
}

TEST(Text, ShowsOnlyThePathOfAFindingWithoutPlace) {
  EXPECT_EQ(text({file("gone.gltf", {finding("IO_ERROR", Severity::error, "No such file.")})}),
            "error[IO_ERROR]: No such file.\n --> gone.gltf\n\n");
}

TEST(Text, ShowsThePointerOfAFindingWithoutLine) {
  EXPECT_EQ(text({file("a.gltf", {finding("UNUSED_OBJECT", Severity::info, "Nothing uses this.",
                                          "/nodes/1")})}),
            "info[UNUSED_OBJECT]: Nothing uses this.\n --> a.gltf at /nodes/1\n\n");
}

TEST(Text, SaysOnceMoreOfOneRepeat) {
  const Diagnostic d =
      times(finding("NODE_EMPTY", Severity::hint, "Empty.", "/nodes/1"), 2, "/nodes/3");
  EXPECT_EQ(text({file("a.gltf", {d})}),
            "hint[NODE_EMPTY]: Empty.\n --> a.gltf at /nodes/1\n"
            "  = note: repeated once more at /nodes/3\n\n");
}

TEST(Text, SaysHowManyFindingsAreNotListed) {
  FileReport report = file("a.gltf", {finding("NODE_EMPTY", Severity::info, "Empty.")});
  report.truncated = true;
  report.counts.infos = 4;
  EXPECT_THAT(
      text({report}),
      ::testing::EndsWith("note: a.gltf: 3 more findings are not listed (--max-issues)\n\n"));
  report.counts.infos = 2;
  EXPECT_THAT(text({report}),
              ::testing::EndsWith("note: a.gltf: 1 more finding is not listed (--max-issues)\n\n"));
}

TEST(Text, CutsAPointerInItsMiddle) {
  const std::string pointer = "/" + std::string(1000, 'a') + "/" + std::string(1000, 'b');
  const std::string out = text({file("a.gltf", {finding("X", Severity::info, "M.", pointer)})});
  EXPECT_THAT(out, ::testing::HasSubstr(" at /" + std::string(79, 'a') + "…" +
                                        std::string(80, 'b') + "\n"));
}

TEST(Text, IsSilentAboutFilesWithoutFindings) { EXPECT_EQ(text({file("a.gltf")}), ""); }

TEST(TextSummary, IsOneQuietLineForACleanFile) {
  EXPECT_EQ(text({file("a.gltf")}, false), "1 file checked: no problems\n");
}

TEST(TextSummary, CountsBySeverityAndSaysWhatWasNotLookedInto) {
  const std::string out = text(sample_run(), false);
  EXPECT_EQ(out.substr(out.find("5 files")),
            "5 files checked: 44 errors, 1 warning, 4 infos\n"
            "1 file could not be read\n"
            "1 file not verified (Git-LFS pointers)\n"
            "5 findings known to the baseline\n"
            "`gltfx explain CODE` tells more about a finding\n");
}

std::string summary_of(const char* level, std::uint64_t wanted, std::uint64_t decoded,
                       ReportFormat format = ReportFormat::text) {
  FormatOptions options;
  options.pixel_level = level;
  FileReport report = file("a.gltf");
  report.images_wanted = wanted;
  report.images_decoded = decoded;
  return run(format, {report}, options);
}

TEST(TextSummary, CountsTheImagesThatWereDecoded) {
  EXPECT_THAT(summary_of("all", 3, 3), HasSubstr("\n3 of 3 images decoded\n"));
  EXPECT_THAT(summary_of("all", 3, 1), HasSubstr("\n1 of 3 images decoded; 2 could not be"));
  EXPECT_THAT(summary_of("all", 0, 0), HasSubstr("\nthere are no images to decode\n"));
  EXPECT_THAT(summary_of("needed", 1, 1), HasSubstr("1 of 1 image decoded for rules"));
  EXPECT_THAT(summary_of("needed", 0, 0), HasSubstr("no rule needs the pixels"));
  EXPECT_THAT(summary_of("headers", 0, 0), Not(HasSubstr("image")));
}

TEST(Summary, SaysInEveryFormatForPeopleThatImagesWereNotDecoded) {
  for (const ReportFormat format :
       {ReportFormat::github, ReportFormat::sarif, ReportFormat::agent}) {
    EXPECT_THAT(summary_of("all", 3, 1, format),
                HasSubstr("1 of 3 images decoded; 2 could not be"));
    EXPECT_THAT(summary_of("all", 3, 3, format), Not(HasSubstr("images decoded")));
  }
}

TEST(TextSummary, NamesTheProgramAsTheUserCallsIt) {
  FormatOptions options;
  options.command = "./bin/gltfx";
  EXPECT_THAT(run(ReportFormat::text, sample_run(), options),
              ::testing::HasSubstr("`./bin/gltfx explain CODE` tells more"));
}

TEST(TextSummary, SaysThatNothingIsNewWhenTheBaselineKnewAll) {
  FileReport report = file("a.gltf");
  report.suppressed = 1;
  EXPECT_EQ(text({report}, false),
            "1 file checked: no new problems\n1 finding known to the baseline\n");
}

TEST(TextSummary, IsLeftOutWhenQuiet) {
  EXPECT_EQ(text(sample_run(), true).find("checked"), std::string::npos);
}

TEST(TextColor, PaintsBySeverityAndLeavesTheWordsAlone) {
  FormatOptions options;
  options.color = true;
  EXPECT_EQ(run(ReportFormat::text, {file("leaf.gltf", {wrong_type()})}, options),
            "\x1b[1;31merror[TYPE_MISMATCH]\x1b[0m"
            "\x1b[1m: 'metallicFactor' is a string; a number is expected.\x1b[0m\n"
            " \x1b[1;34m-->\x1b[0m leaf.gltf:7:27 at "
            "/materials/0/pbrMetallicRoughness/metallicFactor ('Leaf')\n"
            "\x1b[1;34m  |\x1b[0m\n"
            "\x1b[1;34m7 |\x1b[0m         \"metallicFactor\": \"0.5\",\n"
            "\x1b[1;34m  |\x1b[0m                           \x1b[1;31m^^^^^\x1b[0m\n"
            "  \x1b[1;34m=\x1b[0m \x1b[1;36mhelp\x1b[0m: write the number without quotes: 0.5\n"
            "  \x1b[1;34m=\x1b[0m \x1b[1mnote\x1b[0m: repeated 41 more times, last at "
            "/materials/44/pbrMetallicRoughness/metallicFactor\n\n"
            "1 file checked: \x1b[1;31m42 errors\x1b[0m\n"
            "`gltfx explain CODE` tells more about a finding\n");
}

TEST(TextColor, HasItsOwnColorForEachSeverity) {
  FormatOptions options;
  options.color = true;
  const auto start = [&](Severity severity) {
    return run(ReportFormat::text, {file("a", {finding("X", severity, "M.")})}, options);
  };
  EXPECT_THAT(start(Severity::warning), ::testing::StartsWith("\x1b[1;33mwarning[X]"));
  EXPECT_THAT(start(Severity::info), ::testing::StartsWith("\x1b[1;34minfo[X]"));
  EXPECT_THAT(start(Severity::hint), ::testing::StartsWith("\x1b[1;32mhint[X]"));
}

TEST(TextColor, IsNotThereUnlessAskedFor) {
  EXPECT_EQ(text(sample_run(), false).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace gltfx::report::testing
