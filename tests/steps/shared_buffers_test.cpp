// SPDX-License-Identifier: Apache-2.0
// New bytes of steps are stored, also if buffers share a file or no buffer can take them.
#include <gmock/gmock.h>

#include "geometry_support.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::AssetText;
using test::Grid;
using test::OrderedJson;
using test::StoredAsset;
using test::view_bytes;
using testing::SizeIs;

// Three grids, two of them in the second buffer. The buffers have the same file. The last grid is
// too small to be compressed.
class SharedBuffers : public testing::Test {
 protected:
  SharedBuffers() {
    asset_.mesh(asset_.grid(Grid(16)));
    asset_.mesh(asset_.grid(Grid(12)));
    asset_.mesh(asset_.grid(Grid(2)));
    for (std::size_t i = 3; i < 9; ++i) asset_.json["bufferViews"][i]["buffer"] = 1;
  }
  fs::path write() {
    folder_.write("b.bin", asset_.bytes);
    asset_.text();
    asset_.json["buffers"].push_back(asset_.json["buffers"][0]);
    return folder_.write("a.gltf", asset_.json.dump(1));
  }
  ConvertReport convert(ConvertOptions options) {
    options.output = output_.native();
    ConvertReport report = convert_file(write().native(), options);
    EXPECT_TRUE(report.written) << report.error;
    return report;
  }

  TempFolder folder_;
  const fs::path output_ = folder_.path() / "out" / "a.gltf";
  AssetText asset_;
};

TEST_F(SharedBuffers, KeepTheirFileWithNewBytes) {
  ConvertOptions options;
  options.compress = Compression::meshopt;
  convert(options);
  const OrderedJson now = StoredAsset::at(output_).json();
  ASSERT_THAT(now["buffers"], SizeIs(3));
  const std::size_t size = fs::file_size(output_.parent_path() / "b.bin");
  EXPECT_LT(size, asset_.bytes.size());
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(now["buffers"][i]["uri"], "b.bin");
    EXPECT_EQ(now["buffers"][i]["byteLength"], size);
  }
  EXPECT_EQ(view_bytes(output_), view_bytes(folder_.path() / "a.gltf"));
}

TEST_F(SharedBuffers, AreCompressedWithinOneFolder) {
  ConvertOptions options;
  options.compress = Compression::meshopt;
  options.output = (folder_.path() / "small.gltf").native();
  const ConvertReport report = convert_file(write().native(), options);
  ASSERT_TRUE(report.written) << report.error;
  ASSERT_THAT(report.new_files, SizeIs(1));
  const OrderedJson now = StoredAsset::at(options.output).json();
  EXPECT_EQ(now["buffers"][0]["uri"], report.new_files[0]);
  EXPECT_EQ(now["buffers"][1]["uri"], report.new_files[0]);
  EXPECT_EQ(content_of(folder_.path() / "b.bin"), asset_.bytes);
  EXPECT_EQ(view_bytes(options.output), view_bytes(folder_.path() / "a.gltf"));
}

TEST_F(SharedBuffers, AreReplacedInPlace) {
  ConvertOptions options;
  options.compress = Compression::meshopt;
  options.in_place = true;
  const fs::path path = write();
  const std::vector<std::string> before = view_bytes(path);
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_LT(fs::file_size(folder_.path() / "b.bin"), asset_.bytes.size());
  EXPECT_EQ(view_bytes(path), before);
}

