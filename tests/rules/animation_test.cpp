// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rules/part.hpp"

namespace gltfx::test {
namespace {

// Accessors: 0 two times, 1 two VEC3, 2 two VEC4, 3 four scalars, 4 six VEC3, 5 times without
// bounds, 6 one time, 7 times as integers, 8 two normalized VEC4 of SHORT, 9 two VEC4 of
// UNSIGNED_INT.
const std::string kRest = R"(, "accessors": [
  {"componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [1]},
  {"componentType": 5126, "type": "VEC3", "count": 2}, {"componentType": 5126, "type": "VEC4", "count": 2},
  {"componentType": 5126, "type": "SCALAR", "count": 4}, {"componentType": 5126, "type": "VEC3", "count": 6},
  {"componentType": 5126, "type": "SCALAR", "count": 2},
  {"componentType": 5126, "type": "SCALAR", "count": 1, "min": [0], "max": [0]},
  {"componentType": 5123, "type": "SCALAR", "count": 2, "min": [0], "max": [1]},
  {"componentType": 5122, "type": "VEC4", "count": 2, "normalized": true},
  {"componentType": 5125, "type": "VEC4", "count": 2},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0,0,0], "max": [0,0,0]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 10}, "targets": [{"POSITION": 10}, {"POSITION": 10}]}]},
  {"primitives": [{"attributes": {"POSITION": 10}}]}],
 "skins": [{"joints": [0]}],
 "nodes": [{}, {"mesh": 0}, {"mesh": 1}, {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1]},
  {"mesh": 1, "skin": 0}, {"mesh": 9}])";

Lines animation(const std::string& samplers, const std::string& channels) {
  return findings("\"animations\": [{\"samplers\": [" + samplers + "], \"channels\": [" + channels +
                      "]}]" + kRest,
                  {"ANIMATION", "UNUSED_OBJECT /animations"});
}

std::string sampler(int input, int output, const std::string& interpolation = "LINEAR") {
  return "{\"input\": " + std::to_string(input) + ", \"output\": " + std::to_string(output) +
         ", \"interpolation\": \"" + interpolation + "\"}";
}
std::string channel(int node, const std::string& path, int index = 0) {
  return "{\"sampler\": " + std::to_string(index) +
         ", \"target\": {\"node\": " + std::to_string(node) + ", \"path\": \"" + path + "\"}}";
}

TEST(Animation, TimesAreFloatsWithBounds) {
  EXPECT_EQ(animation(sampler(0, 1), channel(0, "scale")), Lines{});
  EXPECT_EQ(
      animation(sampler(5, 1), channel(0, "scale")),
      Lines{"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS /animations/0/samplers/0/input"});
  EXPECT_EQ(
      animation(sampler(7, 1), channel(0, "scale")),
      Lines{"ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT /animations/0/samplers/0/input"});
}

TEST(Animation, SplineHasTwoKeyframesAndThreeValuesForEach) {
  EXPECT_EQ(animation(sampler(0, 4, "CUBICSPLINE"), channel(0, "scale")), Lines{});
  EXPECT_EQ(
      animation(sampler(0, 1, "CUBICSPLINE"), channel(0, "scale")),
      Lines{"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT /animations/0/channels/0/sampler"});
  EXPECT_EQ(animation(sampler(6, 1, "CUBICSPLINE"), channel(0, "scale"))[0],
            "ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS /animations/0/samplers/0/input");
}

TEST(Animation, OutputFitsItsPath) {
  const Lines wrong{
      "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT /animations/0/channels/0/sampler"};
  EXPECT_EQ(animation(sampler(0, 1), channel(0, "translation")), Lines{});
  EXPECT_EQ(animation(sampler(0, 2), channel(0, "translation")), wrong);
  EXPECT_EQ(animation(sampler(0, 2), channel(0, "rotation")), Lines{});
  EXPECT_EQ(animation(sampler(0, 8), channel(0, "rotation")), Lines{});
  EXPECT_EQ(animation(sampler(0, 9), channel(0, "rotation")), wrong);
  EXPECT_EQ(animation(sampler(0, 1), channel(0, "rotation")), wrong);
}

TEST(Animation, WeightsHaveOneValueForEachMorphTarget) {
  EXPECT_EQ(animation(sampler(0, 3), channel(1, "weights")), Lines{});
  EXPECT_EQ(
      animation(sampler(0, 5), channel(1, "weights")),
      Lines{"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT /animations/0/channels/0/sampler"});
}

