// SPDX-License-Identifier: Apache-2.0
// The references of incomplete objects that the Khronos validator follows, and the order in which
// it follows references.
#include <gtest/gtest.h>

#include "part.hpp"

namespace gltfx::test {
namespace {

Lines khronos_links(const std::string& members) {
  return verdict(asset(members), Profile::khronos);
}

TEST(KhronosAccessor, ThatIsIncompleteIsUsedButNotFollowed) {
  EXPECT_EQ(khronos_links(R"("accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "type": 3, "count": 1},
    {"bufferView": 9, "componentType": 5126, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 4}, {"buffer": 0, "byteLength": 4}],
    "buffers": [{"byteLength": 4}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])"),
            (Lines{"UNDEFINED_PROPERTY /accessors/0", "TYPE_MISMATCH /accessors/1/type",
                   "UNDEFINED_PROPERTY /accessors/2",
                   "BUFFER_VIEW_TARGET_MISSING /meshes/0/primitives/0/attributes/POSITION",
                   "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS "
                   "/meshes/0/primitives/0/attributes/POSITION",
                   "UNUSED_OBJECT /accessors/1", "UNUSED_OBJECT /accessors/2",
                   "UNUSED_OBJECT /bufferViews/1", "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosAccessor, WithAnUnknownTypeHasNoComponents) {
  EXPECT_EQ(khronos_links(R"("accessors": [{"bufferView": 0, "byteOffset": 8, "componentType": 5126,
    "type": "VEC5", "count": 2}], "bufferViews": [{"buffer": 0, "byteLength": 4}],
    "buffers": [{"byteLength": 4}])"),
            (Lines{"VALUE_NOT_IN_LIST /accessors/0/type",
                   "ACCESSOR_TOO_LONG /accessors/0/byteOffset", "UNUSED_OBJECT /accessors/0"}));
}

TEST(KhronosAccessor, SparsePartsAreFollowedTogether) {
  EXPECT_EQ(khronos_links(R"("accessors": [{"componentType": 5126, "type": "SCALAR", "count": 2,
    "sparse": {"count": 0, "indices": {"bufferView": 9, "componentType": 5121},
    "values": {"bufferView": 0}}}, {"componentType": 5126, "type": "SCALAR",
    "count": 2, "sparse": {"count": 3, "indices": {"bufferView": 9,
    "componentType": 3}, "values": {"bufferView": 9}}}],
    "bufferViews": [{"buffer": 0, "byteLength": 4}], "buffers": [{"byteLength": 4}])"),
            (Lines{"VALUE_NOT_IN_RANGE /accessors/0/sparse/count",
                   "VALUE_NOT_IN_LIST /accessors/1/sparse/indices/componentType",
                   "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE /accessors/1/sparse/count",
                   "UNRESOLVED_REFERENCE /accessors/1/sparse/indices/bufferView",
                   "UNRESOLVED_REFERENCE /accessors/1/sparse/values/bufferView",
                   "UNUSED_OBJECT /accessors/0", "UNUSED_OBJECT /accessors/1",
                   "UNUSED_OBJECT /bufferViews/0"}));
}

TEST(KhronosAnimation, NeedsBothListsToBeFollowed) {
  EXPECT_EQ(khronos_links(
                R"("accessors": [{"componentType": 5126, "type": "SCALAR", "count": 2, "min": [0],
    "max": [1]}], "nodes": [{"extras": {}}], "animations": [{"channels": [],
    "samplers": [{"input": 0, "output": 9}]}, {"channels": [{"sampler": 9,
    "target": {"node": 0, "path": "scale"}}]}])"),
            (Lines{"EMPTY_ENTITY /animations/0/channels", "UNDEFINED_PROPERTY /animations/1",
                   "UNUSED_OBJECT /accessors/0", "UNUSED_OBJECT /nodes/0"}));
}

TEST(KhronosAnimation, PointersAreToldWithoutSamplers) {
  EXPECT_EQ(
      khronos_links(R"("extensionsUsed": ["KHR_animation_pointer"], "animations": [{"samplers": 3,
    "channels": [{"sampler": 0, "target": {"path": 3,
    "extensions": {"KHR_animation_pointer": {"pointer": "/nodes"}}}}]}])"),
      (Lines{"TYPE_MISMATCH /animations/0/channels/0/target/path",
             "TYPE_MISMATCH /animations/0/samplers",
             "INCOMPLETE_EXTENSION_SUPPORT "
             "/animations/0/channels/0/target/extensions/KHR_animation_pointer",
             "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH "
             "/animations/0/channels/0/target/extensions/KHR_animation_pointer"}));
}

