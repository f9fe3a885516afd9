// SPDX-License-Identifier: Apache-2.0
// Equal objects are merged; different ones are not.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::picture;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ConvertOptions dedup_options() {
  ConvertOptions options;
  options.dedup = true;
  return options;
}

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

// Two meshes of one primitive each, with equal positions: accessors 0 and 1.
MadeAsset twice() {
  MadeAsset made;
  for (int i = 0; i < 2; ++i) {
    made.mesh({{"attributes", {{"POSITION", made.accessor(kTriangle, "VEC3", true)}}}});
  }
  made.json["scenes"] = {{{"nodes", {0, 1}}}};
  return made;
}

OrderedJson position_of(const StoredAsset& asset, std::size_t mesh) {
  return asset.json()["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"];
}

class Dedup : public test::ConvertMade {
 protected:
  Dedup() : ConvertMade(dedup_options()) {}

  void expect_apart(MadeAsset& made, const std::string& why) {
    const ConvertReport report = run(made.glb());
    ASSERT_FALSE(report.steps.empty()) << report.error;
    EXPECT_FALSE(report.steps[0].changes) << why << ": " << report.steps[0].what;
    EXPECT_THAT(report.steps[0].refused, IsEmpty()) << why;
  }
  // Converts a text with files that exist in the folder.
  StoredAsset merged(const std::string& text) {
    ConvertOptions options = options_;
    options.output = (folder_.path() / "out" / "a.gltf").native();
    const ConvertReport report = convert_file(folder_.write("a.gltf", text).native(), options);
    EXPECT_TRUE(report.written) << report.error;
    row_ = report.steps.at(0);
    return StoredAsset::at(options.output);
  }
};

TEST_F(Dedup, SetsReferencesToTheFirstObject) {
  MadeAsset made = twice();
  made.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      made.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(row_.what, "1 accessor, 1 buffer view");
  EXPECT_THAT(row_.losses, IsEmpty());
  EXPECT_EQ(position_of(now, 0), 0);
  EXPECT_EQ(position_of(now, 1), 0);
  EXPECT_EQ(now.json()["meshes"][0]["primitives"][0]["attributes"]["NORMAL"], 1);
  EXPECT_THAT(now.json()["meshes"], SizeIs(2));
  EXPECT_THAT(numbers_of(now, 1), ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1));
  EXPECT_LE(now.bin.size(), 88U);
}

TEST_F(Dedup, ChangesOnlyRemovedObjectsAndIndices) {
  const StoredAsset now = merged(R"({ "asset" : {"version": "2.0"},
  "samplers" : [ {"wrapS" : 33071}, {"wrapS": 10497, "name": "s"}, { "wrapS":33071 } ],
  "textures": [ {"sampler": 0, "name" : "t"}, {"sampler": 2, "name": "t"}, {"sampler": 1} ],
  "materials": [ {"normalTexture": {"index": 1, "scale": 0.50}, "extras": {"n": [1, 2.0]}},
                 {"normalTexture": {"scale": 0.50, "index": 0}, "extras": {"n": [1, 2]}},
                 {"normalTexture": {"index": 2}} ] })");
  EXPECT_EQ(now.text, R"({ "asset" : {"version": "2.0"},
  "samplers" : [ {"wrapS" : 33071}, {"wrapS": 10497, "name": "s"} ],
  "textures": [ {"sampler": 0, "name" : "t"}, {"sampler": 1} ],
  "materials": [ {"normalTexture": {"index": 0, "scale": 0.50}, "extras": {"n": [1, 2.0]}},
                 {"normalTexture": {"index": 1}} ] })");
  EXPECT_EQ(row_.what, "1 sampler, 1 texture, 1 material");
}

