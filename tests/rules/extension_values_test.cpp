// SPDX-License-Identifier: Apache-2.0
// Numbers of attributes of extensions: splats and instances.
#include <gtest/gtest.h>

#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

Lines values(const std::string& asset, Profile profile = Profile::standard) {
  return selected(asset,
                  {"SPLAT_ROTATION_NON_UNIT", "SPLAT_SCALE_NEGATIVE", "SPLAT_OPACITY_OUT_OF_RANGE",
                   "INSTANCING_ROTATION_NON_UNIT", "ACCESSOR_INVALID_FLOAT"},
                  profile);
}

std::string splat(const std::string& name, const std::string& type, Component component,
                  const std::string& bytes, const std::string& more = {}) {
  DataAsset asset;
  asset.accessor(type, component, 1, bytes, more);
  return asset.text(R"("extensionsUsed": ["KHR_gaussian_splatting"], )" +
                    mesh("\"KHR_gaussian_splatting:" + name + "\": 0", R"(, "mode": 0)"));
}
std::string at(const std::string& name) {
  return " /meshes/0/primitives/0/attributes/KHR_gaussian_splatting:" + name;
}

TEST(Splats, RotationsAreUnitQuaternions) {
  EXPECT_EQ(values(splat("ROTATION", "VEC4", kFloat, floats({0, 0.6F, 0, 0.8F}))), Lines());
  EXPECT_EQ(values(splat("ROTATION", "VEC4", kFloat, floats({0, 0.6F, 0, 0.6F}))),
            Lines{"SPLAT_ROTATION_NON_UNIT" + at("ROTATION")});
  const std::string normalized = R"(, "normalized": true)";
  EXPECT_EQ(
      values(splat("ROTATION", "VEC4", kInt8, packed<std::int8_t>({0, 75, 0, 101}), normalized)),
      Lines());
  EXPECT_EQ(
      values(splat("ROTATION", "VEC4", kInt8, packed<std::int8_t>({0, 70, 0, 90}), normalized)),
      Lines{"SPLAT_ROTATION_NON_UNIT" + at("ROTATION")});
}

TEST(Splats, ScalesAreLengths) {
  EXPECT_EQ(values(splat("SCALE", "VEC3", kFloat, floats({0, 1, 200}))), Lines());
  EXPECT_EQ(values(splat("SCALE", "VEC3", kFloat, floats({-4.5F, -4, -5}))),
            Lines{"SPLAT_SCALE_NEGATIVE" + at("SCALE") + " x3"});
}

TEST(Splats, OpacitiesLieBetweenZeroAndOne) {
  EXPECT_EQ(values(splat("OPACITY", "SCALAR", kFloat, floats({1}))), Lines());
  for (const float wrong : {-0.01F, 1.01F}) {
    EXPECT_EQ(values(splat("OPACITY", "SCALAR", kFloat, floats({wrong}))),
              Lines{"SPLAT_OPACITY_OUT_OF_RANGE" + at("OPACITY")});
  }
}

TEST(Splats, InAFormatThatTheyCannotHaveAreNotLookedInto) {
  EXPECT_EQ(values(splat("OPACITY", "SCALAR", kInt16, packed<std::int16_t>({-5}))), Lines());
}

std::string instance(const std::string& name, const std::string& type, Component component,
                     const std::string& bytes, const std::string& more = {}) {
  DataAsset asset;
  asset.accessor(type, component, 1, bytes, more);
  return asset.text(R"("extensionsUsed": ["EXT_mesh_gpu_instancing"],
    "nodes": [{}, {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {")" +
                    name + R"(": 0}}}}])");
}

TEST(Instances, RotationsAreUnitQuaternions) {
  const Lines wrong{
      "INSTANCING_ROTATION_NON_UNIT "
      "/nodes/1/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION"};
  EXPECT_EQ(values(instance("ROTATION", "VEC4", kFloat, floats({0, 0, 0, 1}))), Lines());
  EXPECT_EQ(values(instance("ROTATION", "VEC4", kFloat, floats({0, 0, 0, 0}))), wrong);
  EXPECT_EQ(values(instance("ROTATION", "VEC4", kInt16, packed<std::int16_t>({0, 0, 0, 30000}),
                            R"(, "normalized": true)")),
            wrong);
  EXPECT_EQ(values(instance("SCALE", "VEC3", kFloat, floats({0, 0, -9}))), Lines());
  EXPECT_EQ(values(instance("ROTATION", "VEC4", kFloat, floats({0, 0, 0, 0})), Profile::khronos),
            Lines());
}

