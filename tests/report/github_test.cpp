// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

std::string github(const std::vector<FileReport>& reports) {
  return run(ReportFormat::github, reports);
}

TEST(Github, AnnotatesTheMarkedPlace) {
  EXPECT_EQ(github({file("models/leaf.gltf", {wrong_type()})}),
            "::error file=models/leaf.gltf,line=7,endLine=7,col=27,endColumn=32,"
            "title=TYPE_MISMATCH::'metallicFactor' is a string; a number is expected."
            "%0Aat /materials/0/pbrMetallicRoughness/metallicFactor ('Leaf')"
            "%0Ahelp: write the number without quotes: 0.5"
            "%0Anote: repeated 41 more times, last at "
            "/materials/44/pbrMetallicRoughness/metallicFactor\n");
}

TEST(Github, HasACommandForEachSeverity) {
  const auto command = [](Severity severity) {
    return github({file("a", {finding("X", severity, "M.")})});
  };
  EXPECT_EQ(command(Severity::error), "::error file=a,title=X::M.\n");
  EXPECT_EQ(command(Severity::warning), "::warning file=a,title=X::M.\n");
  EXPECT_EQ(command(Severity::info), "::notice file=a,title=X::M.\n");
  EXPECT_EQ(command(Severity::hint), "::notice file=a,title=X::M.\n");
}

TEST(Github, EscapesWhatWouldEndAPropertyOrAMessage) {
  EXPECT_EQ(github({file("C:\\50%,a.gltf", {finding("X", Severity::error, "100%, a: b")})}),
            "::error file=C%3A\\50%25%2Ca.gltf,title=X::100%25, a: b\n");
}

TEST(Github, DoesNotTakeAssetTextForAnEscape) {
  EXPECT_EQ(github({file("a", {finding("X", Severity::error, "a%0A::warning::b\nc")})}),
            "::error file=a,title=X::a%250A::warning::b\\u000ac\n");
}

TEST(Github, LeavesColumnsOutAcrossLines) {
  const Diagnostic d =
      on(finding("X", Severity::error, "M."), kLeaf, "{\n      \"name\": \"Leaf\"");
  EXPECT_EQ(github({file("a", {d})}), "::error file=a,line=4,endLine=5,title=X::M.\n");
}

TEST(Github, NamesTheByteInABinaryFileInsteadOfALine) {
  const std::string_view chunk = R"({"scene":7})";
  const Diagnostic d = on(finding("X", Severity::error, "M.", "/scene"), chunk, "7", 20);
  EXPECT_EQ(github({file("a.glb", {d, bad_chunk()}, "model/gltf-binary")}),
            "::error file=a.glb,title=X::M.%0Aat byte 29 at /scene\n"
            "::error file=a.glb,title=GLB_CHUNK_TOO_BIG::The chunk ends after the file."
            "%0Aat byte 12\n");
}

TEST(Github, EndsWithHowFarImagesWereLookedInto) {
  FormatOptions options;
  options.pixel_level = "needed";
  EXPECT_EQ(run(ReportFormat::github, {file("a"), file("b")}, options),
            "gltfx: 2 files checked, pixels: needed\n");
}

TEST(Github, SaysWhatWasNotListedOrVerified) {
  EXPECT_THAT(
      github(sample_run()),
      ::testing::EndsWith("::notice file=big.gltf,title=gltfx::3 more findings are not listed "
                          "(--max-issues)\n"
                          "::notice title=gltfx::1 file not verified (Git-LFS pointers)\n"));
}

TEST(Github, SaysNothingOfACleanFile) { EXPECT_EQ(github({file("a.gltf")}), ""); }

}  // namespace
}  // namespace gltfx::report::testing
