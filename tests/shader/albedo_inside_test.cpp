// SPDX-License-Identifier: Apache-2.0
#include "shader/albedo_inside.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace gltfx::shader {
namespace {

// The table holds isotropic lobes: the least anisotropy is summed, by fewer points.
TEST(ShareInside, OfTheTableIsThatOfASum) {
  double apart = 0;
  int count = 0;
  for (const double ior : {1.1, 1.33, 1.5}) {
    for (const double roughness : {0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0}) {
      for (const double specular : {0.3, 1.0}) {
        for (double cosine = 0.02; cosine <= 1; cosine += 0.049) {
          Material material;
          material.ior = ior;
          material.specular = specular;
          const Fresnel fresnel = dielectric_fresnel(material, 1 / ior, ShaderMode::conserving);
          const Vec3d v(std::sqrt(1 - cosine * cosine), 0, cosine);
          const Microfacets facets = microfacets(roughness);
          Microfacets summed = facets;
          summed.alpha_t *= 1 + 1e-12;
          const double difference =
              share_inside(fresnel, facets, v).x - share_inside(fresnel, summed, v).x;
          EXPECT_NEAR(difference, 0, 0.08) << ior << ", " << roughness << ", " << cosine;
          apart += std::fabs(difference);
          ++count;
        }
      }
    }
  }
  EXPECT_LT(apart / count, 0.012);
}

}  // namespace
}  // namespace gltfx::shader