TEST(Instances, TranslationsAreFinite) {
  EXPECT_EQ(
      values(instance("TRANSLATION", "VEC3", kFloat, packed<std::uint32_t>({0, 0x7f800000U, 0}))),
      Lines{"ACCESSOR_INVALID_FLOAT /accessors/0"});
}

// An animation of the property of a pointer, with two keyframes.
Lines pointed(const std::string& pointer, const std::string& type, const std::string& output,
              const std::string& interpolation = "LINEAR") {
  DataAsset asset;
  asset.accessor("SCALAR", kFloat, 2, floats({0, 1}), R"(, "min": [0], "max": [1])");
  const std::size_t count = output.size() / 4 / (type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4);
  asset.accessor(type, kFloat, count, output);
  const std::string text = asset.text(R"("extensionsUsed": ["KHR_animation_pointer"],
    "materials": [{"emissiveFactor": [0, 0, 0], "alphaCutoff": 0.5,
      "extensions": {"KHR_materials_ior": {}}}], "nodes": [{"rotation": [0, 0, 0, 1]}],
    "animations": [{"channels": [{"sampler": 0, "target": {"path": "pointer",
      "extensions": {"KHR_animation_pointer": {"pointer": ")" +
                                      pointer + R"("}}}}],
      "samplers": [{"input": 0, "output": 1, "interpolation": ")" +
                                      interpolation + R"("}]}])");
  return selected(text, {"ANIMATION_POINTER_OUTPUT_OUT_OF_RANGE",
                         "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION"});
}

TEST(PointedValues, StayWithinTheRangeOfTheirProperty) {
  const Lines wrong{"ANIMATION_POINTER_OUTPUT_OUT_OF_RANGE /animations/0/channels/0/sampler"};
  const std::string cutoff = "/materials/0/alphaCutoff", glow = "/materials/0/emissiveFactor";
  EXPECT_EQ(pointed(cutoff, "SCALAR", floats({0, 1})), Lines());
  EXPECT_EQ(pointed(cutoff, "SCALAR", floats({0, -0.1F})), wrong);
  EXPECT_EQ(pointed(glow, "VEC3", floats({0, 1, 0, 1, 0, 1})), Lines());
  EXPECT_EQ(pointed(glow, "VEC3", floats({0, 1, 0, 1, 0, 1.5F})), wrong);
  // Tangents of splines are not values.
  EXPECT_EQ(pointed(cutoff, "SCALAR", floats({-9, 1, 9, 9, 0, -9}), "CUBICSPLINE"), Lines());
  EXPECT_EQ(pointed(glow, "VEC3", floats({-9, -9, -9, 0, 1, 0, 9, 9, 9, 9, 9, 9, 1, 2, 1, 9, 9, 9}),
                    "CUBICSPLINE"),
            wrong);
}

TEST(PointedValues, MayBeLessFreeThanThoseAtRest) {
  const Lines wrong{"ANIMATION_POINTER_OUTPUT_OUT_OF_RANGE /animations/0/channels/0/sampler"};
  const std::string ior = "/materials/0/extensions/KHR_materials_ior/ior";
  EXPECT_EQ(pointed(ior, "SCALAR", floats({1, 2.4F})), Lines());
  EXPECT_EQ(pointed(ior, "SCALAR", floats({1, 0.5F})), wrong);
  EXPECT_EQ(pointed(ior, "SCALAR", floats({0, 1.5F})), wrong) << "0 has a meaning at rest only";
}

TEST(PointedValues, RotationsAreUnitQuaternions) {
  EXPECT_EQ(pointed("/nodes/0/rotation", "VEC4", floats({0, 0, 0, 1, 0, 1, 0, 0})), Lines());
  EXPECT_EQ(pointed("/nodes/0/rotation", "VEC4", floats({0, 0, 0, 1, 0, 1, 0, 1})),
            Lines{"ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION "
                  "/animations/0/channels/0/sampler"});
}

}  // namespace
}  // namespace gltfx::test
