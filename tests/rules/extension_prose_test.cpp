// SPDX-License-Identifier: Apache-2.0
// Requirements of extension texts that their schemas do not state: which extensions may be
// required, names that belong together, repeats, and what joints, gravity, shapes and sounds need
// from other objects.
#include <gtest/gtest.h>

#include "model/packed_bytes.hpp"
#include "rules/part.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

TEST(Required, NotWhereEverythingHasAFallback) {
  const auto textures = [](const std::string& list, const std::string& extension) {
    const std::string name = "\"" + extension + "\"";
    return findings(R"("extensionsUsed": [)" + name + R"(], "extensionsRequired": [)" + name +
                        R"(], "textures": [)" + list + R"(], "images": [{}, {}])",
                    {"EXTENSION_REQUIRED", "NON_REQUIRED"});
  };
  const std::string both = R"({"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}})";
  const std::string alone = R"({"extensions": {"EXT_texture_webp": {"source": 1}}})";
  const Lines needless{"EXTENSION_REQUIRED_WITH_FALLBACK /extensionsUsed/0"};
  EXPECT_EQ(textures(both, "EXT_texture_webp"), needless);
  EXPECT_EQ(textures(alone, "EXT_texture_webp"), Lines{});
  EXPECT_EQ(textures(both + "," + alone, "EXT_texture_webp"), Lines{});
  EXPECT_EQ(textures(R"({"source": 0, "extensions": {"KHR_texture_basisu": {"source": 1}}})",
                     "KHR_texture_basisu"),
            Lines{})
      << "of which the text says nothing";
  EXPECT_EQ(textures(R"({"source": 0, "extensions": {"EXT_texture_avif": {"source": 1}}})",
                     "EXT_texture_avif"),
            Lines{});
  EXPECT_EQ(findings(R"("extensionsUsed": ["EXT_texture_avif"], "images": [{}],
                        "textures": [{"extensions": {"EXT_texture_avif": {"source": 0}}}])",
                     {"NON_REQUIRED"}),
            Lines{"NON_REQUIRED_EXTENSION /textures/0/extensions/EXT_texture_avif"});
}

Lines packed_lines(const std::string& attributes, const std::string& ids,
                   const std::string& more = {}) {
  return findings(R"("extensionsUsed": ["KHR_draco_mesh_compression"], )" + more +
                      R"("meshes": [{"primitives": [{"attributes": {)" + attributes +
                      R"(}, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0,
    "attributes": {)" +
                      ids +
                      R"(}}}}]}],
    "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3},
     {"type": "VEC3", "componentType": 5126, "count": 3, "bufferView": 0}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}])",
                  {"DRACO_ATTRIBUTE_ID", "DRACO_COPY"});
}
const std::string kPacked = " /meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";

TEST(Draco, EachAttributeHasItsOwnIdentifier) {
  const std::string both = R"("POSITION": 0, "NORMAL": 0)";
  EXPECT_EQ(packed_lines(both, R"("POSITION": 0, "NORMAL": 1)"), Lines{});
  EXPECT_EQ(packed_lines(both, R"("POSITION": 1, "NORMAL": 1)"),
            Lines{"DRACO_ATTRIBUTE_ID_REPEATED" + kPacked + "/attributes/NORMAL"});
}

TEST(Draco, RequiredGeometryNeedsNoPlainCopy) {
  const std::string required = R"("extensionsRequired": ["KHR_draco_mesh_compression"], )";
  EXPECT_EQ(packed_lines(R"("POSITION": 0)", R"("POSITION": 0)", required), Lines{});
  EXPECT_EQ(packed_lines(R"("POSITION": 1)", R"("POSITION": 0)", required),
            Lines{"DRACO_COPY_UNREAD" + kPacked});
  EXPECT_EQ(packed_lines(R"("POSITION": 1)", R"("POSITION": 0)"), Lines{}) << "which is a fallback";
  EXPECT_EQ(packed_lines(R"("POSITION": 0, "_MORE": 1)", R"("POSITION": 0)", required), Lines{})
      << "what is not compressed is read as it is";
}

Lines grouped(const std::string& first, const std::string& second) {
  const std::string begin = R"({"mode": 5, "attributes": {"POSITION": 0}, "indices": 1)";
  return findings(R"("extensionsUsed": ["EXT_mesh_primitive_restart"],
    "meshes": [{"primitives": [)" +
                      begin + first + "}, " + begin + second + R"(}],
    "extensions": {"EXT_mesh_primitive_restart": {"primitiveGroups": [{"primitives": [0, 1], "indices": 1}]}}}],
    "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3}, {"type": "SCALAR", "componentType": 5123, "count": 3}])",
                  {"RESTART"});
}

