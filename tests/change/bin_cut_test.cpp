// SPDX-License-Identifier: Apache-2.0
// Only whole words that no other buffer view uses are cut from a BIN chunk.
#include <gmock/gmock.h>

#include "change/deletion.hpp"
#include "json/parse.hpp"
#include "schema/compile.hpp"

namespace gltfx::change {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct CutView {
  std::string text;
  std::vector<std::string> cut;  ///< "begin-end"
};

CutView without_first_view(const std::string& text, std::uint64_t bin_size,
                           const schema::Set& set = *schema::builtin_set()) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  EXPECT_TRUE(parsed.ok()) << text;
  container::Container container;
  container.chunks = {{container::kChunkJson, 0, 12, 20, 0},
                      {container::kChunkBin, 0, 20, 28, bin_size}};
  container.bin = container.chunks[1];
  const std::vector<std::string> pointers{"/bufferViews/0"};
  const auto done = plan_deletion(parsed.document, set, pointers, {false, &container});
  EXPECT_TRUE(done && done->obstacles.empty()) << text;
  CutView result{json::apply_edits(text, done->change.edits), {}};
  const auto bin = done->change.bins.find(1);
  if (bin == done->change.bins.end()) return result;
  for (const ByteRange& range : bin->second.cut) {
    result.cut.push_back(std::to_string(range.begin) + "-" + std::to_string(range.end));
  }
  return result;
}

// `views` are the buffer views of the document.
CutView cut(const std::string& views, std::uint64_t bin_size, std::uint64_t buffer) {
  return without_first_view(R"({"buffers":[{"byteLength":)" + std::to_string(buffer) +
                                R"(},{"byteLength":9}],"bufferViews":[)" + views + "]}",
                            bin_size);
}

TEST(BinCut, WhatOnlyAnOrphanHasIsCutAndTheRestMoves) {
  const CutView result = cut(R"({"buffer":0,"byteOffset":4,"byteLength":6},)"
                             R"({"buffer":0,"byteLength":4},)"
                             R"({"buffer":1,"byteOffset":8,"byteLength":1},)"
                             R"({"buffer":0,"byteOffset":12,"byteLength":4})",
                             16, 16);
  EXPECT_THAT(result.cut, ElementsAre("4-12"));
  EXPECT_EQ(result.text, R"({"buffers":[{"byteLength":8},{"byteLength":9}],"bufferViews":[)"
                         R"({"buffer":0,"byteLength":4},)"
                         R"({"buffer":1,"byteOffset":8,"byteLength":1},)"
                         R"({"buffer":0,"byteOffset":4,"byteLength":4}]})");
}

TEST(BinCut, WhatFilledTheEndUpGoesToo) {
  const CutView result = cut(R"({"buffer":0,"byteOffset":8,"byteLength":3},)"
                             R"({"buffer":0,"byteLength":5})",
                             12, 11);
  EXPECT_THAT(result.cut, ElementsAre("5-12"));
  EXPECT_EQ(result.text, R"({"buffers":[{"byteLength":5},{"byteLength":9}],"bufferViews":[)"
                         R"({"buffer":0,"byteLength":5}]})");
}

TEST(BinCut, LessThanAWordStays) {
  const CutView result = cut(R"({"buffer":0,"byteOffset":4,"byteLength":2},)"
                             R"({"buffer":0,"byteOffset":6,"byteLength":2})",
                             8, 8);
  EXPECT_THAT(result.cut, IsEmpty());
  EXPECT_THAT(result.text, HasSubstr(R"({"buffer":0,"byteOffset":6,"byteLength":2})"));
  EXPECT_THAT(result.text, HasSubstr(R"({"byteLength":8})"));
}

TEST(BinCut, ABufferKeepsItsLastByte) {
  const CutView result = cut(R"({"buffer":0,"byteLength":8})", 8, 8);
  EXPECT_THAT(result.cut, IsEmpty());
  EXPECT_EQ(result.text, R"({"buffers":[{"byteLength":8},{"byteLength":9}]})");
}

TEST(BinCut, NothingIsCutWhereNotEveryUseOfTheBytesIsKnown) {
  const std::string orphan = R"({"buffer":0,"byteLength":8})";
  for (const char* const other : {R"({"byteLength":8})", R"({"buffer":0})"}) {
    const CutView result = cut(orphan + "," + other, 16, 16);
    EXPECT_THAT(result.cut, IsEmpty()) << other;
    EXPECT_THAT(result.text, HasSubstr(other));
  }
}

TEST(BinCut, AVendorsExtensionMayReferToTheBuffer) {
  const schema::Compiled compiled = schema::compile_with({{"words.json", R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "gltfx:ext/TEST_words", "title": "TEST_words", "description": "Words.",
    "x-gltfx": {"extension": "TEST_words", "on": ["node"], "status": "vendor",
                "spec": "https://example.com/"},
    "type": "object", "properties": {"buffer": {"description": "Where they are.",
      "type": "integer", "minimum": 0, "x-gltfx": {"ref": "buffers"}}}})",
                                                           true}});
  ASSERT_TRUE(compiled.set) << compiled.errors.at(0).message;
  const std::string text = R"({"nodes":[{"extensions":{"TEST_words":{"buffer":0}}}],
    "buffers":[{"byteLength":8}],"bufferViews":[{"buffer":0,"byteLength":4},)"
                           R"({"buffer":0,"byteOffset":4,"byteLength":4}]})";
  EXPECT_THAT(without_first_view(text, 8, *compiled.set).cut, IsEmpty());
}

}  // namespace
}  // namespace gltfx::change
