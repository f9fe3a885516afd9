// SPDX-License-Identifier: Apache-2.0
// Known mistakes of programs that write or copy GLBs give one error that names the cause.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text.hpp"
#include "container/glb_builder.hpp"

namespace gltfx::container::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kShortJson = R"({"asset":{"version":"2.0"}})";  // 27 bytes

std::vector<std::string> codes_of(const Container& container) {
  std::vector<std::string> codes;
  for (const auto* errors : {&container.errors, &container.late_errors}) {
    for (const ContainerError& error : *errors) codes.emplace_back(code_name(error.code));
  }
  return codes;
}

std::string bin_of(const Container& container) {
  if (!container.bin) return "none";
  return std::string(container.bytes.text().substr(container.bin->offset, container.bin->length));
}

TEST(GlbMistakes, ChunkTypesThatAreNumbers) {
  const Container container = open_glb(glb(chunk(0, kJson) + chunk(1, "abcd")));
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHUNK_TYPE_NUMBER"));
  EXPECT_EQ(*container.json, kJson);
  EXPECT_EQ(bin_of(container), "abcd");
  const Container literal = literal_reading(container);
  EXPECT_THAT(codes_of(literal), ElementsAre("GLB_UNEXPECTED_FIRST_CHUNK", "GLB_UNKNOWN_CHUNK_TYPE",
                                             "GLB_UNKNOWN_CHUNK_TYPE"));
  EXPECT_EQ(literal.json, nullptr);
  EXPECT_EQ(literal.bytes.size(), container.bytes.size());
}

TEST(GlbMistakes, OneOfTheTypesIsANumber) {
  const Container container = open_glb(glb(json_chunk() + chunk(1, "abcd")));
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHUNK_TYPE_NUMBER"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("chunk 2 is the number 1"));
  EXPECT_EQ(bin_of(container), "abcd");
}

TEST(GlbMistakes, OtherNumbersAreUnknownTypes) {
  EXPECT_THAT(codes_of(open_glb(glb(json_chunk() + chunk(2, "abcd")))),
              ElementsAre("GLB_UNKNOWN_CHUNK_TYPE"));
  EXPECT_THAT(codes_of(open_glb(glb(json_chunk() + bin_chunk() + chunk(1, "abcd")))),
              ElementsAre("GLB_UNKNOWN_CHUNK_TYPE"));
}

TEST(GlbMistakes, AJsonLengthWithoutItsPadding) {
  const std::string chunks = chunk(kChunkJson, kShortJson) + " " + bin_chunk();
  const Container container = open_glb(glb(chunks));
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHUNK_LENGTH_UNALIGNED"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("27 bytes, without the 1 byte of padding"));
  EXPECT_EQ(container.errors[0].help, "write 28 to byte 12");
  EXPECT_EQ(*container.json, std::string(kShortJson) + " ");
  EXPECT_EQ(bin_of(container), "abcd");
  EXPECT_GT(codes_of(literal_reading(container)).size(), 1U);
}

TEST(GlbMistakes, ABinLengthWithoutItsPadding) {
  const Container container =
      open_glb(glb(json_chunk() + chunk(kChunkBin, "abcde") + std::string(3, '\0')));
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHUNK_LENGTH_UNALIGNED"));
  EXPECT_EQ(bin_of(container), std::string("abcde\0\0\0", 8));
}

TEST(GlbMistakes, AWrongLengthWithoutPaddingBehindItStays) {
  const Container container = open_glb(glb(chunk(kChunkJson, kShortJson) + bin_chunk()));
  EXPECT_EQ(container.literal, nullptr);
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHUNK_LENGTH_UNALIGNED"));
  EXPECT_EQ(bin_of(container), "abcd");
  const Container padded = open_glb(glb(chunk(kChunkJson, kShortJson) + "x" + bin_chunk()));
  EXPECT_EQ(padded.literal, nullptr);
}

// A file with bytes of every value, as floats have them.
std::string binary() {
  std::string data;
  for (int i = 0; i < 256; ++i) data += static_cast<char>(i);
  return glb(json_chunk() + bin_chunk(data + "\n\n\n\n"));
}