TEST(Restart, PrimitivesOfAGroupAreAlikeInEverything) {
  const std::string place =
      " /meshes/0/extensions/EXT_mesh_primitive_restart/primitiveGroups/0/primitives/1";
  const Lines wrong{"RESTART_PRIMITIVES_DIFFER" + place};
  EXPECT_EQ(grouped("", ""), Lines{});
  EXPECT_EQ(grouped(R"(, "extensions": {"A_x": {"a": [1, 2]}})",
                    R"(, "extensions": {"A_x": {"a": [1.0, 2]}})"),
            Lines{});
  EXPECT_EQ(grouped(R"(, "extensions": {"A_x": {"a": [1, 2]}})",
                    R"(, "extensions": {"A_x": {"a": [1, 3]}})"),
            wrong);
  EXPECT_EQ(grouped("", R"(, "extensions": {"A_x": {}})"), wrong);
  EXPECT_EQ(grouped(R"(, "extras": 1)", ""), wrong);
}

Lines technique(const std::string& technique, const std::string& values) {
  return findings(R"("extensionsUsed": ["KHR_techniques_webgl"],
    "materials": [{"extensions": {"KHR_techniques_webgl": {"technique": 0, "values": {)" +
                      values + R"(}}}}],
    "extensions": {"KHR_techniques_webgl": {"programs": [], "shaders": [], "techniques": [{)" +
                      technique + "}]}}",
                  {"TECHNIQUE"});
}

TEST(Techniques, EveryUniformHasAValue) {
  const std::string at = " /materials/0/extensions/KHR_techniques_webgl";
  const Lines missing{"TECHNIQUE_VALUE_MISSING" + at};
  EXPECT_EQ(technique(R"("uniforms": {"u": {"type": 5126}})", R"("u": 1)"), Lines{});
  EXPECT_EQ(technique(R"("uniforms": {"u": {"type": 5126}})", ""), missing);
  EXPECT_EQ(technique(R"("uniforms": {"u": {"type": 5126, "value": 2}})", ""), Lines{});
  EXPECT_EQ(technique(R"("uniforms": {"u": {"type": 35676, "node": 0}})", ""), Lines{});
  EXPECT_EQ(technique(R"("uniforms": {"u": {"type": 35676, "semantic": "MODEL"}})", ""), Lines{});
  EXPECT_EQ(technique("", R"("u": 1)"), Lines{"TECHNIQUE_VALUE_UNKNOWN" + at + "/values/u"});
}

TEST(Techniques, MeaningsAreKnownOrBeginWithAnUnderscore) {
  const auto uniform = [](const std::string& semantic) {
    return technique(R"("uniforms": {"u": {"type": 35676, "semantic": ")" + semantic + "\"}}", "");
  };
  const auto attribute = [](const std::string& semantic) {
    return technique(R"("attributes": {"a": {"semantic": ")" + semantic + "\"}}", "");
  };
  const std::string at = " /extensions/KHR_techniques_webgl/techniques/0/";
  const Lines wrong{"TECHNIQUE_SEMANTIC_UNKNOWN" + at + "uniforms/u/semantic"};
  EXPECT_EQ(uniform("MODELVIEWINVERSETRANSPOSE"), Lines{});
  EXPECT_EQ(uniform("_WIND"), Lines{});
  EXPECT_EQ(uniform("WIND"), wrong);
  EXPECT_EQ(uniform("POSITION"), wrong);
  EXPECT_EQ(attribute("POSITION"), Lines{});
  EXPECT_EQ(attribute("TEXCOORD_12"), Lines{});
  EXPECT_EQ(attribute("WEIGHT"), Lines{});
  EXPECT_EQ(attribute("TEXCOORD_"),
            Lines{"TECHNIQUE_SEMANTIC_UNKNOWN" + at + "attributes/a/semantic"});
  EXPECT_EQ(attribute("MODEL"), Lines{"TECHNIQUE_SEMANTIC_UNKNOWN" + at + "attributes/a/semantic"});
}

TEST(Mdl, ArgumentsHaveNamesOfTheirOwn) {
  const auto arguments = [](const std::string& names) {
    return findings(R"("extensionsUsed": ["NV_materials_mdl"], "extensions": {"NV_materials_mdl":
      {"functionCalls": [{"functionName": "f", "type": {"typeName": "material"}, "arguments": [)" +
                        names + "]}]}}",
                    {"NAME_REPEATED", "UNDEFINED_PROPERTY"});
  };
  const std::string a = R"({"name": "a", "type": {"typeName": "int"}, "value": 1})";
  EXPECT_EQ(arguments(a), Lines{});
  EXPECT_EQ(arguments(a + "," + a),
            Lines{"NAME_REPEATED /extensions/NV_materials_mdl/functionCalls/0/arguments/1/name"});
}

TEST(Mdl, ModulesInTheTextHaveAPath) {
  const auto module = [](const std::string& members) {
    return findings(R"("extensionsUsed": ["NV_materials_mdl"], "extensions": {"NV_materials_mdl":
      {"modules": [{)" + members +
                        "}]}}",
                    {"UNDEFINED_PROPERTY"});
  };
  EXPECT_EQ(module(R"("uri": "wood.mdl")"), Lines{});
  EXPECT_EQ(module(R"("uri": "data:application/vnd.mdl;base64,AAAA", "modulePath": "::wood")"),
            Lines{});
  EXPECT_EQ(module(R"("uri": "data:application/vnd.mdl;base64,AAAA")"),
            Lines{"UNDEFINED_PROPERTY /extensions/NV_materials_mdl/modules/0"});
}

TEST(Quantization, ScalesAllAxesAlike) {
  const auto node = [](const std::string& scale, const std::string& component,
                       const std::string& normal = R"(, "NORMAL": 1)") {
    return findings(R"("extensionsUsed": ["KHR_mesh_quantization"],
      "nodes": [{"mesh": 0, "scale": )" +
                        scale + R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0)" +
                        normal + R"(}}]}],
      "accessors": [{"type": "VEC3", "componentType": )" +
                        component +
                        R"(, "count": 3}, {"type": "VEC3", "componentType": 5126, "count": 3}])",
                    {"QUANTIZED"}, Profile::strict);
  };
  const Lines wrong{"QUANTIZED_MESH_SCALE_NOT_UNIFORM /nodes/0/scale"};
  EXPECT_EQ(node("[1, 2, 1]", "5122"), wrong);
  EXPECT_EQ(node("[1, 1, 2]", "5121"), wrong);
  EXPECT_EQ(node("[2, -2, 2]", "5122"), Lines{}) << "mirrored";
  EXPECT_EQ(node("[1, 2, 1]", "5126"), Lines{}) << "not quantised";
  EXPECT_EQ(node("[1, 2, 1]", "5122", ""), Lines{}) << "no vectors on the surface";
}

TEST(Anisotropy, NeedsATangentSpaceWithoutATextureToo) {
  const auto shown = [](const std::string& strength, const std::string& attributes) {
    return findings(R"("extensionsUsed": ["KHR_materials_anisotropy"],
      "materials": [{"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": )" +
                        strength + R"(}}}],
      "meshes": [{"primitives": [{"material": 0, "attributes": {)" +
                        attributes + R"(}}]}],
      "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3}, {"type": "VEC4", "componentType": 5126, "count": 3}])",
                    {"MESH_PRIMITIVE_NO_TANGENT", "UNUSED_MESH_TANGENT"});
  };
  const std::string whole = R"("POSITION": 0, "NORMAL": 0, "TANGENT": 1)";
  EXPECT_EQ(shown("1", whole), Lines{});
  EXPECT_EQ(shown("1", R"("POSITION": 0, "NORMAL": 0)"),
            Lines{"MESH_PRIMITIVE_NO_TANGENT_SPACE /meshes/0/primitives/0/material"});
  EXPECT_EQ(shown("0", R"("POSITION": 0, "NORMAL": 0)"), Lines{}) << "which has no direction";
}

TEST(Languages, StandUnderNumbers) {
  const auto title = [](const std::string& members) {
    return findings(R"("extensionsUsed": ["KHR_xmp_json_ld"], "extensions": {"KHR_xmp_json_ld":
      {"packets": [{"@context": {"dc": "http://a", "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#"},
        "@id": "", "dc:title": {"@type": "rdf:Alt", )" +
                        members + "}}]}}",
                    {"XMP"});
  };
  EXPECT_EQ(title(R"("rdf:_1": {"@language": "en", "@value": "x"})"), Lines{});
  EXPECT_EQ(title(R"("@set": ["x"])"),
            Lines{"XMP_LANGUAGE_INVALID /extensions/KHR_xmp_json_ld/packets/0/dc:title/@set"});
}

// --- Requirements of bodies and sounds on other objects ---

std::string body_node(const std::string& members, const std::string& more = {}) {
  return R"({"extensions": {"OMI_physics_body": {)" + members + "}}" + more + "}";
}
std::string moving(const std::string& type, const std::string& more = {}) {
  return body_node(R"("motion": {"type": ")" + type + "\"}", more);
}

// --- Joints ---

// Node 0 is the parent of node 1, which has the joint; node 2 is the parent of node 3, which it is
// connected to.
Lines joint(const std::string& above, const std::string& other) {
  return findings(
      R"("extensionsUsed": ["OMI_physics_body", "OMI_physics_joint"],
     "extensions": {"OMI_physics_joint": {"physicsJoints": [{}]}}, "nodes": [)" +
          above + R"(, {"extensions": {"OMI_physics_joint": {"joint": 0, "connectedNode": 3}}}, )" +
          other + ", {}]",
      {"JOINT_"});
}
const std::string kChild = R"(, "children": [1])";
const std::string kOtherChild = R"(, "children": [3])";
const std::string kJoint = "JOINT_WITHOUT_BODY /nodes/1/extensions/OMI_physics_joint";

TEST(Joint, ConnectsADynamicBodyWithAny) {
  EXPECT_EQ(joint(moving("dynamic", kChild), moving("static", kOtherChild)), Lines{});
  EXPECT_EQ(joint(moving("dynamic", kChild), moving("dynamic", kOtherChild)), Lines{});
  EXPECT_EQ(joint(moving("kinematic", kChild), moving("dynamic", kOtherChild)), Lines{kJoint});
  EXPECT_EQ(joint(moving("dynamic"), moving("dynamic", kOtherChild)), Lines{kJoint});
  EXPECT_EQ(joint(moving("dynamic", kChild), moving("dynamic")), Lines{kJoint + "/connectedNode"});
}

TEST(Joint, HasNoEffectWhenNeitherSideMoves) {
  const auto sides = [](const std::string& one, const std::string& other) {
    const std::string motion = R"({"KHR_physics_rigid_bodies": {"motion": {}}})";
    const auto node = [&](const std::string& side, const std::string& child) {
      return R"({"children": [)" + child + "]" +
             (side.empty() ? "" : R"(, "extensions": )" + motion) + "}";
    };
    return findings(
        R"("extensionsUsed": ["KHR_physics_rigid_bodies"], "extensions":
        {"KHR_physics_rigid_bodies": {"physicsJoints": [{}]}}, "nodes": [)" +
            node(one, "1") + R"(, {"extensions": {"KHR_physics_rigid_bodies": {"joint":
        {"connectedNode": 3, "joint": 0}}}}, )" +
            node(other, "3") + ", {}]",
        {"JOINT_"});
  };
  EXPECT_EQ(sides("moves", ""), Lines{});
  EXPECT_EQ(sides("", "moves"), Lines{});
  EXPECT_EQ(sides("", ""),
            Lines{"JOINT_WITHOUT_BODY /nodes/1/extensions/KHR_physics_rigid_bodies/joint"});
}

// --- Gravity ---

Lines gravity(const std::string& nodes) {
  return findings(
      R"("extensionsUsed": ["OMI_physics_body", "OMI_physics_gravity"], "nodes": [)" + nodes + "]",
      {"GRAVITY_"});
}
std::string pulling(const std::string& members, const std::string& line = {}) {
  return R"({"extensions": {"OMI_physics_body": {)" + members +
         R"(}, "OMI_physics_gravity": {"type": "line", "gravity": 1, "line": {"points": [)" +
         (line.empty() ? "0, 0, 0, 0, 0, 1" : line) + "]}}}}";
}
const std::string kGravity = "/nodes/0/extensions/OMI_physics_gravity";

TEST(Gravity, IsOnATriggerOfItsOwn) {
  const Lines wrong{"GRAVITY_WITHOUT_TRIGGER " + kGravity};
  EXPECT_EQ(gravity(pulling(R"("trigger": {})")), Lines{});
  EXPECT_EQ(gravity(pulling("")), wrong);
  EXPECT_EQ(gravity(pulling(R"("trigger": {}, "motion": {"type": "static"})")), wrong);
  EXPECT_EQ(gravity(pulling(R"("trigger": {}, "collider": {})")), wrong);
  const std::string compound = body_node(R"("trigger": {"nodes": [0]})", R"(, "children": [0])");
  EXPECT_EQ(gravity(pulling(R"("trigger": {})") + ", " + compound), wrong);
}

TEST(Gravity, HasThreeNumbersForEachPointOfALine) {
  const Lines wrong{"GRAVITY_LINE_LENGTH " + kGravity + "/line/points"};
  EXPECT_EQ(gravity(pulling(R"("trigger": {})", "0, 0, 0, 0, 0, 1, 0")), wrong);
  EXPECT_EQ(gravity(pulling(R"("trigger": {})", "0, 0, 0, 0, 0, 1, 0, 1, 1")), Lines{});
}

// --- Shapes ---

TEST(Shape, OfAMeshHasTriangles) {
  const auto shape = [](const std::string& type, const std::string& modes) {
    return findings(R"("extensionsUsed": ["OMI_physics_shape"], "extensions": {"OMI_physics_shape":
      {"shapes": [{"type": ")" +
                        type + R"(", ")" + type +
                        R"(": {"mesh": 0}}]}}, "meshes": [{"primitives": [)" + modes + "]}]",
                    {"SHAPE_"});
  };
  const std::string triangles = R"({"attributes": {}}, {"attributes": {}, "mode": 5})";
  const std::string lines = R"(, {"attributes": {}, "mode": 1})";
  EXPECT_EQ(shape("trimesh", triangles), Lines{});
  for (const std::string type : {"trimesh", "convex"}) {
    EXPECT_EQ(
        shape(type, triangles + lines),
        Lines{"SHAPE_WITHOUT_TRIANGLES /extensions/OMI_physics_shape/shapes/0/" + type + "/mesh"});
  }
}

// --- Sounds ---

// One source that refers to MP3 directly, and to `audio` through `extension`, if there is one.
Lines sound(const std::string& audio, const std::string& extension = {}) {
  const std::string source =
      extension.empty() ? R"({"audio": 1})"
                        : R"({"audio": 0, "extensions": {")" + extension + R"(": {"audio": 1}}})";
  return findings(R"("extensionsUsed": ["KHR_audio_emitter", "OMI_audio_opus",
      "OMI_audio_ogg_vorbis"], "extensions": {"KHR_audio_emitter": {"audio": [{"uri": "a.mp3"}, {)" +
                      audio + R"(}], "sources": [)" + source + R"(], "emitters": []}})",
                  {"AUDIO_MIME"});
}
Lines wrong_sound(const std::string& member) {
  return {"AUDIO_MIME_TYPE_INVALID /extensions/KHR_audio_emitter/audio/1/" + member};
}

TEST(Sound, IsOfTheTypeThatTheReferringExtensionAllows) {
  const auto of_type = [](const std::string& type, const std::string& extension = {}) {
    return sound(R"("bufferView": 0, "mimeType": ")" + type + "\"", extension);
  };
  const Lines wrong = wrong_sound("mimeType");
  EXPECT_EQ(of_type("audio/mpeg"), Lines{});
  EXPECT_EQ(of_type("audio/wav"), wrong);
  EXPECT_EQ(of_type("audio/ogg"), wrong);
  EXPECT_EQ(of_type("audio/ogg", "OMI_audio_ogg_vorbis"), Lines{});
  EXPECT_EQ(of_type("audio/mpeg", "OMI_audio_ogg_vorbis"), wrong);
  EXPECT_EQ(of_type("audio/opus", "OMI_audio_opus"), Lines{});
  EXPECT_EQ(of_type("video/webm", "OMI_audio_opus"), Lines{});
  EXPECT_EQ(of_type("audio/ogg", "OMI_audio_opus"), wrong);
}

TEST(Sound, IsToldByTheNameOfItsFileWhereNothingElseTells) {
  const auto of_name = [](const std::string& name, const std::string& extension = {}) {
    return sound(R"("uri": ")" + name + "\"", extension);
  };
  EXPECT_EQ(of_name("a.ogg", "OMI_audio_ogg_vorbis"), Lines{});
  EXPECT_EQ(of_name("a.oga", "OMI_audio_ogg_vorbis"), wrong_sound("uri"));
  EXPECT_EQ(of_name("a.opus", "OMI_audio_opus"), Lines{});
  EXPECT_EQ(of_name("a.webm", "OMI_audio_opus"), Lines{});
  EXPECT_EQ(of_name("a.ogg", "OMI_audio_opus"), wrong_sound("uri"));
  EXPECT_EQ(of_name("data:audio/opus;base64,AAAA", "OMI_audio_opus"), Lines{});
  EXPECT_EQ(of_name("a.bin"), Lines{});  // the text of KHR_audio_emitter does not require a name
}

}  // namespace
}  // namespace gltfx::test
