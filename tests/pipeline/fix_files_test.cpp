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

std::string file_of(const std::filesystem::path& path) { return container::test::content_of(path); }

// A PNG of one pixel.
std::string picture() {
  return *container::decode_base64(
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg="
      "=");
}

std::string with_image(const std::string& uri, const std::string& more = {}) {
  return R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + "\"}" + more + "]}";
}
std::string with_buffer(const std::string& uri) {
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
    return file_of(path);
  }

  TempFolder folder_;
  FixReport report_;
};

TEST_F(FixFiles, EncodesASpaceAndNothingElse) {
  folder_.write("St\xC3\xBChle 1.png", picture());
  EXPECT_EQ(fixed(with_image("St\xC3\xBChle 1.png")), with_image("St\xC3\xBChle%201.png"));
  EXPECT_EQ(validate_file((folder_.path() / "asset.gltf").native()).counts.errors, 0U);
}

TEST_F(FixFiles, EncodesAHashWhereTheFileIsThere) {
  folder_.write("wood#1.png", picture());
  folder_.write("mesh?2.bin", "0123");
  EXPECT_EQ(fixed(with_image("wood#1.png")), with_image("wood%231.png"));
  EXPECT_EQ(fixed(with_buffer("mesh?2.bin")), with_buffer("mesh%3F2.bin"));
  EXPECT_EQ(fixed(with_buffer("mesh#3.bin")), with_buffer("mesh#3.bin"));
}

TEST_F(FixFiles, CutsAQueryWhereOnlyTheFileWithoutItIsThere) {
  folder_.write("a.bin", "0123");
  EXPECT_EQ(fixed(with_buffer("a.bin?v=2")), with_buffer("a.bin"));
  folder_.write("a.bin?v=2", "0123");
  EXPECT_EQ(fixed(with_buffer("a.bin?v=2")), with_buffer("a.bin?v=2"));
}

// The name is certain, whatever is wrong with the file.
TEST_F(FixFiles, EncodesAHashInTheNameOfAFileWithErrors) {
  folder_.write("mesh#2.bin", "012");
  EXPECT_EQ(fixed(with_buffer("mesh#2.bin")), with_buffer("mesh%232.bin"));
}

TEST_F(FixFiles, NamesTheFileThatDiffersInCaseEndingOrSpelling) {
  folder_.write("Textures/Wood.PNG", picture());
  folder_.write("leaf.png", picture());
  folder_.write("lambert1.001.png", picture());
  folder_.write("Mesh.bin", "0123");
  EXPECT_EQ(fixed(with_image("textures/wood.png")), with_image("Textures/Wood.PNG"));
  EXPECT_EQ(fixed(with_image("leaf.jpg")), with_image("leaf.png"));
  EXPECT_EQ(fixed(with_image("lambert1.png")), with_image("lambert1.001.png"));
  EXPECT_EQ(fixed(with_image("maps/leaf.png")), with_image("leaf.png"));
  EXPECT_EQ(fixed(with_buffer("mesh.bin")), with_buffer("Mesh.bin"));
}

TEST_F(FixFiles, LeavesANameWhereTwoFilesAreMeantOrNoneDecodes) {
  folder_.write("Leaf.png", picture());
  folder_.write("LEAF.png", picture());
  folder_.write("Wood.png", "not a picture");
  folder_.write("Mesh.bin", "012");
  for (const char* uri : {"leaf.png", "wood.png"}) {
    EXPECT_EQ(fixed(with_image(uri)), with_image(uri));
    EXPECT_EQ(report_.left(), 1U);
  }
  EXPECT_EQ(fixed(with_buffer("mesh.bin")), with_buffer("mesh.bin"));
}

TEST_F(FixFiles, LeavesANameWhereAnotherImageHasTheFile) {
  folder_.write("stones.png", picture());
  const std::string asset = with_image("stone.png", R"(,{"uri":"stones.png"})");
  EXPECT_EQ(fixed(asset), asset);
}

TEST_F(FixFiles, OfAWindowsDriveAreFoundWhenAskedFor) {
  folder_.write("maps/wood.png", picture());
  const std::string asset = with_image(R"(C:\\Users\\me\\maps\\wood.png)");
  EXPECT_EQ(fixed(asset), asset);
  EXPECT_EQ(fixed(asset, "URI_OUTSIDE_ROOT"), with_image("maps/wood.png"));
}

std::string number(std::size_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((value >> shift) & 0xFFU);
  }
  return bytes;
}

std::string glb_of(const std::string& chunks) {
  return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}
std::string chunk_of(const std::string& type, const std::string& data, std::size_t uncounted = 0) {
  return number(data.size() - uncounted) + type + data;
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
    return file_of(path);
  }
};

const std::string kBinType("BIN\0", 4);
const std::string kJson = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]}    )";

TEST_F(FixGlb, WritesTheTypesOfChunksThatAreNumbers) {
  EXPECT_EQ(fixed_glb(glb_of(chunk_of(number(0), kJson) + chunk_of(number(1), "abcd"))),
            glb_of(chunk_of("JSON", kJson) + chunk_of(kBinType, "abcd")));
}

TEST_F(FixGlb, CountsPaddingThatIsThere) {
  const std::string sound = glb_of(chunk_of("JSON", kJson) + chunk_of(kBinType, "abcd"));
  EXPECT_EQ(fixed_glb(glb_of(chunk_of("JSON", kJson, 3) + chunk_of(kBinType, "abcd"))), sound);
}

TEST_F(FixGlb, RemovesAnEmptyUriInFrontOfTheBinChunk) {
  const std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":""}]} )";
  const std::string after =
      fixed_glb(glb_of(chunk_of("JSON", json + std::string(3 - (json.size() + 3) % 4, ' ')) +
                       chunk_of(kBinType, "abcd")));
  EXPECT_EQ(after.find("uri"), std::string::npos);
  EXPECT_NE(after.find("abcd"), std::string::npos);
}

TEST_F(FixGlb, ConvertsNamesToUtf8WhenAskedFor) {
  const auto asset = [](const std::string& name) {
    std::string json = R"({"asset":{"version":"2.0"},"nodes":[{"name":")" + name + "\"}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return glb_of(chunk_of("JSON", json));
  };
  EXPECT_EQ(fixed_glb(asset("St\xFChle")), asset("St\xFChle"));
  EXPECT_EQ(fixed_glb(asset("St\xFChle"), "JSON_INVALID_UTF8"), asset("St\xC3\xBChle"));
  EXPECT_EQ(fixed_glb(asset("\x83\x65\x83\x58\x83\x67"), "JSON_INVALID_UTF8"),
            asset("\xE3\x83\x86\xE3\x82\xB9\xE3\x83\x88"));
}

}  // namespace
}  // namespace gltfx
