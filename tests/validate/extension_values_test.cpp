// SPDX-License-Identifier: Apache-2.0
// Numbers of attributes that extensions bring: splats and instances.
#include <gtest/gtest.h>

#include "validate/data_asset.hpp"

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

}  // namespace
}  // namespace gltfx::test
