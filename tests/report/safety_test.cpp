// SPDX-License-Identifier: Apache-2.0
// For any text of an asset, no format lets it control a terminal, fake a line or command a build
// server.
#include <regex>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/safe_text.hpp"
#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

constexpr std::string_view kHostile =
    "\x1b[31mred\x1b]0;title\x07\n::error file=x::fake\r\n##vso[task.setvariable]##[error]x "
    "\u202Egnp.exe \x9b"
    "2J \xff %0A::stop-commands::t";

FileReport hostile_report() {
  const std::string evil(kHostile);
  Diagnostic d = finding("UNEXPECTED_PROPERTY", Severity::warning, evil, "/" + evil);
  d.help = evil;
  d.object_name = evil;
  d.location.line = d.location.end_line = 1;
  d.location.column = d.location.end_column = 1;
  d.excerpt.text = evil;
  d.excerpt.caret = 3;
  d.excerpt.width = 5;
  FileReport report = file(evil, {times(d, 3, "/" + evil)});
  report.info.emplace();
  report.info->version = "2.0";
  report.info->generator = evil;
  report.info->extensions_used = {evil};
  report.info->resources.push_back({"/buffers/0", evil, "external", evil, {}, {}});
  report.truncated = true;
  report.requirements.emplace_back();
  Requirement& requirement = report.requirements.back();
  requirement.measure = requirement.on = requirement.op = requirement.from = evil;
  requirement.pointer = requirement.object_name = requirement.unit = evil;
  requirement.value = evil;
  requirement.limit = std::vector<std::string>{evil, evil};
  return report;
}

class Hostile : public ::testing::TestWithParam<ReportFormat> {
 protected:
  std::string out = run(GetParam(), {hostile_report(), hostile_report()});
};

TEST_P(Hostile, HasNoControlCharacterButLineBreaks) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool ends_row = out[i] == '\r' && GetParam() == ReportFormat::csv;
    EXPECT_TRUE(!ends_row || out[i + 1] == '\n');
    EXPECT_TRUE(out[i] == '\n' || ends_row || static_cast<unsigned char>(out[i]) >= 0x20) << out;
  }
  EXPECT_EQ(out.find('\x7f'), std::string::npos);
}

TEST_P(Hostile, HasNoCommandInTheMiddleOfALine) {
  EXPECT_FALSE(std::regex_search(out, std::regex("##[A-Za-z]*\\["))) << out;
}

TEST_P(Hostile, HasNoCommandAtTheStartOfALineButItsOwn) {
  const std::regex foreign("(^|\n)\\s*::(?!(warning|notice) file=)");
  EXPECT_FALSE(std::regex_search(out, foreign)) << out;
}

TEST_P(Hostile, IsValidUtf8) {
  // The strict serialiser of another library refuses anything else.
  EXPECT_NO_THROW(static_cast<void>(nlohmann::json(out).dump())) << out;
}

TEST_P(Hostile, EndsInALineBreak) { EXPECT_EQ(out.back(), '\n'); }

INSTANTIATE_TEST_SUITE_P(
    Formats, Hostile,
    ::testing::Values(ReportFormat::text, ReportFormat::json, ReportFormat::khronos,
                      ReportFormat::github, ReportFormat::gitlab, ReportFormat::sarif,
                      ReportFormat::junit, ReportFormat::agent, ReportFormat::csv),
    [](const auto& format) { return std::string(report_format_name(format.param)); });

TEST_P(Hostile, HasNoReorderingCharacter) { EXPECT_EQ(out.find("\u202E"), std::string::npos); }

TEST(HostileJson, KeepsTheValueThatItDefused) {
  const std::string name = "##vso[a]\u202E\U000E0041é";
  const auto parsed = nlohmann::json::parse(run(ReportFormat::json, {file(name)}));
  EXPECT_EQ(parsed["files"][0]["path"], name);
}

TEST(SafeText, DefusesEveryCommandWord) {
  EXPECT_EQ(safe("a ##[error]b"), "a #\\u0023[error]b");
  EXPECT_EQ(safe("##vso[x]##TeamCity[y]"), "#\\u0023vso[x]#\\u0023TeamCity[y]");
  EXPECT_EQ(safe("###vso[x]"), "##\\u0023vso[x]");
}

TEST(SafeText, LeavesOtherHashesAlone) {
  for (const std::string text : {"#1", "Leaf ##2", "## vso[", "#[", "##vso", "##"}) {
    EXPECT_EQ(safe(text), text);
  }
}

TEST(SafeText, GivesTheSameInPartsAsInOne) {
  const std::string text = "x##vso[a]\x1b##[b]é##";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    if (cut < text.size() && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) continue;
    EXPECT_EQ(safe_part(text, 0, cut) + safe_part(text, cut, text.size()), safe(text)) << cut;
  }
}

TEST(SafeText, CutsByCharactersNotBytes) {
  EXPECT_EQ(safe_cut("äöü", 3), "äöü");
  EXPECT_EQ(safe_cut("äöüß", 3), "ä…üß");
  EXPECT_EQ(safe_cut("##vso[abcdefgh]", 6), "#\\u0023v…gh]");
}

}  // namespace
}  // namespace gltfx::report::testing
