// SPDX-License-Identifier: Apache-2.0
// Values outside the lists that the specification closes.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

struct Case {
  std::string members;  ///< members of the root object
  std::string pointer;
};

// One value per list, in the core and in the extensions.
std::vector<Case> outsiders() {
  const auto accessor = [](const std::string& members) {
    return R"("accessors": [{"count": 1, )" + members + "}]";
  };
  const auto animation = [](const std::string& sampler, const std::string& target) {
    return R"("animations": [{"samplers": [{"input": 0, "output": 0)" + sampler +
           R"(}], "channels": [{"sampler": 0, "target": {)" + target + "}}]}]";
  };
  const auto extension = [](const std::string& name, const std::string& members) {
    return R"("extensionsUsed": [")" + name + "\"], " + members;
  };
  const auto root = [&](const std::string& name, const std::string& object) {
    return extension(name, R"("extensions": {")" + name + "\": " + object + "}");
  };
  const auto view = [&](const std::string& name, const std::string& members) {
    return extension(
        name, R"("buffers": [{"byteLength": 16}], "bufferViews": [{"buffer": 0, "byteLength": 16,
        "extensions": {")" +
                  name + R"(": {"buffer": 0, "byteLength": 16, "byteStride": 4, "count": 4, )" +
                  members + "}}}]");
  };
  const auto splats = [&](const std::string& members) {
    return extension("KHR_gaussian_splatting",
                     R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0},
        "mode": 0, "extensions": {"KHR_gaussian_splatting": {)" +
                         members + "}}}]}]");
  };
  const std::string on_view = "/bufferViews/0/extensions/";
  const std::string on_splat = "/meshes/0/primitives/0/extensions/KHR_gaussian_splatting/";
  return {
      {accessor(R"("componentType": 0, "type": "SCALAR")"), "/accessors/0/componentType"},
      {accessor(R"("componentType": 5124, "type": "SCALAR")"), "/accessors/0/componentType"},
      {accessor(R"("componentType": 5126, "type": "VEC5")"), "/accessors/0/type"},
      {accessor(R"("componentType": 5126, "type": "vec3")"), "/accessors/0/type"},
      {accessor(R"("componentType": 5126, "type": "SCALAR", "sparse": {"count": 1, "indices":
          {"bufferView": 0, "componentType": 5126}, "values": {"bufferView": 0}})"),
       "/accessors/0/sparse/indices/componentType"},
      {animation(R"(, "interpolation": "CUBIC")", R"("path": "scale")"),
       "/animations/0/samplers/0/interpolation"},
      {animation("", R"("path": "colour")"), "/animations/0/channels/0/target/path"},
      {animation("", R"("path": "pointer")"), "/animations/0/channels/0/target/path"},
      {R"("bufferViews": [{"buffer": 0, "byteLength": 1, "target": 34964}])",
       "/bufferViews/0/target"},
      {R"("cameras": [{"type": "fisheye"}])", "/cameras/0/type"},
      {R"("images": [{"bufferView": 0, "mimeType": "image/jpg"}])", "/images/0/mimeType"},
      {R"("images": [{"bufferView": 0, "mimeType": "image/webp"}])", "/images/0/mimeType"},
      {R"("materials": [{"alphaMode": "TRANSPARENT"}])", "/materials/0/alphaMode"},
      {R"("samplers": [{"magFilter": 9984}])", "/samplers/0/magFilter"},
      {R"("samplers": [{"minFilter": 0}])", "/samplers/0/minFilter"},
      {R"("samplers": [{"wrapS": 33069}])", "/samplers/0/wrapS"},
      {R"("samplers": [{"wrapT": 10496}])", "/samplers/0/wrapT"},
      {root("KHR_lights_punctual", R"({"lights": [{"type": "area"}]})"),
       "/extensions/KHR_lights_punctual/lights/0/type"},
      {root("KHR_interactivity", R"({"graphs": [{"types": [{"signature": "string"}]}]})"),
       "/extensions/KHR_interactivity/graphs/0/types/0/signature"},
      {view("KHR_meshopt_compression", R"("mode": "VERTICES")"),
       on_view + "KHR_meshopt_compression/mode"},
      {view("KHR_meshopt_compression", R"("mode": "ATTRIBUTES", "filter": "NORMAL")"),
       on_view + "KHR_meshopt_compression/filter"},
      {view("EXT_meshopt_compression", R"("mode": "ATTRIBUTES", "filter": "COLOR")"),
       on_view + "EXT_meshopt_compression/filter"},
      {splats(R"("kernel": "box", "colorSpace": "srgb_rec709_display")"), on_splat + "kernel"},
      {splats(R"("kernel": "ellipse", "colorSpace": "adobe")"), on_splat + "colorSpace"},
      {splats(
           R"("kernel": "ellipse", "colorSpace": "srgb_rec709_display", "projection": "fisheye")"),
       on_splat + "projection"},
  };
}

