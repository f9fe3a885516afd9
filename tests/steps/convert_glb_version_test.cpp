// SPDX-License-Identifier: Apache-2.0
// GLBs become GLBs of the other version, and those of version 3 become files.
#include <algorithm>
#include <cstdint>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/codes.hpp"
#include "container/glb3_builder.hpp"
#include "convert_support.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::kChunkBin;
using container::kChunkJson;
using container::test::Chunk3;
using container::test::content_of;
using container::test::glb3;
using container::test::TempFolder;
using test::glb_of;
using test::options_to;
using test::picture;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint32_t kExtra = 0x41525458;

const std::string kTwoChunks = R"({"asset":{"version":"2.1"},"buffers":[
  {"byteLength":5,"chunk":1},{"byteLength":4,"chunk":3}],
  "bufferViews":[{"buffer":0,"byteLength":5},{"buffer":1,"byteOffset":1,"byteLength":3}]})";

class GlbVersions : public testing::Test {
 protected:
  fs::path output() const { return folder_.path() / "out" / "a.glb"; }

  ConvertReport run(const std::string& bytes, std::optional<GlbVersion> version,
                    bool partial = false) {
    ConvertOptions options = options_to(output());
    options.later.glb_version = version;
    options.partial = partial;
    return convert_file(folder_.write("a.glb", bytes).native(), options);
  }
  StoredAsset made(const std::string& bytes, std::optional<GlbVersion> version = {}) {
    report_ = run(bytes, version);
    EXPECT_TRUE(report_.written) << report_.error;
    return StoredAsset::at(output());
  }

  TempFolder folder_;
  ConvertReport report_;
};

TEST_F(GlbVersions, ChunksAreJoinedInVersionTwo) {
  const StoredAsset now = made(glb3(
      {{kChunkJson, kTwoChunks}, {kChunkBin, "abcde"}, {kExtra, "more"}, {kChunkBin, "1234"}}));
  EXPECT_EQ(now.container.glb_version, 2U);
  EXPECT_THAT(now.container.errors, SizeIs(1));  // the extra chunk
  EXPECT_EQ(now.bin, std::string("abcde\0\0\0", 8) + "1234");
  EXPECT_EQ(now.json()["buffers"].dump(), R"([{"byteLength":12}])");
  EXPECT_EQ(now.json()["bufferViews"].dump(),
            R"([{"buffer":0,"byteLength":5},{"buffer":0,"byteOffset":9,"byteLength":3}])");
  ASSERT_THAT(report_.steps, SizeIs(1));
  EXPECT_EQ(report_.steps[0].what, "GLB version 3 -> 2, 2 BIN chunks joined");
  EXPECT_THAT(report_.steps[0].losses, IsEmpty());  // the extra chunk is still chunk 2
  EXPECT_EQ(report_.steps[0].bytes_after, fs::file_size(output()));
}

TEST_F(GlbVersions, NumbersOfOtherChunksThatChangeAreNamed) {
  const StoredAsset now = made(
      glb3({{kExtra, "more"},
            {kChunkJson, R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":2,"chunk":2}]})"},
            {kChunkBin, "ab"}}));
  EXPECT_EQ(now.json()["buffers"].dump(), R"([{"byteLength":2}])");
  ASSERT_THAT(report_.steps[0].losses, SizeIs(1));
  EXPECT_EQ(report_.steps[0].losses[0].quantity, "the number of chunk 0 ('XTRA'), which becomes 2");
  EXPECT_EQ(now.chunk(now.container.chunks.at(2)), "more");
}

TEST_F(GlbVersions, WhatVersionTwoCannotHoldIsRefusedAndLeftOutWhereAsked) {
  const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":2}]})";
  const Chunk3 bin{kChunkBin, "abcd"};
  for (const auto& [chunk, why] : std::vector<std::pair<Chunk3, std::string>>{
           {{kChunkJson, "[]"}, "chunk 2 ('JSON') is a second JSON chunk"},
           {{kExtra, "1", 3}, "chunk 2 ('XTRA') has an encoding"},
           {{kChunkBin, "1", 3}, "has an encoding, which version 2 does not state"},
           {{kChunkBin, "1"}, "is the data of no buffer, and version 2 has one BIN chunk"}}) {
    const std::string bytes = glb3({{kChunkJson, text}, bin, chunk});
    const ConvertReport refused = run(bytes, {});
    EXPECT_FALSE(refused.written);
    EXPECT_THAT(refused.error, HasSubstr(why));
    const ConvertReport partial = run(bytes, {}, true);
    EXPECT_TRUE(partial.written) << partial.error;
    EXPECT_THAT(partial.steps[0].losses, SizeIs(1));
    EXPECT_EQ(content_of(output()), glb_of(text, "abcd"));
    fs::remove(output());
  }
}