TEST_F(Dedup, KeepsDifferentAccessors) {
  for (const char* patch : {
           R"({"name": "b"})",
           R"({"extras": {"a": 1}})",
           R"({"max": [1, 1, 0.5]})",
           R"({"componentType": 5125})",
           R"({"normalized": true, "componentType": 5121})",
           R"({"count": 2})",
           R"({"type": "SCALAR", "min": [0], "max": [1]})",
           R"({"unknown": 0})",
       }) {
    MadeAsset made = twice();
    made.json["accessors"][1].merge_patch(OrderedJson::parse(patch));
    expect_apart(made, patch);
  }
  MadeAsset values = twice();
  values.accessor<float>({0, 0, 0, 1, 0, 0, -0.F, 1, 0}, "VEC3", true);
  values.json["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 2;
  values.json["accessors"].erase(1);
  values.json["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 1;
  values.json["bufferViews"].erase(1);
  values.json["accessors"][1]["bufferView"] = 1;
  expect_apart(values, "the sign of a zero");
}

TEST_F(Dedup, KeepsAccessorsOfDifferentUses) {
  MadeAsset made;
  const std::size_t indices = made.accessor<std::uint16_t>({0, 1, 2, 0}, "SCALAR");
  const std::size_t ids = made.accessor<std::uint16_t>({0, 1, 2, 0}, "SCALAR");
  made.json["accessors"][ids]["count"] = 3;
  made.json["accessors"][indices]["count"] = 3;
  made.mesh({{"attributes", {{"POSITION", made.accessor(kTriangle, "VEC3", true)}, {"_ID", ids}}},
             {"indices", indices}});
  expect_apart(made, "indices and vertices");
}

TEST_F(Dedup, ComparesElementsNotTheirStorage) {
  MadeAsset made = twice();
  // The second set of positions, interleaved with other data.
  const std::size_t mixed =
      made.accessor<float>({0, 0, 0, 5, 5, 5, 1, 0, 0, 5, 5, 5, 0, 1, 0, 5, 5, 5}, "VEC3");
  made.json["bufferViews"][mixed]["byteStride"] = 24;
  OrderedJson positions = made.json["accessors"][1];
  positions["bufferView"] = mixed;
  made.json["accessors"][mixed] = positions;
  positions["byteOffset"] = 12;
  positions["min"] = {5, 5, 5};
  positions["max"] = {5, 5, 5};
  made.json["accessors"].push_back(positions);
  made.mesh({{"attributes", {{"POSITION", mixed}}}});
  made.mesh({{"attributes", {{"POSITION", mixed + 1}}}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(row_.what, "2 accessors, 1 buffer view");
  EXPECT_EQ(position_of(now, 2), 0);
  EXPECT_THAT(numbers_of(now, position_of(now, 3)), ElementsAre(5, 5, 5, 5, 5, 5, 5, 5, 5));
}

TEST_F(Dedup, MergesSparseAccessorsOfEqualViews) {
  MadeAsset made = twice();
  for (int i = 0; i < 2; ++i) {
    const std::size_t at = made.accessor<std::uint8_t>({2}, "SCALAR");
    const std::size_t values = made.accessor<float>({0, 3, 0}, "VEC3");
    made.json["accessors"].erase(made.json["accessors"].size() - 1);
    made.json["accessors"].erase(made.json["accessors"].size() - 1);
    OrderedJson& accessor = made.json["accessors"][static_cast<std::size_t>(i)];
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                          {"values", {{"bufferView", 2 * i + 3}}}};
    accessor["sparse"]["indices"]["bufferView"] = 2 * i + 2;
    accessor["max"] = {1, 3, 0};
    static_cast<void>(values);
  }
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["accessors"], SizeIs(1));
  EXPECT_EQ(row_.what, "1 accessor, 3 buffer views");
  // A single different value prevents the merge.
  made.json["accessors"][1]["sparse"]["values"]["bufferView"] = 0;
  made.json["accessors"][1]["max"] = {1, 1, 0};
  EXPECT_THAT(row_of(made.glb()).what, Not(HasSubstr("accessor")));
}

TEST_F(Dedup, KeepsViewsWithoutAStrideForDifferentAttributes) {
  MadeAsset made = twice();
  made.json["accessors"][1]["name"] = "other";
  expect_apart(made, "vertex attributes that share a view need its stride");
  for (auto& view : made.json["bufferViews"]) view["byteStride"] = 12;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(row_.what, "1 buffer view");
  EXPECT_EQ(now.json()["accessors"][1]["bufferView"], 0);
}

TEST_F(Dedup, KeepsViewsOfDifferentTargets) {
  MadeAsset made = twice();
  for (auto& view : made.json["bufferViews"]) view["byteStride"] = 12;
  made.json["accessors"][1]["name"] = "other";
  made.json["bufferViews"][0]["target"] = 34962;
  expect_apart(made, "target");
}

TEST_F(Dedup, MergesImagesAndListsLostNames) {
  folder_.write("one.png", picture("leaf"));
  folder_.write("two.png", picture("leaf"));
  folder_.write("three.png", picture("twig"));
  const StoredAsset now = merged(R"({"asset": {"version": "2.0"},
  "images": [{"uri": "one.png", "name": "one"}, {"uri": "three.png"},
             {"uri": "two.png", "name": "two", "mimeType": "image/png"}, {"uri": "one.png"}],
  "textures": [{"source": 0, "name": "a"}, {"source": 2, "name": "b"}, {"source": 1}]})");
  EXPECT_EQ(now.json()["images"].dump(), R"([{"uri":"one.png","name":"one"},{"uri":"three.png"}])");
  EXPECT_EQ(now.json()["textures"].dump(),
            R"([{"source":0,"name":"a"},{"source":0,"name":"b"},{"source":1}])");
  EXPECT_EQ(row_.what, "2 images");
  ASSERT_THAT(row_.losses, SizeIs(1));
  EXPECT_EQ(row_.losses[0].quantity, "the name of /images/2");
}

TEST_F(Dedup, KeepsImagesOfDifferentExtrasAndTypes) {
  folder_.write("one.png", picture("leaf"));
  folder_.write("two.png", picture("leaf"));
  for (const char* more : {R"("extras": 1)", R"("mimeType": "image/jpeg")", R"("x": {})"}) {
    const StoredAsset now = merged(fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "images": [{{"uri": "one.png", "mimeType": "image/png"}},
           {{"uri": "two.png", {}}}], "textures": [{{"source": 0}}, {{"source": 1}}]}})",
        more));
    EXPECT_THAT(now.json()["images"], SizeIs(2)) << more;
  }
}

