// SPDX-License-Identifier: Apache-2.0
// Decoding of meshoptimizer streams; convert_draco_test.cpp tests Draco.
#include <gmock/gmock.h>

#include "geometry_support.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::AssetText;
using test::OrderedJson;
using test::StoredAsset;
using test::view_bytes;
using testing::HasSubstr;

constexpr const char* kStream = "EXT_meshopt_compression";

class Decode : public testing::Test {
 protected:
  void SetUp() override {
    asset_.mesh(asset_.grid());
    ConvertOptions options = test::options_to(packed_);
    options.compress = Compression::meshopt;
    ASSERT_TRUE(convert_file(asset_.write(folder_).native(), options).written);
  }
  ConvertReport decode(bool partial = false) {
    ConvertOptions options = test::options_to(plain_);
    options.compress = Compression::none;
    options.partial = partial;
    return convert_file(packed_.native(), options);
  }
  // Uses a changed text.
  ConvertReport decode(const OrderedJson& json) {
    folder_.write("packed/a.gltf", json.dump());
    return decode();
  }
  OrderedJson packed() const { return StoredAsset::at(packed_).json(); }
  OrderedJson plain() const { return StoredAsset::at(plain_).json(); }

  TempFolder folder_;
  AssetText asset_;
  const fs::path packed_ = folder_.path() / "packed" / "a.gltf";
  const fs::path plain_ = folder_.path() / "plain" / "a.gltf";
};

TEST_F(Decode, ReplacesStreamsWithTheirContent) {
  const ConvertReport report = decode();
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(report.steps[0].what, "3 buffer views");
  EXPECT_EQ(view_bytes(plain_), view_bytes(folder_.path() / "a.gltf"));
  EXPECT_EQ(plain()["accessors"], asset_.json["accessors"]);
  EXPECT_EQ(plain()["buffers"].size(), 1U);
  EXPECT_FALSE(plain().contains("extensionsUsed"));
  EXPECT_FALSE(plain().contains("extensionsRequired"));
  const OrderedJson views = plain()["bufferViews"];
  for (const auto& view : views) EXPECT_FALSE(view.contains("extensions"));
}

TEST_F(Decode, ListsExtrasOfStreams) {
  OrderedJson json = packed();
  json["bufferViews"][0]["extensions"][kStream]["extras"] = {{"a", 1}};
  const ConvertReport report = decode(json);
  ASSERT_TRUE(report.written) << report.error;
  ASSERT_EQ(report.steps[0].losses.size(), 1U);
  EXPECT_EQ(report.steps[0].losses[0].quantity, "the extras of EXT_meshopt_compression in 1 place");
}

TEST_F(Decode, LeavesPlainData) {
  ASSERT_TRUE(decode().written);
  const fs::path again = folder_.path() / "again" / "a.gltf";
  ConvertOptions options = test::options_to(again);
  options.compress = Compression::none;
  EXPECT_FALSE(convert_file(plain_.native(), options).changes);
  EXPECT_EQ(content_of(again), content_of(plain_));
}

TEST_F(Decode, UpdatesTheListsOfExtensions) {
  OrderedJson json = packed();
  json["extensionsUsed"] = OrderedJson::array({"KHR_lights_punctual", kStream});
  ASSERT_TRUE(decode(json).written);
  EXPECT_EQ(plain()["extensionsUsed"], OrderedJson::array({"KHR_lights_punctual"}));
  EXPECT_FALSE(plain().contains("extensionsRequired"));
}

// Compressed views with plain copies in a file.
class DecodeCopies : public Decode {
 protected:
  OrderedJson with_copies(bool exact) {
    OrderedJson json = packed();
    std::string bytes(json["buffers"][1]["byteLength"], '\0');
    const auto views = view_bytes(folder_.path() / "a.gltf");
    for (std::size_t i = 0; i < views.size(); ++i) {
      bytes.replace(json["bufferViews"][i].value("byteOffset", 0U), views[i].size(), views[i]);
    }
    if (!exact) bytes[2] = static_cast<char>(bytes[2] ^ 1);
    folder_.write("packed/copy.bin", bytes);
    json["buffers"][1]["uri"] = "copy.bin";
    json.erase("extensionsRequired");
    return json;
  }
};

