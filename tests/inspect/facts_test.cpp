// SPDX-License-Identifier: Apache-2.0
/// Facts about handmade assets, in which each number can be counted by hand.
#include "inspect/facts.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/container.hpp"
#include "container/resolver.hpp"
#include "container/temp_folder.hpp"
#include "model/opened_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx::inspect {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

AssetFacts facts_of(const std::string& text, const container::Resolver& resolver = {}) {
  const model::OpenedAsset opened(
      "a.gltf", container::open_bytes(container::Bytes::from_string(text), "a.gltf"), resolver);
  EXPECT_FALSE(opened.document().empty());
  return collect_facts(opened, *schema::builtin_set(), {});
}

std::uint64_t bytes(const AssetFacts& facts, ByteUse use) {
  return facts.bytes[static_cast<std::size_t>(use)];
}

// 96 bytes: positions of 3 vertices and, in the same view, indices after them; a gap of 6; 30 bytes
// without a reference; then two times of an animation and 4 bytes to the end.
const std::string kBuffer = R"({"byteLength": 96, "uri": "data.bin"})";

class Buffer : public testing::Test {
 protected:
  Buffer() : resolver_(folder_.path(), folder_.path()) {
    folder_.write("data.bin", std::string(96, '\0'));
  }
  AssetFacts facts(const std::string& members) {
    return facts_of(
        R"({"asset": {"version": "2.0"}, "buffers": [)" + kBuffer + "], " + members + "}",
        resolver_);
  }
  container::test::TempFolder folder_;
  container::Resolver resolver_;
};

TEST_F(Buffer, EachByteCountsOnceForWhoComesFirst) {
  const AssetFacts seen = facts(R"("bufferViews": [
      {"buffer": 0, "byteLength": 42}, {"buffer": 0, "byteOffset": 48, "byteLength": 8},
      {"buffer": 0, "byteOffset": 84, "byteLength": 12}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
      {"bufferView": 0, "byteOffset": 36, "componentType": 5123, "type": "SCALAR", "count": 3},
      {"bufferView": 1, "componentType": 5126, "type": "SCALAR", "count": 2, "max": [2.5]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
               {"primitives": [{"attributes": {"POSITION": 0}}]}],
    "nodes": [{}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                    "samplers": [{"input": 2, "output": 0}]}])");
  EXPECT_EQ(bytes(seen, ByteUse::meshes), 42U);
  EXPECT_EQ(seen.meshes[0].bytes, 42U);
  EXPECT_EQ(seen.meshes[1].bytes, 0U);  // shares the positions of the first
  EXPECT_EQ(bytes(seen, ByteUse::animations), 8U);
  EXPECT_EQ(seen.animations[0].bytes, 8U);
  EXPECT_EQ(bytes(seen, ByteUse::padding), 6U);
  EXPECT_EQ(bytes(seen, ByteUse::unused), 40U);  // with the unused view
  EXPECT_EQ(seen.total_bytes(), bytes(seen, ByteUse::json) + 96);
  ASSERT_EQ(seen.files.size(), 2U);
  EXPECT_EQ(seen.files[1].uri, "data.bin");
  EXPECT_DOUBLE_EQ(seen.animations[0].duration, 2.5);
  EXPECT_EQ(seen.animations[0].keyframes, 2U);
}

TEST_F(Buffer, AttributesThatAlternateAreOnePart) {
  const AssetFacts seen =
      facts(R"("bufferViews": [{"buffer": 0, "byteLength": 96, "byteStride": 32}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
                  {"bufferView": 0, "byteOffset": 12, "componentType": 5126, "type": "VEC3", "count": 3}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}])");
  EXPECT_EQ(bytes(seen, ByteUse::meshes), 96U);
  EXPECT_EQ(bytes(seen, ByteUse::unused), 0U);
  EXPECT_EQ(seen.meshes[0].gpu_bytes, 72U);
}

TEST_F(Buffer, WhatAnExtensionOfANodeRefersToIsUsedAsWell) {
  const AssetFacts seen = facts(R"("bufferViews": [{"buffer": 0, "byteLength": 96}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 8}],
    "nodes": [{"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}])");
  EXPECT_EQ(bytes(seen, ByteUse::other), 96U);
  EXPECT_EQ(bytes(seen, ByteUse::unused), 0U);
}

TEST_F(Buffer, AMissingFileIsNamedAndCountsNothing) {
  const AssetFacts seen = facts_of(
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 9, "uri": "gone.bin"}]})",
      resolver_);
  EXPECT_EQ(seen.files.size(), 1U);
  EXPECT_THAT(seen.problems, ElementsAre(HasSubstr("'gone.bin' does not exist")));
}

