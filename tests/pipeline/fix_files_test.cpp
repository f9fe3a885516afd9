// SPDX-License-Identifier: Apache-2.0
// Fixes of what leads to files, and of how the file of the asset is put together.
#include <gltfx/pipeline.hpp>

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

std::string file_content(const std::filesystem::path& path) {
  return container::test::content_of(path);
}

// A PNG of one pixel.
std::string tiny_picture() {
  return *container::decode_base64(
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg="
      "=");
}

std::string asset_of_image(const std::string& uri, const std::string& more = {}) {
  return R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + "\"}" + more + "]}";
}
std::string asset_of_buffer(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":")" + uri + "\"}]}";
}

class FixFiles : public testing::Test {
 protected:
  std::string fixed(const std::string& asset, const std::string& unsafe = {}) {
    const auto path = folder_.write("asset.gltf", asset);
    FixOptions options;
    options.in_place = true;
    if (!unsafe.empty()) options.only = {unsafe};
    options.unsafe = !unsafe.empty();
    report_ = fix_file(path.native(), options);
    EXPECT_EQ(report_.error, "");
    return file_content(path);
  }

  TempFolder folder_;
  FixReport report_;
};

TEST_F(FixFiles, EncodesASpaceAndNothingElse) {
  folder_.write("St\xC3\xBChle 1.png", tiny_picture());
  EXPECT_EQ(fixed(asset_of_image("St\xC3\xBChle 1.png")), asset_of_image("St\xC3\xBChle%201.png"));
  EXPECT_EQ(validate_file((folder_.path() / "asset.gltf").native()).counts.errors, 0U);
}

TEST_F(FixFiles, EncodesAHashWhereTheFileIsThere) {
  folder_.write("wood#1.png", tiny_picture());
  folder_.write("mesh?2.bin", "0123");
  EXPECT_EQ(fixed(asset_of_image("wood#1.png")), asset_of_image("wood%231.png"));
  EXPECT_EQ(fixed(asset_of_buffer("mesh?2.bin")), asset_of_buffer("mesh%3F2.bin"));
  EXPECT_EQ(fixed(asset_of_buffer("mesh#3.bin")), asset_of_buffer("mesh#3.bin"));
}

TEST_F(FixFiles, CutsAQueryWhereOnlyTheFileWithoutItIsThere) {
  folder_.write("a.bin", "0123");
  EXPECT_EQ(fixed(asset_of_buffer("a.bin?v=2")), asset_of_buffer("a.bin"));
  folder_.write("a.bin?v=2", "0123");
  EXPECT_EQ(fixed(asset_of_buffer("a.bin?v=2")), asset_of_buffer("a.bin?v=2"));
}

// The name is certain, whatever is wrong with the file.
TEST_F(FixFiles, EncodesAHashInTheNameOfAFileWithErrors) {
  folder_.write("wood#1.png", "not a picture");
  EXPECT_EQ(fixed(asset_of_image("wood#1.png")), asset_of_image("wood%231.png"));
}

TEST_F(FixFiles, NamesTheFileThatDiffersInCaseEndingOrSpelling) {
  folder_.write("Textures/Wood.PNG", tiny_picture());
  folder_.write("leaf.png", tiny_picture());
  folder_.write("lambert1.001.png", tiny_picture());
  folder_.write("Mesh.bin", "0123");
  EXPECT_EQ(fixed(asset_of_image("textures/wood.png")), asset_of_image("Textures/Wood.PNG"));
  EXPECT_EQ(fixed(asset_of_image("leaf.jpg")), asset_of_image("leaf.png"));
  EXPECT_EQ(fixed(asset_of_image("lambert1.png")), asset_of_image("lambert1.001.png"));
  EXPECT_EQ(fixed(asset_of_image("maps/leaf.png")), asset_of_image("leaf.png"));
  EXPECT_EQ(fixed(asset_of_buffer("mesh.bin")), asset_of_buffer("Mesh.bin"));
}

