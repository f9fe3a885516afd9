// SPDX-License-Identifier: Apache-2.0
// Unused objects are removed; all others stay.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "made_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ConvertOptions prune_options() {
  ConvertOptions options;
  options.prune = true;
  return options;
}

// A triangle in a scene; it uses accessor 0.
MadeAsset shown_triangle() {
  MadeAsset made;
  made.mesh({{"attributes",
              {{"POSITION", made.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", true)}}}});
  made.json["scenes"] = {{{"nodes", {0}}}};
  return made;
}

// Adds unused objects before all others.
MadeAsset with_unused_material() {
  MadeAsset made = shown_triangle();
  made.json["materials"] = {{{"name", "unused"}}, {{"name", "used"}}};
  made.json["meshes"][0]["primitives"][0]["material"] = 1;
  return made;
}

class Prune : public test::ConvertMade {
 protected:
  Prune() : ConvertMade(prune_options()) {}

  void expect_nothing_to_do(MadeAsset& made) {
    const ConvertStep row = row_of(made.glb());
    EXPECT_FALSE(row.changes) << row.what;
    EXPECT_THAT(row.refused, IsEmpty());
    EXPECT_EQ(row.what, "");
  }
  StoredAsset pruned_file(const std::string& text, const std::string& name = "a.gltf") {
    ConvertOptions options = options_;
    options.output = (folder_.path() / "out" / name).native();
    const ConvertReport report = convert_file(folder_.write(name, text).native(), options);
    EXPECT_TRUE(report.written) << report.error;
    row_ = report.steps.at(0);
    return StoredAsset::at(options.output);
  }
};

TEST_F(Prune, ChangesOnlyRemovedObjectsAndIndices) {
  const std::string before = R"({ "asset" : {"version": "2.0", "extras": {"n": 1.10}},
  "scenes" : [ {"nodes": [0]} ], "nodes": [{"mesh":1}],
  "meshes": [ {"primitives": [{"attributes": {"POSITION": 1}, "material": 0}]},
              {"primitives": [{"attributes": {"POSITION": 2}, "material": 2}], "name" : "kept"} ],
  "accessors": [ {"componentType": 5126, "type": "VEC3", "count": 3},
                 {"componentType": 5126, "type": "VEC3", "count": 3, "min":[0,0,0], "max":[0,0,0]},
                 {"componentType": 5126, "type": "VEC3", "count": 3, "min":[0,0,0], "max":[0,0,0]} ],
  "materials": [ {"name": "a"}, {"name": "b"}, {"name": "c", "alphaCutoff": 0.50, "alphaMode":"MASK"} ],
  "skins" : [{"joints": [0]}],
  "samplers": [{}], "textures": [{"sampler": 0, "source": 0}], "images": [{"uri": "gone.png"}] })";
  EXPECT_EQ(pruned_file(before).text, R"({ "asset" : {"version": "2.0", "extras": {"n": 1.10}},
  "scenes" : [ {"nodes": [0]} ], "nodes": [{"mesh":0}],
  "meshes": [ {"primitives": [{"attributes": {"POSITION": 0}, "material": 0}], "name" : "kept"} ],
  "accessors": [ {"componentType": 5126, "type": "VEC3", "count": 3, "min":[0,0,0], "max":[0,0,0]} ],
  "materials": [ {"name": "c", "alphaCutoff": 0.50, "alphaMode":"MASK"} ] })");
  EXPECT_EQ(row_.what, "9 objects");
  EXPECT_THAT(row_.left, IsEmpty());
}

TEST_F(Prune, RemovesBytesOfRemovedObjects) {
  MadeAsset made;
  made.accessor<float>(std::vector<float>(300, 7), "VEC3", true);
  made.mesh({{"attributes",
              {{"POSITION", made.accessor<float>({1, 2, 3, 4, 5, 6, 7, 8, 9}, "VEC3", true)}}}});
  made.json["scenes"] = {{{"nodes", {0}}}};
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(numbers_of(now, 0), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(now.json()["bufferViews"], SizeIs(1));
  EXPECT_LT(now.bin.size(), 48U);
  EXPECT_EQ(row_.what, "2 objects");
}

TEST_F(Prune, RemovesABufferWithoutUsersAndItsChunk) {
  MadeAsset made;
  made.accessor<float>({1, 2, 3}, "VEC3", true);
  made.json["nodes"] = {{{"name", "empty"}}};
  made.json["scenes"] = {{{"nodes", {0}}}};
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.text,
            R"({"asset":{"version":"2.0"},"nodes":[{"name":"empty"}],"scenes":[{"nodes":[0]}]})");
  EXPECT_FALSE(now.container.bin);
}

TEST_F(Prune, AddsAMissingLengthToABuffer) {
  MadeAsset made = shown_triangle();
  made.accessor<float>({1, 2, 3}, "VEC3");
  std::string glb = made.glb();
  const std::string member = R"("buffers":[{"byteLength")";
  const std::size_t at = glb.find(member);
  ASSERT_NE(at, std::string::npos);
  glb.replace(at, member.size(), R"("buffers":[{"byteLengtX")");
  const StoredAsset now = converted_twice(glb);
  EXPECT_EQ(now.json()["buffers"][0]["byteLength"], now.bin.size());
}

TEST_F(Prune, KeepsScenesNodesCamerasAndAnimations) {
  MadeAsset made = shown_triangle();
  made.json["nodes"].push_back({{"name", "of no scene"}});
  made.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  made.json["scenes"].push_back({{"name", "empty"}});
  const std::size_t input = made.accessor<float>({0, 1}, "SCALAR", true);
  const std::size_t output = made.accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3");
  made.json["animations"] = {
      {{"samplers", {{{"input", input}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"path", "translation"}}}}}}}};
  expect_nothing_to_do(made);
}