TEST_F(GlbVersions, VersionThreeKeepsTheText) {
  const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]} )";
  const std::string old = glb_of(text, "abcd", container::test::chunk(kExtra, "more"));
  made(old, GlbVersion::three);
  EXPECT_EQ(report_.steps[0].what, "GLB version 2 -> 3");
  const std::string three = content_of(output());
  EXPECT_EQ(three, glb3({{kChunkJson, StoredAsset(old).container.json->data()},
                         {kChunkBin, "abcd"},
                         {kExtra, "more"}}));
  EXPECT_EQ(report_.steps[0].bytes_after, three.size());
  EXPECT_THAT(StoredAsset(three).container.errors, IsEmpty());
  made(three);
  EXPECT_EQ(content_of(output()), old);
}

TEST_F(GlbVersions, FilesGoIntoAGlbOfVersionThree) {
  folder_.write("b.bin", "abcd");
  const fs::path path = folder_.write(
      "a.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"b.bin","byteLength":4}]})");
  ConvertOptions options = options_to(output());
  options.later.glb_version = GlbVersion::three;
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(report.steps[0].what, "one GLB of version 3, 1 buffer");
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_EQ(now.container.glb_version, 3U);
  EXPECT_EQ(now.bin, "abcd");
  EXPECT_EQ(now.json()["buffers"].dump(), R"([{"byteLength":4}])");
}

TEST_F(GlbVersions, FilesGoIntoTheFirstChunkAndTheOthersStay) {
  folder_.write("leaf.png", picture("leaf"));
  folder_.write("b.bin", "12345678");
  const std::string text = R"({"asset":{"version":"2.1"},"images":[{"uri":"leaf.png"}],
    "buffers":[{"uri":"b.bin","byteLength":8},{"byteLength":4,"chunk":2},{"byteLength":3,"chunk":3}],
    "bufferViews":[{"buffer":0,"byteLength":8},{"buffer":1,"byteLength":4},{"buffer":2,"byteLength":3}]})";
  const fs::path path = folder_.write(
      "a.glb", glb3({{kExtra, "x"}, {kChunkJson, text}, {kChunkBin, "abcd"}, {kChunkBin, "xyz"}}));
  ConvertOptions options = options_to(output());
  options.to = StoredAs::glb;
  options.later.glb_version = GlbVersion::three;
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  const StoredAsset now = StoredAsset::at(output());
  ASSERT_THAT(now.container.chunks, SizeIs(4));
  EXPECT_EQ(now.chunk(now.container.chunks[2]).substr(0, 16),
            std::string("abcd\0\0\0\0", 8) + "12345678");
  EXPECT_EQ(now.chunk(now.container.chunks[3]), "xyz");
  EXPECT_EQ(now.json()["buffers"].dump(),
            R"([{"byteLength":36,"chunk":2},{"byteLength":3,"chunk":3}])");
  EXPECT_EQ(now.json()["bufferViews"].dump(),
            R"([{"buffer":0,"byteLength":8,"byteOffset":8},{"buffer":0,"byteLength":4},)"
            R"({"buffer":1,"byteLength":3},{"buffer":0,"byteOffset":16,"byteLength":20}])");
}

TEST_F(GlbVersions, ChunksBecomeFilesAndImagesInThemToo) {
  const std::string text =
      R"({"asset":{"version":"2.1"},"images":[{"bufferView":1,"mimeType":"image/png"}],
    "buffers":[{"byteLength":4,"chunk":1},{"byteLength":20,"chunk":2},{"chunk":3,"byteLength":3}],
    "bufferViews":[{"buffer":0,"byteLength":4},{"buffer":1,"byteLength":20},{"buffer":2,"byteLength":3}]})";
  const fs::path path = folder_.write("a.glb", glb3({{kChunkJson, text},
                                                     {kChunkBin, "abcd"},
                                                     {kChunkBin, picture("leaf")},
                                                     {kChunkBin, "xyz"}}));
  const fs::path out = folder_.path() / "out" / "a.gltf";
  test::converted(path, out);
  EXPECT_EQ(
      StoredAsset::at(out).json().dump(),
      R"({"asset":{"version":"2.1"},"images":[{"uri":"a_image0.png","mimeType":"image/png"}],)"
      R"("buffers":[{"byteLength":4,"uri":"a.bin"},{"uri":"a-2.bin","byteLength":3}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":4},{"buffer":1,"byteLength":3}]})");
  EXPECT_EQ(content_of(out.parent_path() / "a.bin"), "abcd");
  EXPECT_EQ(content_of(out.parent_path() / "a-2.bin"), "xyz");
  EXPECT_EQ(content_of(out.parent_path() / "a_image0.png"), picture("leaf"));
}

