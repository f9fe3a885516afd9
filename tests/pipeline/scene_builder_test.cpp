// SPDX-License-Identifier: Apache-2.0
// Scenes of small assets: what is drawn, where, in which pose, and what is said of the rest.
#include "pipeline/scene_builder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/draco_encoder.hpp"
#include "model/meshopt_encoder.hpp"
#include "pipeline/scene_asset.hpp"

namespace gltfx {
namespace {

using test::Accessors;
using test::floats;
using test::kFloat;
using test::kUnsignedByte;
using test::one_mesh;
using test::packed;
using test::scene_of;
using test::scene_of_text;
using test::triangle;
using testing::Contains;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

const std::string kMesh = one_mesh(R"("POSITION": 0, "NORMAL": 1)");

Float3 at(const render::Instance& instance, const Float3& p) {
  Float3 result{};
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& row = instance.to_world[r];
    result[r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
  }
  return result;
}

testing::Matcher<Float3> near(float x, float y, float z) {
  return ElementsAre(FloatNear(x, 1e-5F), FloatNear(y, 1e-5F), FloatNear(z, 1e-5F));
}

TEST(SceneBuilder, AMeshIsReadOnceHoweverOftenItIsDrawn) {
  const render::Scene scene =
      scene_of(triangle(), kMesh + R"(, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "translation": [1, 2, 3]}, {"mesh": 0, "scale": [2, 2, 2]}, {"mesh": 0}])");
  EXPECT_THAT(scene.notes, IsEmpty());
  ASSERT_THAT(scene.meshes, SizeIs(1));
  EXPECT_THAT(scene.meshes[0].triangles, SizeIs(1));
  EXPECT_THAT(scene.meshes[0].normals, SizeIs(3));
  EXPECT_EQ(scene.meshes[0].material, render::kNone);
  ASSERT_THAT(scene.instances, SizeIs(2));
  EXPECT_THAT(at(scene.instances[0], {1, 0, 0}), near(2, 2, 3));
  EXPECT_THAT(at(scene.instances[1], {1, 0, 0}), near(2, 0, 0));
}

TEST(SceneBuilder, HiddenNodesAreNotDrawnButTheirCamerasLook) {
  const render::Scene scene = scene_of(triangle(), kMesh + R"(, "scenes": [{"nodes": [0]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25}}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
 "nodes": [{"mesh": 0, "camera": 0, "name": "front", "extensions": {"KHR_lights_punctual": {"light": 0},
  "KHR_node_visibility": {"visible": false}}}])");
  EXPECT_THAT(scene.instances, IsEmpty());
  EXPECT_THAT(scene.lights, IsEmpty());
  ASSERT_THAT(scene.cameras, SizeIs(1));
  EXPECT_EQ(scene.cameras[0].name, "front");
}

TEST(SceneBuilder, WhatIsDrawnWithoutASceneIsSaid) {
  const render::Scene all = scene_of(triangle(), kMesh + R"(, "nodes": [{"mesh": 0}])");
  EXPECT_THAT(all.instances, SizeIs(1));
  EXPECT_THAT(all.notes, ElementsAre(HasSubstr("no scene")));
  const render::Scene library = scene_of(triangle(), kMesh);
  EXPECT_THAT(library.instances, SizeIs(1));
  EXPECT_THAT(library.notes, ElementsAre(HasSubstr("no nodes")));
  const render::Scene empty = scene_of_text(R"({"asset": {"version": "2.0"}})");
  EXPECT_THAT(empty.instances, IsEmpty());
  EXPECT_THAT(empty.notes, IsEmpty());
}

TEST(SceneBuilder, TheSceneThatIsAskedFor) {
  const std::string members =
      kMesh +
      R"(, "scenes": [{"nodes": [0]}, {"nodes": [1]}], "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [9, 0, 0]}])";
  SceneOptions second;
  second.scene = 1;
  EXPECT_THAT(at(scene_of(triangle(), members, second).instances.at(0), {0, 0, 0}), near(9, 0, 0));
  const render::Scene first = scene_of(triangle(), members);
  EXPECT_THAT(at(first.instances.at(0), {0, 0, 0}), near(0, 0, 0));
  EXPECT_THAT(first.notes, ElementsAre(HasSubstr("first one")));
}