TEST_F(Prune, KeepsObjectsThatExtensionsReferTo) {
  MadeAsset made = shown_triangle();
  made.json["extensionsUsed"] = {"KHR_materials_variants", "KHR_texture_basisu",
                                 "KHR_materials_clearcoat"};
  made.json["images"] = {{{"uri", "a.ktx2"}, {"mimeType", "image/ktx2"}}};
  made.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  made.json["materials"] = {
      {{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 0}}}}}}}}};
  made.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "v"}}};
  made.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 0}, {"variants", {0}}}};
  expect_nothing_to_do(made);
}

TEST_F(Prune, KeepsObjectsThatAPointerRefersTo) {
  MadeAsset made = with_unused_material();
  made.json["extensionsUsed"] = {"KHR_animation_pointer"};
  const std::size_t input = made.accessor<float>({0, 1}, "SCALAR", true);
  const std::size_t output = made.accessor<float>({0, 1}, "SCALAR");
  const OrderedJson target{
      {"path", "pointer"},
      {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/1/alphaCutoff"}}}}}};
  made.json["materials"].push_back({{"name", "moved"}});
  made.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", target}}}}}};
  made.json["meshes"][0]["primitives"][0]["material"] = 2;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["materials"], SizeIs(2));
  EXPECT_THAT(now.text, HasSubstr("\"/materials/0/alphaCutoff\""));
}

TEST_F(Prune, RemovesObjectsThatReferOnlyToEachOther) {
  MadeAsset made = with_unused_material();
  made.json["extensionsUsed"] = {"MSFT_lod"};
  made.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {2};
  made.json["materials"].push_back({{"extensions", {{"MSFT_lod", {{"ids", {0}}}}}}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["materials"].dump(), R"([{"name":"used"}])");
  EXPECT_FALSE(now.json().contains("extensionsUsed"));
}

TEST_F(Prune, RemovesNamesOfExtensionsWithTheirLastObject) {
  MadeAsset made = with_unused_material();
  made.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_ior", "ACME_rules",
                                 "KHR_mesh_quantization"};
  made.json["materials"][0]["extensions"]["KHR_materials_unlit"] = OrderedJson::object();
  made.json["materials"][0]["extensions"]["KHR_materials_ior"] = OrderedJson::object();
  made.json["materials"][1]["extensions"]["KHR_materials_ior"]["ior"] = 1.25;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["extensionsUsed"],
              ElementsAre("KHR_materials_ior", "ACME_rules", "KHR_mesh_quantization"));
}

TEST_F(Prune, TreatsAnAssetWithoutScenesAsALibrary) {
  MadeAsset made = with_unused_material();
  made.json.erase("scenes");
  const std::size_t unused = made.accessor<float>({1, 2, 3}, "VEC3");
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["materials"], SizeIs(2));
  EXPECT_THAT(now.json()["accessors"], SizeIs(unused));
  ASSERT_THAT(row_.left, SizeIs(1));
  EXPECT_EQ(row_.left[0].pointer, "/materials");
  EXPECT_EQ(row_.left[0].reason, "without scenes, the asset is a library");
}

TEST_F(Prune, RefusesIfAnUnknownExtensionHasAnInteger) {
  MadeAsset made = with_unused_material();
  made.json["extensionsUsed"] = {"ACME_ref"};
  made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = {0.5, 1};
  expect_refused(made, "/nodes/0/extensions/ACME_ref",
                 "may hold indices (describe it with --schema)");
  options_.partial = true;
  const ConvertReport report = run(made.glb());
  EXPECT_TRUE(report.written);
  EXPECT_FALSE(report.steps[0].changes);
}

TEST_F(Prune, DoesNotRefuseIfNothingIsUnused) {
  MadeAsset made = shown_triangle();
  made.json["extensionsUsed"] = {"ACME_ref"};
  made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = 1;
  expect_nothing_to_do(made);
}