TEST_F(GlbVersions, StepsChangeTheirChunksOnlyInPlace) {
  const std::string text = R"({"asset":{"version":"2.1"},
    "buffers":[{"byteLength":12,"chunk":1},{"byteLength":12,"chunk":3}],
    "bufferViews":[{"buffer":0,"byteLength":12},{"buffer":1,"byteLength":12}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
                 {"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"}],
    "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"_A":1},"mode":0}]}]})";
  const fs::path path = folder_.write("a.glb", glb3({{kChunkJson, text},
                                                     {kChunkBin, std::string(12, 'a')},
                                                     {kExtra, "x", 9},
                                                     {kChunkBin, std::string(12, 'b')}}));
  ConvertOptions options;
  options.in_place = options.prune = true;
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  const StoredAsset now = StoredAsset::at(path);
  EXPECT_EQ(now.container.glb_version, 3U);
  ASSERT_THAT(now.container.chunks, SizeIs(3));
  EXPECT_EQ(now.container.chunks[1].type, kExtra);
  EXPECT_EQ(now.container.chunks[1].encoding, 9U);
  EXPECT_EQ(now.chunk(now.container.chunks[2]), std::string(12, 'b'));
  EXPECT_EQ(now.json()["buffers"].dump(), R"([{"byteLength":12,"chunk":2}])");
  EXPECT_EQ(report.steps[0].bytes_after, fs::file_size(path));
  EXPECT_FALSE(convert_file(path.native(), options).changes);
}

TEST_F(GlbVersions, InPlaceTheVersionStaysUnlessAsked) {
  const std::string three =
      glb3({{kChunkJson, R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]})"},
            {kChunkBin, "abcd"}});
  const fs::path path = folder_.write("a.glb", three);
  ConvertOptions options;
  EXPECT_FALSE(convert_file(path.native(), options).changes);
  options.in_place = true;
  EXPECT_FALSE(convert_file(path.native(), options).changes);
  options.later.glb_version = GlbVersion::two;
  EXPECT_TRUE(convert_file(path.native(), options).written);
  EXPECT_EQ(StoredAsset::at(path).container.glb_version, 2U);
  options.later.glb_version = GlbVersion::three;
  EXPECT_TRUE(convert_file(path.native(), options).written);
  EXPECT_EQ(content_of(path), three);
}

std::vector<fs::path> glbs_below(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".glb") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Converts GLBs to the other version and back; returns the refused ones.
std::set<std::string> sent_there_and_back(const std::vector<fs::path>& paths, std::size_t& same) {
  const TempFolder folder;
  std::set<std::string> refused;
  for (const fs::path& path : paths) {
    const StoredAsset before = StoredAsset::at(path);
    const bool is_3 = before.container.glb_version == 3U;
    ConvertOptions options = options_to(folder.path() / "there.glb");
    options.later.glb_version = is_3 ? GlbVersion::two : GlbVersion::three;
    const ConvertReport there = convert_file(path.native(), options);
    if (!there.written) {
      EXPECT_NE(there.error, "") << path;
      refused.insert(path.filename().native());
      continue;
    }
    const std::string from = std::exchange(options.output, (folder.path() / "back.glb").native());
    options.later.glb_version = is_3 ? GlbVersion::three : GlbVersion::two;
    const ConvertReport back = convert_file(from, options);
    EXPECT_TRUE(back.written) << path << back.error;
    const bool is_sound =
        before.container.late_errors.empty() &&
        std::all_of(before.container.errors.begin(), before.container.errors.end(),
                    [](const container::ContainerError& error) {
                      return error.code == Code::GLB_UNKNOWN_CHUNK_TYPE;
                    });
    if (is_3 || !is_sound) continue;
    EXPECT_EQ(content_of(options.output), content_of(path)) << path;
    ++same;
  }
  return refused;
}

TEST_F(GlbVersions, EveryFixtureGoesThereAndBack) {
  std::size_t same = 0;
  const auto refused =
      sent_there_and_back(glbs_below(fs::path(GLTFX_SOURCE_DIR) / "fixtures"), same);
  EXPECT_GE(same, 9U);
  // Those without a text to read, and those with what version 2 cannot hold.
  EXPECT_THAT(refused,
              ElementsAre("chunk-top-bit.glb", "empty.glb", "encoded-json.glb", "later-chunk.glb",
                          "no-json.glb", "tumbler-version-3.glb", "two-json.glb"));
}

// More than 4 GiB, nearly all of which lies in no block of the disk.
TEST_F(GlbVersions, AboveFourGibibytesVersionThreeStays) {
  constexpr std::uint64_t kLength = (std::uint64_t{1} << 32U) + 64;
  const std::string text = R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":)" +
                           std::to_string(kLength) +
                           R"(,"chunk":1}],"bufferViews":[{"buffer":0,"byteLength":4}]})";
  std::string head = glb3({{kChunkJson, text}, {kChunkBin, "", 0, kLength}});
  const std::uint64_t size = head.size() + kLength;
  head.replace(8, 8, container::test::little_endian_64(size));
  const fs::path path = folder_.write("large.glb", head);
  std::error_code error;
  fs::resize_file(path, size, error);
  if (error) GTEST_SKIP() << error.message();
  ConvertOptions options;
  options.to = StoredAs::glb;
  EXPECT_FALSE(convert_file(path.native(), options).changes);
  options.later.glb_version = GlbVersion::two;
  const ConvertReport refused = convert_file(path.native(), options);
  EXPECT_EQ(refused.problem, EditProblem::refused);
  EXPECT_THAT(refused.error, HasSubstr("a GLB of version 2 has at most 4 GiB; use --glb 3"));
}

}  // namespace
}  // namespace gltfx