TEST(GlbMistakes, LineEndsOfWindows) {
  std::string changed;
  for (const char c : binary()) changed += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Container container = open_glb(changed);
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHANGED_AS_TEXT"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("line break"));
  EXPECT_EQ(container.json, nullptr);
  EXPECT_GT(codes_of(literal_reading(container)).size(), 0U);
}

TEST(GlbMistakes, BytesThatWereReplaced) {
  std::string changed;
  for (const char c : binary()) {
    changed += (c & 0x80) != 0 ? std::string("\xEF\xBF\xBD") : std::string(1, c);
  }
  const Container container = open_glb(changed);
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHANGED_AS_TEXT"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("replaced"));
}

TEST(GlbMistakes, BytesOfTheHeaderThatWereReplaced) {
  std::string bytes = binary();
  bytes.replace(8, 2, "\xEF\xBF\xBD");
  EXPECT_THAT(codes_of(open_glb(bytes)), ElementsAre("GLB_CHANGED_AS_TEXT"));
}

TEST(GlbMistakes, BytesThatWereEncoded) {
  std::string changed;
  for (const char c : binary()) append_utf8(changed, static_cast<unsigned char>(c));
  const Container container = open_glb(changed);
  EXPECT_THAT(codes_of(container), ElementsAre("GLB_CHANGED_AS_TEXT"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("character of UTF-8"));
}

TEST(GlbMistakes, AFileThatWasCutIsNotOneOfThem) {
  for (const std::size_t less : {1U, 2U, 50U, 200U}) {
    std::string bytes = binary();
    bytes.resize(bytes.size() - less);
    EXPECT_EQ(open_glb(bytes).literal, nullptr) << less;
  }
  // U+FFFD in a name is that of the author.
  const std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"\xEF\xBF\xBD\"}} ";
  std::string bytes = glb(chunk(kChunkJson, json.substr(0, json.size() / 4 * 4)) + bin_chunk());
  bytes.pop_back();
  EXPECT_EQ(open_glb(bytes).literal, nullptr);
}

struct OtherFile {
  std::string bytes;
  std::string name;
};

TEST(NotAGlb, IsCalledWhatItIs) {
  std::string stl(84 + 50, '\x01');
  stl.replace(80, 4, little_endian(1));
  const std::string usdz =
      "PK\x03\x04" + std::string(22, '\1') + std::string("\x0A\0\0\0", 4) + "scene.usdc";
  for (const OtherFile& file : std::vector<OtherFile>{
           {"# Blender\no Cube\nv 1 1 1\nv 1 -1 1\nf 1 2 3\n", "a Wavefront OBJ model"},
           {"# x\r\n\r\nmtllib a.mtl\r\n", "a Wavefront OBJ model"},
           {"Kaydara FBX Binary  " + std::string("\0\x1a\0", 3), "an FBX model"},
           {"; FBX 7.3.0 project file\n", "an FBX model"},
           {"solid x\nfacet normal 0 0 1\nendsolid", "an STL model"},
           {stl, "an STL model"},
           {"ply\nformat ascii 1.0\n", "a PLY model"},
           {usdz, "a USDZ model"},
           {"#usda 1.0\n(\n)\n", "a USD model"},
           {"BLENDER-v306RENDH", "a Blender file"},
           {"b3dm" + little_endian(1) + little_endian(28), "a b3dm tile of 3D Tiles"},
           {"i3dm" + little_endian(1) + little_endian(28), "an i3dm tile of 3D Tiles"},
           {"pnts" + little_endian(1) + little_endian(28), "a pnts tile of 3D Tiles"},
           {"cmpt" + little_endian(1) + little_endian(28), "a cmpt tile of 3D Tiles"},
           {"Z2xURgIAAAB0BQAAFAQAAEpTT057", "the base64 text of a GLB"},
           {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "a COLLADA model"},
           {"<!DOCTYPE html><html>", "an HTML page"}}) {
    const Container container = open_glb(file.bytes);
    ASSERT_THAT(codes_of(container), ElementsAre("GLB_INVALID_MAGIC")) << file.name;
    EXPECT_THAT(container.errors[0].message, HasSubstr("The file is " + file.name));
    EXPECT_NE(container.errors[0].help, "");
  }
  EXPECT_THAT(open_glb("hello, this is a text").errors[0].message, HasSubstr("The magic"));
}

}  // namespace
}  // namespace gltfx::container::test
