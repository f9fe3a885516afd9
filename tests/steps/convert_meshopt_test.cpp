// SPDX-License-Identifier: Apache-2.0
// Buffer views are stored as meshoptimizer streams.
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
using test::texts_of;
using test::view_bytes;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kExtension = "EXT_meshopt_compression";

class Meshopt : public testing::Test {
 protected:
  ConvertOptions options(const fs::path& output) const {
    ConvertOptions options = test::options_to(output);
    options.compress = Compression::meshopt;
    return options;
  }
  const ConvertStep& step() const { return test::step_of(report_, "meshopt"); }
  // The container does not change.
  StoredAsset converted(AssetText& asset) {
    report_ = convert_file(asset.write(folder_).native(), options(output_));
    EXPECT_TRUE(report_.written) << report_.error;
    return StoredAsset::at(output_);
  }
  OrderedJson stream_of(const StoredAsset& asset, std::size_t view) {
    return asset.json()["bufferViews"][view].value(
        "/extensions/EXT_meshopt_compression"_json_pointer, OrderedJson());
  }

  TempFolder folder_;
  const fs::path output_ = folder_.path() / "out" / "a.gltf";
  ConvertReport report_;
};

TEST_F(Meshopt, KeepsViewsBitForBitAndTheirIndices) {
  AssetText asset;
  asset.mesh(asset.grid());
  const StoredAsset now = converted(asset);
  EXPECT_EQ(view_bytes(output_), view_bytes(folder_.path() / "a.gltf"));
  EXPECT_EQ(stream_of(now, 0)["mode"], "ATTRIBUTES");
  EXPECT_EQ(stream_of(now, 0)["byteStride"], 12);
  EXPECT_EQ(stream_of(now, 0)["count"], 256);
  EXPECT_EQ(stream_of(now, 2)["mode"], "INDICES");
  EXPECT_EQ(stream_of(now, 2)["byteStride"], 2);
  EXPECT_LT(fs::file_size(folder_.path() / "out" / "b.bin"), asset.bytes.size() * 3 / 4);
  EXPECT_EQ(step().what, "3 of 3 buffer views");
  EXPECT_THAT(step().losses, IsEmpty());
  EXPECT_THAT(step().left, IsEmpty());
}

TEST_F(Meshopt, DescribesPlainBytesInABufferWithoutData) {
  AssetText asset;
  asset.mesh(asset.grid());
  const OrderedJson now = converted(asset).json();
  EXPECT_EQ(now["extensionsUsed"], OrderedJson::array({kExtension}));
  EXPECT_EQ(now["extensionsRequired"], OrderedJson::array({kExtension}));
  ASSERT_EQ(now["buffers"].size(), 2U);
  EXPECT_FALSE(now["buffers"][1].contains("uri"));
  EXPECT_EQ(now["buffers"][1]["extensions"][kExtension]["fallback"], true);
  std::size_t end = 0;
  for (const auto& view : now["bufferViews"]) {
    EXPECT_EQ(view["buffer"], 1);
    EXPECT_EQ(view["extensions"][kExtension]["buffer"], 0);
    EXPECT_GE(view["byteOffset"], end);
    end = view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
  }
  EXPECT_EQ(now["buffers"][1]["byteLength"], (end + 7) / 8 * 8);
}

TEST_F(Meshopt, ChangesNoOtherText) {
  AssetText asset;
  asset.mesh(asset.grid());
  OrderedJson before = OrderedJson::parse(asset.text());
  OrderedJson now = converted(asset).json();
  for (OrderedJson* json : {&before, &now}) {
    for (const char* member : {"buffers", "extensionsUsed", "extensionsRequired"}) {
      json->erase(member);
    }
    for (auto& view : (*json)["bufferViews"]) {
      for (const char* member : {"buffer", "byteOffset", "extensions"}) view.erase(member);
    }
  }
  EXPECT_EQ(before, now);
}

TEST_F(Meshopt, ChangesNothingTheSecondTime) {
  AssetText asset;
  asset.mesh(asset.grid());
  converted(asset);
  const fs::path again = folder_.path() / "again" / "a.gltf";
  const ConvertReport report = convert_file(output_.native(), options(again));
  EXPECT_FALSE(report.changes);
  EXPECT_EQ(content_of(again), content_of(output_));
  EXPECT_THAT(texts_of(test::step_of(report, "meshopt").left),
              Contains("/bufferViews/0: it is already compressed"));
}

