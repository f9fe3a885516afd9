// SPDX-License-Identifier: Apache-2.0
// Geometry is stored as Draco bitstreams and decoded again.
#include <cmath>
#include <map>
#include <numeric>

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
using test::step_of;
using test::StoredAsset;
using test::texts_of;
using test::view_bytes;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

class Draco : public testing::Test {
 protected:
  ConvertReport convert(const fs::path& from, const fs::path& to, Compression codec,
                        bool partial = false) {
    ConvertOptions options = test::options_to(to);
    options.compress = codec;
    options.partial = partial;
    return convert_file(from.native(), options);
  }
  OrderedJson converted(AssetText& asset) {
    report_ = convert(asset.write(folder_), output_, Compression::draco);
    EXPECT_TRUE(report_.written) << report_.error;
    return StoredAsset::at(output_).json();
  }
  // Decodes to plain accessors.
  OrderedJson decoded() {
    const ConvertReport report = convert(output_, plain_, Compression::none);
    EXPECT_TRUE(report.written) << report.error;
    return StoredAsset::at(plain_).json();
  }
  const ConvertStep& step() const { return step_of(report_, "draco"); }
  std::string refusal(AssetText& asset) {
    const std::string error = convert(asset.write(folder_), output_, Compression::draco).error;
    EXPECT_FALSE(fs::exists(output_));
    return error;
  }

  // Triangles of a plain primitive with float attributes. Each triangle starts at its least corner;
  // triangles are sorted.
  static std::vector<std::vector<std::vector<float>>> triangles(const fs::path& path,
                                                                const OrderedJson& primitive) {
    const OrderedJson json = StoredAsset::at(path).json();
    const auto views = view_bytes(path);
    std::vector<std::vector<float>> vertices;
    for (const auto& [name, index] : primitive["attributes"].items()) {
      const auto& accessor = json["accessors"][index.get<std::size_t>()];
      const std::size_t components = accessor["type"] == "VEC3" ? 3 : 2;
      vertices.resize(accessor["count"]);
      const std::size_t offset = accessor.value("byteOffset", 0U);
      for (std::size_t i = 0; i < vertices.size() * components; ++i) {
        float value = 0;
        std::memcpy(&value, &views[accessor["bufferView"]][offset + i * 4], 4);
        vertices[i / components].push_back(value);
      }
    }
    const auto& indices = json["accessors"][primitive["indices"].get<std::size_t>()];
    const std::size_t size = indices["componentType"] == 5123 ? 2 : 4;
    std::vector<std::vector<std::vector<float>>> list;
    for (std::size_t i = 0; i < indices["count"]; i += 3) {
      auto& corners = list.emplace_back();
      for (std::size_t k = i; k < i + 3; ++k) {
        std::uint32_t index = 0;
        std::memcpy(&index, &views[indices["bufferView"]][k * size], size);
        corners.push_back(vertices.at(index));
      }
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    }
    std::sort(list.begin(), list.end());
    return list;
  }

  TempFolder folder_;
  const fs::path input_ = folder_.path() / "a.gltf";
  const fs::path output_ = folder_.path() / "out" / "a.gltf";
  const fs::path plain_ = folder_.path() / "plain" / "a.gltf";
  ConvertReport report_;
};

OrderedJson primitive_of(const OrderedJson& json, std::size_t mesh = 0) {
  return json["meshes"][mesh]["primitives"][0];
}

TEST_F(Draco, KeepsTrianglesBitForBit) {
  AssetText asset;
  asset.mesh(asset.grid());
  const OrderedJson now = converted(asset);
  const OrderedJson primitive = primitive_of(now);
  EXPECT_EQ(primitive["attributes"], primitive_of(asset.json)["attributes"]);
  EXPECT_EQ(primitive["indices"], 2);
  EXPECT_EQ(primitive["extensions"][kDraco]["attributes"].dump(),
            R"({"POSITION":0,"TEXCOORD_0":1})");
  EXPECT_EQ(now["extensionsRequired"], OrderedJson::array({kDraco}));
  EXPECT_EQ(now["bufferViews"].size(), 1U);
  for (const auto& accessor : now["accessors"]) EXPECT_FALSE(accessor.contains("bufferView"));
  EXPECT_EQ(step().what, "1 of 1 primitive");
  EXPECT_LT(fs::file_size(output_.parent_path() / "b.bin"), asset.bytes.size() * 3 / 4);
  const OrderedJson plain = decoded();
  EXPECT_EQ(triangles(plain_, primitive_of(plain)), triangles(input_, primitive_of(asset.json)));
  EXPECT_FALSE(plain.contains("extensionsRequired"));
  EXPECT_FALSE(plain.contains("extensionsUsed"));
  EXPECT_FALSE(primitive_of(plain).contains("extensions"));
  EXPECT_EQ(plain["bufferViews"].size(), 3U);
  EXPECT_EQ(plain["accessors"][0]["min"], asset.json["accessors"][0]["min"]);
}

