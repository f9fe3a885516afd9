// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "base/number.hpp"

namespace gltfx {
namespace {

TEST(Printable, LeavesOrdinaryTextAlone) {
  EXPECT_EQ(printable(""), "");
  EXPECT_EQ(printable("plain \u00e4\u20ac\U0001F600 text"), "plain \u00e4\u20ac\U0001F600 text");
  EXPECT_EQ(printable("\u00a0"), "\u00a0");
}

TEST(HalfSentence, IsPrintableAndLacksItsStop) {
  EXPECT_EQ(half_sentence("It ends early."), "It ends early");
  EXPECT_EQ(half_sentence("an \x1b in it"), "an \\u001b in it");
  EXPECT_EQ(half_sentence(""), "");
  EXPECT_EQ(without_stop("v1.2"), "v1.2");
}

TEST(Printable, ShowsControlCharactersAsEscapes) {
  EXPECT_EQ(printable("\x1b[31m"), "\\u001b[31m");
  EXPECT_EQ(printable("a\nb\r"), "a\\u000ab\\u000d");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\u0000");
  EXPECT_EQ(printable("\x1f \x7f"), "\\u001f \\u007f");
  EXPECT_EQ(printable("\u0080\u009b\u009f"), "\\u0080\\u009b\\u009f");
  EXPECT_EQ(printable("a\tb"), "a b");
}

TEST(Printable, ShowsWhatReordersHidesOrEndsALine) {
  EXPECT_EQ(printable("\u202a\u202e\u2066\u2069"), "\\u202a\\u202e\\u2066\\u2069");
  EXPECT_EQ(printable("\u200b\u200f\u061c\ufeff"), "\\u200b\\u200f\\u061c\\ufeff");
  EXPECT_EQ(printable("\u2028\u2029"), "\\u2028\\u2029");
  EXPECT_EQ(printable("\U000e0041"), "\\u{e0041}");
  EXPECT_EQ(printable("\u2010\u2027\u202f"), "\u2010\u2027\u202f");
}

TEST(Printable, ShowsWhatIsNotSeen) {
  // A soft hyphen, a grapheme joiner, Hangul fillers, selectors of variants, a blank Braille cell.
  EXPECT_EQ(printable("wo\u00adod"), "wo\\u00adod");
  EXPECT_EQ(printable("\u034f\u115f\u1160\u3164\uffa0"), "\\u034f\\u115f\\u1160\\u3164\\uffa0");
  EXPECT_EQ(printable("\u180b\u180e\ufe00\ufe0f\U000e0100"),
            "\\u180b\\u180e\\ufe00\\ufe0f\\u{e0100}");
  EXPECT_EQ(printable("\u2800\u2061\u206f\ufff9"), "\\u2800\\u2061\\u206f\\ufff9");
  // Private use, noncharacters, and planes reserved for ignorable characters.
  EXPECT_EQ(printable("\ue000\uf8ff\U000f0000\U0010fffd"), "\\ue000\\uf8ff\\u{f0000}\\u{10fffd}");
  EXPECT_EQ(printable("\ufdd0\uffff\U0001fffe\U000e0fff"), "\\ufdd0\\uffff\\u{1fffe}\\u{e0fff}");
  EXPECT_EQ(printable("\U0004fffe\U0007ffff\U000dffff"), "\\u{4fffe}\\u{7ffff}\\u{dffff}");
  // Their neighbours are seen.
  EXPECT_EQ(printable("\u00ac\u00ae\u180a\ufdcf\ufe10\u2801"),
            "\u00ac\u00ae\u180a\ufdcf\ufe10\u2801");
}

TEST(Printable, ShowsInvalidUtf8ByteByByte) {
  EXPECT_EQ(printable("a\x80z"), "a\\x80z");
  EXPECT_EQ(printable("\xC3"), "\\xc3");
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf");
}

TEST(Printable, NothingItReturnsIsChangedByIt) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  for (std::uint32_t c = 0x80; c < 0x3000; ++c) append_utf8(all, c);
  const std::string once = printable(all);
  EXPECT_EQ(printable(once), once);
}

TEST(Quoted, PutsQuotesAroundAndCutsByCharacters) {
  EXPECT_EQ(quoted("abc"), "'abc'");
  EXPECT_EQ(quoted(""), "''");
  EXPECT_EQ(quoted("abcd", 4), "'abcd'");
  EXPECT_EQ(quoted("abcde", 4), "'abcd…'");
  EXPECT_EQ(quoted("äöüß!", 4), "'äöüß…'");
  EXPECT_EQ(quoted("\n\n", 1), "'\\u000a…'");
  EXPECT_EQ(gltfx::quoted(std::string(61, 'x')), "'" + std::string(60, 'x') + "…'");
}

TEST(CodePoints, AreCountedAndMeasured) {
  const std::string_view text = "a\u00e4\u20ac\U0001F600z";
  EXPECT_EQ(count_code_points(text), 5u);
  EXPECT_EQ(count_code_points(""), 0u);
  EXPECT_EQ(count_code_points("\x80\xFF"), 2u);
  const std::size_t ends[] = {0, 1, 3, 6, 10, 11, 11};
  for (std::size_t count = 0; count < 7; ++count) {
    EXPECT_EQ(bytes_of_code_points(text, count), ends[count]) << count;
  }
}

TEST(Utf8, EveryScalarValueIsWrittenAndReadBack) {
  for (std::uint32_t c = 0; c <= 0x10FFFF; ++c) {
    if (c >= 0xD800 && c <= 0xDFFF) continue;
    std::string text;
    append_utf8(text, c);
    const CodePoint point = decode_utf8(text, 0);
    ASSERT_TRUE(point.valid) << c;
    ASSERT_EQ(point.value, c);
    ASSERT_EQ(point.size, text.size());
    // Every cut of it is invalid, one byte at a time.
    if (text.size() > 1) {
      const CodePoint cut = decode_utf8(std::string_view(text).substr(0, text.size() - 1), 0);
      ASSERT_FALSE(cut.valid);
      ASSERT_EQ(cut.size, 1u);
    }
  }
}

TEST(Utf8, OverlongSurrogateAndTooLargeSequencesAreInvalid) {
  for (const std::string_view text :
       {"\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xF0\x8F\xBF\xBF", "\xED\xA0\x80", "\xED\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\x80", "\xBF", "\xFE", "\xFF", "\xC3(",
        "\xE2\x82(", "\xF0\x9F\x98("}) {
    EXPECT_FALSE(decode_utf8(text, 0).valid) << printable(text);
    EXPECT_EQ(decode_utf8(text, 0).size, 1u) << printable(text);
  }
}

TEST(JoinOr, ReadsLikeASentence) {
  using Items = std::vector<std::string>;
  EXPECT_EQ(join_or(Items{}), "");
  EXPECT_EQ(join_or(Items{"a"}), "a");
  EXPECT_EQ(join_or(Items{"a", "b"}), "a or b");
  EXPECT_EQ(join_or(Items{"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(join_or(Items{"a", "b", "c"}, 3), "a, b or c");
  EXPECT_EQ(join_or(Items{"a", "b", "c"}, 2), "a, b or 1 other");
  EXPECT_EQ(join_or(Items{"a", "b", "c", "d"}, 2), "a, b or 2 others");
}

TEST(JoinAnd, NamesAll) {
  using Items = std::vector<std::string>;
  EXPECT_EQ(join_and(Items{}), "");
  EXPECT_EQ(join_and(Items{"a"}), "a");
  EXPECT_EQ(join_and(Items{"a", "b"}), "a and b");
  EXPECT_EQ(join_and(Items{"a", "b", "c"}), "a, b and c");
}

TEST(NumberText, IsWhatAPersonWrites) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0), "-0");
  EXPECT_EQ(number_text(1), "1");
  EXPECT_EQ(number_text(-1.5), "-1.5");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(number_text(100000), "100000");
  EXPECT_EQ(number_text(999999999999999), "999999999999999");
  EXPECT_EQ(number_text(1e20), "100000000000000000000");
  EXPECT_EQ(number_text(123456789012345680000.0), "123456789012345680000");  // as ECMAScript has it
  EXPECT_EQ(number_text(1.5e20), "150000000000000000000");
  EXPECT_EQ(number_text(1e21), "1e+21");
  EXPECT_EQ(number_text(1.25e-5), "0.0000125");
  EXPECT_EQ(number_text(5e-324), "5e-324");
  EXPECT_EQ(number_text(1.7976931348623157e308), "1.7976931348623157e+308");
  EXPECT_EQ(number_text(1e-6), "0.000001");
  EXPECT_EQ(number_text(1e-7), "1e-7");
  EXPECT_EQ(number_text(1.5e-100), "1.5e-100");
  EXPECT_EQ(number_text(-2.5e300), "-2.5e+300");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "Infinity");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-Infinity");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "NaN");
}

TEST(NumberText, ReadsBackEqual) {
  for (double value = 1e-320; value < 1e307; value *= 7.3) {
    EXPECT_EQ(std::strtod(number_text(value).c_str(), nullptr), value);
    EXPECT_EQ(std::strtod(number_text(-std::floor(value)).c_str(), nullptr), -std::floor(value));
  }
}

}  // namespace
}  // namespace gltfx
