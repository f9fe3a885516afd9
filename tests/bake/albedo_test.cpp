// SPDX-License-Identifier: Apache-2.0
/// The tables of albedos against their quadratures. With GLTFX_UPDATE_TABLES set in the environment
/// the tables are written anew (format them afterwards, build again).
#include <cstdlib>
#include <fstream>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "albedo_integrals.hpp"
#include "random.hpp"

namespace gltfx::bake {
namespace {

using test::Chance;

constexpr int kTableResolution = 256;

std::string table(const std::string& type, const std::string& name, int rows,
                  const std::function<double(double, double)>& value) {
  std::string text = fmt::format("const std::array<AlbedoRow, {}> {}{{{{\n", type, name);
  for (int r = 0; r < rows; ++r) {
    text += "    {";
    for (int c = 0; c < kAlbedoColumns; ++c) {
      text += fmt::format("{:.5f}F{}", value(row_roughness(r, rows), column_cosine(c)),
                          c + 1 < kAlbedoColumns ? ", " : "");
    }
    text += "},\n";
  }
  return text + "}};\n";
}

void write(const std::string& file, const std::string& what, const std::string& tables) {
  std::ofstream(fmt::format("{}/libgltfx/bake/{}", GLTFX_SOURCE_DIR, file))
      << "// SPDX-License-Identifier: Apache-2.0\n// " << what
      << " Written by tests/bake/albedo_test.cpp: do not edit.\n#include \"bake/albedo.hpp\"\n\n"
      << "namespace gltfx::bake {\n\n"
      << tables << "\n}  // namespace gltfx::bake\n";
}

TEST(AlbedoTables, AreWrittenWhenAskedFor) {
  if (std::getenv("GLTFX_UPDATE_TABLES") == nullptr) GTEST_SKIP();
  const auto specular = [](double r, double c) {
    return integrate_specular_albedo(r, c, kTableResolution);
  };
  write("albedo_specular.cpp", "What specular_brdf reflects.",
        table("kSpecularRows", "kSpecularConstant", kSpecularRows,
              [&](double r, double c) { return specular(r, c).constant; }) +
            "\n" +
            table("kSpecularRows", "kSpecularRising", kSpecularRows,
                  [&](double r, double c) { return specular(r, c).rising; }));
  write("albedo_sheen.cpp", "What sheen_brdf reflects.",
        table("kSheenRows", "kSheenAlbedo", kSheenRows,
              [](double r, double c) { return integrate_sheen_albedo(r, c, kTableResolution); }));
}

TEST(AlbedoTables, AgreeWithTheQuadrature) {
  Chance chance(51);
  for (int i = 0; i < 60; ++i) {
    const double roughness = chance.between(0.1, 1);
    const double cosine = chance.between(0.1, 1);
    const SpecularAlbedo exact = integrate_specular_albedo(roughness, cosine, 96);
    const SpecularAlbedo read = SpecularCurve(roughness).at(cosine);
    EXPECT_NEAR(read.constant, exact.constant, 6e-4) << roughness << " " << cosine;
    EXPECT_NEAR(read.rising, exact.rising, 3e-4) << roughness << " " << cosine;
    EXPECT_NEAR(SheenCurve(roughness).at(cosine), integrate_sheen_albedo(roughness, cosine, 96),
                3e-4)
        << roughness << " " << cosine;
    EXPECT_NEAR(diffuse_fresnel(cosine), integrate_diffuse_fresnel(cosine, 96), 2e-5);
  }
}

TEST(AlbedoTables, EndsAreReached) {
  // A mirror: 1 - w and w, whatever the angle.
  for (const double cosine : {0.2, 0.6, 1.0}) {
    const double w = std::pow(1 - cosine, 5);
    EXPECT_NEAR(SpecularCurve(0).at(cosine).constant, 1 - w, 1e-3);
    EXPECT_NEAR(SpecularCurve(0).at(cosine).rising, w, 1e-3);
  }
  EXPECT_NEAR(SpecularCurve(1).at(1).constant + SpecularCurve(1).at(1).rising, 1 - std::log(2.0),
              1e-4);  // the integral can be done by hand there
  EXPECT_NEAR(SheenCurve(0).at(0.9), 0, 1e-4);
}

}  // namespace
}  // namespace gltfx::bake