TEST_F(Prune, UpdatesExtensionsThatASchemaDescribes) {
  const schema::Compiled compiled = schema::compile_with({{"ref.json", R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "gltfx:ext/ACME_ref", "title": "ACME_ref", "description": "A curve.",
    "x-gltfx": {"extension": "ACME_ref", "on": ["node"], "status": "vendor",
                "spec": "https://example.com/"},
    "type": "object", "properties": {"curve": {"description": "Index of an accessor.",
      "type": "integer", "minimum": 0, "x-gltfx": {"ref": "accessors"}}}})",
                                                           true}});
  ASSERT_TRUE(compiled.set) << compiled.errors.at(0).message;
  options_.schemas = compiled.set;
  MadeAsset made = shown_triangle();
  made.accessor<float>({1, 2, 3}, "VEC3");
  made.json["extensionsUsed"] = {"ACME_ref"};
  made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] =
      made.accessor<float>({4, 5, 6}, "VEC3");
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["nodes"][0]["extensions"]["ACME_ref"]["curve"], 1);
  EXPECT_THAT(numbers_of(now, 1), ElementsAre(4, 5, 6));
}

TEST_F(Prune, AllowsUnknownExtensionsWithoutIntegersOrInRemovedObjects) {
  MadeAsset made = with_unused_material();
  made.json["extensionsUsed"] = {"ACME_ref", "ACME_words"};
  made.json["nodes"][0]["extensions"]["ACME_words"] = {{"curve", {0.5, 2.5}},
                                                       {"of", "/materials/1"}};
  made.json["materials"][0]["extensions"]["ACME_ref"]["texture"] = 0;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["materials"], SizeIs(1));
  EXPECT_EQ(now.json()["nodes"][0]["extensions"]["ACME_words"],
            made.json["nodes"][0]["extensions"]["ACME_words"]);
  EXPECT_THAT(now.json()["extensionsUsed"], ElementsAre("ACME_words"));
}

TEST_F(Prune, RefusesTheListOfAPointerThatIsSetAtRunTime) {
  MadeAsset made = with_unused_material();
  made.json["samplers"] = OrderedJson::array({OrderedJson::object()});
  made.json["extensionsUsed"] = {"KHR_interactivity"};
  made.json["extensions"]["KHR_interactivity"]["graphs"] = OrderedJson::array({OrderedJson::parse(
      R"({"types":[{"signature":"float"},{"signature":"ref"}],"declarations":[{"op":"pointer/get"}],
          "nodes":[{"declaration":0,"configuration":{"pointer":{"value":["/materials/{m}/alphaCutoff"]},
          "type":{"value":[1]}}}]})")});
  options_.partial = true;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_FALSE(now.json().contains("samplers"));
  EXPECT_THAT(now.json()["materials"], SizeIs(2));
  ASSERT_THAT(row_.refused, SizeIs(1));
  EXPECT_EQ(row_.refused[0].pointer, "/materials");
  EXPECT_THAT(row_.refused[0].reason, HasSubstr("is set at run time"));
}

TEST_F(Prune, RefusesMaterialsIfPropertiesFollowTheirOrder) {
  MadeAsset made = with_unused_material();
  made.json["extensionsUsed"] = {"VRM"};
  made.json["extensions"]["VRM"]["materialProperties"] = {{{"name", "unused"}}, {{"name", "used"}}};
  expect_refused(made, "/materials", "/extensions/VRM/materialProperties follows their order");
}

TEST_F(Prune, NotesExtrasThatMayBeIndices) {
  MadeAsset made = with_unused_material();
  made.json["nodes"][0]["extras"] = {{"materialIndex", 1}, {"speed", 3}, {"textures", {0, 1}}};
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["nodes"][0]["extras"]["materialIndex"], 1);
  const std::string glb = made.glb();
  ASSERT_THAT(row_.left, SizeIs(1));
  EXPECT_EQ(row_.left[0].pointer, "/nodes/0/extras/materialIndex");
  EXPECT_EQ(row_.left[0].reason, "may be an index, like 1 more in extras; it is not updated");
}

TEST_F(Prune, KeepsBrokenReferences) {
  for (
      const char* text : {
          R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,9]}],"nodes":[{"mesh":7}],"meshes":[{}]})",
          R"({"asset":{"version":"2.0"},"scenes":{},"materials":[1,2],"meshes":[[]],"images":[null,{}]})",
          R"({"asset":{"version":"2.0"},"scenes":[],"accessors":[{"bufferView":-1},{"sparse":{"indices":{"bufferView":0}}}],"bufferViews":[{"buffer":99}]})",
      }) {
    ConvertOptions options = options_;
    options.output = output().native();
    const ConvertReport report = convert_file(folder_.write("b.gltf", text).native(), options);
    EXPECT_TRUE(report.written || !report.error.empty()) << text;
  }
}

// Each texture has its own sampler: time does not grow with the square, and the stack is limited.
TEST_F(Prune, RemovesManyObjectsAtOnce) {
  MadeAsset made = shown_triangle();
  for (int i = 0; i < 20000; ++i) {
    made.json["samplers"].push_back(OrderedJson::object());
    made.json["textures"].push_back({{"sampler", i}});
  }
  made.json["materials"] = {{{"normalTexture", {{"index", 19999}}}}};
  made.json["meshes"][0]["primitives"][0]["material"] = 0;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["textures"].dump(), R"([{"sampler":0}])");
  EXPECT_EQ(row_.what, "39998 objects");
}

}  // namespace
}  // namespace gltfx