TEST_F(Draco, ChangesNothingTheSecondTime) {
  AssetText asset;
  asset.mesh(asset.grid());
  converted(asset);
  const fs::path again = folder_.path() / "again" / "a.gltf";
  const ConvertReport report = convert(output_, again, Compression::draco);
  EXPECT_FALSE(report.changes);
  EXPECT_EQ(content_of(again), content_of(output_));
  EXPECT_THAT(texts_of(step_of(report, "draco").left),
              ElementsAre("/meshes/0/primitives/0: it is already compressed"));
}

// Otherwise time would grow with the square of the number of primitives.
TEST_F(Draco, EncodesOnlyTheVerticesOfEachPrimitive) {
  AssetText asset;
  constexpr std::uint32_t kVertices = 60000, kCorners = 120;
  std::vector<float> positions;
  for (std::uint32_t i = 0; i < kVertices; ++i) {
    const auto x = static_cast<float>(i);
    positions.insert(positions.end(), {std::sin(x), std::cos(x * 2), x});
  }
  const std::size_t shared = asset.accessor(positions, 5126, "VEC3", 3);
  OrderedJson primitives = OrderedJson::array();
  for (std::uint32_t first = 0; first < kVertices; first += kCorners) {
    std::vector<std::uint32_t> indices(kCorners);
    std::iota(indices.begin(), indices.end(), first);
    primitives.push_back({{"attributes", {{"POSITION", shared}}},
                          {"indices", asset.accessor(indices, 5125, "SCALAR", 1)}});
  }
  asset.mesh(primitives[0]);
  asset.json["meshes"][0]["primitives"] = primitives;
  const OrderedJson now = converted(asset);
  EXPECT_EQ(step().what, "500 of 500 primitives");
  for (const auto& primitive : now["meshes"][0]["primitives"]) {
    const std::size_t position = primitive["attributes"]["POSITION"];
    ASSERT_LE(now["accessors"][position]["count"], kCorners);
  }
  const OrderedJson plain = decoded();
  for (const std::size_t i : {0U, 1U, 499U}) {
    EXPECT_EQ(triangles(plain_, plain["meshes"][0]["primitives"][i]),
              triangles(input_, primitives[i]));
  }
}

TEST_F(Draco, ConvertsAStripToAList) {
  AssetText asset;
  OrderedJson primitive = asset.grid();
  std::vector<std::uint16_t> strip;
  for (std::uint16_t row = 0; row < 15; ++row) {
    for (std::uint16_t x = 0; x < 16; ++x) {
      const auto low = static_cast<std::uint16_t>(row * 16 + x);
      const auto high = static_cast<std::uint16_t>(low + 16);
      if (x == 0 && row > 0) strip.push_back(low);
      strip.insert(strip.end(), {low, high});
      if (x == 15 && row < 14) strip.push_back(high);
    }
  }
  primitive["mode"] = 5;
  primitive["indices"] = asset.accessor(strip, 5123, "SCALAR", 1);
  asset.json["accessors"][2]["name"] = "of nobody";
  asset.mesh(primitive);
  const OrderedJson now = converted(asset);
  EXPECT_EQ(primitive_of(now)["mode"], 4);
  EXPECT_EQ(now["accessors"][3]["count"], 15 * 15 * 6);
}

TEST_F(Draco, AddsAnAccessorForMissingIndices) {
  AssetText asset;
  const Grid grid;
  std::vector<float> positions;
  for (const std::uint16_t index : grid.indices) {
    positions.insert(positions.end(), &grid.positions[index * 3U], &grid.positions[index * 3U] + 3);
  }
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] =
      asset.accessor(positions, 5126, "VEC3", 3, {{"min", {0, 0, -0.757}}, {"max", {1, 1, 1}}});
  asset.mesh(primitive);
  const OrderedJson now = converted(asset);
  const auto indices = primitive_of(now)["indices"].get<std::size_t>();
  EXPECT_EQ(now["accessors"][indices]["count"], grid.indices.size());
  EXPECT_EQ(now["accessors"][indices]["componentType"], 5123);
}

