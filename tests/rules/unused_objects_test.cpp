// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

Lines unused(const std::string& members, Profile profile = Profile::khronos) {
  return places(asset_with(members), "UNUSED_OBJECT", profile);
}

TEST(UnusedObjects, AreNamedInTheOrderOfTheReport) {
  EXPECT_EQ(
      unused(R"("textures": [{}], "skins": [{"joints": [0]}], "samplers": [{}], "nodes": [{}, {}],
      "meshes": [{}], "materials": [{}], "images": [{"uri": "a.png"}],
      "cameras": [{}], "bufferViews": [{}], "buffers": [{}], "accessors": [{}],
      "animations": [{}], "scenes": [{}])"),
      (Lines{"/accessors/0", "/buffers/0", "/bufferViews/0", "/cameras/0", "/images/0",
             "/materials/0", "/meshes/0", "/nodes/1", "/samplers/0", "/skins/0", "/textures/0"}));
}

TEST(UnusedObjects, ScenesAndAnimationsAreNeverUnused) {
  EXPECT_EQ(unused(R"("scenes": [{}, {}], "animations": [{}])"), Lines{});
}

TEST(UnusedObjects, NodesAreUsedByScenesParentsSkinsAndAnimations) {
  const std::string rest = R"(, "scenes": [{"nodes": [0]}], "skins": [{"joints": [2]}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 3}}])";
  const std::string nodes = R"("nodes": [{"children": [1], "skin": 0}, {}, {}, {}, {}])";
  EXPECT_EQ(unused(nodes + rest + R"(, "samplers": [{}]}])"), Lines{"/nodes/4"});
  EXPECT_EQ(unused(nodes + rest + "}]"), (Lines{"/nodes/3", "/nodes/4"}))
      << "an animation without samplers is not followed";
}

TEST(UnusedObjects, TheRootOfASkeletonIsUsedButNotForTheKhronosProfile) {
  const std::string members = R"("nodes": [{"skin": 0}, {}, {}], "scenes": [{"nodes": [0]}],
    "skins": [{"joints": [1], "skeleton": 2}])";
  EXPECT_EQ(unused(members), Lines{"/nodes/2"});
  EXPECT_EQ(unused(members, Profile::standard), Lines{});
}

TEST(UnusedObjects, WhatAnExtensionRefersToIsUsed) {
  const std::string members = R"("extensionsUsed": ["MSFT_lod", "KHR_draco_mesh_compression"],
    "nodes": [{"extensions": {"MSFT_lod": {"ids": [1]}}, "mesh": 0}, {}], "scenes": [{"nodes": [0]}],
    "buffers": [{}], "bufferViews": [{"buffer": 0}], "meshes": [{"primitives": [{"attributes": {"_A": 9},
      "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"_A": 0}}}}]}])";
  EXPECT_EQ(unused(members, Profile::standard), Lines{});
  EXPECT_EQ(unused(members), (Lines{"/bufferViews/0", "/nodes/1"}))
      << "that validator does not know them";
}

TEST(UnusedObjects, ObjectsOfExtensionsComeLastInTheOrderOfTheText) {
  EXPECT_EQ(
      unused(R"("extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants"], "extensions": {
      "KHR_lights_punctual": {"lights": [{"type": "point"}, {"type": "point"}]},
      "KHR_materials_variants": {"variants": [{"name": "a"}]}}, "materials": [{}],
      "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 1}}}], "scenes": [{"nodes": [0]}])"),
      (Lines{"/materials/0", "/extensions/KHR_lights_punctual/lights/0",
             "/extensions/KHR_materials_variants/variants/0"}));
}

TEST(UnusedObjects, AHoleIsNotUnused) {
  EXPECT_EQ(unused(R"("meshes": [5])", Profile::standard), Lines{});
}

TEST(UnusedObjects, RepeatsAreFolded) {
  EXPECT_EQ(unused(R"("materials": [{}, {}, {}])", Profile::standard), Lines{"/materials/0 x3"});
}

TEST(MeshWeights, AreUnusedWhenEveryNodeHasItsOwn) {
  const auto of_nodes = [](const std::string& nodes) {
    return places(asset_with(R"("meshes": [{"weights": [1]}], "nodes": [)" + nodes + "]"),
                  "UNUSED_MESH_WEIGHTS");
  };
  EXPECT_EQ(of_nodes(R"({"mesh": 0, "weights": [0]})"), Lines{"/meshes/0/weights"});
  EXPECT_EQ(of_nodes(R"({"mesh": 0, "weights": [0]}, {"mesh": 0})"), Lines{});
  EXPECT_EQ(of_nodes(R"({})"), Lines{});
}

// An asset with an unused object of every kind.
std::string loose(const std::string& extensions) {
  return asset_with(
      R"("extensionsUsed": ["ACME_table", "KHR_texture_transform"], "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "weights": [1], "children": [1])" +
      extensions + R"(}, {"name": "mark"}],
    "meshes": [{"weights": [0], "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TANGENT": 1,
      "TEXCOORD_0": 2}, "targets": [{"POSITION": 0}], "material": 0}]}],
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
      {"componentType": 5126, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC2", "count": 1},
      {"componentType": 5126, "type": "SCALAR", "count": 1}, {"componentType": 5126, "type": "SCALAR", "count": 1}],
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1]}}, {}], "textures": [{}],
    "bufferViews": [{"buffer": 0, "byteLength": 4}], "buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,AAAAAA=="}],
    "animations": [{"samplers": [{"input": 3, "output": 4}, {"input": 3, "output": 4}],
      "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}])");
}

const std::set<std::string, std::less<>>& unused_codes() {
  static const std::set<std::string, std::less<>> codes{"UNUSED_OBJECT", "UNUSED_MESH_TANGENT",
                                                        "UNUSED_MESH_WEIGHTS", "EXTENSION_UNUSED",
                                                        "NODE_EMPTY"};
  return codes;
}

TEST(UnusedObjects, NothingIsCalledUnusedBesideObjectsOfUnknownExtensions) {
  const Lines plain = selected(loose(""), unused_codes());
  for (const std::string& code : unused_codes()) {
    EXPECT_TRUE(std::any_of(plain.begin(), plain.end(), [&](const std::string& line) {
      return line.starts_with(code);
    })) << code;
  }
  const std::string unknown = R"(, "extensions": {"ACME_table": {"rows": 0}})";
  EXPECT_EQ(selected(loose(unknown), unused_codes()), Lines{});
  EXPECT_EQ(selected(loose(unknown), unused_codes(), Profile::strict), Lines{});
  EXPECT_EQ(selected(loose(unknown), unused_codes(), Profile::khronos),
            selected(loose(""), unused_codes(), Profile::khronos));
}

TEST(UnusedObjects, ADeclarationAloneUsesNothing) {
  EXPECT_EQ(
      places(asset_with(R"("extensionsUsed": ["ACME_table"], "materials": [{}])"), "UNUSED_OBJECT"),
      Lines{"/materials/0"});
}

}  // namespace
}  // namespace gltfx::test