TEST_F(DecodeCopies, KeepsPlainCopiesThatAreEqual) {
  const ConvertReport report = decode(with_copies(true));
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(view_bytes(plain_), view_bytes(folder_.path() / "a.gltf"));
  const auto buffer = plain()["bufferViews"][0]["buffer"].get<std::size_t>();
  EXPECT_EQ(plain()["buffers"][buffer]["uri"], "copy.bin");
  EXPECT_FALSE(plain()["buffers"][buffer].contains("extensions"));
  EXPECT_EQ(content_of(plain_.parent_path() / "copy.bin"),
            content_of(packed_.parent_path() / "copy.bin"));
}

TEST_F(DecodeCopies, DropsPlainCopiesThatDiffer) {
  const ConvertReport report = decode(with_copies(false));
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(view_bytes(plain_), view_bytes(folder_.path() / "a.gltf"));
}

TEST_F(Decode, RefusesABrokenStream) {
  std::string bytes = content_of(packed_.parent_path() / "b.bin");
  bytes[0] = 'x';
  folder_.write("packed/b.bin", bytes);
  const ConvertReport report = decode();
  EXPECT_THAT(report.error, HasSubstr("/bufferViews/0: it has a stream that cannot be decoded"));
  EXPECT_FALSE(fs::exists(plain_));
  EXPECT_TRUE(decode(true).written);
  EXPECT_TRUE(plain()["bufferViews"][0].contains("extensions"));
  EXPECT_FALSE(plain()["bufferViews"][1].contains("extensions"));
  EXPECT_EQ(plain()["extensionsRequired"], OrderedJson::array({kStream}));
}

TEST_F(Decode, RefusesAStreamWithoutADescription) {
  OrderedJson json = packed();
  json["bufferViews"][1]["extensions"][kStream]["mode"] = "WHATEVER";
  EXPECT_THAT(decode(json).error,
              HasSubstr("/bufferViews/1: the description of its stream is invalid"));
}

TEST_F(Decode, RefusesAStreamOutsideItsBuffer) {
  OrderedJson json = packed();
  json["bufferViews"][1]["extensions"][kStream]["byteOffset"] = 4000000000U;
  EXPECT_THAT(decode(json).error, HasSubstr("/bufferViews/1: it has no bytes for its stream"));
}

// The validator warns about doubtful values in a stream, which an encoder may have caused. Decoded
// they are errors, but the asset is not worse.
TEST(DecodedFindings, AreNotNewErrors) {
  container::test::TempFolder folder;
  test::AssetText asset;
  OrderedJson primitive = asset.grid();
  std::vector<std::int16_t> normals;
  for (int i = 0; i < 256; ++i) normals.insert(normals.end(), {16383, 0, 0, 0});
  const std::size_t view =
      asset.view(test::bytes_of(normals), {{"byteStride", 8}, {"target", 34962}});
  primitive["attributes"]["NORMAL"] =
      asset.accessor_at(view, 256, 5122, "VEC3", {{"normalized", true}});
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    asset.json[list].push_back("KHR_mesh_quantization");
  asset.mesh(primitive);
  const std::filesystem::path packed = folder.path() / "packed" / "a.gltf";
  ConvertOptions options = test::options_to(packed);
  options.compress = Compression::meshopt;
  ConvertReport report = convert_file(asset.write(folder).native(), options);
  ASSERT_TRUE(report.written) << report.error;
  options = test::options_to(folder.path() / "plain" / "a.gltf");
  options.compress = Compression::none;
  report = convert_file(packed.native(), options);
  EXPECT_TRUE(report.written) << report.error;
  ASSERT_THAT(report.new_warnings, testing::SizeIs(1));
  EXPECT_THAT(report.new_warnings[0], testing::HasSubstr("ACCESSOR_VECTOR3_NON_UNIT"));
}

}  // namespace
}  // namespace gltfx