TEST_F(FixFiles, LeavesANameWhereTwoFilesAreMeantOrNoneDecodes) {
  folder_.write("Leaf.png", tiny_picture());
  folder_.write("LEAF.png", tiny_picture());
  folder_.write("Wood.png", "not a picture");
  folder_.write("Mesh.bin", "012");
  for (const char* uri : {"leaf.png", "wood.png"}) {
    EXPECT_EQ(fixed(asset_of_image(uri)), asset_of_image(uri));
    EXPECT_EQ(report_.left(), 1U);
  }
  EXPECT_EQ(fixed(asset_of_buffer("mesh.bin")), asset_of_buffer("mesh.bin"));
}

TEST_F(FixFiles, LeavesANameWhereAnotherImageHasTheFile) {
  folder_.write("stones.png", tiny_picture());
  const std::string asset = asset_of_image("stone.png", R"(,{"uri":"stones.png"})");
  EXPECT_EQ(fixed(asset), asset);
}

TEST_F(FixFiles, OfAWindowsDriveAreFoundWhenAskedFor) {
  folder_.write("maps/wood.png", tiny_picture());
  const std::string asset = asset_of_image(R"(C:\\Users\\me\\maps\\wood.png)");
  EXPECT_EQ(fixed(asset), asset);
  EXPECT_EQ(fixed(asset, "URI_OUTSIDE_ROOT"), asset_of_image("maps/wood.png"));
}

std::string four_bytes(std::size_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((value >> shift) & 0xFFU);
  }
  return bytes;
}

std::string glb_file(const std::string& chunks) {
  return "glTF" + four_bytes(2) + four_bytes(12 + chunks.size()) + chunks;
}
std::string glb_chunk(const std::string& type, const std::string& data, std::size_t uncounted = 0) {
  return four_bytes(data.size() - uncounted) + type + data;
}

class FixGlb : public FixFiles {
 protected:
  std::string fixed_glb(const std::string& bytes, const std::string& unsafe = {}) {
    const auto path = folder_.write("asset.glb", bytes);
    FixOptions options;
    options.in_place = true;
    if (!unsafe.empty()) options.only = {unsafe};
    options.unsafe = !unsafe.empty();
    report_ = fix_file(path.native(), options);
    EXPECT_EQ(report_.error, "");
    return file_content(path);
  }
};

const std::string kGlbBin("BIN\0", 4);
const std::string kGlbJson = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]}    )";

TEST_F(FixGlb, WritesTheTypesOfChunksThatAreNumbers) {
  EXPECT_EQ(
      fixed_glb(glb_file(glb_chunk(four_bytes(0), kGlbJson) + glb_chunk(four_bytes(1), "abcd"))),
      glb_file(glb_chunk("JSON", kGlbJson) + glb_chunk(kGlbBin, "abcd")));
}

TEST_F(FixGlb, CountsPaddingThatIsThere) {
  const std::string sound = glb_file(glb_chunk("JSON", kGlbJson) + glb_chunk(kGlbBin, "abcd"));
  EXPECT_EQ(fixed_glb(glb_file(glb_chunk("JSON", kGlbJson, 3) + glb_chunk(kGlbBin, "abcd"))),
            sound);
}

TEST_F(FixGlb, RemovesAnEmptyUriInFrontOfTheBinChunk) {
  const std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":""}]} )";
  const std::string after =
      fixed_glb(glb_file(glb_chunk("JSON", json + std::string(3 - (json.size() + 3) % 4, ' ')) +
                         glb_chunk(kGlbBin, "abcd")));
  EXPECT_EQ(after.find("uri"), std::string::npos);
  EXPECT_NE(after.find("abcd"), std::string::npos);
}

TEST_F(FixGlb, ConvertsNamesToUtf8WhenAskedFor) {
  const auto asset = [](const std::string& name) {
    std::string json = R"({"asset":{"version":"2.0"},"nodes":[{"name":")" + name + "\"}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return glb_file(glb_chunk("JSON", json));
  };
  EXPECT_EQ(fixed_glb(asset("St\xFChle"), "JSON_INVALID_UTF8"), asset("St\xC3\xBChle"));
  EXPECT_EQ(fixed_glb(asset("\x83\x65\x83\x58\x83\x67"), "JSON_INVALID_UTF8"),
            asset("\xE3\x83\x86\xE3\x82\xB9\xE3\x83\x88"));
}

}  // namespace
}  // namespace gltfx