TEST(KhronosAnimation, AccessorsWithoutAFormatHaveTheWrongOne) {
  EXPECT_EQ(
      khronos_links(R"("accessors": [{"componentType": 5126, "count": 2}, {"componentType": 5126,
    "type": "SCALAR", "count": "a"}], "nodes": [{"extras": {}}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 0,
    "path": "scale"}}], "samplers": [{"input": 0, "output": 0}]},
    {"channels": [{"sampler": 0, "target": {"path": "x"}}],
    "samplers": [{"input": 1, "output": 1, "interpolation": "CUBICSPLINE"}]}],
    "skins": [{"joints": [0], "inverseBindMatrices": 1}])"),
      (Lines{"UNDEFINED_PROPERTY /accessors/0", "TYPE_MISMATCH /accessors/1/count",
             "VALUE_NOT_IN_LIST /animations/1/channels/0/target/path",
             "SKIN_IBM_INVALID_FORMAT /skins/0/inverseBindMatrices",
             "INVALID_IBM_ACCESSOR_COUNT /skins/0/inverseBindMatrices",
             "ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT /animations/0/samplers/0/input",
             "ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS /animations/0/samplers/0/input",
             "ACCESSOR_USAGE_OVERRIDE /animations/0/samplers/0/output",
             "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT /animations/0/channels/0/sampler",
             "ACCESSOR_USAGE_OVERRIDE /animations/1/samplers/0/input",
             "ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS /animations/1/samplers/0/input",
             "ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS /animations/1/samplers/0/input",
             "ACCESSOR_USAGE_OVERRIDE /animations/1/samplers/0/output", "UNUSED_OBJECT /skins/0"}));
}

TEST(KhronosAnimation, EveryPairOfTargetsIsTold) {
  EXPECT_EQ(khronos_links(
                R"("accessors": [{"componentType": 5126, "type": "SCALAR", "count": 2, "min": [0],
    "max": [1]}], "animations": [{"channels": [{"sampler": 9, "target": {"node": 9,
    "path": "x"}}, {"sampler": 9, "target": {"node": 9, "path": "x"}},
    {"target": {"node": 9, "path": "x"}}], "samplers": [{"input": 0, "output": 0}]}])"),
            (Lines{"VALUE_NOT_IN_LIST /animations/0/channels/0/target/path",
                   "VALUE_NOT_IN_LIST /animations/0/channels/1/target/path",
                   "UNDEFINED_PROPERTY /animations/0/channels/2",
                   "VALUE_NOT_IN_LIST /animations/0/channels/2/target/path",
                   "ACCESSOR_USAGE_OVERRIDE /animations/0/samplers/0/output",
                   "UNRESOLVED_REFERENCE /animations/0/channels/0/target/node",
                   "UNRESOLVED_REFERENCE /animations/0/channels/0/sampler",
                   "ANIMATION_DUPLICATE_TARGETS /animations/0/channels/0/target",
                   "ANIMATION_DUPLICATE_TARGETS /animations/0/channels/0/target",
                   "UNRESOLVED_REFERENCE /animations/0/channels/1/target/node",
                   "UNRESOLVED_REFERENCE /animations/0/channels/1/sampler",
                   "ANIMATION_DUPLICATE_TARGETS /animations/0/channels/1/target",
                   "UNRESOLVED_REFERENCE /animations/0/channels/2/target/node",
                   "UNUSED_OBJECT /animations/0/channels/samplers/0"}));
}

TEST(KhronosSkin, CommonRootsAreSoughtAnewBehindNone) {
  EXPECT_EQ(khronos_links(R"("nodes": [{"extras": {}}, {"children": [2]}, {}],
    "skins": [{"joints": [0, 1, 2], "skeleton": 1}, {"joints": [1, 0]},
    {"skeleton": 0}])"),
            (Lines{"UNDEFINED_PROPERTY /skins/2", "SKIN_NO_COMMON_ROOT /skins/1/joints",
                   "SKIN_SKELETON_INVALID /skins/2/skeleton", "UNUSED_OBJECT /skins/0",
                   "UNUSED_OBJECT /skins/1", "UNUSED_OBJECT /skins/2"}));
}

TEST(KhronosSkin, CountsWithoutAMesh) {
  EXPECT_EQ(khronos_links(R"("nodes": [{"skin": 0, "mesh": 3, "scale": [1, 1, 2]}, {}],
    "skins": [{"joints": [1]}])"),
            (Lines{"UNRESOLVED_REFERENCE /nodes/0/mesh", "NODE_EMPTY /nodes/0",
                   "NODE_SKINNED_MESH_LOCAL_TRANSFORMS /nodes/0", "UNUSED_OBJECT /nodes/0"}));
}

