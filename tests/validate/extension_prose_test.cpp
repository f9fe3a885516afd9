// SPDX-License-Identifier: Apache-2.0
// What the texts of extensions ask beside their schemas: who may be required, which names go
// together, what repeats.
#include <gtest/gtest.h>

#include "model/packed_bytes.hpp"
#include "validate/part.hpp"
#include "validate/textured.hpp"

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
  EXPECT_EQ(node("[1, 2, 1]", "5122", ""), Lines{}) << "nothing that stands on the surface";
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

}  // namespace
}  // namespace gltfx::test
