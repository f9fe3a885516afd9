// SPDX-License-Identifier: Apache-2.0
// Verbs change GLBs of version 3 in place: what does not change stays byte for byte.
#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/container.hpp"
#include "container/glb3_builder.hpp"
#include "container/temp_folder.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx {
namespace {

using container::kChunkBin;
using container::kChunkJson;
using container::test::Chunk3;
using container::test::content_of;
using container::test::glb3;
using container::test::TempFolder;
using testing::SizeIs;

constexpr std::uint32_t kExtra = 0x41525458;

std::string floats(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

const std::string kCorners = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
const std::string kNormals = floats({0, 0, 2, 0, 0, 1, 0, 0, 1});

// A triangle with a first normal of length 2, in a chunk of its own.
std::string triangle_text(std::string_view first = R"("byteLength":36)") {
  return fmt::format(R"({{"asset":{{"version":"2.1"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"type":"VEC3","count":3}}],
"bufferViews":[{{"buffer":0,"byteLength":36,"target":34962}},{{"buffer":1,"byteLength":36,"target":34962}}],
"buffers":[{{{},"chunk":1}},{{"byteLength":36,"chunk":4}}]}})",
                     first);
}

std::vector<Chunk3> triangle() {
  return {{kChunkJson, triangle_text()}, {kChunkBin, kCorners}, {kExtra, "odd", 5},
          {kChunkJson, "[1]"},           {kChunkBin, kNormals}, {kExtra, "last"}};
}

container::Container opened_glb3(const std::filesystem::path& path) {
  return *container::open_file(path);
}

std::string data_of_chunk(const container::Container& glb, std::size_t position) {
  const container::Chunk& chunk = glb.chunks.at(position);
  return std::string(glb.bytes.text().substr(chunk.offset, chunk.length));
}

nlohmann::json json_of(const container::Container& glb) { return nlohmann::json::parse(*glb.json); }

TEST(EditGlb3, AFixRewritesTheBytesOfOneChunk) {
  const TempFolder folder;
  const auto path = folder.write("a.glb", glb3(triangle()));
  FixOptions options;
  options.in_place = true;
  const FixReport report = fix_file(path.native(), options);
  EXPECT_TRUE(report.written) << report.error;
  std::vector<Chunk3> wanted = triangle();
  wanted[4].data = floats({0, 0, 1, 0, 0, 1, 0, 0, 1});
  EXPECT_EQ(content_of(path), glb3(wanted));
  EXPECT_FALSE(fix_file(path.native(), options).changes);
}

TEST(EditGlb3, AFixOfTheTextMovesTheRest) {
  const TempFolder folder;
  std::vector<Chunk3> chunks = triangle();
  chunks[0].data = triangle_text(R"("byteLength":"36")");
  chunks[4].data = floats({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const auto path = folder.write("a.glb", glb3(chunks));
  FixOptions options;
  options.in_place = true;
  const FixReport report = fix_file(path.native(), options);
  EXPECT_TRUE(report.written) << report.error;
  chunks[0].data = triangle_text();
  const container::Container now = opened_glb3(path);
  chunks[0].data.resize(now.json->size(), ' ');
  EXPECT_LT(now.json->size(), triangle_text().size() + 8);
  EXPECT_EQ(content_of(path), glb3(chunks));
}

TEST(EditGlb3, ADeletedBufferTakesItsChunkAlong) {
  const TempFolder folder;
  const auto path = folder.write("a.glb", glb3(triangle()));
  DeleteOptions options;
  options.in_place = options.cascade = true;
  options.pointers = {"/buffers/0"};
  const DeleteReport report = delete_objects(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(report.bytes, 36U);
  const container::Container now = opened_glb3(path);
  ASSERT_THAT(now.chunks, SizeIs(5));
  EXPECT_EQ(json_of(now)["buffers"].dump(), R"([{"byteLength":36,"chunk":3}])");
  EXPECT_EQ(data_of_chunk(now, 3), kNormals);
  EXPECT_EQ(now.chunks[1].encoding, 5U);
}

TEST(EditGlb3, BytesOfADeletedViewAreCutFromItsChunk) {
  const TempFolder folder;
  const std::string text = R"({"asset":{"version":"2.1"},
"buffers":[{"byteLength":8,"chunk":1},{"byteLength":24,"chunk":2}],"images":[{"bufferView":2,"mimeType":"image/png"}],
"bufferViews":[{"buffer":0,"byteLength":8},{"buffer":1,"byteLength":8},{"buffer":1,"byteOffset":16,"byteLength":8}]})";
  const auto path = folder.write(
      "a.glb",
      glb3({{kChunkJson, text}, {kChunkBin, "12345678"}, {kChunkBin, "abcdefgh--------ABCDEFGH"}}));
  DeleteOptions options;
  options.in_place = true;
  options.pointers = {"/bufferViews/1"};
  const DeleteReport report = delete_objects(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  const container::Container now = opened_glb3(path);
  EXPECT_EQ(data_of_chunk(now, 1), "12345678");
  EXPECT_EQ(data_of_chunk(now, 2), "--------ABCDEFGH");
  EXPECT_EQ(json_of(now)["buffers"].dump(),
            R"([{"byteLength":8,"chunk":1},{"byteLength":16,"chunk":2}])");
}

}  // namespace
}  // namespace gltfx
