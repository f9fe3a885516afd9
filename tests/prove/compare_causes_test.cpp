// SPDX-License-Identifier: Apache-2.0
/// One edit is one change at its place, also of data that many objects use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

CompareReport report_of(const EditedAsset& before, const EditedAsset& after) {
  CompareReport report;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), {}, report);
  return report;
}

std::string listed(const CompareReport& report) {
  std::string text(compare_level_name(report.level));
  for (const Change& change : report.changes) {
    text += "\n  " + std::string(change.kind) + " " + change.old_pointer.value_or("null") + " " +
            change.new_pointer.value_or("null") + ": " + change.what;
  }
  return text;
}

/// Three meshes of the same two triangles, with a material that has several members, and two clips
/// with the same times.
EditedAsset shared_asset() {
  const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,   // positions
                          0, 0, 1, 0, 0, 1, 1, 1,               // texture coordinates
                          0, 1, 0, 0, 0, 1, 2, 3, 3, 2, 1, 0};  // times and places
  const std::uint16_t indices[] = {0, 1, 2, 2, 1, 3};
  std::string bytes(sizeof(values) + sizeof(indices), '\0');
  std::memcpy(bytes.data(), values, sizeof(values));
  std::memcpy(bytes.data() + sizeof(values), indices, sizeof(indices));
  return EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
    "nodes": [{"name": "A", "mesh": 0}, {"name": "B", "mesh": 1}, {"name": "C", "mesh": 2}],
    "meshes": [
      {"name": "a", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 5,
                                    "material": 0}]},
      {"name": "b", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 5,
                                    "material": 1}]},
      {"name": "c", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 5,
                                    "material": 2}]}],
    "materials": [{"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1],
                                                           "roughnessFactor": 0.5}},
                  {"name": "Green"}, {"name": "Blue"}],
    "animations": [{"samplers": [{"input": 2, "output": 3}, {"input": 2, "output": 4}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                                 {"sampler": 1, "target": {"node": 1, "path": "scale"}}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC2"},
      {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 2, "type": "SCALAR",
       "min": [0], "max": [1]},
      {"bufferView": 0, "byteOffset": 88, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 100, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 128, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 140}]})",
                           bytes);
}

void put(EditedAsset& asset, std::size_t at, float value) {
  std::memcpy(asset.files["buffer0.bin"].data() + at, &value, sizeof(value));
}

/// Compares in both directions: one change, whose pointers are exchanged.
Change only_change(const EditedAsset& before, const EditedAsset& after) {
  const CompareReport report = report_of(before, after);
  const CompareReport back = report_of(after, before);
  EXPECT_THAT(report.changes, SizeIs(1)) << listed(report);
  EXPECT_THAT(back.changes, SizeIs(1)) << listed(back);
  EXPECT_EQ(report.level, back.level);
  if (report.changes.size() != 1 || back.changes.size() != 1) return {};
  EXPECT_EQ(report.changes[0].old_pointer, back.changes[0].new_pointer) << listed(back);
  EXPECT_EQ(report.changes[0].new_pointer, back.changes[0].old_pointer) << listed(back);
  return report.changes[0];
}

TEST(CompareCauses, DataOfSeveralMeshesIsOneChange) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  put(after, 12, 1.5F);
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "geometry.position");
  EXPECT_EQ(change.new_pointer, "/meshes/0/primitives/0/attributes/POSITION");
  EXPECT_THAT(change.also, ElementsAre("/meshes/1/primitives/0/attributes/POSITION",
                                       "/meshes/2/primitives/0/attributes/POSITION"));
}

TEST(CompareCauses, IndicesAreOneChange) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.files["buffer0.bin"][128 + 4] = 3;  // the last corner of the first triangle
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "geometry.elements");
  EXPECT_EQ(change.new_pointer, "/meshes/0/primitives/0/indices");
  EXPECT_THAT(change.what, HasSubstr("1 triangle connects other vertices"));
  EXPECT_EQ(change.level, CompareLevel::differs);
}