TEST(SceneBuilder, PrimitivesThatAreNotDrawnAreCounted) {
  const render::Scene scene = scene_of(triangle(), R"("meshes": [{"primitives": [
 {"attributes": {"POSITION": 0}, "mode": 0}, {"attributes": {"POSITION": 0}},
 {"attributes": {"NORMAL": 1}}, {"attributes": {"NORMAL": 1}}]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}])");
  EXPECT_THAT(scene.meshes, SizeIs(2));
  EXPECT_THAT(scene.notes,
              ElementsAre("Primitive 2 of mesh 0 has no positions that can be read, and 1 more "
                          "like it."));
}

TEST(SceneBuilder, CopiesOfANodeStandInItsSpace) {
  Accessors accessors = triangle();
  accessors.add("VEC3", kFloat, 2, floats({1, 0, 0, 0, 1, 0}));
  const std::string node =
      R"({"mesh": 0, "scale": [2, 2, 2], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 3)";
  const render::Scene scene =
      scene_of(accessors, kMesh + R"(, "scenes": [{"nodes": [0]}], "nodes": [)" + node + "}}}}]");
  EXPECT_THAT(scene.meshes, SizeIs(1));
  ASSERT_THAT(scene.instances, SizeIs(2));
  EXPECT_THAT(at(scene.instances[0], {1, 1, 0}), near(4, 2, 0));
  EXPECT_THAT(at(scene.instances[1], {1, 1, 0}), near(2, 4, 0));
  const render::Scene broken =
      scene_of(accessors, kMesh + R"(, "scenes": [{"nodes": [0]}], "nodes": [)" + node +
                              R"(, "SCALE": 0}}}}])");
  EXPECT_THAT(broken.instances, IsEmpty());
  EXPECT_THAT(broken.notes, ElementsAre(HasSubstr("copies that cannot be read")));
}

// Positions are 0; joints and weights follow the triangle's accessors.
const std::string kSkinned = R"(, "skins": [{"joints": [1]}], "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0, "translation": [100, 0, 0]}, {"translation": [0, 5, 0]}, {"mesh": 0}])";

Accessors skinned_triangle() {
  Accessors accessors = triangle();
  accessors.add("VEC4", kUnsignedByte, 3, std::string(12, '\0'));
  accessors.add("VEC4", kFloat, 3, floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  return accessors;
}

TEST(SceneBuilder, SkinnedMeshesStandWhereTheirJointsAre) {
  const render::Scene scene =
      scene_of(skinned_triangle(),
               one_mesh(R"("POSITION": 0, "NORMAL": 1, "JOINTS_0": 3, "WEIGHTS_0": 4)") + kSkinned);
  ASSERT_THAT(scene.meshes, SizeIs(1));
  EXPECT_THAT(scene.meshes[0].positions[0], near(0, 5, 0));
  ASSERT_THAT(scene.instances, SizeIs(1));
  EXPECT_EQ(scene.instances[0].to_world, render::kIdentity)
      << "the node's own place does not count";
}

TEST(SceneBuilder, ASkinWithoutInfluencesMovesNothing) {
  const render::Scene scene = scene_of(skinned_triangle(), kMesh + kSkinned);
  EXPECT_THAT(scene.meshes.at(0).positions[0], near(0, 0, 0));
  EXPECT_THAT(at(scene.instances.at(0), {0, 0, 0}), near(100, 0, 0));
}

TEST(SceneBuilder, AnAnimationPosesTheScene) {
  Accessors accessors = triangle();
  accessors.add("SCALAR", kFloat, 2, floats({0, 2}));
  accessors.add("VEC3", kFloat, 2, floats({0, 0, 0, 8, 0, 0}));
  accessors.add("SCALAR", kFloat, 2, floats({0, 1}));
  const std::string members =
      R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]}]}],
 "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0, "weights": [0]}],
 "animations": [{"samplers": [{"input": 3, "output": 4}, {"input": 3, "output": 5}], "channels": [
  {"sampler": 0, "target": {"node": 0, "path": "translation"}}, {"sampler": 1, "target": {"node": 1, "path": "weights"}}]}])";
  SceneOptions half;
  half.animation = 0;
  half.time = 1;
  const render::Scene posed = scene_of(accessors, members, half);
  EXPECT_THAT(posed.notes, IsEmpty());
  ASSERT_THAT(posed.meshes, SizeIs(2)) << "two poses of one mesh";
  EXPECT_THAT(at(posed.instances[0], {0, 0, 0}), near(4, 0, 0));
  EXPECT_THAT(posed.meshes[posed.instances[1].mesh].positions[1], near(1, 0, 0.5F));
  const render::Scene rest = scene_of(accessors, members);
  EXPECT_THAT(rest.meshes, SizeIs(1));
  EXPECT_THAT(at(rest.instances[0], {0, 0, 0}), near(0, 0, 0));
}

