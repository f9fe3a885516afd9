// SPDX-License-Identifier: Apache-2.0
// Extensions: declarations, hosts, relations, requirements.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/findings.hpp"
#include "schema/leaf.hpp"

namespace gltfx::test {
namespace {

using schema::kKhronosValidator;
using testing::Contains;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string on_material(const std::string& names, const std::string& extensions) {
  return asset_using(names, R"("materials": [{"extensions": {)" + extensions + "}}]");
}
const std::string kAt = "/materials/0/extensions/";

TEST(Declaration, MissingIsToldAtEachObjectAndTheContentIsStillJudged) {
  const std::string json = material(R"("extensions": {"KHR_materials_ior": {"ior": "x"}})");
  EXPECT_THAT(verdict(json), ElementsAre("UNDECLARED_EXTENSION " + kAt + "KHR_materials_ior",
                                         "TYPE_MISMATCH " + kAt + "KHR_materials_ior/ior"));
  EXPECT_THAT(verdict(json, kKhronosValidator),
              ElementsAre("UNDECLARED_EXTENSION " + kAt + "KHR_materials_ior"));
}

TEST(Declaration, UnknownExtensionsAreSeenButNotLookedInto) {
  const std::string json =
      on_material("ACME_thing", R"("ACME_thing": {"index": 99, "extensions": 3})");
  EXPECT_THAT(verdict(json), IsEmpty());
  EXPECT_THAT(result_of(json).extensions_seen, ElementsAre("ACME_thing"));
}

TEST(Declaration, NamesAreJudgedByTheirFormAsKhronosDoes) {
  const std::string json =
      asset(R"("extensionsUsed": ["sparkle", "KHR_", "khr_a", "_a", "KHR_a-b", "A1_b"])");
  std::vector<std::string> expected;
  for (const char* const at : {"0", "1", "2", "3", "4"}) {
    expected.push_back(std::string("INVALID_EXTENSION_NAME_FORMAT /extensionsUsed/") + at);
    expected.push_back(std::string("UNSUPPORTED_EXTENSION /extensionsUsed/") + at);
  }
  expected.emplace_back("UNSUPPORTED_EXTENSION /extensionsUsed/5");
  EXPECT_THAT(verdict(json, kKhronosValidator), ElementsAreArray(expected));
  EXPECT_THAT(verdict(json), IsEmpty());  // rules after the walk report it
}

TEST(Declaration, RequiredMustBeUsed) {
  EXPECT_THAT(
      verdict(asset(R"("extensionsUsed": ["KHR_a"], "extensionsRequired": ["KHR_a", "KHR_b"])")),
      ElementsAre("UNUSED_EXTENSION_REQUIRED /extensionsRequired/1"));
}

TEST(Declaration, ListsAreHandedOver) {
  const auto result =
      result_of(asset(R"("extensionsUsed": ["KHR_a", "KHR_b"], "extensionsRequired": ["KHR_b"])"));
  EXPECT_THAT(result.extensions_used, ElementsAre("KHR_a", "KHR_b"));
  EXPECT_THAT(result.extensions_required, ElementsAre("KHR_b"));
}

TEST(Home, OtherObjectsAreRefusedAndTheRightOneNamed) {
  const Found found =
      only(asset_using("KHR_lights_punctual",
                       R"("materials": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}])"));
  EXPECT_EQ(found.code, "UNEXPECTED_EXTENSION_OBJECT");
  EXPECT_EQ(found.pointer, kAt + "KHR_lights_punctual");
  EXPECT_THAT(found.help, testing::AllOf(HasSubstr("node"), HasSubstr("glTF")));
}

TEST(Home, NameOnlyExtensionsHaveNone) {
  EXPECT_THAT(
      verdict(asset(
          R"("extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
    "meshes": [{"primitives": [{"attributes": {"_A": 0}}], "extensions": {"KHR_mesh_quantization": {}}}],
    "accessors": [{"componentType": 5126, "count": 1, "type": "VEC3"}])")),
      ElementsAre("UNEXPECTED_EXTENSION_OBJECT /meshes/0/extensions/KHR_mesh_quantization"));
}

TEST(Home, SlotsInsideExtensionsAreHomesAsWell) {
  const std::string json = asset_using("KHR_materials_clearcoat,KHR_texture_transform",
                                       R"("images": [{"uri": "a"}], "textures": [{"source": 0}],
    "materials": [{"extensions": {"KHR_materials_clearcoat": {"clearcoatNormalTexture": {"index": 0, "scale": 2,
      "extensions": {"KHR_texture_transform": {"offset": [1]}}}}}}])");
  EXPECT_THAT(verdict(json), ElementsAre("ARRAY_LENGTH_NOT_IN_LIST " + kAt +
                                         "KHR_materials_clearcoat/clearcoatNormalTexture/"
                                         "extensions/KHR_texture_transform/offset"));
}

TEST(Exclusion, IsToldOnceAPairWhicheverSaysIt) {
  const Found one = only(on_material("KHR_materials_unlit,KHR_materials_ior",
                                     R"("KHR_materials_unlit": {}, "KHR_materials_ior": {})"));
  EXPECT_EQ(one.code, "EXTENSION_EXCLUDED");
  EXPECT_THAT(one.message,
              testing::AllOf(HasSubstr("'KHR_materials_unlit'"), HasSubstr("'KHR_materials_ior'")));
  const Found other = only(on_material("KHR_materials_unlit,KHR_materials_ior",
                                       R"("KHR_materials_ior": {}, "KHR_materials_unlit": {})"));
  EXPECT_EQ(other.code, "EXTENSION_EXCLUDED");
}

TEST(Exclusion, IsNoMatterOfTheKhronosProfileWhichWarnsOfCompany) {
  const std::string json = on_material("KHR_materials_unlit,KHR_materials_ior",
                                       R"("KHR_materials_unlit": {}, "KHR_materials_ior": {})");
  EXPECT_THAT(verdict(json, kKhronosValidator),
              ElementsAre("MULTIPLE_EXTENSIONS " + kAt + "KHR_materials_unlit"));
}

TEST(Company, OfAStandaloneExtensionIsWarnedOf) {
  const std::string json =
      on_material("KHR_materials_unlit,ACME_glow", R"("KHR_materials_unlit": {}, "ACME_glow": {})");
  EXPECT_THAT(verdict(json), ElementsAre("MULTIPLE_EXTENSIONS " + kAt + "KHR_materials_unlit"));
}

TEST(Companion, MissingIsAWarningOrAnErrorAsTheFileSays) {
  const Found found = only(
      on_material("ADOBE_materials_clearcoat_tint", R"("ADOBE_materials_clearcoat_tint": {})"));
  EXPECT_EQ(found.code, "EXTENSION_COMPANION_MISSING");
  EXPECT_THAT(found.message, HasSubstr("'KHR_materials_clearcoat'"));
  for (const bool error : {false, true}) {
    const std::string words =
        std::string(R"(, "requires": [{"extension": "KHR_a", "because": "So.", "severity": ")") +
        (error ? "error" : "warning") + "\"}]";
    const auto set = set_with(acme(R"("properties": {})", words));
    ASSERT_NE(set, nullptr);
    EXPECT_EQ(only(on_material("ACME_x", R"("ACME_x": {})"), *set).is_error, error);
    EXPECT_THAT(verdict(on_material("ACME_x,KHR_a", R"("ACME_x": {}, "KHR_a": {})"), {}, *set),
                IsEmpty());
  }
}

TEST(Override, CountsOnlyWhenTheOtherHasAnEffect) {
  const auto said = [](const char* transmission) {
    return verdict(on_material(
        "KHR_materials_transmission,KHR_materials_diffuse_transmission",
        std::string(R"("KHR_materials_diffuse_transmission": {}, "KHR_materials_transmission": )") +
            transmission));
  };
  EXPECT_THAT(said(R"({"transmissionFactor": 1})"),
              ElementsAre("EXTENSION_OVERRIDDEN " + kAt + "KHR_materials_diffuse_transmission"));
  EXPECT_THAT(said(R"({"transmissionFactor": 0.0})"), IsEmpty());
  EXPECT_THAT(said("{}"), IsEmpty());
}

TEST(Requirement, OfAnExtensionThatCannotBeOptionalIsToldAtTheList) {
  EXPECT_THAT(verdict(asset(R"("extensionsUsed": ["KHR_a", "KHR_mesh_quantization"])")),
              ElementsAre("NON_REQUIRED_EXTENSION /extensionsUsed/1"));
  EXPECT_THAT(
      verdict(asset(
          R"("extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"])")),
      IsEmpty());
}

TEST(Requirement, WithoutFallbackIsToldAtTheObject) {
  const auto texture = [](const char* members, const char* required) {
    return asset(std::string(R"("extensionsUsed": ["EXT_texture_webp", "KHR_texture_basisu"], )") +
                 required + R"("images": [{"uri": "a"}], "textures": [{)" + members + "}]");
  };
  const char* webp = R"("extensions": {"EXT_texture_webp": {"source": 0}})";
  EXPECT_THAT(verdict(texture(webp, "")),
              ElementsAre("NON_REQUIRED_EXTENSION /textures/0/extensions/EXT_texture_webp"));
  EXPECT_THAT(verdict(texture(webp, R"("extensionsRequired": ["EXT_texture_webp"], )")), IsEmpty());
  EXPECT_THAT(
      verdict(texture(R"("source": 0, "extensions": {"EXT_texture_webp": {"source": 0}})", "")),
      IsEmpty());
  EXPECT_THAT(
      verdict(texture(
          R"("extensions": {"EXT_texture_webp": {"source": 0}, "KHR_texture_basisu": {"source": 0}})",
          R"("extensionsRequired": ["KHR_texture_basisu"], )")),
      IsEmpty())
      << "readers that get this far have the other one";
  EXPECT_THAT(verdict(texture(webp, ""), kKhronosValidator),
              Not(Contains("NON_REQUIRED_EXTENSION /textures/0/extensions/EXT_texture_webp")));
}

TEST(Form, ExtensionsThatAreNoObjectsAreTold) {
  EXPECT_THAT(verdict(material(R"("extensions": [])")),
              ElementsAre("TYPE_MISMATCH /materials/0/extensions"));
  EXPECT_THAT(verdict(on_material("KHR_materials_unlit", R"("KHR_materials_unlit": true)")),
              ElementsAre("TYPE_MISMATCH " + kAt + "KHR_materials_unlit"));
}

TEST(Generation, DecidesWhichChannelsASlotReads) {
  const auto channels = [](const std::string& more) {
    const auto result = result_of(asset_using(
        "KHR_materials_translucency", R"("images": [{"uri": "a"}], "textures": [{"source": 0}],
      "materials": [{"extensions": {"KHR_materials_translucency": {"translucencyTexture": {"index": 0})" +
                                          more + "}}}]"));
    EXPECT_FALSE(result.slots.empty());
    return result.slots.empty() ? std::string() : result.slots[0].slot->channels;
  };
  EXPECT_EQ(channels(""), "r") << "the first generation";
  EXPECT_EQ(channels(R"(, "translucencyColorFactor": [1, 1, 1])"), "a");
  EXPECT_EQ(channels(R"(, "translucencyColorTexture": {"index": 0})"), "a");
}

TEST(KhronosValidator, ExtensionsThatItDoesNotKnowAreUnknown) {
  const std::string json =
      on_material("KHR_materials_diffuse_transmission",
                  R"("KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 7})");
  EXPECT_THAT(verdict(json),
              ElementsAre("VALUE_NOT_IN_RANGE " + kAt +
                          "KHR_materials_diffuse_transmission/diffuseTransmissionFactor"));
  EXPECT_THAT(verdict(json, kKhronosValidator), Not(Contains(HasSubstr("VALUE_NOT_IN_RANGE"))));
}

TEST(KhronosValidator, EndsBehindAnAssetOfAnotherVersion) {
  for (const char* version : {"\"1.0\"", "\"3.0\"", "2", "\"two\""}) {
    const std::string json =
        std::string(R"({"asset": {"version": )") + version + R"(}, "materials": [], "nope": 1})";
    EXPECT_TRUE(result_of(json, kKhronosValidator).stopped_at_asset) << version;
    EXPECT_THAT(verdict(json, kKhronosValidator), Not(Contains("EMPTY_ENTITY /materials")))
        << version;
    EXPECT_THAT(verdict(json, kKhronosValidator), Contains("UNEXPECTED_PROPERTY /nope")) << version;
    EXPECT_THAT(verdict(json), Contains("EMPTY_ENTITY /materials")) << version;
  }
  EXPECT_FALSE(result_of(R"({"asset": {"version": "2.1"}})", kKhronosValidator).stopped_at_asset);
  EXPECT_TRUE(result_of("{}", kKhronosValidator).stopped_at_asset);
}

}  // namespace
}  // namespace gltfx::test