TEST_F(Dedup, KeepsAnImageOfColorsApartFromOneOfData) {
  folder_.write("one.png", picture("leaf"));
  const auto text = [](const char* slot) {
    return fmt::format(R"({{"asset": {{"version": "2.0"}}, "images": [{{"uri": "one.png"}},
        {{"uri": "one.png"}}], "textures": [{{"source": 0}}, {{"source": 1}}],
        "materials": [{{"name": "a", "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}},
                       "{}": {{"index": 1}}}}]}})",
                       slot);
  };
  EXPECT_THAT(merged(text("occlusionTexture")).json()["images"], SizeIs(2));
  EXPECT_THAT(merged(text("normalTexture")).json()["images"], SizeIs(2));
  EXPECT_THAT(merged(text("emissiveTexture")).json()["images"], SizeIs(1));
}

TEST_F(Dedup, DoesNotCopyAFileThatLostItsReferences) {
  const std::string triangle(36, '\1');
  folder_.write("one.bin", triangle);
  folder_.write("two.bin", triangle);
  const StoredAsset now = merged(R"({"asset": {"version": "2.0"},
  "buffers": [{"uri": "one.bin", "byteLength": 36}, {"uri": "two.bin", "byteLength": 36}],
  "bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 12, "target": 34962},
                  {"buffer": 1, "byteLength": 36, "byteStride": 12, "target": 34962}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 1}}]}]})");
  EXPECT_THAT(now.json()["buffers"], SizeIs(1));
  const auto out = folder_.path() / "out";
  EXPECT_TRUE(std::filesystem::exists(out / "one.bin"));
  EXPECT_FALSE(std::filesystem::exists(out / "two.bin"));
}

TEST_F(Dedup, RemovesTheViewAndBufferOfTheLastImageInAChunk) {
  folder_.write("leaf.png", picture("leaf"));
  const std::string png = picture("leaf");
  const std::string text = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"images":[{{"uri":"leaf.png"}},{{"bufferView":0,"mimeType":"image/png"}}],)"
      R"("textures":[{{"source":0,"name":"a"}},{{"source":1}}],"bufferViews":[{{"buffer":0,"byteLength":{0}}}],)"
      R"("buffers":[{{"byteLength":{0}}}]}})",
      png.size());
  ConvertOptions options = options_;
  options.output = output().native();
  const ConvertReport report =
      convert_file(folder_.write("a.glb", test::glb_of(text, png)).native(), options);
  ASSERT_TRUE(report.written) << report.error;
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_EQ(
      now.text,
      R"({"asset":{"version":"2.0"},"images":[{"uri":"leaf.png"}],"textures":[{"source":0,"name":"a"},{"source":0}]})");
  EXPECT_FALSE(now.container.bin);
}

TEST_F(Dedup, KeepsMeshesNodesAndObjectsOfDifferentNames) {
  MadeAsset made;
  made.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}, {{"alphaCutoff", 0.5}}};
  made.json["textures"] = {{{"name", "a"}}, {{"name", "b"}}, {{"extras", 1}}};
  made.json["meshes"] = {{{"primitives", {{{"attributes", OrderedJson::object()}}}}},
                         {{"primitives", {{{"attributes", OrderedJson::object()}}}}}};
  made.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}};
  made.json["skins"] = {{{"joints", {0}}}, {{"joints", {0}}}};
  expect_apart(made, "names");
}

