// SPDX-License-Identifier: Apache-2.0
#include "json/lines.hpp"

#include <gmock/gmock.h>

#include "base/text.hpp"
#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

// Line and column by counting, character by character.
std::pair<std::uint32_t, std::uint32_t> counted(std::string_view text, std::size_t byte) {
  std::uint32_t line = 1;
  std::size_t start = 0;
  for (std::size_t i = 0; i < byte; ++i) {
    const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (text[i] == '\n' || (text[i] == '\r' && !pair)) {
      ++line;
      start = i + 1;
    }
  }
  const auto column = count_code_points(text.substr(start, byte - start));
  return {line, static_cast<std::uint32_t>(column + 1)};
}

void expect_counted(std::string_view text) {
  const LineIndex lines(text);
  const auto size = static_cast<std::uint32_t>(text.size());
  for (std::uint32_t byte = 0; byte <= size; ++byte) {
    const bool inside = byte < size && (text[byte] & 0xC0) == 0x80;
    if (inside) continue;
    const Location at = lines.locate({byte, size});
    ASSERT_EQ(std::pair(at.line, at.column), counted(text, byte)) << byte;
    ASSERT_EQ(std::pair(at.end_line, at.end_column), counted(text, size)) << byte;
  }
}

TEST(Lines, ColumnsInUtf16CountPairsTwice) {
  // Across the blocks of the index, in one line and in many.
  for (const std::string_view end : {"", "\n"}) {
    std::string text;
    std::uint32_t units = 1;
    const std::string piece = "a\U0001F342é" + std::string(end);
    for (int i = 0; i < 3000; ++i) text += piece;
    const LineIndex lines(text);
    const auto size = static_cast<std::uint32_t>(piece.size());
    for (std::uint32_t at = 0; at + size <= text.size(); at += size) {
      const Location here = lines.locate({at + 1, at + 5});
      ASSERT_EQ(here.utf16_column, units + 1) << at;
      ASSERT_EQ(here.utf16_end_column, units + 3) << at;
      ASSERT_EQ(here.end_column, here.column + 1) << at;
      if (end.empty()) units += 4;
    }
  }
}

TEST(Lines, EndAtLineFeedCarriageReturnOrBoth) {
  expect_counted("");
  expect_counted("a");
  expect_counted("\n");
  expect_counted("\r");
  expect_counted("\r\n");
  expect_counted("a\nb\r\nc\rd\n\ne\r\r\nf\n\r");
}

TEST(Lines, ColumnsCountCodePoints) {
  const std::string_view text = "\u00e4\u20ac\U0001F600x";
  const Location at = LineIndex(text).locate({9, 10});
  EXPECT_EQ(at.column, 4u);
  EXPECT_EQ(at.end_column, 5u);
  expect_counted(text);
}

TEST(Lines, AreFoundAcrossTheBlocksOfTheIndex) {
  // Line ends of all kinds at and around every multiple of the block size.
  for (const std::string_view line_end : {"\n", "\r", "\r\n"}) {
    for (std::size_t before = 4090; before < 4100; ++before) {
      std::string text(before, 'x');
      text.append(line_end).append("\u00e4").append(5000, 'y').append(line_end).append("z");
      const LineIndex lines(text);
      for (std::size_t byte :
           {before - 1, before, before + line_end.size(), before + line_end.size() + 2,
            std::size_t{8191}, std::size_t{8192}, text.size() - 1, text.size()}) {
        const auto at = static_cast<std::uint32_t>(byte);
        const Location found = lines.locate({at, at});
        ASSERT_EQ(std::pair(found.line, found.column), counted(text, byte))
            << before << " " << byte;
      }
    }
  }
}

TEST(Lines, AnIndexThatEndsEarlyAnswersUpToThere) {
  std::string text;
  for (int i = 0; i < 6000; ++i) text += "\u00e4b\n";
  const LineIndex whole(text);
  for (const std::size_t reach : {0U, 3U, 4095U, 4096U, 4097U, 9000U, 24000U}) {
    const LineIndex lines(text, reach);
    const auto at = static_cast<std::uint32_t>(reach / 4 * 4);
    EXPECT_EQ(lines.locate({0, at}).end_line, whole.locate({0, at}).end_line) << reach;
    EXPECT_EQ(lines.excerpt({at, at}).text, whole.excerpt({at, at}).text) << reach;
  }
}

