// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

const std::string kMaterialPrimitive = "/meshes/0/primitives/0";

const std::set<std::string, std::less<>> kMaterialCodes{
    "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE", "MESH_PRIMITIVE_NO_TANGENT_SPACE",
    "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "UNUSED_MESH_TANGENT", "UNUSED_OBJECT"};

// A mesh with one primitive; its attributes are only names.
Lines of_material(const std::string& names, const std::string& materials,
                  const std::string& primitive = R"(, "material": 0)",
                  Profile profile = Profile::standard) {
  std::string attributes = R"("POSITION": 0)";
  std::string name;
  for (const char c : names + " ") {
    if (c != ' ') {
      name += c;
    } else if (!name.empty()) {
      attributes += ", \"" + name + "\": 0";
      name.clear();
    }
  }
  Lines lines = selected(
      asset_with(
          R"("extensionsUsed": ["KHR_materials_variants", "KHR_materials_clearcoat", "KHR_texture_transform"],
      "extensions": {"KHR_materials_variants": {"variants": [{"name": "a"}]}},
      "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "textures": [{}], "materials": [)" +
          materials +
          R"(], "accessors": [{"count": 3}], "meshes": [{"primitives": [{"attributes": {)" +
          attributes + "}" + primitive + "}]}]"),
      kMaterialCodes, profile);
  // Texture and variant are used by some tests only.
  std::erase(lines, "UNUSED_OBJECT /textures/0");
  std::erase(lines, "UNUSED_OBJECT /extensions/KHR_materials_variants/variants/0");
  return lines;
}

const std::string kNormalMap = R"({"normalTexture": {"index": 0}})";
const std::string kCoat =
    R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatNormalTexture": {"index": 0}}}})";
const std::string kEmission = R"({"emissiveTexture": {"index": 0}})";

TEST(TangentSpace, NormalMapsNeedNormalsAndTangents) {
  const Lines found{"MESH_PRIMITIVE_GENERATED_TANGENT_SPACE " + kMaterialPrimitive + "/material"};
  EXPECT_EQ(of_material("NORMAL TANGENT TEXCOORD_0", kNormalMap), Lines{});
  EXPECT_EQ(of_material("NORMAL TEXCOORD_0", kNormalMap), found);
  EXPECT_EQ(of_material("TANGENT TEXCOORD_0", kNormalMap), found);
  EXPECT_EQ(of_material("TEXCOORD_0", kNormalMap), found);
}

TEST(TangentSpace, OtherTexturesInTangentSpaceCannotDoWithoutIt) {
  EXPECT_EQ(of_material("NORMAL TANGENT TEXCOORD_0", kCoat), Lines{});
  EXPECT_EQ(of_material("NORMAL TEXCOORD_0", kCoat),
            Lines{"MESH_PRIMITIVE_NO_TANGENT_SPACE " + kMaterialPrimitive + "/material"});
}

TEST(TangentSpace, TangentsThatNothingReadsAreNamed) {
  const Lines found{"UNUSED_MESH_TANGENT " + kMaterialPrimitive + "/attributes/TANGENT"};
  EXPECT_EQ(of_material("NORMAL TANGENT TEXCOORD_0", kEmission), found);
  EXPECT_EQ(of_material("NORMAL TANGENT", "", ""), found);
  EXPECT_EQ(of_material("TANGENT TEXCOORD_0", kEmission), Lines{})
      << "tangents without normals are reported as that";
  EXPECT_EQ(of_material("TANGENT TEXCOORD_0", kEmission, R"(, "material": 0)", Profile::khronos),
            found);
}

TEST(TexCoords, EverySetThatATextureReadsIsThere) {
  const Lines found{"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS " + kMaterialPrimitive + "/material"};
  EXPECT_EQ(of_material("TEXCOORD_0", kEmission), Lines{});
  EXPECT_EQ(of_material("", kEmission), found);
  EXPECT_EQ(
      of_material(
          "TEXCOORD_0",
          R"({"emissiveTexture": {"index": 0}, "occlusionTexture": {"index": 0, "texCoord": 1}})"),
      found);
  EXPECT_EQ(
      of_material(
          "TEXCOORD_0 TEXCOORD_1",
          R"({"emissiveTexture": {"index": 0}, "occlusionTexture": {"index": 0, "texCoord": 1}})"),
      Lines{});
}

TEST(TexCoords, ATransformMayNameAnotherSet) {
  const std::string moved =
      R"({"emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}}})";
  EXPECT_EQ(of_material("TEXCOORD_0 TEXCOORD_1", moved), Lines{});
  EXPECT_EQ(of_material("TEXCOORD_0", moved),
            Lines{"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS " + kMaterialPrimitive + "/material"});
}

TEST(TexCoords, AWrongSetNumberIsNotLookedFor) {
  EXPECT_EQ(of_material("", R"({"emissiveTexture": {"index": 0, "texCoord": -1}})"), Lines{});
}

TEST(TexCoords, SetsThatNothingReadsAreNamed) {
  const std::string unused = "UNUSED_OBJECT " + kMaterialPrimitive + "/attributes/TEXCOORD_";
  EXPECT_EQ(of_material("TEXCOORD_0 TEXCOORD_1", kEmission), Lines{unused + "1"});
  EXPECT_EQ(of_material("TEXCOORD_0", "", ""), Lines{unused + "0"});
}

TEST(TexCoords, AGapMakesTheKhronosProfileCountNone) {
  EXPECT_EQ(of_material("TEXCOORD_0 TEXCOORD_2", kEmission),
            Lines{"UNUSED_OBJECT " + kMaterialPrimitive + "/attributes/TEXCOORD_2"});
  EXPECT_EQ(of_material("TEXCOORD_0 TEXCOORD_2", kEmission, R"(, "material": 0)", Profile::khronos),
            Lines{"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS " + kMaterialPrimitive + "/material"});
}

TEST(Variants, TheirMaterialsAreHeldAgainstThePrimitiveToo) {
  const std::string mapping =
      R"(, "extensions": {"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]}]}})";
  const std::string at =
      kMaterialPrimitive + "/extensions/KHR_materials_variants/mappings/0/material";
  EXPECT_EQ(of_material("TEXCOORD_0", kEmission, mapping), Lines{});
  EXPECT_EQ(of_material("", kEmission, mapping), Lines{"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS " + at});
  EXPECT_EQ(of_material("NORMAL TANGENT TEXCOORD_0", kNormalMap, mapping), Lines{})
      << "the tangents are for the variant";
  EXPECT_EQ(of_material("NORMAL TANGENT TEXCOORD_0", kNormalMap, mapping, Profile::khronos),
            Lines{"UNUSED_MESH_TANGENT " + kMaterialPrimitive + "/attributes/TANGENT"});
}

}  // namespace
}  // namespace gltfx::test
