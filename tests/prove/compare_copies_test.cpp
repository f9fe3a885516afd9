// SPDX-License-Identifier: Apache-2.0
/// Copies of a mesh at one node, attributes beside a bitstream, and names of what stores data.
#include <cstring>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using testing::IsEmpty;
using testing::SizeIs;

const std::filesystem::path kCopied = std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures" / "good";

CompareReport report_on(const EditedAsset& before, const EditedAsset& after,
                        const CompareOptions& options = {}) {
  CompareReport report;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), options, report);
  return report;
}

void change_floats(char* at, std::size_t count, float factor, float addend) {
  for (std::size_t i = 0; i < count; ++i) {
    float value = 0;
    std::memcpy(&value, at + i * sizeof value, sizeof value);
    value = value * factor + addend;
    std::memcpy(at + i * sizeof value, &value, sizeof value);
  }
}

/// Six posts, which one node draws.
class CompareCopies : public testing::Test {
 protected:
  EditedAsset before_ = EditedAsset::load(kCopied / "fence.gltf");
  EditedAsset after_ = before_;

  void shrink_mesh() {
    for (std::size_t i = 0; i < 24; ++i) change_floats(after_.element(0, i), 3, 0.5F, 0);
    for (const char* bound : {"min", "max"}) {
      for (Json& each : after_.json["accessors"][0][bound]) each = each.get<double>() / 2;
    }
  }
  void scale_copies() {
    std::string& bytes = after_.files.at("buffer0.bin");
    const std::size_t offset = bytes.size();
    bytes.resize(offset + 6 * 3 * sizeof(float), '\0');
    change_floats(bytes.data() + offset, 6 * 3, 0, 2);
    after_.json["buffers"][0]["byteLength"] = bytes.size();
    after_.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size() - offset}});
    after_.json["accessors"].push_back({{"bufferView", after_.json["bufferViews"].size() - 1},
                                        {"componentType", 5126},
                                        {"count", 6},
                                        {"type", "VEC3"}});
    after_.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        after_.json["accessors"].size() - 1;
  }
};

TEST_F(CompareCopies, UndoWhatHappenedToTheMesh) {
  shrink_mesh();
  scale_copies();
  const CompareReport report = report_on(before_, after_);
  EXPECT_LE(report.level, CompareLevel::bounds);
  EXPECT_THAT(report.unproven, IsEmpty());
  EXPECT_LE(report_on(after_, before_).level, CompareLevel::bounds);
}

TEST_F(CompareCopies, UndoNothingIfTheMeshStays) {
  scale_copies();
  const CompareReport report = report_on(before_, after_);
  ASSERT_THAT(report.changes, SizeIs(1));
  EXPECT_EQ(report.changes[0].new_pointer.value_or(""),
            "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE");
  EXPECT_THAT(report.changes[0].what, testing::StartsWith("6 of 6 copies moved by at most "));
}

TEST_F(CompareCopies, AreToldByHowFarTheyMoved) {
  change_floats(after_.element(3, 2), 1, 1, 1);
  const CompareReport report = report_on(before_, after_);
  ASSERT_THAT(report.changes, SizeIs(1));
  EXPECT_EQ(report.changes[0].kind, "node.value");
  EXPECT_EQ(report.changes[0].what, "1 of 6 copies moved by at most 1");
  EXPECT_EQ(report.level, CompareLevel::differs);
}

// The bound of positions is a part of the scene with all copies, of which the mesh is small.
TEST_F(CompareCopies, BelongToTheSizeOfTheScene) {
  change_floats(after_.element(0, 0), 1, 1, 2e-4F);
  EXPECT_EQ(report_on(before_, after_).level, CompareLevel::bounds);
}

// As optimizers do.
TEST_F(CompareCopies, MayBeDrawnByAnotherNode) {
  Json& nodes = after_.json["nodes"];
  nodes.push_back(nodes[0]);
  nodes[1].erase("name");
  nodes[0] = {{"name", "Posts"}};
  after_.json["scenes"][0]["nodes"] = {0, 1};
  CompareOptions drawn;
  drawn.drawn = true;
  EXPECT_EQ(report_on(before_, after_, drawn).level, CompareLevel::storage);
  EXPECT_EQ(report_on(before_, after_).level, CompareLevel::differs);
}

// Two primitives of one mesh with materials that are equal.
TEST_F(CompareCopies, PrimitivesOfEqualMaterialsMayBeJoined) {
  Json& primitives = before_.json["meshes"][0]["primitives"];
  before_.json["accessors"][2]["count"] = 18;
  before_.json["accessors"].push_back(before_.json["accessors"][2]);
  before_.json["accessors"].back()["byteOffset"] = 36;
  primitives.push_back(primitives[0]);
  primitives[1]["indices"] = before_.json["accessors"].size() - 1;
  primitives[1]["material"] = 1;
  before_.json["materials"].push_back(before_.json["materials"][0]);
  before_.json["materials"][1]["name"] = "Oak";
  CompareOptions drawn;
  drawn.drawn = true;
  EXPECT_EQ(report_on(before_, after_, drawn).level, CompareLevel::storage);
  EXPECT_EQ(report_on(after_, before_, drawn).level, CompareLevel::storage);
}

// Nothing lights it.
TEST_F(CompareCopies, NormalsOfAnUnlitMaterialAreNotDrawn) {
  before_.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
  before_.json["extensionsUsed"].push_back("KHR_materials_unlit");
  after_ = before_;
  after_.json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  CompareOptions drawn;
  drawn.drawn = true;
  EXPECT_EQ(report_on(before_, after_, drawn).level, CompareLevel::storage);
  EXPECT_EQ(report_on(before_, after_).level, CompareLevel::differs);
}

// Such an accessor has no bytes: its elements are zeros, as they are beside plain vertices.
TEST(CompareDraco, ReadsAttributesThatTheBitstreamLacks) {
  EditedAsset before = EditedAsset::load(kCopied / "bowl.glb");
  Json& primitive = before.json["meshes"][0]["primitives"][0];
  const std::size_t position = primitive["attributes"]["POSITION"];
  before.json["accessors"].push_back({{"componentType", 5126},
                                      {"count", before.json["accessors"][position]["count"]},
                                      {"type", "VEC3"}});
  primitive["attributes"]["_ZERO"] = before.json["accessors"].size() - 1;
  EditedAsset after = before;
  after.json["asset"]["generator"] = "another";
  const CompareReport report = report_on(before, after);
  EXPECT_THAT(report.unproven, IsEmpty());
  EXPECT_EQ(report.level, CompareLevel::storage);
}

TEST(CompareNames, GoWithTheViewsThatHaveThem) {
  EditedAsset before = EditedAsset::load(kCopied / "fence.gltf");
  EditedAsset after = before;
  before.json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 4}, {"name", "spare"}});
  EXPECT_EQ(report_on(before, after).level, CompareLevel::storage);
  EXPECT_EQ(report_on(after, before).level, CompareLevel::storage);
  after.json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 4}, {"name", "other"}});
  const CompareReport renamed = report_on(before, after);
  ASSERT_THAT(renamed.changes, SizeIs(1));
  EXPECT_EQ(renamed.changes[0].kind, "stored.name");
}

}  // namespace
}  // namespace gltfx::prove
