// SPDX-License-Identifier: Apache-2.0
/// The tables of albedos against their quadratures. With GLTFX_UPDATE_TABLES set in the environment
/// the tables are rewritten.
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "albedo_integrals.hpp"
#include "random.hpp"
#include "table_file.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;

constexpr int kTableResolution = 256;

void write(const std::string& name, int rows, const std::function<double(double, double)>& value) {
  TableFile file(name);
  for (int r = 0; r < rows; ++r) {
    std::vector<double> row;
    for (int c = 0; c < kAlbedoColumns; ++c)
      row.push_back(value(row_roughness(r, rows), column_cosine(c)));
    file.row(row);
  }
}

void write_film_weights() {
  TableFile file("film_weights");
  for (int r = 0; r < kFilmRows; ++r) {
    file.open();
    for (int c = 0; c < kFilmColumns; ++c) {
      file.open();
      file.numbers(
          integrate_film_weights(row_roughness(r, kFilmRows), film_cosine(c), kTableResolution / 2)
              .at);
      file.close();
    }
    file.close();
  }
}

TEST(AlbedoTables, AreWrittenWhenAskedFor) {
  if (std::getenv("GLTFX_UPDATE_TABLES") == nullptr) GTEST_SKIP();
  const auto specular = [](double r, double c) {
    return integrate_specular_albedo(r, c, kTableResolution);
  };
  write("specular_constant", kSpecularRows,
        [&](double r, double c) { return specular(r, c).constant; });
  write("specular_rising", kSpecularRows,
        [&](double r, double c) { return specular(r, c).rising; });
  write("sheen_albedo", kSheenRows,
        [](double r, double c) { return integrate_sheen_albedo(r, c, kTableResolution); });
  write_film_weights();
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
  // A mirror: 1 - w and w, at any angle.
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
}  // namespace gltfx::shader