TEST(CompareCauses, TimesOfSeveralCurvesAreOneChange) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  put(after, 84, 2);
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "animation.shifted");
  EXPECT_EQ(change.new_pointer, "/animations/0/samplers/0/input");
  EXPECT_THAT(change.also, ElementsAre("/animations/0/samplers/1/input"));
}

TEST(CompareCauses, ABufferThatOneAssetCannotReadIsOneChange) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["buffers"][0]["byteLength"] = 5000;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.new_pointer, "/buffers/0");
  EXPECT_EQ(change.old_pointer, std::nullopt);
  EXPECT_EQ(change.what, "can be read in the old asset only");
}

TEST(CompareCauses, IndicesWithoutBytesTakeNoMemory) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["accessors"][5]["count"] = std::uint64_t{1} << 53U;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.new_pointer, "/accessors/5");
  EXPECT_EQ(change.what, "can be read in the old asset only");
}

TEST(CompareCauses, AListThatIsGoneIsOneChange) {
  const EditedAsset before = EditedAsset::made(R"({"asset": {"version": "2.0"},
    "textures": [{"source": 0}, {"source": 1}, {"source": 2}],
    "images": [{"name": "a", "uri": "data:,a"}, {"name": "b", "uri": "data:,b"},
               {"name": "c", "uri": "data:,c"}]})");
  EditedAsset after = before;
  after.json.erase("images");
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "image.removed");
  EXPECT_EQ(change.old_pointer, "/images");
  EXPECT_EQ(change.what, "all 3 objects of the list were removed: 'a', 'b', 'c'");
}

TEST(CompareCauses, ACollapsedTriangleIsTheSameChangeInBothDirections) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  put(after, 36, 0);  // the last vertex is where the third one is
  EXPECT_EQ(only_change(before, after).kind, "geometry.position");
}

TEST(CompareCauses, APrimitiveThatIsGoneIsTold) {
  EditedAsset before = shared_asset();
  Json& primitives = before.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["extras"] = {{"a", 1}};
  primitives[1]["extensions"] = {{"ACME_note", {{"b", 2}}}};
  EditedAsset after = before;
  after.json["meshes"][0]["primitives"].erase(1);
  const CompareReport report = report_of(before, after);
  ASSERT_THAT(report.changes, SizeIs(2)) << listed(report);
  EXPECT_EQ(report.changes[0].kind, "geometry.elements") << listed(report);
  EXPECT_EQ(report.changes[1].kind, "mesh.value") << listed(report);
  EXPECT_EQ(report.changes[1].old_pointer, "/meshes/0/primitives/1") << listed(report);
}

// More elements than keyframes: no reader knows which of them is the rotation.
TEST(CompareCauses, RotationsWithTooManyValuesAreNotRead) {
  EditedAsset before = shared_asset();
  before.json["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5126}, {"count", 2}, {"type", "VEC4"}});
  before.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
  before.json["animations"][0]["samplers"][0]["output"] = 6;
  EditedAsset after = before;
  after.json["accessors"][6]["count"] = 8;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "animation.curve");
  EXPECT_EQ(change.what, "has keyframes that can be read in one asset only");
}

TEST(CompareCauses, AScaleOfZeroDiffersInBothDirections) {
  EditedAsset before = shared_asset();
  before.json["nodes"].push_back({{"name", "Empty"}, {"scale", {1, 2, 1}}});
  before.json["scenes"][0]["nodes"].push_back(3);
  EditedAsset after = before;
  after.json["nodes"][3]["scale"][2] = 0;
  EXPECT_EQ(only_change(before, after).level, CompareLevel::differs);
}

TEST(CompareCauses, AModeThatMakesOtherElementsIsOneChange) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["meshes"][0]["primitives"][0]["mode"] = 1;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "geometry.elements");
  EXPECT_EQ(change.new_pointer, "/meshes/0/primitives/0/mode");
  EXPECT_EQ(change.what, "2 triangles became 2 lines");
}

