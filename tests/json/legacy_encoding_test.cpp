// SPDX-License-Identifier: Apache-2.0
#include "json/legacy_encoding.hpp"

#include <string>

#include <gtest/gtest.h>

namespace gltfx::json {
namespace {

std::string read_legacy(std::string_view text) {
  const auto found = read_legacy_text(text);
  return found ? std::string(found->encoding) + ": " + apply_edits(text, found->parts) : "nothing";
}

TEST(LegacyText, IsLatin1) {
  EXPECT_EQ(read_legacy("\"St\xFChle\""), "Latin-1: \"St\xC3\xBChle\"");
  EXPECT_EQ(read_legacy("caf\xE9, M\xFCller"), "Latin-1: caf\xC3\xA9, M\xC3\xBCller");
  EXPECT_EQ(read_legacy("B\xE9"
                        "b\xE9"),
            "Latin-1: B\xC3\xA9"
            "b\xC3\xA9");
  EXPECT_EQ(read_legacy("\"\xC4\xD6\xDC\""), "Latin-1: \"\xC3\x84\xC3\x96\xC3\x9C\"");
}

TEST(LegacyText, IsWhatWindowsMadeOfLatin1) {
  EXPECT_EQ(read_legacy("don\x92t, 5 \x80"), "Windows-1252: don\xE2\x80\x99t, 5 \xE2\x82\xAC");
  EXPECT_EQ(read_legacy("\x81"), "nothing");
}

TEST(LegacyText, MayHavePartsInUtf8) {
  EXPECT_EQ(read_legacy("St\xFChle, St\xC3\xBChle"), "Latin-1: St\xC3\xBChle, St\xC3\xBChle");
}

TEST(LegacyText, IsShiftJis) {
  // "テスト" and "表", whose second byte is a backslash.
  EXPECT_EQ(read_legacy("\"\x83\x65\x83\x58\x83\x67\""),
            "Shift-JIS: \"\xE3\x83\x86\xE3\x82\xB9\xE3\x83\x88\"");
  EXPECT_EQ(read_legacy("\"\x95\x5C\x8E\xA6\""), "Shift-JIS: \"\xE8\xA1\xA8\xE7\xA4\xBA\"");
}

}  // namespace
}  // namespace gltfx::json
