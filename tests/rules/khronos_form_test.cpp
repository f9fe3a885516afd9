// SPDX-License-Identifier: Apache-2.0
// The Khronos validator's findings on members that it cannot read and on incomplete lists, and the
// checks that it then skips.
#include <gtest/gtest.h>

#include "part.hpp"

namespace gltfx::test {
namespace {

Lines khronos(const std::string& members) { return verdict(asset(members), Profile::khronos); }

TEST(KhronosMember, BrokenIndexOfAnAttributeStaysInTheMap) {
  EXPECT_EQ(khronos(R"("accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}],
    "meshes": [{"primitives": [{"attributes": {"?": "a", "POSITION": 1.5,
    "COLOR_1": 0}}]}])"),
            (Lines{"MESH_PRIMITIVE_INVALID_ATTRIBUTE /meshes/0/primitives/0/attributes/?",
                   "INVALID_INDEX /meshes/0/primitives/0/attributes/?",
                   "INVALID_INDEX /meshes/0/primitives/0/attributes/POSITION",
                   "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY /meshes/0/primitives/0/attributes",
                   "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosMember, NullIsABrokenValueAndNone) {
  EXPECT_EQ(khronos(R"("bufferViews": [{"buffer": null, "byteLength": 1}],
    "buffers": [{"byteLength": 1}])"),
            (Lines{"TYPE_MISMATCH /bufferViews/0/buffer", "UNDEFINED_PROPERTY /bufferViews/0",
                   "UNUSED_OBJECT /buffers/0", "UNUSED_OBJECT /bufferViews/0"}));
}

TEST(KhronosMember, IndexOfARequiredMemberIsNotMissedTwice) {
  EXPECT_EQ(khronos(R"("meshes": [{"primitives": {}}], "skins": [{"joints": []}])"),
            (Lines{"TYPE_MISMATCH /meshes/0/primitives", "EMPTY_ENTITY /skins/0/joints",
                   "UNUSED_OBJECT /meshes/0", "UNUSED_OBJECT /skins/0"}));
}

TEST(KhronosMember, DependencyCountsOnlyWhatCanBeRead) {
  EXPECT_EQ(khronos(R"("nodes": [{"skin": 0.5}, {"mesh": [], "weights": [1]}, {"weights": ["a"]}],
    "accessors": [{"bufferView": "a", "byteOffset": "b", "componentType": 5126,
    "type": "SCALAR", "count": 1}])"),
            (Lines{"TYPE_MISMATCH /accessors/0/bufferView",
                   "UNSATISFIED_DEPENDENCY /accessors/0/byteOffset", "TYPE_MISMATCH /nodes/0/skin",
                   "TYPE_MISMATCH /nodes/1/mesh", "UNSATISFIED_DEPENDENCY /nodes/1/weights",
                   "ARRAY_TYPE_MISMATCH /nodes/2/weights", "NODE_EMPTY /nodes/0",
                   "NODE_EMPTY /nodes/1", "NODE_EMPTY /nodes/2", "UNUSED_OBJECT /accessors/0",
                   "UNUSED_OBJECT /nodes/0", "UNUSED_OBJECT /nodes/1", "UNUSED_OBJECT /nodes/2"}));
}

TEST(KhronosMember, CutoffIsThereEvenWhenItCannotBeRead) {
  EXPECT_EQ(khronos(R"("materials": [{"alphaCutoff": "a"}])"),
            (Lines{"TYPE_MISMATCH /materials/0/alphaCutoff",
                   "MATERIAL_ALPHA_CUTOFF_INVALID_MODE /materials/0/alphaCutoff",
                   "UNUSED_OBJECT /materials/0"}));
}

TEST(KhronosMember, OneOfTwoThatCannotBeReadIsNone) {
  EXPECT_EQ(
      khronos(R"("images": [{"uri": 3}, {"bufferView": 0, "mimeType": 3}])"),
      (Lines{"TYPE_MISMATCH /images/0/uri", "ONE_OF_MISMATCH /images/0",
             "TYPE_MISMATCH /images/1/mimeType", "UNSATISFIED_DEPENDENCY /images/1/bufferView",
             "UNRESOLVED_REFERENCE /images/1/bufferView", "UNUSED_OBJECT /images/0",
             "UNUSED_OBJECT /images/1"}));
}

TEST(KhronosMember, NullLeavesTheDefault) {
  EXPECT_EQ(
      khronos(R"("accessors": [{"bufferView": 0, "byteOffset": null, "componentType": 5126,
    "type": "SCALAR", "count": 2}], "bufferViews": [{"buffer": 0,
    "byteOffset": null, "byteLength": 6}], "buffers": [{"byteLength": 4}],
    "materials": [{"alphaMode": null, "alphaCutoff": null}],
    "meshes": [{"primitives": [{"mode": null, "attributes": {"POSITION": 0}}]}])"),
      (Lines{"TYPE_MISMATCH /accessors/0/byteOffset", "TYPE_MISMATCH /bufferViews/0/byteOffset",
             "TYPE_MISMATCH /materials/0/alphaMode", "TYPE_MISMATCH /materials/0/alphaCutoff",
             "MATERIAL_ALPHA_CUTOFF_INVALID_MODE /materials/0/alphaCutoff",
             "TYPE_MISMATCH /meshes/0/primitives/0/mode",
             "BUFFER_VIEW_TOO_LONG /bufferViews/0/byteLength", "ACCESSOR_TOO_LONG /accessors/0",
             "BUFFER_VIEW_TARGET_MISSING /meshes/0/primitives/0/attributes/POSITION",
             "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS "
             "/meshes/0/primitives/0/attributes/POSITION",
             "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT "
             "/meshes/0/primitives/0/attributes/POSITION",
             "MESH_PRIMITIVE_INCOMPATIBLE_MODE /meshes/0/primitives/0",
             "UNUSED_OBJECT /materials/0", "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosList, WithSomethingElseInItIsNotReadAtAll) {
  EXPECT_EQ(khronos(R"("meshes": [{"primitives": [3, {"attributes": 3}]}],
    "animations": [{"channels": [{"sampler": "a"}, null], "samplers": [{}]}])"),
            (Lines{"ARRAY_TYPE_MISMATCH /animations/0/channels",
                   "UNDEFINED_PROPERTY /animations/0/samplers/0",
                   "UNDEFINED_PROPERTY /animations/0/samplers/0",
                   "ARRAY_TYPE_MISMATCH /meshes/0/primitives", "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosList, OfMorphTargetsIsReadToTheEnd) {
  EXPECT_EQ(khronos(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": [3, {},
    {"JOINTS_0": "a"}]}]}])"),
            (Lines{"ARRAY_TYPE_MISMATCH /meshes/0/primitives/0/targets",
                   "EMPTY_ENTITY /meshes/0/primitives/0/targets/1",
                   "MESH_PRIMITIVE_INVALID_ATTRIBUTE /meshes/0/primitives/0/targets/2/JOINTS_0",
                   "INVALID_INDEX /meshes/0/primitives/0/targets/2/JOINTS_0",
                   "UNRESOLVED_REFERENCE /meshes/0/primitives/0/attributes/POSITION",
                   "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosList, OfNamesIsVoidWhenOneIsNone) {
  EXPECT_EQ(khronos(R"("extensionsUsed": ["KHR_materials_unlit", 3],
    "materials": [{"extensions": {"KHR_materials_unlit": {}}}])"),
            (Lines{"ARRAY_TYPE_MISMATCH /extensionsUsed/1",
                   "UNDECLARED_EXTENSION /materials/0/extensions/KHR_materials_unlit",
                   "UNUSED_OBJECT /materials/0"}));
}

TEST(KhronosList, RepeatsCountOnlyAmongWhatBelongsThere) {
  EXPECT_EQ(
      khronos(R"("nodes": [{"children": [-1, -1, 9, 9]}])"),
      (Lines{"INVALID_INDEX /nodes/0/children/0", "INVALID_INDEX /nodes/0/children/1",
             "DUPLICATE_ELEMENTS /nodes/0/children/3", "UNRESOLVED_REFERENCE /nodes/0/children/2",
             "UNRESOLVED_REFERENCE /nodes/0/children/3", "UNUSED_OBJECT /nodes/0"}));
}

TEST(KhronosBound, OfIntegersHasItsLengthAndNothingElse) {
  EXPECT_EQ(khronos(R"("accessors": [{"componentType": 5121, "type": "VEC2", "count": 1, "min": [],
    "max": [1, 300]}, {"componentType": 5121, "type": "VEC2", "count": 1,
    "min": [1.5, "a"], "max": [1]}])"),
            (Lines{"ARRAY_LENGTH_NOT_IN_LIST /accessors/0/min", "INVALID_GL_VALUE /accessors/0/max",
                   "ARRAY_TYPE_MISMATCH /accessors/1/min", "ARRAY_TYPE_MISMATCH /accessors/1/min",
                   "ARRAY_LENGTH_NOT_IN_LIST /accessors/1/max", "UNUSED_OBJECT /accessors/0",
                   "UNUSED_OBJECT /accessors/1"}));
}

TEST(KhronosBound, OfFloatsMayBeEmptyFirst) {
  EXPECT_EQ(khronos(R"("accessors": [{"componentType": 5126, "type": "VEC2", "count": 1, "min": [],
    "max": ["a"]}, {"componentType": 5126, "type": "VEC2", "count": 1,
    "max": ["a", 1]}])"),
            (Lines{"EMPTY_ENTITY /accessors/0/min", "ARRAY_LENGTH_NOT_IN_LIST /accessors/0/max",
                   "ARRAY_TYPE_MISMATCH /accessors/1/max", "UNUSED_OBJECT /accessors/0",
                   "UNUSED_OBJECT /accessors/1"}));
}

TEST(KhronosBound, IsNotReadWithoutAType) {
  EXPECT_EQ(
      khronos(R"("accessors": [{"componentType": 5126, "type": "VEC5", "count": 1, "min": 3},
    {"componentType": 3, "type": "VEC2", "count": 1, "max": 3}])"),
      (Lines{"VALUE_NOT_IN_LIST /accessors/0/type", "VALUE_NOT_IN_LIST /accessors/1/componentType",
             "UNUSED_OBJECT /accessors/0", "UNUSED_OBJECT /accessors/1"}));
}