std::optional<Diagnostic> finding_at(const Case& each, Profile profile) {
  ValidateOptions options;
  options.profile = profile;
  options.select = {"VALUE_NOT_IN_LIST"};
  const FileReport report = validate_bytes(asset_with(each.members), "test", options);
  for (const Diagnostic& found : report.diagnostics) {
    if (found.pointer == each.pointer) return found;
  }
  return std::nullopt;
}

TEST(ClosedLists, AValueOutsideIsAnError) {
  for (const Case& each : outsiders()) {
    for (const Profile profile : {Profile::standard, Profile::strict}) {
      const auto found = finding_at(each, profile);
      ASSERT_TRUE(found) << each.members;
      EXPECT_EQ(found->severity, Severity::error) << each.members;
    }
    const auto khronos = finding_at(each, Profile::khronos);
    if (!khronos) continue;  // an extension that the Khronos validator does not support
    EXPECT_EQ(khronos->severity, Severity::warning) << each.members;
  }
}

TEST(ClosedLists, OfPrimitivesTheModeIsARange) {
  const std::string asset =
      asset_with(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 7}]}])");
  EXPECT_EQ(places(asset, "VALUE_NOT_IN_RANGE"), Lines{"/meshes/0/primitives/0/mode"});
}

TEST(ClosedLists, WhatADeclaredExtensionAddsIsListed) {
  const auto found = [](const std::string& extension, const std::string& members) {
    return places(asset_with(R"("extensionsUsed": [")" + extension + "\"], " + members),
                  "VALUE_NOT_IN_LIST");
  };
  const std::string target =
      R"("animations": [{"samplers": [{}], "channels": [{"sampler": 0, "target": {"path": "pointer"}}]}])";
  EXPECT_EQ(found("KHR_animation_pointer", target), Lines{});
  EXPECT_EQ(found("KHR_texture_basisu", target).size(), 1U);
  const std::string doubles =
      R"("accessors": [{"count": 1, "componentType": 5130, "type": "SCALAR"}])";
  EXPECT_EQ(found("KHR_accessor_float64", doubles), Lines{});
  EXPECT_EQ(found("KHR_materials_unlit", doubles), Lines{"/accessors/0/componentType"});
  const auto image = [](const std::string& type) {
    return R"("images": [{"bufferView": 0, "mimeType": ")" + type + "\"}]";
  };
  EXPECT_EQ(found("EXT_texture_webp", image("image/webp")), Lines{});
  EXPECT_EQ(found("KHR_texture_basisu", image("image/ktx2")), Lines{});
  EXPECT_EQ(found("MSFT_texture_dds", image("image/vnd-ms.dds")), Lines{});
  EXPECT_EQ(found("NV_materials_mdl", image("image/x-exr")), Lines{});
  EXPECT_EQ(found("EXT_texture_webp", image("image/ktx2")), Lines{"/images/0/mimeType"});
}

TEST(ClosedLists, AnExtensionOfWhichNothingIsKnownMayAddAValueButNoMisspeltOne) {
  const auto found = [](const std::string& mode, const std::string& extension = "ACME_glass") {
    return finding_at({R"("extensionsUsed": [")" + extension +
                           R"("], "materials": [{"alphaMode": ")" + mode + "\"}]",
                       "/materials/0/alphaMode"},
                      Profile::standard);
  };
  const auto added = found("REFRACT");
  ASSERT_TRUE(added);
  EXPECT_EQ(added->severity, Severity::warning);
  EXPECT_NE(added->help.find("'ACME_glass'"), std::string::npos) << added->help;
  const auto misspelt = found("BLENDED");
  ASSERT_TRUE(misspelt);
  EXPECT_EQ(misspelt->severity, Severity::error);
  EXPECT_EQ(misspelt->help, "did you mean 'BLEND'?");
  for (const char* const name : {"VRM", "EXT_mesh_bmesh", "KHR_Texture_Transform"}) {
    const auto known = found("REFRACT", name);
    ASSERT_TRUE(known) << name;
    EXPECT_EQ(known->severity, Severity::error) << name << " adds no values";
  }
}

}  // namespace
}  // namespace gltfx::test