TEST(KhronosLinks, BrokenReferencesComeInTheirTurn) {
  EXPECT_EQ(
      khronos_links(R"("scene": 7, "scenes": [{"nodes": [9, 1]}], "nodes": [{"children": [1, 8, 1],
    "mesh": 9, "camera": 9}, {}],
    "meshes": [{"primitives": [{"attributes": {"TEXCOORD_0": 0, "POSITION": 9},
    "indices": 9, "material": 9}]}], "accessors": [{"bufferView": 9,
    "componentType": 5126, "type": "VEC2", "count": 1}], "textures": [{"sampler": 9,
    "source": 9}], "materials": [{"normalTexture": {"index": 9},
    "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 9}}}],
    "bufferViews": [{"buffer": 9, "byteLength": 4}])"),
      (Lines{
          "DUPLICATE_ELEMENTS /nodes/0/children/2",
          "UNRESOLVED_REFERENCE /scene",
          "UNRESOLVED_REFERENCE /bufferViews/0/buffer",
          "UNRESOLVED_REFERENCE /accessors/0/bufferView",
          "UNRESOLVED_REFERENCE /textures/0/source",
          "UNRESOLVED_REFERENCE /textures/0/sampler",
          "UNRESOLVED_REFERENCE /materials/0/pbrMetallicRoughness/metallicRoughnessTexture/index",
          "UNRESOLVED_REFERENCE /materials/0/normalTexture/index",
          "UNRESOLVED_REFERENCE /meshes/0/primitives/0/attributes/POSITION",
          "UNRESOLVED_REFERENCE /meshes/0/primitives/0/indices",
          "MESH_PRIMITIVE_INCOMPATIBLE_MODE /meshes/0/primitives/0",
          "UNRESOLVED_REFERENCE /meshes/0/primitives/0/material",
          "UNUSED_OBJECT /meshes/0/primitives/0/attributes/TEXCOORD_0",
          "UNRESOLVED_REFERENCE /nodes/0/camera",
          "UNRESOLVED_REFERENCE /nodes/0/mesh",
          "UNRESOLVED_REFERENCE /nodes/0/children/1",
          "NODE_PARENT_OVERRIDE /nodes/0/children/2",
          "UNRESOLVED_REFERENCE /scenes/0/nodes/0",
          "SCENE_NON_ROOT_NODE /scenes/0/nodes/1",
          "NODE_EMPTY /nodes/1",
          "UNUSED_OBJECT /bufferViews/0",
          "UNUSED_OBJECT /materials/0",
          "UNUSED_OBJECT /meshes/0",
          "UNUSED_OBJECT /nodes/0",
          "UNUSED_OBJECT /textures/0"}));
}

TEST(KhronosLinks, OffsetsThatCannotBeReadLieBeforeTheStart) {
  EXPECT_EQ(
      khronos_links(R"("accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR",
    "count": 9}, {"bufferView": 1, "byteOffset": 2, "componentType": 5126,
    "type": "SCALAR", "count": 9}], "bufferViews": [{"buffer": 0, "byteLength": 5,
    "byteOffset": "a"}, {"buffer": 0, "byteLength": 6, "byteOffset": "a"},
    {"buffer": 0, "byteOffset": 5}], "buffers": [{"byteLength": 4}])"),
      (Lines{"TYPE_MISMATCH /bufferViews/0/byteOffset", "TYPE_MISMATCH /bufferViews/1/byteOffset",
             "UNDEFINED_PROPERTY /bufferViews/2", "BUFFER_VIEW_TOO_LONG /bufferViews/1/byteLength",
             "BUFFER_VIEW_TOO_LONG /bufferViews/2/byteOffset",
             "ACCESSOR_OFFSET_ALIGNMENT /accessors/1/byteOffset", "UNUSED_OBJECT /accessors/0",
             "UNUSED_OBJECT /accessors/1", "UNUSED_OBJECT /bufferViews/2"}));
}

TEST(KhronosLinks, WeightsOfAMeshWithoutPrimitivesAreOverridden) {
  EXPECT_EQ(
      khronos_links(R"("nodes": [{"mesh": 0}], "meshes": [{"weights": [1], "primitives": 3}])"),
      (Lines{"TYPE_MISMATCH /meshes/0/primitives", "UNUSED_OBJECT /nodes/0",
             "UNUSED_MESH_WEIGHTS /meshes/0/weights"}));
}

}  // namespace
}  // namespace gltfx::test
