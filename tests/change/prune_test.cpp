// SPDX-License-Identifier: Apache-2.0
// Orphans go, indices behind them move up, and of a BIN chunk only whole words that nobody needs.
#include "change/prune.hpp"

#include <gmock/gmock.h>

#include "json/parse.hpp"
#include "schema/compile.hpp"

namespace gltfx::change {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct PruneResult {
  std::string text;
  std::string error;
  std::vector<std::string> cut;  ///< "begin-end"
};

PruneResult pruned(const std::string& text, const edit::Orphans& orphans,
                   std::optional<std::uint64_t> bin_size = {}, const schema::Set* set = nullptr) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  EXPECT_TRUE(parsed.ok()) << text;
  const edit::References references(parsed.document,
                                    set != nullptr ? *set : *schema::builtin_set());
  const auto done = prune(parsed.document, references, orphans, bin_size);
  PruneResult result;
  if (!done) {
    result.error = done.error().message;
    return result;
  }
  result.text = json::apply_edits(text, done->edits);
  for (const ByteRange& range : done->cut) {
    result.cut.push_back(std::to_string(range.begin) + "-" + std::to_string(range.end));
  }
  return result;
}

const edit::Orphans kFirstTexture{{"textures", {0}}, {"images", {}}};

std::string two_textures(const std::string& members) {
  return R"({"textures":[{},{"name":"b"}],)" + members + "}";
}

TEST(Prune, NumbersInExtrasAreInTheWayOnlyWhereTheySoundLikeIndices) {
  EXPECT_EQ(pruned(two_textures(R"("extras":{"weight":3,"textures":"all"})"), kFirstTexture).text,
            R"({"textures":[{"name":"b"}],"extras":{"weight":3,"textures":"all"}})");
  EXPECT_THAT(pruned(two_textures(R"("extras":{"weight":3,"myImage":0})"), kFirstTexture).error,
              HasSubstr("/extras/myImage may be an index"));
}

TEST(Prune, NamesGoWithTheLastObjectOfTheirExtension) {
  const std::string lists = R"("extensionsUsed":["EXT_texture_webp"],)";
  const std::string webp = R"({"extensions":{"EXT_texture_webp":{"source":0}}})";
  const auto textures = [&](const std::string& other) {
    return "{" + lists + R"("textures":[)" + webp + "," + other + R"(],"images":[{}]})";
  };
  EXPECT_EQ(pruned(textures("{}"), kFirstTexture).text, R"({"textures":[{}],"images":[{}]})");
  EXPECT_EQ(pruned(textures(webp), kFirstTexture).text,
            "{" + lists + R"("textures":[)" + webp + R"(],"images":[{}]})");
}

TEST(Prune, PointersFollowUnlessTheyAreMadeAtRunTime) {
  const auto with = [](const std::string& pointer) {
    return pruned(two_textures(R"("x":{"pointer":")" + pointer + R"("})"), kFirstTexture);
  };
  EXPECT_THAT(with("/textures/1/name").text, HasSubstr(R"("/textures/0/name")"));
  for (const char* const pointer : {"/textures/b/name", "/textures/1x/name", "/images/{i}/name",
                                    "/meshes/0/name", "/textures//name"}) {
    EXPECT_THAT(with(pointer).text, HasSubstr(pointer));
  }
  EXPECT_THAT(with("/textures/{i}/name").error, HasSubstr("at run time"));
}

// View 0 goes. `views` are those of the document.
PruneResult cut(const std::string& views, std::uint64_t bin_size, std::uint64_t buffer) {
  return pruned(R"({"buffers":[{"byteLength":)" + std::to_string(buffer) +
                    R"(},{"byteLength":9}],"bufferViews":[)" + views + "]}",
                {{"bufferViews", {0}}}, bin_size);
}

TEST(Prune, WhatOnlyAnOrphanHasIsCutAndTheRestMoves) {
  const PruneResult result = cut(R"({"buffer":0,"byteOffset":4,"byteLength":6},)"
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

TEST(Prune, LessThanAWordStays) {
  const PruneResult result = cut(R"({"buffer":0,"byteOffset":4,"byteLength":2},)"
                                 R"({"buffer":0,"byteOffset":6,"byteLength":2})",
                                 8, 8);
  EXPECT_THAT(result.cut, IsEmpty());
  EXPECT_THAT(result.text, HasSubstr(R"({"buffer":0,"byteOffset":6,"byteLength":2})"));
  EXPECT_THAT(result.text, HasSubstr(R"({"byteLength":8})"));
}

TEST(Prune, ABufferKeepsItsLastByte) {
  const PruneResult result = cut(R"({"buffer":0,"byteLength":8})", 8, 8);
  EXPECT_THAT(result.cut, IsEmpty());
  EXPECT_EQ(result.text, R"({"buffers":[{"byteLength":8},{"byteLength":9}]})");
}

TEST(Prune, NothingIsCutWhereNotEveryUseOfTheBytesIsKnown) {
  const std::string orphan = R"({"buffer":0,"byteLength":8})";
  for (const char* const other :
       {R"({"byteLength":8})", R"({"buffer":0})",
        R"({"buffer":0,"byteOffset":8,"byteLength":4,"extensions":{}})"}) {
    const PruneResult result = cut(orphan + "," + other, 16, 16);
    EXPECT_THAT(result.cut, IsEmpty()) << other;
    EXPECT_THAT(result.text, HasSubstr(other));
  }
}

TEST(Prune, WithoutBufferViewsNothingIsCut) {
  const std::string text = two_textures(R"("buffers":[{"byteLength":8}])");
  for (const edit::Orphans& orphans :
       {kFirstTexture, edit::Orphans{{"textures", {0}}, {"bufferViews", {}}}}) {
    const PruneResult result = pruned(text, orphans, 8);
    EXPECT_THAT(result.cut, IsEmpty());
    EXPECT_THAT(result.text, HasSubstr(R"([{"name":"b"}])"));
  }
}

TEST(Prune, AVendorsExtensionMayReferToTheBuffer) {
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
  const edit::Orphans orphans{{"bufferViews", {0}}};
  EXPECT_THAT(pruned(text, orphans, 8, compiled.set.get()).cut, IsEmpty());
  EXPECT_THAT(pruned(text, orphans, 8).error, HasSubstr("TEST_words"));
}

}  // namespace
}  // namespace gltfx::change