TEST_F(Draco, StoresEqualPrimitivesInOneBitstream) {
  AssetText asset;
  const OrderedJson primitive = asset.grid();
  asset.mesh(primitive);
  asset.mesh(primitive);
  const OrderedJson now = converted(asset);
  EXPECT_EQ(primitive_of(now, 0)["extensions"], primitive_of(now, 1)["extensions"]);
  EXPECT_EQ(now["bufferViews"].size(), 1U);
  EXPECT_EQ(now["accessors"].size(), 3U);
}

TEST_F(Draco, StoresSharedVerticesOfTwoMeshesInTwoBitstreams) {
  AssetText asset;
  const OrderedJson whole = asset.grid(Grid(32));
  OrderedJson half = whole;
  const Grid grid(32);
  half["indices"] =
      asset.accessor(std::vector<std::uint16_t>(grid.indices.begin(), grid.indices.begin() + 900),
                     5123, "SCALAR", 1);
  asset.mesh(whole);
  asset.mesh(half);
  const OrderedJson now = converted(asset);
  const auto positions = [&](std::size_t mesh) {
    return primitive_of(now, mesh)["attributes"]["POSITION"].get<std::size_t>();
  };
  ASSERT_TRUE(primitive_of(now, 1).contains("extensions"))
      << testing::PrintToString(texts_of(step().left));
  EXPECT_EQ(positions(0), 0U);
  EXPECT_EQ(positions(1), 4U);
  EXPECT_NE(now["accessors"][0]["count"], now["accessors"][4]["count"]);
  EXPECT_NE(now["accessors"][0]["max"], now["accessors"][4]["max"]);
  const OrderedJson plain = decoded();
  for (const std::size_t mesh : {0U, 1U}) {
    EXPECT_EQ(triangles(plain_, primitive_of(plain, mesh)),
              triangles(input_, primitive_of(asset.json, mesh)));
  }
}

TEST_F(Draco, LeavesUnsupportedPrimitives) {
  AssetText asset;
  asset.mesh(asset.grid());
  OrderedJson lines = asset.grid();
  lines["mode"] = 1;
  asset.mesh(lines);
  OrderedJson morphed = asset.grid();
  morphed["targets"] = OrderedJson::array({{{"POSITION", morphed["attributes"]["POSITION"]}}});
  asset.mesh(morphed);
  OrderedJson shares = asset.grid();
  shares["attributes"]["POSITION"] = morphed["attributes"]["POSITION"];
  asset.mesh(shares);
  OrderedJson twice = asset.grid();
  Grid collapsed;
  collapsed.indices[1] = collapsed.indices[0];
  twice["indices"] = asset.accessor(collapsed.indices, 5123, "SCALAR", 1);
  asset.mesh(twice);
  const OrderedJson now = converted(asset);
  EXPECT_THAT(texts_of(step().left),
              UnorderedElementsAre(
                  "/meshes/1/primitives/0: it has no triangles",
                  "/meshes/2/primitives/0: it has morph targets",
                  "/meshes/3/primitives/0: it shares /accessors/6 with /meshes/2/primitives/0",
                  "/meshes/4/primitives/0: Draco does not keep triangles that repeat a vertex"));
  EXPECT_TRUE(primitive_of(now, 0).contains("extensions"));
}

// One view loses the indices of the triangles and half of the positions.
TEST_F(Draco, ShrinksAViewThatLosesSomeAccessors) {
  AssetText asset;
  const Grid grid;
  const std::string points = test::bytes_of(grid.positions);
  const auto view = asset.view(points + points + "12345678" + points, {{"byteStride", 12}});
  const auto add = [&](std::size_t offset) {
    return asset.accessor_at(
        view, 256, 5126, "VEC3",
        {{"byteOffset", offset}, {"min", {0, 0, -0.7568025}}, {"max", {1, 1, 0.9996983}}});
  };
  OrderedJson triangles, dots, others;
  dots["attributes"]["POSITION"] = add(0);
  triangles["attributes"]["POSITION"] = add(points.size());
  others["attributes"]["POSITION"] = add(2 * points.size() + 8);
  triangles["indices"] = asset.accessor(grid.indices, 5123, "SCALAR", 1);
  dots["mode"] = others["mode"] = 0;
  for (const OrderedJson& each : {dots, triangles, others}) asset.mesh(each);
  for (const char* bound : {"min", "max"}) {
    for (auto& accessor : asset.json["accessors"]) accessor.erase(bound);
  }
  report_ = convert(asset.write(folder_), output_, Compression::draco, true);
  ASSERT_TRUE(report_.written) << report_.error;
  const OrderedJson now = StoredAsset::at(output_).json();
  EXPECT_EQ(step().what, "1 of 3 primitives");
  EXPECT_EQ(now["bufferViews"][view]["byteLength"], 2 * points.size());
  EXPECT_EQ(view_bytes(output_)[view], points + points);
  EXPECT_EQ(now["accessors"][2]["byteOffset"], points.size());
  EXPECT_EQ(now["bufferViews"].size(), 2U);
}