TEST(Animation, TargetCanBeMoved) {
  const std::string at = " /animations/0/channels/0/target";
  EXPECT_EQ(animation(sampler(0, 1), channel(3, "scale")),
            Lines{"ANIMATION_CHANNEL_TARGET_NODE_MATRIX" + at});
  EXPECT_EQ(animation(sampler(0, 1), channel(4, "scale")),
            Lines{"ANIMATION_CHANNEL_TARGET_NODE_SKIN" + at + "/path"});
  EXPECT_EQ(animation(sampler(0, 5), channel(2, "weights")),
            Lines{"ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS" + at});
  EXPECT_EQ(animation(sampler(0, 5), channel(0, "weights")),
            Lines{"ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS" + at});
  EXPECT_EQ(animation(sampler(0, 5), channel(5, "weights")), Lines{});
}

TEST(Animation, PropertyIsMovedOnce) {
  EXPECT_EQ(animation(sampler(0, 1), channel(0, "scale") + "," + channel(0, "scale")),
            Lines{"ANIMATION_DUPLICATE_TARGETS /animations/0/channels/0/target"});
  EXPECT_EQ(animation(sampler(0, 1), channel(0, "scale") + "," + channel(0, "translation") + "," +
                                         channel(1, "scale")),
            Lines{});
  const std::string free = R"({"sampler": 0, "target": {"path": "scale"}})";
  EXPECT_EQ(animation(sampler(0, 1), free + "," + free), Lines{});
}

TEST(Animation, SamplerIsUsed) {
  EXPECT_EQ(animation(sampler(0, 1) + "," + sampler(0, 1), channel(0, "scale", 1)),
            Lines{"UNUSED_OBJECT /animations/0/samplers/0"});
}

TEST(Animation, KhronosPointersStrayBehindAChannelWithoutSampler) {
  const std::string members = R"("animations": [{"samplers": [{"input": 0, "output": 1}],
    "channels": [{"target": {}}, {"target": {}}]}])" +
                              kRest;
  const std::vector<std::string_view> code{"UNUSED_OBJECT /animations"};
  EXPECT_EQ(findings(members, code), Lines{"UNUSED_OBJECT /animations/0/samplers/0"});
  const Lines astray = findings(members, code, Profile::khronos);
  ASSERT_EQ(astray.size(), 14U);
  EXPECT_EQ(astray[0], "UNUSED_OBJECT /animations/0/channels/0/samplers/0");
  EXPECT_EQ(astray[1], "UNUSED_OBJECT /animations/0/accessors/2") << "what follows strays, too";
}

std::string pointer_channel(const std::string& pointer, int index = 0) {
  return "{\"sampler\": " + std::to_string(index) +
         R"(, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": ")" +
         pointer + "\"}}}}";
}

// Accessors: 0 two times, 1 two scalars, 2 two VEC3, 3 two VEC4, 4 two bytes, 5 four scalars.
Lines pointers(const std::string& channels, const std::string& output,
               const std::string& interpolation = "LINEAR", Profile profile = Profile::standard) {
  return findings(
      R"("extensionsUsed": ["KHR_animation_pointer", "KHR_node_visibility", "KHR_texture_transform"],
 "accessors": [{"componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [1]},
  {"componentType": 5126, "type": "SCALAR", "count": 2}, {"componentType": 5126, "type": "VEC3", "count": 2},
  {"componentType": 5126, "type": "VEC4", "count": 2}, {"componentType": 5121, "type": "SCALAR", "count": 2},
  {"componentType": 5126, "type": "SCALAR", "count": 4},
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0,0,0], "max": [0,0,0]},
  {"componentType": 5126, "type": "VEC2", "count": 2}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 6}, "targets": [{"POSITION": 6}, {"POSITION": 6}]}]}],
 "nodes": [{"mesh": 0}, {"extensions": {"KHR_node_visibility": {}}}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
   "extensions": {"KHR_texture_transform": {"offset": [0, 0]}}}}, "extras": {"glow": 1}}],
 "textures": [{}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
 "animations": [{"channels": [)" +
          channels + R"(], "samplers": [{"input": 0, "output": )" + output +
          R"(, "interpolation": ")" + interpolation + "\"}]}]",
      {"ANIMATION", "KHR_ANIMATION", "INCOMPLETE", "PATTERN"}, profile);
}

const std::string kAt = " /animations/0/channels/0/target/extensions/KHR_animation_pointer";

TEST(AnimationPointer, LeadsToAPropertyThatIsThere) {
  for (const char* good :
       {"/materials/0/pbrMetallicRoughness/metallicFactor", "/materials/0/alphaCutoff",
        "/cameras/0/perspective/yfov", "/nodes/0/weights/1", "/materials/0/extras/glow"}) {
    EXPECT_EQ(pointers(pointer_channel(good), "1"), Lines{}) << good;
  }
  for (const char* bad :
       {"/materials/1/alphaCutoff", "/materials/0/alphaCutof", "/cameras/0/perspective/zfar",
        "/materials/00/alphaCutoff", "/nodes/0/weights/2", "/nodes/1/weights",
        "/materials/0/emissiveFactor/0", "/materials/0/normalTexture/scale",
        "/materials/0/extras/gloom", "/materials/0/extensions/KHR_materials_ior/ior", "/"}) {
    EXPECT_EQ(pointers(pointer_channel(bad), "1"),
              Lines{"ANIMATION_POINTER_UNRESOLVED" + kAt + "/pointer"})
        << bad;
  }
}