TEST_F(Dedup, KeepsObjectsThatAPointerDistinguishes) {
  MadeAsset made = twice();
  made.json["accessors"][1]["name"] = "other";
  made.json["extensionsUsed"] = {"KHR_animation_pointer"};
  const std::size_t input = made.accessor<float>({0, 1}, "SCALAR", true);
  const std::size_t output = made.accessor<float>({0.25F, 0.75F}, "SCALAR");
  made.json["materials"] = {{{"alphaMode", "MASK"}}, {{"alphaMode", "MASK"}}};
  const OrderedJson target{
      {"path", "pointer"},
      {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/1/alphaCutoff"}}}}}};
  made.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", target}}}}}};
  expect_apart(made, "a pointer");
}

TEST_F(Dedup, UpdatesPointers) {
  MadeAsset made = twice();
  made.json["extensionsUsed"] = {"KHR_animation_pointer"};
  const std::size_t input = made.accessor<float>({0, 1}, "SCALAR", true);
  const std::size_t output = made.accessor<float>({0.25F, 0.75F}, "SCALAR");
  made.json["materials"] = {OrderedJson::object(), OrderedJson::object(), {{"name", "moved"}}};
  const OrderedJson target{
      {"path", "pointer"},
      {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/2/alphaCutoff"}}}}}};
  made.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", target}}}}}};
  EXPECT_THAT(converted_twice(made.glb()).text, HasSubstr("\"/materials/1/alphaCutoff\""));
}

TEST_F(Dedup, KeepsAccessorsThatADecoderFills) {
  MadeAsset made = twice();
  made.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  for (std::size_t i = 0; i < 2; ++i) {
    made.json["accessors"][i].erase("bufferView");
    made.json["meshes"][i]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", i}, {"attributes", {{"POSITION", 0}}}};
  }
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["accessors"], SizeIs(2));
  EXPECT_EQ(row_.what, "1 buffer view");  // one of two equal streams
}

TEST_F(Dedup, RefusesIfAnUnknownExtensionHasAnInteger) {
  MadeAsset made = twice();
  made.json["extensionsUsed"] = {"ACME_ref"};
  made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = 1;
  expect_refused(made, "/nodes/0/extensions/ACME_ref",
                 "may hold indices (describe it with --schema)");
  made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = 1.5;
  EXPECT_EQ(position_of(converted_twice(made.glb()), 1), 0);
}

TEST_F(Dedup, RefusesMaterialsIfPropertiesFollowTheirOrder) {
  MadeAsset made = twice();
  made.json["materials"] = {OrderedJson::object(), OrderedJson::object()};
  made.json["extensionsUsed"] = {"VRM"};
  made.json["extensions"]["VRM"]["materialProperties"] = {{{"name", "a"}}, {{"name", "b"}}};
  expect_refused(made, "/materials", "/extensions/VRM/materialProperties follows their order");
  options_.partial = true;
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(now.json()["materials"], SizeIs(2));
  EXPECT_THAT(now.json()["accessors"], SizeIs(1));
}

// Overlapping ranges of one buffer are read only within a budget.
TEST_F(Dedup, ReadsSharedBytesWithinABudget) {
  MadeAsset made;
  made.accessor(std::vector<float>(300000), "SCALAR");
  made.json["accessors"] = OrderedJson::array();
  for (int i = 0; i < 1000; ++i) {
    made.json["accessors"].push_back({{"bufferView", 0},
                                      {"byteOffset", 4 * i},
                                      {"componentType", 5126},
                                      {"count", 299000},
                                      {"type", "SCALAR"}});
  }
  const ConvertStep row = row_of(made.glb());
  ASSERT_THAT(row.left, SizeIs(1));
  EXPECT_EQ(row.left[0].reason, "objects share too many bytes to compare all of them");
}

TEST_F(Dedup, MergesManyEqualObjects) {
  MadeAsset made = twice();
  for (int i = 0; i < 20000; ++i) {
    made.json["samplers"].push_back({{"wrapS", 33071}});
    made.json["textures"].push_back({{"sampler", i}});
  }
  made.json["materials"] = {{{"normalTexture", {{"index", 19999}}}}};
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["textures"].dump(), R"([{"sampler":0}])");
  EXPECT_EQ(now.json()["materials"][0]["normalTexture"]["index"], 0);
}

TEST_F(Dedup, KeepsBrokenReferences) {
  for (
      const char* text : {
          R"({"asset":{"version":"2.0"},"textures":[{"source":7},{"source":7},{"source":-1}]})",
          R"({"asset":{"version":"2.0"},"materials":[1,2],"meshes":[[]],"images":[null,{},{}]})",
          R"({"asset":{"version":"2.0"},"accessors":[{"bufferView":0},{"bufferView":0}],"bufferViews":[{"buffer":99},{"buffer":99}]})",
      }) {
    ConvertOptions options = options_;
    options.output = output().native();
    const ConvertReport report = convert_file(folder_.write("b.gltf", text).native(), options);
    EXPECT_TRUE(report.written || !report.error.empty()) << text;
  }
}

}  // namespace
}  // namespace gltfx