TEST(CompareCauses, TellsAnAttributeWithOtherNumbersAtBothPlaces) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 0;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "geometry.attribute");
  EXPECT_EQ(change.old_pointer, "/meshes/0/primitives/0/attributes/TEXCOORD_0");
  EXPECT_EQ(change.new_pointer, change.old_pointer);
  EXPECT_EQ(change.what, "TEXCOORD_0 has 3 numbers a vertex, not 2");
}

// Readers of the bitstream get the same numbers, and the accessor tells them another type.
TEST(CompareCauses, TellsAnAccessorThatContradictsItsBitstream) {
  const EditedAsset before =
      EditedAsset::load(std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures/good/cobble.glb");
  EditedAsset after = before;
  after.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "mesh.value");
  EXPECT_EQ(change.new_pointer, "/meshes/0/primitives/0/attributes/TEXCOORD_1");
}

// The order in which members are compared is another one in each run.
TEST(CompareCauses, TellsTheWholeValueOfWhatWasRemoved) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["materials"][0].erase("pbrMetallicRoughness");
  const Change change = only_change(before, after);
  EXPECT_EQ(change.old_pointer, "/materials/0/pbrMetallicRoughness");
  EXPECT_EQ(change.before, R"({"baseColorFactor": [1, 0, 0, 1], "roughnessFactor": 0.5})");
}

TEST(CompareCauses, SaysAShortValueThatWasRemoved) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["materials"][0]["pbrMetallicRoughness"].erase("roughnessFactor");
  EXPECT_EQ(only_change(before, after).what, "roughnessFactor 0.5 was removed");
}

TEST(CompareCauses, TellsANodeThatASceneListsTwice) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["scenes"][0]["nodes"] = {0, 1, 2, 1};
  EXPECT_EQ(only_change(before, after).new_pointer, "/scenes/0/nodes");
}

TEST(CompareCauses, TellsABufferThatIsStatedTooShort) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["buffers"][0]["byteLength"] = 100;
  const Change change = only_change(before, after);
  EXPECT_EQ(change.kind, "stored.name");
  EXPECT_EQ(change.new_pointer, "/buffers/0/byteLength");
}

// An extension without a schema may use them.
TEST(CompareCauses, TellsElementsThatNothingKnownUses) {
  EditedAsset before = shared_asset();
  before.json["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
  before.json["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "SCALAR"}});
  EditedAsset after = before;
  after.json["accessors"][6]["byteOffset"] = 12;
  EXPECT_EQ(only_change(before, after).new_pointer, "/accessors/6");
  std::swap(after.json["accessors"][6], after.json["accessors"][7]);
  after.json["accessors"][7].erase("byteOffset");
  EXPECT_EQ(report_of(before, after).level, CompareLevel::storage);
}

TEST(CompareCauses, TellsPartsBesideAMatrix) {
  EditedAsset before = shared_asset();
  before.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
  EditedAsset after = before;
  after.json["nodes"][0]["scale"] = {2, 2, 2};
  EXPECT_EQ(only_change(before, after).new_pointer, "/nodes/0/scale");
}

TEST(CompareCauses, NamesWhatOnlyDescribesData) {
  const EditedAsset before = shared_asset();
  EditedAsset after = before;
  after.json["accessors"][0]["max"][0] = 2;
  after.json["asset"]["generator"] = "hand";
  const CompareReport report = report_of(before, after);
  EXPECT_EQ(report.level, CompareLevel::storage) << listed(report);
  EXPECT_THAT(report.changes, IsEmpty()) << listed(report);
  EXPECT_THAT(report.storage, Contains("/accessors/0/max describes data differently"));
  EXPECT_THAT(report.storage, Contains("/asset/generator is another one"));
}

}  // namespace
}  // namespace gltfx::prove