TEST(Bytes, ADataUriTakesMoreThanItHolds) {
  const std::string text =
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 3, "uri": "data:;base64,AAAA"}]})";
  const AssetFacts seen = facts_of(text);
  EXPECT_EQ(bytes(seen, ByteUse::json), text.size() - 19);
  EXPECT_EQ(bytes(seen, ByteUse::base64), 16U);
  EXPECT_EQ(bytes(seen, ByteUse::padding), 3U);
  EXPECT_EQ(seen.total_bytes(), text.size());
}

const char* const kTriangle = R"("accessors": [{"componentType": 5126, "type": "VEC3", "count": 3,
    "min": [0, 0, 0], "max": [1, 2, 0]},
    {"componentType": 5120, "normalized": true, "type": "VEC3", "count": 3, "min": [-127, 0, 0], "max": [127, 127, 0]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}, {"primitives": [{"attributes": {"POSITION": 1}}]}])";

std::string scene(const std::string& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], )" +
         std::string(kTriangle) + R"(, "nodes": )" + nodes + "}";
}

TEST(Extent, FollowsTheNodesOfTheScene) {
  const AssetFacts seen = facts_of(scene(
      R"([{"children": [1], "translation": [10, 0, 0]}, {"mesh": 0, "scale": [2, 1, 1]}, {"mesh": 1}])"));
  ASSERT_TRUE(seen.bounds);
  EXPECT_THAT(seen.bounds->least, ElementsAre(10, 0, 0));
  EXPECT_THAT(seen.bounds->greatest, ElementsAre(12, 2, 0));
  EXPECT_EQ(seen.triangles, 2U);
  EXPECT_EQ(seen.drawn_triangles, 1U);
  EXPECT_EQ(seen.vertices, 6U);
}

TEST(Extent, IntegersThatAreNormalizedCountAsFractions) {
  const AssetFacts seen = facts_of(scene(R"([{"mesh": 1}])"));
  ASSERT_TRUE(seen.bounds);
  EXPECT_THAT(seen.bounds->least, ElementsAre(-1, 0, 0));
  EXPECT_THAT(seen.bounds->greatest, ElementsAre(1, 1, 0));
}

TEST(Extent, TheJointsMoveASkinnedMesh) {
  std::string text =
      scene(R"([{"children": [1, 2]}, {"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
    {"translation": [0, 5, 0]}])");
  text.insert(1, R"("skins": [{"joints": [2]}], )");
  const AssetFacts seen = facts_of(text);
  ASSERT_TRUE(seen.bounds);
  EXPECT_THAT(seen.bounds->least, ElementsAre(0, 5, 0));
  EXPECT_THAT(seen.bounds->greatest, ElementsAre(1, 7, 0));
  EXPECT_EQ(seen.skins[0].joints, 1U);
}

TEST(Extent, NothingShownHasNone) {
  EXPECT_FALSE(facts_of(scene("[{}]")).bounds);
  EXPECT_FALSE(facts_of(R"({"asset": {"version": "2.0"}})").bounds);
}