// The assets free different bytes of their buffer, so that each needs a file of its own.
TEST_F(Meshopt, KeepsAssetsApartThatShareABuffer) {
  AssetText asset;
  asset.mesh(asset.grid());
  const fs::path one = asset.write(folder_);
  OrderedJson points = OrderedJson::parse(asset.text());
  points["meshes"][0]["primitives"][0].erase("indices");
  points["meshes"][0]["primitives"][0]["mode"] = 0;
  points["accessors"].erase(2);
  points["bufferViews"].erase(2);
  const fs::path other = folder_.write("other.gltf", points.dump());
  const fs::path out = folder_.path() / "out";
  for (const unsigned jobs : {1U, 4U}) {
    ConvertOptions options;
    options.compress = Compression::meshopt;
    options.shared_folder = true;
    convert_files({{one.native(), out / "a.gltf"}, {other.native(), out / "other.gltf"}}, options,
                  jobs, [](ConvertReport&& report) {
                    EXPECT_TRUE(report.written) << report.path << ": " << report.error;
                  });
    EXPECT_EQ(view_bytes(out / "a.gltf"), view_bytes(one));
    EXPECT_EQ(view_bytes(out / "other.gltf"), view_bytes(other));
    fs::remove_all(out);
  }
}

TEST_F(Meshopt, LeavesTheBufferOfTheSourceInItsFolder) {
  AssetText asset;
  asset.mesh(asset.grid());
  const fs::path source = asset.write(folder_);
  const auto before = view_bytes(source);
  const ConvertReport report =
      convert_file(source.native(), options(folder_.path() / "beside.gltf"));
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_EQ(content_of(folder_.path() / "b.bin"), asset.bytes);
  EXPECT_EQ(view_bytes(folder_.path() / "beside.gltf"), before);
}

TEST_F(Meshopt, KeepsTheStrideOfInterleavedVertices) {
  AssetText asset;
  const Grid grid;
  std::string bytes;
  for (std::size_t i = 0; i < grid.texcoords.size() / 2; ++i) {
    bytes += test::bytes_of(std::vector<float>(&grid.positions[i * 3], &grid.positions[i * 3] + 3));
    bytes += test::bytes_of(std::vector<float>(&grid.texcoords[i * 2], &grid.texcoords[i * 2] + 2));
  }
  const auto view = asset.view(bytes, {{"byteStride", 20}});
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] =
      asset.accessor_at(view, 256, 5126, "VEC3", {{"min", {0, 0, -1}}, {"max", {1, 1, 1}}});
  primitive["attributes"]["TEXCOORD_0"] =
      asset.accessor_at(view, 256, 5126, "VEC2", {{"byteOffset", 12}});
  asset.mesh(primitive);
  const StoredAsset now = converted(asset);
  EXPECT_EQ(stream_of(now, 0)["byteStride"], 20);
  EXPECT_EQ(view_bytes(output_), view_bytes(folder_.path() / "a.gltf"));
}

// The last vertex of an interleaved view may be incomplete.
TEST_F(Meshopt, PadsAnIncompleteLastElementWithZeros) {
  AssetText asset;
  std::vector<float> values(256 * 5 - 2, 0.5F);
  const auto view = asset.view(test::bytes_of(values), {{"byteStride", 20}});
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] = asset.accessor_at(
      view, 256, 5126, "VEC3", {{"min", {0.5, 0.5, 0.5}}, {"max", {0.5, 0.5, 0.5}}});
  asset.mesh(primitive);
  const StoredAsset now = converted(asset);
  EXPECT_EQ(now.json()["bufferViews"][0]["byteLength"], 256 * 20);
  EXPECT_EQ(view_bytes(output_)[0], test::bytes_of(values) + std::string(8, '\0'));
}

