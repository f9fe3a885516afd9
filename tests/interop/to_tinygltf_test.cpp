// SPDX-License-Identifier: Apache-2.0
// Contents of models of tinygltf, and members that they cannot hold.
#include <gmock/gmock.h>

#include "container/base64.hpp"
#include "support.hpp"

namespace gltfx::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using tinygltf::Value;

constexpr const char* kTriangle =
    R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
       "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
         "min": [0, 0, 0], "max": [1, 1, 0]}],
       "bufferViews": [{"buffer": 0, "byteLength": 36}],
       "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])";

MemoryAsset asset_of(const std::string& members) {
  return {R"({"asset": {"version": "2.0"}, )" + members + "}", "asset.gltf"};
}

struct Converted {
  tinygltf::Model model;
  TinygltfReport report;
};

Converted convert(const std::string& members, const ToTinygltfOptions& options = {}) {
  Converted converted;
  converted.report = to_tinygltf(asset_of(members), converted.model, options);
  EXPECT_TRUE(converted.report.done) << problems(converted.report);
  return converted;
}

TEST(ToTinygltf, NotesWhatHasNoPlace) {
  const Converted there = convert(
      R"("nodes": [{"extras": null}, {}], "scene": 0, "scenes": [{"nodes": [0, 1], "lamps": 4}],
         "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation",
           "extras": 1}}], "samplers": [{"input": 1, "output": 0}]}],
         "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "sparse": {"count": 1,
           "extras": {}, "indices": {"bufferView": 0, "componentType": 5125, "extras": "i"},
           "values": {"bufferView": 1, "extras": "v"}}},
           {"componentType": 5126, "type": "SCALAR", "count": 1, "min": [0], "max": [0]}],
         "bufferViews": [{"buffer": 0, "byteLength": 4}, {"buffer": 0, "byteLength": 12}],
         "buffers": [{"byteLength": 12, "uri": "data:application/gltf-buffer;base64,AAAAAAAAAAAAAAAA"}])");
  EXPECT_EQ(pointers(there.report.notes, true),
            "/scenes/0/lamps\n/nodes/0/extras\n/animations/0/channels/0/target/extras\n"
            "/accessors/0/sparse/indices/extras\n/accessors/0/sparse/values/extras\n"
            "/accessors/0/sparse/extras\n");
}

TEST(ToTinygltf, KeepsValuesThatTinygltfDrops) {
  const Converted there = convert(
      R"("extras": {"none": null, "empty": {}, "list": [null, 1, true, "a", {"b": []}],
         "large": 5000000000, "real": 1.0, "least": -2147483648}, "nodes": [{"extras": 7}])");
  EXPECT_THAT(there.report.notes, IsEmpty());
  const Value& extras = there.model.extras;
  EXPECT_TRUE(extras.Has("none"));
  EXPECT_TRUE(extras.Get("empty").IsObject());
  EXPECT_EQ(extras.Get("list").ArrayLen(), 5U);
  EXPECT_TRUE(extras.Get("list").Get(4).Get("b").IsArray());
  EXPECT_EQ(extras.Get("large").Get<double>(), 5e9);
  EXPECT_TRUE(extras.Get("real").IsReal());
  EXPECT_EQ(there.model.nodes.at(0).extras.Get<int>(), 7);
}

TEST(ToTinygltf, LeavesOutWhatIsNestedTooDeep) {
  const std::string deep = std::string(600, '[') + std::string(600, ']');
  const Converted there = convert(R"("extras": {"deep": )" + deep + "}");
  ASSERT_EQ(there.report.notes.size(), 1U);
  EXPECT_TRUE(there.report.notes[0].lost);
  EXPECT_THAT(there.report.notes[0].pointer, testing::StartsWith("/extras/deep/0/0/0/"));
}

TEST(ToTinygltf, RefusesWhatIsNotValid) {
  tinygltf::Model model;
  model.scenes.resize(7);
  const TinygltfReport report = to_tinygltf(asset_of(R"("nodes": [{"mesh": 3}])"), model, {});
  EXPECT_FALSE(report.done);
  EXPECT_EQ(report.error, "it is not valid");
  ASSERT_EQ(report.validation.counts.errors, 1U);
  EXPECT_EQ(report.validation.diagnostics.at(0).code, "UNRESOLVED_REFERENCE");
  EXPECT_EQ(model.scenes.size(), 7U) << "it stays as it was";
}

TEST(ToTinygltf, RefusesWhatCannotBeRead) {
  tinygltf::Model model;
  const TinygltfReport report = to_tinygltf("no such file.gltf", model, {});
  EXPECT_FALSE(report.done);
  EXPECT_FALSE(report.validation.readable);
  EXPECT_FALSE(to_tinygltf(MemoryAsset{"no glTF", "x"}, model, {}).done);
  EXPECT_FALSE(to_tinygltf(MemoryAsset{"", "x.gltf"}, model, {}).done);
}

TEST(ToTinygltf, TakesFilesFromMemory) {
  MemoryAsset asset = asset_of(R"("buffers": [{"byteLength": 3, "uri": "a%20b/c.bin"}])");
  asset.files["a b/c.bin"] = "abcd";
  tinygltf::Model model;
  const TinygltfReport report = to_tinygltf(asset, model, {});
  ASSERT_TRUE(report.done) << problems(report);
  EXPECT_EQ(model.buffers.at(0).uri, "a%20b/c.bin");
  EXPECT_THAT(model.buffers.at(0).data, testing::ElementsAre('a', 'b', 'c'));
}

