// SPDX-License-Identifier: Apache-2.0
// Carets are under the marked text, for any characters of the asset.
#include "report/excerpt.hpp"

#include <gmock/gmock.h>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

std::string excerpt(std::string_view text, std::string_view marked) {
  return excerpt_lines(on(finding("X", Severity::error, "M."), text, marked), Style(false));
}

TEST(Excerpt, CountsATabAsTheBlankItIsPrintedAs) {
  EXPECT_EQ(excerpt("\t\t\"a\":\t1", "1"),
            "  |\n"
            "1 |   \"a\": 1\n"
            "  |        ^\n");
}

TEST(Excerpt, GivesWideCharactersTwoColumns) {
  EXPECT_EQ(excerpt(R"("樹": "葉っぱ", "x": 1)", R"("葉っぱ")"),
            "  |\n"
            "1 | \"樹\": \"葉っぱ\", \"x\": 1\n"
            "  |       ^^^^^^^^\n");
}

TEST(Excerpt, GivesCombiningMarksNoColumn) {
  EXPECT_EQ(excerpt("\"e\u0301a\u0308\": 1", "1"),
            "  |\n"
            "1 | \"e\u0301a\u0308\": 1\n"
            "  |       ^\n");
}

TEST(Excerpt, MarksAnEmojiWithTwoCarets) {
  EXPECT_EQ(excerpt("\"🌳\": 1", "🌳"),
            "  |\n"
            "1 | \"🌳\": 1\n"
            "  |  ^^\n");
}

TEST(Excerpt, StandsRightBehindNeutralisedText) {
  EXPECT_EQ(excerpt("\"\x1b[2J\": 1", "1"),
            "  |\n"
            "1 | \"\\u001b[2J\": 1\n"
            "  |              ^\n");
}

TEST(Excerpt, MarksAllOfANeutralisedCharacter) {
  EXPECT_EQ(excerpt("\"a\x01\": 1", "\x01"),
            "  |\n"
            "1 | \"a\\u0001\": 1\n"
            "  |   ^^^^^^\n");
}

TEST(Excerpt, MarksABadByte) {
  EXPECT_EQ(excerpt("\"a\xff\": 1", "\xff"),
            "  |\n"
            "1 | \"a\\xff\": 1\n"
            "  |   ^^^^\n");
}

TEST(Excerpt, KeepsItsPlaceBehindATruncatedSequence) {
  EXPECT_EQ(excerpt("\"\xe2\x82\": 1", "1"),
            "  |\n"
            "1 | \"\\xe2\\x82\": 1\n"
            "  |             ^\n");
}

TEST(Excerpt, ShowsThatALineWasCutOnBothSides) {
  const std::string filler(500, 'x');
  EXPECT_EQ(excerpt(filler + "!" + filler, "!"),
            "  |\n"
            "1 | …" +
                std::string(49, 'x') + "!" + std::string(50, 'x') +
                "…\n"
                "  |  " +
                std::string(49, ' ') + "^\n");
}

TEST(Excerpt, EndsTheMarkWhereTheLineIsCut) {
  EXPECT_EQ(excerpt("\"" + std::string(500, 'x') + "\"", std::string(500, 'x')),
            "  |\n"
            "1 | …" +
                std::string(100, 'x') +
                "…\n"
                "  |  " +
                std::string(100, '^') + "\n");
}

TEST(Excerpt, MarksTheEndOfALineBehindIt) {
  Diagnostic d = on(finding("X", Severity::error, "M."), "{\"a\": [", "[");
  d.excerpt.caret = 7;
  d.excerpt.width = 1;
  EXPECT_EQ(excerpt_lines(d, Style(false)),
            "  |\n"
            "1 | {\"a\": [\n"
            "  |        ^\n");
}

TEST(Excerpt, ShowsAnEmptyLineWithoutTrailingBlanks) {
  Diagnostic d = finding("X", Severity::error, "M.");
  d.location.line = 3;
  d.excerpt.width = 1;
  EXPECT_EQ(excerpt_lines(d, Style(false)),
            "  |\n"
            "3 |\n"
            "  | ^\n");
}

TEST(Excerpt, DropsBlanksBehindTheText) {
  EXPECT_EQ(excerpt("[1,   \t ", "1"),
            "  |\n"
            "1 | [1,\n"
            "  |  ^\n");
}

TEST(Excerpt, DefusesACommandThatSpansTheMark) {
  EXPECT_EQ(excerpt("\"##vso[x]\"", "#vso"),
            "  |\n"
            "1 | \"#\\u0023vso[x]\"\n"
            "  |   ^^^^^^^^^\n");
}

TEST(DisplayWidth, IsThatOfATerminal) {
  EXPECT_EQ(display_width(""), 0u);
  EXPECT_EQ(display_width("abc é ß"), 7u);
  EXPECT_EQ(display_width("…"), 1u);
  EXPECT_EQ(display_width("漢字"), 4u);
  EXPECT_EQ(display_width("한국"), 4u);
  EXPECT_EQ(display_width("ｱ"), 1u) << "a half-width form";
  EXPECT_EQ(display_width("Ａ"), 2u) << "a full-width form";
  EXPECT_EQ(display_width("e\u0301"), 1u);
  EXPECT_EQ(display_width("\U0001F600"), 2u);
  EXPECT_EQ(display_width("\U0002000B"), 2u) << "an ideograph beyond the basic plane";
}

}  // namespace
}  // namespace gltfx::report::testing