TEST_F(SharedBuffers, BecomeOneInAGlb) {
  ConvertOptions options;
  options.compress = Compression::meshopt;
  options.to = StoredAs::glb;
  options.output = (folder_.path() / "a.glb").native();
  const ConvertReport report = convert_file(write().native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_THAT(StoredAsset::at(options.output).json()["buffers"], SizeIs(2));
  EXPECT_EQ(view_bytes(options.output), view_bytes(folder_.path() / "a.gltf"));
}

// The second grid equals the first one, so its buffer loses all users.
TEST_F(SharedBuffers, AreRemovedWithoutUsers) {
  AssetText twice;
  twice.mesh(twice.grid());
  twice.mesh(twice.grid());
  for (std::size_t i = 3; i < 6; ++i) twice.json["bufferViews"][i]["buffer"] = 1;
  asset_ = twice;
  ConvertOptions options;
  options.dedup = true;
  convert(options);
  const OrderedJson now = StoredAsset::at(output_).json();
  ASSERT_THAT(now["buffers"], SizeIs(1));
  EXPECT_THAT(now["bufferViews"], SizeIs(3));
  EXPECT_EQ(fs::file_size(output_.parent_path() / "b.bin"), now["buffers"][0]["byteLength"]);
  EXPECT_LT(now["buffers"][0]["byteLength"], asset_.bytes.size());
}

// The file is also an image, so it must not change.
TEST(NewBytes, GetABufferIfNoOtherCanStoreThem) {
  TempFolder folder;
  AssetText asset;
  asset.mesh(asset.grid());
  asset.json["images"].push_back({{"uri", "b.bin"}});
  folder.write("b.bin", asset.bytes);
  const fs::path path = folder.write("a.gltf", asset.text());
  ConvertOptions options;
  options.compress = Compression::meshopt;
  options.output = (folder.path() / "out" / "a.gltf").native();
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  const OrderedJson now = StoredAsset::at(options.output).json();
  ASSERT_THAT(report.new_files, SizeIs(1));
  EXPECT_TRUE(report.new_files[0].starts_with("a-"));
  EXPECT_EQ(now["buffers"][0]["uri"], report.new_files[0]);
  EXPECT_EQ(now["buffers"][0]["byteLength"],
            fs::file_size(folder.path() / "out" / report.new_files[0]));
  EXPECT_EQ(content_of(folder.path() / "out" / "b.bin"), asset.bytes);
  EXPECT_EQ(view_bytes(options.output), view_bytes(path));
}

// The view ends after its buffer. The new bytes do not become its content.
TEST(NewBytes, DoNotFollowABufferThatAViewOverruns) {
  TempFolder folder;
  AssetText asset;
  asset.mesh(asset.grid());
  asset.mesh(asset.grid(Grid(12)));
  asset.json["bufferViews"][3]["byteOffset"] = asset.bytes.size() - 8;
  const fs::path path = asset.write(folder);
  ConvertOptions options;
  options.reorder = true;
  options.partial = true;
  options.output = (folder.path() / "out" / "a.gltf").native();
  const ConvertReport report = convert_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(view_bytes(options.output)[3], "none");
  EXPECT_THAT(StoredAsset::at(options.output).json()["buffers"], SizeIs(2));
  options.output = (folder.path() / "again" / "a.gltf").native();
  EXPECT_FALSE(convert_file((folder.path() / "out" / "a.gltf").native(), options).changes);
  ConvertOptions packing;
  packing.output = (folder.path() / "a.glb").native();
  EXPECT_EQ(convert_file((folder.path() / "out" / "a.gltf").native(), packing).error,
            "/buffers/1: /bufferViews/3 refers to bytes after the end of its buffer "
            "(--partial writes the rest)");
}

TEST(NewBytes, KeepTheMediaTypeOfADataUri) {
  TempFolder folder;
  AssetText asset;
  asset.mesh(asset.grid());
  const fs::path path = asset.write(folder);
  ConvertOptions options;
  options.to = StoredAs::embedded;
  options.output = (folder.path() / "embedded.gltf").native();
  ASSERT_TRUE(convert_file(path.native(), options).written);
  std::string text = content_of(options.output);
  const std::string octets = "data:application/octet-stream;base64,";
  text.replace(text.find(octets), octets.size(), "data:application/gltf-buffer;base64,");
  const fs::path embedded = folder.write("typed.gltf", text);
  ConvertOptions compress;
  compress.compress = Compression::meshopt;
  compress.output = (folder.path() / "small.gltf").native();
  const ConvertReport report = convert_file(embedded.native(), compress);
  ASSERT_TRUE(report.written) << report.error;
  const std::string uri = StoredAsset::at(compress.output).json()["buffers"][0]["uri"];
  EXPECT_TRUE(uri.starts_with("data:application/gltf-buffer;base64,")) << uri.substr(0, 60);
  EXPECT_EQ(view_bytes(compress.output), view_bytes(path));
}

}  // namespace
}  // namespace gltfx
