// SPDX-License-Identifier: Apache-2.0
#include "container/base64.hpp"

#include <cstddef>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::container {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string decoded(std::string_view text) {
  const auto bytes = decode_base64(text);
  return bytes ? *bytes : "error: " + bytes.error().message;
}

TEST(Base64, DecodesTheVectorsOfTheRfc) {
  EXPECT_EQ(decoded(""), "");
  EXPECT_EQ(decoded("Zg=="), "f");
  EXPECT_EQ(decoded("Zm8="), "fo");
  EXPECT_EQ(decoded("Zm9v"), "foo");
  EXPECT_EQ(decoded("Zm9vYg=="), "foob");
  EXPECT_EQ(decoded("Zm9vYmE="), "fooba");
  EXPECT_EQ(decoded("Zm9vYmFy"), "foobar");
}

TEST(Base64, EveryCharacterOfTheAlphabetHasItsValue) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    const std::string bytes = decoded(std::string("AAA") + alphabet[i]);
    EXPECT_EQ(bytes, std::string({'\0', '\0', static_cast<char>(i)})) << alphabet[i];
  }
}

TEST(Base64, EveryOtherByteIsRefusedAtEveryPlace) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";
  for (int byte = 0; byte < 256; ++byte) {
    const char c = static_cast<char>(byte);
    if (alphabet.find(c) != std::string::npos) continue;
    for (std::size_t at = 0; at < 8; ++at) {
      std::string text = "AAAAAAAA";
      text[at] = c;
      const std::string start =
          "error: Character " + std::to_string(at + 1) + " of the base64 text";
      EXPECT_THAT(decoded(text), StartsWith(start)) << byte;
    }
  }
}

TEST(Base64, TheFirstBadCharacterIsNamed) {
  EXPECT_THAT(decoded("AAAAAA-AA*AA"), HasSubstr("Character 7 of the base64 text is '-'"));
  EXPECT_THAT(decoded("AA A"), HasSubstr("Character 3 of the base64 text is ' '"));
  EXPECT_THAT(decoded("AAA\nAAAA"), HasSubstr("Character 4"));
  EXPECT_THAT(decoded("AA*A="), HasSubstr("Character 3 of the base64 text is '*'"));
  EXPECT_THAT(decoded("A*=="), HasSubstr("Character 2 of the base64 text is '*'"));
}

TEST(Base64, PaddingStandsOnlyAtTheEnd) {
  EXPECT_THAT(decoded("AA==AAAA"), HasSubstr("Character 3 of the base64 text is '='"));
  EXPECT_THAT(decoded("=AAA"), HasSubstr("Character 1 of the base64 text is '='"));
  EXPECT_THAT(decoded("A==="), HasSubstr("Character 2 of the base64 text is '='"));
  EXPECT_THAT(decoded("===="), HasSubstr("Character 1 of the base64 text is '='"));
  EXPECT_THAT(decoded("AA=A"), HasSubstr("Character 3 of the base64 text is '='"));
  EXPECT_THAT(decoded("AAAA="), HasSubstr("error: "));
  EXPECT_THAT(decoded("A=AAA"), HasSubstr("Character 2 of the base64 text is '='"));
}

TEST(Base64, MissingPaddingIsRefused) {
  for (const char* text : {"A", "AA", "AAA", "AAAAA", "AAAAAA", "AA="}) {
    EXPECT_THAT(decoded(text), HasSubstr("not a multiple of 4")) << text;
  }
}

TEST(Base64, SpareBitsMustBeZero) {
  EXPECT_EQ(decoded("AQ=="), "\x01");
  EXPECT_THAT(decoded("AR=="), HasSubstr("Character 2 of the base64 text has unused bits"));
  EXPECT_THAT(decoded("AAB="), HasSubstr("Character 3 of the base64 text has unused bits"));
  EXPECT_EQ(decoded("AAE="), std::string("\0\1", 2));
}

TEST(Base64, WhatIsEncodedIsDecodedAgain) {
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    const std::string text = encode_base64(bytes);
    EXPECT_EQ(text.size() % 4, 0U);
    const auto again = decode_base64(text);
    ASSERT_TRUE(again) << text;
    EXPECT_EQ(*again, bytes);
    bytes += static_cast<char>(i * 37);
  }
  EXPECT_EQ(encode_base64("M"), "TQ==");
}

}  // namespace
}  // namespace gltfx::container