TEST_F(Meshopt, StoresAViewOfManyKeyframesInOneStream) {
  AssetText asset;
  asset.mesh(asset.grid());
  std::vector<float> keys;
  for (int i = 0; i < 100; ++i) keys.push_back(static_cast<float>(i) * 0.25F);
  std::vector<float> values(300, 2);
  auto all = keys;
  all.insert(all.end(), values.begin(), values.end());
  const auto view = asset.view(test::bytes_of(all));
  const auto input = asset.accessor_at(view, 100, 5126, "SCALAR", {{"min", {0}}, {"max", {24.75}}});
  const auto output = asset.accessor_at(view, 100, 5126, "VEC3", {{"byteOffset", 400}});
  asset.json["animations"] = OrderedJson::array(
      {{{"samplers", {{{"input", input}, {"output", output}}}},
        {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}});
  const StoredAsset now = converted(asset);
  EXPECT_EQ(stream_of(now, view)["mode"], "ATTRIBUTES");
  EXPECT_EQ(view_bytes(output_)[view], test::bytes_of(all));
}

TEST_F(Meshopt, UsesTriangleModeAfterReorder) {
  AssetText asset;
  asset.mesh(asset.grid());
  ConvertOptions more = options(output_);
  more.reorder = true;
  report_ = convert_file(asset.write(folder_).native(), more);
  ASSERT_TRUE(report_.written) << report_.error;
  EXPECT_EQ(stream_of(StoredAsset::at(output_), 2)["mode"], "TRIANGLES");
}

TEST_F(Meshopt, DoesNotUseTriangleModeForLines) {
  AssetText asset;
  OrderedJson primitive = asset.grid();
  primitive["mode"] = 1;
  asset.mesh(primitive);
  ConvertOptions more = options(output_);
  more.reorder = true;
  report_ = convert_file(asset.write(folder_).native(), more);
  ASSERT_TRUE(report_.written) << report_.error;
  EXPECT_EQ(stream_of(StoredAsset::at(output_), 2)["mode"], "INDICES");
}

TEST_F(Meshopt, LeavesDataThatIsNotGeometry) {
  AssetText asset;
  asset.mesh(asset.grid());
  const auto image = asset.view(test::picture(std::string(500, 'x')));
  asset.json["images"] = OrderedJson::array({{{"bufferView", image}, {"mimeType", "image/png"}}});
  const auto unused = asset.accessor(std::vector<float>(200), 5126, "SCALAR", 1);
  const auto places = asset.view(test::bytes_of(std::vector<std::uint16_t>{1, 2}));
  const auto values = asset.view(test::bytes_of(std::vector<float>{1, 2, 3, 4}));
  asset.json["accessors"][1]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", places}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  converted(asset);
  EXPECT_THAT(texts_of(step().left),
              ElementsAre("/bufferViews/3: it is an image",
                          fmt::format("/bufferViews/4: no known object uses /accessors/{}", unused),
                          "/bufferViews/5: /accessors/1/sparse/indices uses it",
                          "/bufferViews/6: /accessors/1/sparse/values uses it"));
  EXPECT_EQ(view_bytes(output_), view_bytes(folder_.path() / "a.gltf"));
}

TEST_F(Meshopt, LeavesNoise) {
  AssetText asset;
  std::vector<std::uint32_t> noise;
  for (std::uint32_t i = 1, x = 7; i <= 600; ++i) noise.push_back(x = x * 1664525U + 1013904223U);
  for (auto& each : noise) each = (each & 0x807fffffU) | 0x3f000000U;
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] =
      asset.accessor(noise, 5126, "VEC3", 3, {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}});
  asset.mesh(primitive);
  const StoredAsset now = converted(asset);
  EXPECT_FALSE(report_.changes);
  EXPECT_FALSE(now.json().contains("extensionsUsed"));
  EXPECT_THAT(texts_of(step().left), ElementsAre(HasSubstr("would not be smaller")));
}

TEST_F(Meshopt, LeavesAViewWithExtensions) {
  AssetText asset;
  asset.mesh(asset.grid());
  asset.json["bufferViews"][0]["extensions"]["ACME_view"] = {{"label", "x"}};
  asset.json["extensionsUsed"] = OrderedJson::array({"ACME_view"});
  const OrderedJson now = converted(asset).json();
  EXPECT_THAT(texts_of(step().left), ElementsAre("/bufferViews/0: it has extensions"));
  EXPECT_EQ(now["extensionsUsed"], OrderedJson::array({"ACME_view", kExtension}));
}

TEST_F(Meshopt, LeavesEverythingIfAnOffsetIsUnknown) {
  AssetText asset;
  asset.mesh(asset.grid());
  asset.json["nodes"][0]["extensions"]["ACME_bytes"] = {{"byteOffset", 4}};
  converted(asset);
  EXPECT_FALSE(report_.changes);
  EXPECT_THAT(texts_of(step().left),
              ElementsAre(HasSubstr("/nodes/0/extensions/ACME_bytes: it may hold an offset")));
}

TEST_F(Meshopt, RefusesBrokenData) {
  AssetText asset;
  asset.mesh(asset.grid());
  asset.json["accessors"][0]["count"] = 1000000;
  const std::string path = asset.write(folder_).native();
  EXPECT_THAT(convert_file(path, options(output_)).error,
              HasSubstr("/bufferViews/0: /accessors/0 does not fit into it"));
  EXPECT_FALSE(fs::exists(output_));
  asset.json["accessors"][0]["count"] = 256;
  asset.json["bufferViews"][1]["byteOffset"] = 4000000000U;
  EXPECT_THAT(convert_file(asset.write(folder_).native(), options(output_)).error,
              HasSubstr("/bufferViews/1: its bytes are missing"));
}

TEST_F(Meshopt, DoesNotDependOnTheNumberOfThreads) {
  AssetText asset;
  for (unsigned side = 4; side < 20; ++side) asset.mesh(asset.grid(Grid(side)));
  converted(asset);
  const std::string one = content_of(output_) + content_of(folder_.path() / "out" / "b.bin");
  ConvertOptions more = options(folder_.path() / "more" / "a.gltf");
  more.jobs = 4;
  EXPECT_TRUE(convert_file((folder_.path() / "a.gltf").native(), more).written);
  EXPECT_EQ(content_of(more.output) + content_of(folder_.path() / "more" / "b.bin"), one);
}

}  // namespace
}  // namespace gltfx