TEST(SceneBuilder, LightsShineAlongTheirNodes) {
  const render::Scene scene =
      scene_of_text(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 0.5, 0], "intensity": 4,
  "range": 7, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}, {"type": "directional"}]}},
 "nodes": [{"translation": [1, 2, 3], "rotation": [0, 0.70710678, 0, 0.70710678], "scale": [3, 3, 3],
  "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"extensions": {"KHR_lights_punctual": {"light": 1}}},
  {"extensions": {"KHR_lights_punctual": {"light": 1}}}]})");
  ASSERT_THAT(scene.lights, SizeIs(2));
  EXPECT_EQ(scene.lights[0].kind, render::Light::Kind::spot);
  EXPECT_THAT(scene.lights[0].intensity, ElementsAre(4, 2, 0));
  EXPECT_THAT(scene.lights[0].position, near(1, 2, 3));
  EXPECT_THAT(scene.lights[0].direction, near(-1, 0, 0));
  EXPECT_EQ(scene.lights[0].range, 7);
  EXPECT_EQ(scene.lights[0].outer_cone, 0.2F);
  EXPECT_EQ(scene.lights[1].kind, render::Light::Kind::directional);
  EXPECT_EQ(scene.lights[1].range, 0);
  EXPECT_THAT(scene.lights[1].direction, near(0, 0, -1));
}

TEST(SceneBuilder, CamerasLookWithoutScale) {
  const render::Scene scene =
      scene_of_text(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
 "cameras": [{"type": "perspective", "name": "eye", "perspective": {"yfov": 0.5, "znear": 0.25, "zfar": 9}},
  {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 10}}],
 "nodes": [{"camera": 0, "translation": [0, 0, 5], "scale": [-2, 3, 4]}, {"camera": 1, "scale": [0, 0, 0]}]})");
  ASSERT_THAT(scene.cameras, SizeIs(2));
  EXPECT_TRUE(scene.cameras[0].perspective);
  EXPECT_EQ(scene.cameras[0].yfov, 0.5F);
  EXPECT_EQ(scene.cameras[0].zfar, 9);
  EXPECT_EQ(scene.cameras[0].to_world,
            (render::Matrix34{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 5}}}));
  EXPECT_FALSE(scene.cameras[1].perspective);
  EXPECT_EQ(scene.cameras[1].ymag, 3);
  EXPECT_EQ(scene.cameras[1].to_world, render::kIdentity) << "flat, but it looks somewhere";
}

TEST(SceneBuilder, CompressedGeometryIsDecoded) {
  Accessors accessors;
  accessors.add_plain(R"({"type": "VEC3", "componentType": 5126, "count": 4})");
  accessors.add_plain(R"({"type": "SCALAR", "componentType": 5121, "count": 6})");
  accessors.add_view(test::draco_bytes(test::draco_square()));
  const std::string members = one_mesh(R"("POSITION": 0)", R"(, "indices": 1, "extensions":
 {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}})") +
                              R"(, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}])";
  const render::Scene scene = scene_of(accessors, members);
  EXPECT_THAT(scene.notes, IsEmpty());
  EXPECT_THAT(scene.meshes.at(0).positions, SizeIs(4));
  EXPECT_THAT(scene.meshes.at(0).triangles, SizeIs(2));
}