TEST(KhronosExtension, ThatIsNoObjectHasNoMembers) {
  EXPECT_EQ(khronos(R"("extensionsUsed": ["KHR_lights_punctual"],
    "nodes": [{"extensions": {"KHR_lights_punctual": 3}},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "extensions": {"KHR_lights_punctual": 3, "X_y": 3})"),
            (Lines{"TYPE_MISMATCH /nodes/0/extensions/KHR_lights_punctual",
                   "UNDEFINED_PROPERTY /nodes/0/extensions/KHR_lights_punctual",
                   "TYPE_MISMATCH /extensions/KHR_lights_punctual",
                   "UNDEFINED_PROPERTY /extensions/KHR_lights_punctual",
                   "TYPE_MISMATCH /extensions/X_y", "UNDECLARED_EXTENSION /extensions/X_y",
                   "UNRESOLVED_REFERENCE /nodes/1/extensions/KHR_lights_punctual/light",
                   "UNUSED_OBJECT /nodes/0", "UNUSED_OBJECT /nodes/1"}));
}

TEST(KhronosExtension, StandsAloneAsFarAsTheTextGoes) {
  EXPECT_EQ(khronos(R"("extensionsUsed": ["KHR_materials_unlit", "KHR_lights_punctual"],
    "materials": [{"extensions": {"KHR_lights_punctual": 1,
    "KHR_materials_unlit": 1}}])"),
            (Lines{"TYPE_MISMATCH /materials/0/extensions/KHR_lights_punctual",
                   "UNEXPECTED_EXTENSION_OBJECT /materials/0/extensions/KHR_lights_punctual",
                   "TYPE_MISMATCH /materials/0/extensions/KHR_materials_unlit",
                   "MULTIPLE_EXTENSIONS /materials/0/extensions/KHR_materials_unlit",
                   "UNUSED_OBJECT /materials/0"}));
}

TEST(KhronosExtension, MappingsNeedTheListOfVariants) {
  EXPECT_EQ(khronos(R"("extensionsUsed": ["KHR_materials_variants"],
    "meshes": [{"primitives": [{"attributes": {"_A": 9},
    "extensions": {"KHR_materials_variants": {"mappings": [{"variants": [0],
    "material": 9}]}}}]}])"),
            (Lines{"MESH_PRIMITIVE_NO_POSITION /meshes/0/primitives/0/attributes",
                   "UNSATISFIED_DEPENDENCY "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0",
                   "UNRESOLVED_REFERENCE /meshes/0/primitives/0/attributes/_A",
                   "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosExtension, VariantsAreToldOneByOne) {
  EXPECT_EQ(khronos(R"("extensionsUsed": ["KHR_materials_variants"],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "a"}]}},
    "meshes": [{"primitives": [{"attributes": {"_A": 9},
    "extensions": {"KHR_materials_variants": {"mappings": [{"variants": [0, 7, "a"],
    "material": 9}, {"variants": [0, 7], "material": 9}]}}}]}])"),
            (Lines{"MESH_PRIMITIVE_NO_POSITION /meshes/0/primitives/0/attributes",
                   "INVALID_INDEX "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/variants/2",
                   "UNRESOLVED_REFERENCE "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/variants/1",
                   "UNRESOLVED_REFERENCE "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/material",
                   "KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/1/variants/0",
                   "KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/1/variants/1",
                   "UNRESOLVED_REFERENCE "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/1/variants/1",
                   "UNRESOLVED_REFERENCE "
                   "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/1/material",
                   "UNRESOLVED_REFERENCE /meshes/0/primitives/0/attributes/_A",
                   "UNUSED_OBJECT /meshes/0"}));
}

TEST(KhronosProjection, IsOnlyReadWhenItIsNamed) {
  EXPECT_EQ(khronos(R"("cameras": [{"type": "perspective", "orthographic": {"xmag": "a"},
    "perspective": {"yfov": 4}}, {"type": 3, "perspective": 3}])"),
            (Lines{"ONE_OF_MISMATCH /cameras/0", "CAMERA_YFOV_GEQUAL_PI /cameras/0/perspective",
                   "UNDEFINED_PROPERTY /cameras/0/perspective", "TYPE_MISMATCH /cameras/1/type",
                   "UNUSED_OBJECT /cameras/0", "UNUSED_OBJECT /cameras/1"}));
}

TEST(KhronosSpot, IsOnlyReadWhenItIsNamed) {
  EXPECT_EQ(khronos(R"("extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "spot": 3,
    "range": -1}, {"type": "spot", "spot": 3}, {"type": "spot", "spot": null},
    {"type": "directional", "range": -1}]}})"),
            (Lines{"EXTRA_PROPERTY /extensions/KHR_lights_punctual/lights/0/spot",
                   "VALUE_NOT_IN_RANGE /extensions/KHR_lights_punctual/lights/0/range",
                   "TYPE_MISMATCH /extensions/KHR_lights_punctual/lights/1/spot",
                   "TYPE_MISMATCH /extensions/KHR_lights_punctual/lights/2/spot",
                   "UNDEFINED_PROPERTY /extensions/KHR_lights_punctual/lights/2",
                   "VALUE_NOT_IN_RANGE /extensions/KHR_lights_punctual/lights/3/range",
                   "UNUSED_OBJECT /extensions/KHR_lights_punctual/lights/0",
                   "UNUSED_OBJECT /extensions/KHR_lights_punctual/lights/1",
                   "UNUSED_OBJECT /extensions/KHR_lights_punctual/lights/2",
                   "UNUSED_OBJECT /extensions/KHR_lights_punctual/lights/3"}));
}

TEST(KhronosCamera, ThatIsNullIsMissingToo) {
  EXPECT_EQ(khronos(R"("cameras": [{"type": "perspective", "perspective": null}])"),
            (Lines{"TYPE_MISMATCH /cameras/0/perspective", "UNDEFINED_PROPERTY /cameras/0",
                   "UNUSED_OBJECT /cameras/0"}));
  EXPECT_EQ(khronos(R"("cameras": [{"type": "orthographic", "orthographic": null}])"),
            (Lines{"TYPE_MISMATCH /cameras/0/orthographic", "UNDEFINED_PROPERTY /cameras/0",
                   "UNUSED_OBJECT /cameras/0"}));
  EXPECT_EQ(khronos(R"("cameras": [{"type": "perspective", "perspective": 5}])"),
            (Lines{"TYPE_MISMATCH /cameras/0/perspective", "UNUSED_OBJECT /cameras/0"}));
}

}  // namespace
}  // namespace gltfx::test