TEST(Images, TellWhoShowsThemAndHow) {
  const AssetFacts seen = facts_of(R"({"asset": {"version": "2.0"},
    "images": [{"name": "a", "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAgAAAABCAIAAABsYngUAAAAIUlEQVR42mNgYGRiZmFlY+fg5OLm4eXjFxAUEhYRFRMHAAkVARU2O3Z5AAAAAElFTkSuQmCC"},
               {"uri": "data:image/png;base64,AAAA"}],
    "textures": [{"source": 0}, {"source": 0}],
    "materials": [{"alphaMode": "MASK", "normalTexture": {"index": 0},
                   "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}, "metallicRoughnessTexture": {"index": 9}}}]})");
  ASSERT_EQ(seen.images.size(), 2U);
  const ImageFacts& image = seen.images[0];
  EXPECT_EQ(image.format, "image/png");
  EXPECT_EQ(image.channels, "rgb");
  EXPECT_EQ(image.width, 8U);
  EXPECT_EQ(image.height, 1U);
  EXPECT_EQ(image.textures, 2U);
  EXPECT_THAT(image.slots, ElementsAre("baseColorTexture", "normalTexture"));
  EXPECT_EQ(image.color_space, "both");
  EXPECT_EQ(image.gpu_bytes, 60U);  // 8, 4, 2 and 1 texels of 4 bytes
  EXPECT_EQ(image.bytes, 90U);
  EXPECT_EQ(seen.images[1].width, 0U);
  EXPECT_THAT(seen.problems, ElementsAre(HasSubstr("Image 1")));
  EXPECT_EQ(seen.materials[0].alpha_mode, "MASK");
  EXPECT_EQ(seen.materials[0].textures, 3U);
}

TEST(Extensions, AreToldWithTheirStatus) {
  const AssetFacts seen = facts_of(R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_materials_ior", "ACME_leaf"], "extensionsRequired": ["ACME_leaf"],
    "materials": [{"extensions": {"KHR_materials_pbrSpecularGlossiness": {}, "KHR_materials_ior": {}}}]})");
  ASSERT_EQ(seen.extensions.size(), 3U);
  EXPECT_EQ(seen.extensions[0].name, "ACME_leaf");
  EXPECT_EQ(seen.extensions[0].status, "unknown");
  EXPECT_TRUE(seen.extensions[0].required);
  EXPECT_FALSE(seen.extensions[0].seen);
  EXPECT_EQ(seen.extensions[1].status, "ratified");
  EXPECT_TRUE(seen.extensions[1].used && seen.extensions[1].seen);
  EXPECT_FALSE(seen.extensions[2].used);
  EXPECT_FALSE(seen.extensions[2].successor.empty());
}

// Numbers, types and links that no valid asset has: everything has an answer, and a quick one.
TEST(Extensions, WithoutObjectsAreCountedByTheirFormats) {
  const auto of = [](const std::string& extension, const std::string& members) {
    return facts_of(R"({"asset": {"version": "2.0"}, "extensionsUsed": [")" + extension + "\"], " +
                    members + "}")
        .extensions.at(0);
  };
  const auto positions = [](const std::string& type) {
    return R"("accessors": [{"type": "VEC3", "componentType": )" + type + R"(, "count": 3},
                            {"type": "VEC3", "componentType": 5126, "count": 3}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}},
                                 {"attributes": {"POSITION": 1}, "targets": [{"POSITION": 0}]}]}])";
  };
  const ExtensionFacts used = of("KHR_mesh_quantization", positions("5122"));
  EXPECT_FALSE(used.seen || used.has_objects);
  EXPECT_EQ(used.accessors, 1U);
  EXPECT_EQ(of("KHR_mesh_quantization", positions("5126")).accessors, 0U);
  EXPECT_EQ(of("KHR_accessor_float64", positions("5130")).accessors, 1U);
  EXPECT_EQ(of("GODOT_single_root", positions("5130")).accessors, std::nullopt);
  const ExtensionFacts splats = of("KHR_gaussian_splatting", positions("5126"));
  EXPECT_TRUE(splats.has_objects);
  EXPECT_EQ(splats.accessors, std::nullopt);
}

TEST(Hostile, AnythingHasFacts) {
  for (
      const char* text :
      {R"({"accessors": [{"componentType": 5126, "type": "MAT4", "count": 9007199254740992, "max": [1e300]}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "a": 0, "b": -1}, "indices": 0}]}]})",
       R"({"meshes": 7, "images": [3, {}], "textures": [{"source": 0}, 1], "nodes": {}, "buffers": [null, 2]})",
       R"({"nodes": [{"children": [0, 1], "mesh": 5}, {"children": [0], "skin": 0}], "scenes": [{"nodes": [0, 1, 0]}],
           "skins": [{"joints": [0, 0, 9]}]})",
       R"({"buffers": [{"byteLength": 9007199254740992}], "bufferViews": [{"buffer": 0, "byteLength": 9007199254740992,
           "byteOffset": 9007199254740992, "extensions": {"EXT_meshopt_compression": {"buffer": 0}}}],
           "images": [{"bufferView": 0}]})",
       R"({"extensionsUsed": [1, {}], "animations": [{"samplers": [{"input": 3}], "channels": [{}]}, 4]})",
       "[]"}) {
    const AssetFacts seen = facts_of(text);
    EXPECT_EQ(seen.total_bytes(), std::string(text).size()) << text;
  }
}

TEST(Hostile, AChainOfNodesIsNoRecursion) {
  std::string nodes = "[{\"mesh\": 0, \"children\": [1]}";
  for (int i = 2; i < 50000; ++i) nodes += ",{\"children\": [" + std::to_string(i) + "]}";
  const AssetFacts seen = facts_of(scene(nodes + "]"));
  EXPECT_TRUE(seen.bounds);
  EXPECT_EQ(seen.nodes, 49999U);
}

TEST(Limits, SumsEndAtTheGreatestNumber) {
  AssetFacts facts;
  facts.images.resize(2);
  facts.images[0].gpu_bytes = UINT64_MAX;
  facts.images[1].gpu_bytes = 5;
  EXPECT_EQ(facts.image_gpu_bytes(), UINT64_MAX);
  EXPECT_THAT(facts.problems, IsEmpty());
}

}  // namespace
}  // namespace gltfx::inspect