TEST(Lines, AreFoundInATextOfExactlySomeBlocks) {
  for (const char last : {'\n', '\r', 'x'}) {
    std::string text(8192, 'x');
    text[4095] = '\n';
    text.back() = last;
    const Location at = LineIndex(text).locate({8192, 8192});
    EXPECT_EQ(std::pair(at.line, at.column), counted(text, 8192));
  }
}

TEST(Lines, OffsetsCountFromTheStartOfTheFile) {
  const Location at = LineIndex("{\n\"a\":1}").locate({2, 5}, 20);
  EXPECT_EQ(at.offset, 22u);
  EXPECT_EQ(at.length, 3u);
  EXPECT_EQ(at.line, 2u);
  EXPECT_EQ(at.column, 1u);
  EXPECT_EQ(at.end_column, 4u);
}

TEST(Excerpt, IsTheWholeLineWhenItFits) {
  const Excerpt excerpt = LineIndex("{\n  \"k\u00e4y\": 12,\r\n}").excerpt({12, 14});
  EXPECT_EQ(excerpt.text, "  \"k\u00e4y\": 12,");
  EXPECT_EQ(excerpt.caret, 9u);
  EXPECT_EQ(excerpt.width, 2u);
  EXPECT_FALSE(excerpt.cut_left);
  EXPECT_FALSE(excerpt.cut_right);
}

TEST(Excerpt, IsCutAroundTheMarkInALongLine) {
  std::string text(1000, 'a');
  text += "MARK";
  text.append(1000, 'b');
  const Excerpt excerpt = LineIndex(text).excerpt({1000, 1004}, 20);
  EXPECT_EQ(excerpt.text, "aaaaaaaaMARKbbbbbbbb");
  EXPECT_EQ(excerpt.caret, 8u);
  EXPECT_EQ(excerpt.width, 4u);
  EXPECT_TRUE(excerpt.cut_left);
  EXPECT_TRUE(excerpt.cut_right);
}

TEST(Excerpt, GivesOneSideWhatTheOtherDoesNotNeed) {
  const std::string text = "{\n0123456789MARK\n}";
  const Excerpt right = LineIndex(text).excerpt({12, 16}, 12);
  EXPECT_EQ(right.text, "23456789MARK");
  EXPECT_TRUE(right.cut_left);
  EXPECT_FALSE(right.cut_right);
  const Excerpt left = LineIndex(text).excerpt({2, 4}, 12);
  EXPECT_EQ(left.text, "0123456789MA");
  EXPECT_FALSE(left.cut_left);
  EXPECT_TRUE(left.cut_right);
}

TEST(Excerpt, MarksASpanOverSeveralLinesToTheEndOfItsFirst) {
  const Excerpt excerpt = LineIndex("a: [\n1\n]").excerpt({3, 8});
  EXPECT_EQ(excerpt.text, "a: [");
  EXPECT_EQ(excerpt.caret, 3u);
  EXPECT_EQ(excerpt.width, 1u);
}

TEST(Excerpt, MarksOneCharacterAtTheEndOfALineOrOfTheText) {
  const LineIndex lines("[1,\n");
  EXPECT_EQ(lines.excerpt({3, 4}).text, "[1,");
  EXPECT_EQ(lines.excerpt({3, 4}).caret, 3u);
  EXPECT_EQ(lines.excerpt({3, 4}).width, 1u);
  EXPECT_EQ(lines.excerpt({4, 4}).text, "");
  EXPECT_EQ(lines.excerpt({4, 4}).width, 1u);
  EXPECT_EQ(LineIndex("").excerpt({0, 0}).width, 1u);
}

TEST(Excerpt, CutsAMarkThatIsWiderThanTheWindow) {
  const Excerpt excerpt = LineIndex("[" + std::string(500, 'x') + "]").excerpt({1, 501}, 10);
  EXPECT_EQ(excerpt.text, "xxxxxxxxxx");
  EXPECT_EQ(excerpt.width, 10u);
  EXPECT_TRUE(excerpt.cut_left);
  EXPECT_TRUE(excerpt.cut_right);
}

TEST(Excerpt, CutsBetweenCharactersOnly) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "\u20ac";
  const Excerpt excerpt = LineIndex(text).excerpt({150, 153}, 5);
  EXPECT_EQ(excerpt.text, "\u20ac\u20ac\u20ac\u20ac\u20ac");
  EXPECT_EQ(excerpt.caret, 2u);
  EXPECT_EQ(excerpt.width, 1u);
}

}  // namespace
}  // namespace gltfx::json::testing