TEST_F(Draco, LeavesSmallPrimitives) {
  AssetText asset;
  asset.mesh(asset.grid(Grid(2)));
  converted(asset);
  EXPECT_FALSE(report_.changes);
  EXPECT_THAT(texts_of(step().left),
              ElementsAre("/meshes/0/primitives/0: its bitstream would not be smaller"));
}

TEST_F(Draco, KeepsIndicesInUnknownExtensionsValid) {
  AssetText asset;
  asset.mesh(asset.grid());
  const auto curve = asset.accessor(std::vector<float>(10, 3), 5126, "SCALAR", 1);
  asset.json["nodes"][0]["extensions"]["ACME_curve"] = {{"accessor", curve}};
  const OrderedJson now = converted(asset);
  EXPECT_EQ(now["nodes"], asset.json["nodes"]);
  EXPECT_EQ(view_bytes(output_)[now["accessors"][curve]["bufferView"]],
            test::bytes_of(std::vector<float>(10, 3)));
  // Views whose index may occur in the extension keep their index.
  EXPECT_EQ(now["bufferViews"].size(), 4U);
  EXPECT_THAT(texts_of(step().left),
              Contains(HasSubstr("/bufferViews/2: it is unused, but /nodes/0/extensions/"
                                 "ACME_curve may hold indices")));
  EXPECT_LT(fs::file_size(output_.parent_path() / "b.bin"), asset.bytes.size() * 3 / 4);
}

TEST_F(Draco, RefusesIfAnUnknownExtensionMayReferToAnAccessor) {
  AssetText asset;
  asset.mesh(asset.grid());
  asset.json["nodes"][0]["extensions"]["ACME_curve"] = {{"accessor", 1}};
  EXPECT_THAT(refusal(asset), HasSubstr("ACME_curve may hold the index of /accessors/1"));
}

TEST_F(Draco, RefusesNumbersInAnUnknownExtensionOfAPrimitive) {
  AssetText asset;
  OrderedJson primitive = asset.grid();
  primitive["extensions"]["ACME_outline"] = {{"vertices", {0.5, 7.5}}};
  asset.mesh(primitive);
  EXPECT_THAT(refusal(asset), HasSubstr("ACME_outline may hold data about its vertices"));
}

TEST_F(Draco, AllowsTextInAnUnknownExtensionOfAPrimitive) {
  AssetText asset;
  OrderedJson primitive = asset.grid();
  primitive["extensions"]["ACME_label"] = {{"text", "x"}};
  asset.mesh(primitive);
  const OrderedJson now = converted(asset);
  EXPECT_EQ(primitive_of(now)["extensions"]["ACME_label"]["text"], "x");
  EXPECT_TRUE(primitive_of(now)["extensions"].contains(kDraco));
}

TEST_F(Draco, RefusesBrokenData) {
  AssetText asset;
  asset.mesh(asset.grid());
  asset.json["accessors"][1]["count"] = 999999;
  EXPECT_THAT(refusal(asset), HasSubstr("/accessors/1 does not fit into its buffer view"));
}

TEST_F(Draco, RefusesAnInvalidBitstream) {
  AssetText asset;
  asset.mesh(asset.grid());
  converted(asset);
  std::string bytes = content_of(output_.parent_path() / "b.bin");
  bytes.replace(0, 5, "CARDO");
  folder_.write("out/b.bin", bytes);
  EXPECT_THAT(convert(output_, plain_, Compression::none).error,
              HasSubstr("/meshes/0/primitives/0: its bitstream cannot be decoded: "));
  EXPECT_FALSE(fs::exists(plain_));
}

TEST_F(Draco, CanBeReplacedByAnotherCodec) {
  AssetText asset;
  asset.mesh(asset.grid());
  converted(asset);
  const fs::path other = folder_.path() / "other" / "a.gltf";
  EXPECT_TRUE(convert(output_, other, Compression::meshopt).written);
  const OrderedJson now = StoredAsset::at(other).json();
  EXPECT_EQ(now["extensionsUsed"], OrderedJson::array({"EXT_meshopt_compression"}));
  const fs::path back = folder_.path() / "back" / "a.gltf";
  EXPECT_TRUE(convert(other, back, Compression::draco).written);
  EXPECT_EQ(StoredAsset::at(back).json()["extensionsUsed"], OrderedJson::array({kDraco}));
  EXPECT_EQ(StoredAsset::at(back).json()["buffers"].size(), 1U);
}

}  // namespace
}  // namespace gltfx