TEST(ToTinygltf, ABufferWithoutBytesIsRefusedWhereItIsNeeded) {
  tinygltf::Model model;
  const TinygltfReport needed = to_tinygltf(
      asset_of(
          R"("buffers": [{"byteLength": 8}], "bufferViews": [{"buffer": 0, "byteLength": 8}])"),
      model, {});
  EXPECT_FALSE(needed.done);
  EXPECT_THAT(problems(needed), HasSubstr("/buffers/0"));
  const Converted idle = convert(R"("buffers": [{"byteLength": 800000000000}])");
  EXPECT_EQ(idle.model.buffers.at(0).data.size(), 1U);
  EXPECT_EQ(pointers(idle.report.notes, true), "/buffers/0/byteLength\n");
}

TEST(ToTinygltf, ReadsLightsAndKeepsTheirExtension) {
  const tinygltf::Model model = model_of(fixture("good/lamp.gltf"));
  ASSERT_FALSE(model.lights.empty());
  EXPECT_FALSE(model.lights[0].type.empty());
  EXPECT_EQ(model.extensions.count("KHR_lights_punctual"), 1U);
}

TEST(ToTinygltf, SparseAccessorsAreExpandedWhenAskedFor) {
  const std::string bytes =
      std::string(64, '\0') + std::string("\1\0\0\0", 4) + std::string("\0\0\x80\x3f", 4);
  const std::string members =
      R"("accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 3,
           "min": [0], "max": [1], "sparse": {"count": 1, "indices": {"bufferView": 1,
           "componentType": 5121}, "values": {"bufferView": 2}}},
           {"componentType": 5126, "type": "MAT4", "count": 900000000, "sparse": {"count": 1,
           "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}}],
         "bufferViews": [{"buffer": 0, "byteLength": 64},
           {"buffer": 0, "byteLength": 1, "byteOffset": 64},
           {"buffer": 0, "byteLength": 4, "byteOffset": 68}],
         "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,)" +
      container::encode_base64(bytes) + R"("}])";
  Converted plain = convert(members);
  EXPECT_TRUE(plain.model.accessors.at(0).sparse.isSparse);
  ToTinygltfOptions options;
  options.expand_sparse = true;
  Converted full = convert(members, options);
  const tinygltf::Accessor& accessor = full.model.accessors.at(0);
  EXPECT_FALSE(accessor.sparse.isSparse);
  EXPECT_EQ(component_at(full.model, accessor, 0, 0), 0);
  EXPECT_EQ(component_at(full.model, accessor, 1, 0), 1);
  EXPECT_TRUE(full.model.accessors.at(1).sparse.isSparse) << "57 GB";
  EXPECT_EQ(pointers(full.report.notes, false), "/accessors/0/sparse\n/accessors/1/sparse\n");
}

TEST(ToTinygltf, CompressionIsGone) {
  for (const char* name : {"good/bowl.glb", "good/kelp.gltf", "good/sedge.glb", "good/coral.glb"}) {
    const tinygltf::Model model = model_of(fixture(name));
    for (const auto* list : {&model.extensionsUsed, &model.extensionsRequired}) {
      for (const std::string& extension : *list) {
        EXPECT_EQ(extension.find("draco"), std::string::npos) << name;
        EXPECT_EQ(extension.find("meshopt"), std::string::npos) << name;
      }
    }
    for (const tinygltf::BufferView& view : model.bufferViews) {
      EXPECT_TRUE(view.extensions.empty()) << name;
    }
    for (const tinygltf::Mesh& mesh : model.meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        EXPECT_EQ(primitive.extensions.count("KHR_draco_mesh_compression"), 0U) << name;
        for (const auto& [attribute, accessor] : primitive.attributes) {
          EXPECT_GE(model.accessors.at(static_cast<std::size_t>(accessor)).bufferView, 0) << name;
        }
      }
    }
  }
}

TEST(ToTinygltf, ImagesAreDecodedOrNot) {
  ToTinygltfOptions options;
  const tinygltf::Model pixels = model_of(fixture("good/leaf.gltf"), options);
  ASSERT_FALSE(pixels.images.empty());
  for (const tinygltf::Image& image : pixels.images) {
    EXPECT_FALSE(image.as_is);
    EXPECT_EQ(image.component, 4);
    EXPECT_EQ(image.image.size(), static_cast<std::size_t>(image.width * image.height * 4));
  }
  options.images = TinygltfImages::encoded;
  const tinygltf::Model files = model_of(fixture("good/leaf.gltf"), options);
  for (const tinygltf::Image& image : files.images) {
    EXPECT_TRUE(image.as_is);
    const std::string bytes(image.image.begin(), image.image.end());
    EXPECT_EQ(bytes, content(fixture("good/" + image.uri)));
  }
}

TEST(ToTinygltf, ImagesOfOtherKindsStayEncoded) {
  tinygltf::Model model;
  const TinygltfReport report = to_tinygltf(fixture("good/leaf-basis.gltf").native(), model, {});
  ASSERT_TRUE(report.done) << problems(report);
  EXPECT_THAT(pointers(report.notes, false), HasSubstr("/images/"));
  bool encoded = false;
  for (const tinygltf::Image& image : model.images) encoded = encoded || image.as_is;
  EXPECT_TRUE(encoded);
}

TEST(ToTinygltf, IndicesBeyondTinygltfAreRefused) {
  tinygltf::Model model;
  const TinygltfReport report = to_tinygltf(
      asset_of(std::string(kTriangle) +
               R"(, "materials": [{"occlusionTexture": {"index": 0, "texCoord": 3000000000}}],
                    "textures": [{}])"),
      model, {});
  EXPECT_FALSE(report.done);
  EXPECT_THAT(report.error, HasSubstr("/materials/0/occlusionTexture/texCoord is beyond"));
}

}  // namespace
}  // namespace gltfx::test