TEST(SceneBuilder, CompressedViewsAreDecoded) {
  const std::string plain = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const test::Octets elements(plain.begin(), plain.end());
  const test::Octets octets = test::MeshoptEncoder(0, 12).encode(elements);
  const std::string stream(octets.begin(), octets.end());
  Accessors accessors;
  accessors.add_view(stream);
  const render::Scene scene = scene_of_text(fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}], "scenes": [{{"nodes": [0]}}],
 "accessors": [{{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 3}}],
 "bufferViews": [{{"buffer": 1, "byteLength": 36, "byteStride": 12, "extensions": {{"EXT_meshopt_compression":
  {{"buffer": 0, "byteLength": {}, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}}}}}],
 "buffers": [{{"byteLength": {}, "uri": "{}"}}, {{"byteLength": 36, "extensions": {{"EXT_meshopt_compression": {{"fallback": true}}}}}}],
 {}}})",
      stream.size(), accessors.bytes().size(), test::buffer_uri(accessors.bytes()),
      one_mesh(R"("POSITION": 0)")));
  EXPECT_THAT(scene.notes, IsEmpty());
  ASSERT_THAT(scene.meshes, SizeIs(1));
  EXPECT_THAT(scene.meshes[0].positions, ElementsAre(near(0, 0, 0), near(1, 0, 0), near(0, 1, 0)));
}

TEST(SceneBuilder, BuffersThatAreMissingAreNamed) {
  const render::Scene scene =
      scene_of_text(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
 "buffers": [{"byteLength": 36, "uri": "away.bin"}, {"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAA"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 3}],
 "nodes": [{"mesh": 0}], )" +
                    one_mesh(R"("POSITION": 0)") + "}");
  EXPECT_THAT(scene.instances, IsEmpty());
  EXPECT_THAT(scene.notes, Contains(HasSubstr("Buffer 0 cannot be loaded: ")));
  EXPECT_THAT(scene.notes, Contains(HasSubstr("Buffer 1 is shorter than its byteLength")));
  EXPECT_THAT(scene.notes, Contains(HasSubstr("no positions")));
}

TEST(SceneBuilder, ManyPosesEndWithTheMemory) {
  std::string nodes, roots;
  for (int i = 0; i < 200; ++i) {
    const char* const comma = i == 0 ? "" : ", ";
    nodes += fmt::format(R"({}{{"mesh": 0, "weights": [{}]}})", comma, i);
    roots += fmt::format("{}{}", comma, i);
  }
  SceneOptions options;
  options.free_bytes = 20000;
  const render::Scene scene =
      scene_of(triangle(),
               one_mesh(R"("POSITION": 0)", R"(, "targets": [{"POSITION": 1}])") +
                   R"(, "scenes": [{"nodes": [)" + roots + R"(]}], "nodes": [)" + nodes + "]",
               options);
  EXPECT_LT(scene.meshes.size(), 60U);
  EXPECT_GT(scene.meshes.size(), 20U);
  EXPECT_THAT(scene.notes, ElementsAre(HasSubstr("more poses than memory allows")));
}

TEST(SceneBuilder, NodesAtInfinityAreLeftOut) {
  const render::Scene scene = scene_of(triangle(), kMesh + R"(, "scenes": [{"nodes": [0]}],
 "nodes": [{"scale": [3e38, 1, 1], "children": [1]}, {"mesh": 0, "scale": [3e38, 1, 1]}])");
  EXPECT_THAT(scene.instances, IsEmpty());
  EXPECT_THAT(scene.notes, ElementsAre("A mesh lies at infinity."));
}

}  // namespace
}  // namespace gltfx