TEST(AnimationPointer, LeadsToSomethingThatCanChange) {
  for (const char* bad : {"/nodes/0/mesh", "/materials/0", "/materials/0/doubleSided",
                          "/nodes/0/parent", "/nodes.length", "/nodes/0/globalMatrix",
                          "/nodes/0/matrix", "/meshes/0/primitives/0/attributes/POSITION", ""}) {
    EXPECT_EQ(pointers(pointer_channel(bad), "1"),
              Lines{"ANIMATION_POINTER_NOT_MUTABLE" + kAt + "/pointer"})
        << bad;
  }
}

TEST(AnimationPointer, MalformedPointerIsReportedOnce) {
  EXPECT_EQ(pointers(pointer_channel("nodes/0/scale"), "2"),
            Lines{"PATTERN_MISMATCH" + kAt + "/pointer"});
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/sc~2ale"), "2"),
            Lines{"PATTERN_MISMATCH" + kAt + "/pointer"});
}

TEST(AnimationPointer, OutputFitsTheProperty) {
  const Lines wrong{
      "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT /animations/0/channels/0/sampler"};
  const std::string offset =
      "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/"
      "KHR_texture_transform/offset";
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/scale"), "2"), Lines{});
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/rotation"), "3"), Lines{});
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/rotation"), "2"), wrong);
  EXPECT_EQ(pointers(pointer_channel(offset), "7"), Lines{});
  EXPECT_EQ(pointers(pointer_channel(offset), "1"), wrong);
  EXPECT_EQ(pointers(pointer_channel("/materials/0/alphaCutoff"), "4"), Lines{});
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/weights"), "5"), Lines{});
  EXPECT_EQ(
      pointers(pointer_channel("/nodes/0/weights"), "1"),
      Lines{"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT /animations/0/channels/0/sampler"});
}

TEST(AnimationPointer, BooleansStepAndAreBytes) {
  const std::string visible = pointer_channel("/nodes/1/extensions/KHR_node_visibility/visible");
  EXPECT_EQ(pointers(visible, "4", "STEP"), Lines{});
  EXPECT_EQ(pointers(visible, "4"),
            Lines{"ANIMATION_POINTER_INTERPOLATION /animations/0/channels/0/sampler"});
  EXPECT_EQ(
      pointers(visible, "1", "STEP"),
      Lines{"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT /animations/0/channels/0/sampler"});
}

TEST(AnimationPointer, PropertyIsMovedOnce) {
  const std::string second =
      "ANIMATION_POINTER_DUPLICATE /animations/0/channels/1/target/extensions/"
      "KHR_animation_pointer/pointer";
  const auto both = [](const std::string& a, const std::string& b) {
    return pointer_channel(a) + "," + pointer_channel(b);
  };
  EXPECT_EQ(pointers(both("/materials/0/alphaCutoff", "/materials/0/alphaCutoff"), "1"),
            Lines{second});
  EXPECT_EQ(pointers(both("/nodes/0/weights/0", "/nodes/0/weights/1"), "1"), Lines{});
  EXPECT_EQ(pointers(both("/nodes/0/weights/0", "/nodes/0/weights/0"), "1"), Lines{second});
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/scale") + "," + channel(0, "scale"), "2"),
            Lines{"ANIMATION_POINTER_DUPLICATE" + kAt + "/pointer"});
  EXPECT_EQ(pointers(pointer_channel("/nodes/0/scale") + "," + channel(0, "translation"), "2"),
            Lines{});
}

TEST(AnimationPointer, TargetHasThePointerAlone) {
  const std::string extension =
      R"("extensions": {"KHR_animation_pointer": {"pointer": "/nodes/0/scale"}}})";
  EXPECT_EQ(
      pointers(R"({"sampler": 0, "target": {"path": "pointer", "node": 0, )" + extension + "}",
               "2"),
      Lines{"KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE" + kAt});
  EXPECT_EQ(pointers(R"({"sampler": 0, "target": {"path": "scale", )" + extension + "}", "2"),
            Lines{"KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH" + kAt});
  EXPECT_EQ(pointers(R"({"sampler": 0, "target": {"path": "pointer"}})", "2"),
            Lines{"ANIMATION_POINTER_MISSING /animations/0/channels/0/target"});
}

TEST(AnimationPointer, KhronosProfileDoesNotResolve) {
  EXPECT_EQ(pointers(pointer_channel("/nodes/9/scale"), "2", "LINEAR", Profile::khronos),
            Lines{"INCOMPLETE_EXTENSION_SUPPORT" + kAt});
}

}  // namespace
}  // namespace gltfx::test
