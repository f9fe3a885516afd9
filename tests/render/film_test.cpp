// SPDX-License-Identifier: Apache-2.0
#include "render/film.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace gltfx::render {
namespace {

TEST(Film, KeepsMeansAndErrors) {
  Film film(1, 1);
  for (const double value : {1.0, 3.0}) {
    PathSample sample;
    sample.scattered = Rgb(value);
    film.add(0, sample);
  }
  EXPECT_EQ(film.radiance(0), Rgb(2));
  EXPECT_NEAR(film.error(0), 1, 1e-6);
}

TEST(Film, WhatIsNoNumberIsLeftOut) {
  Film film(1, 1);
  PathSample sample;
  sample.scattered = Rgb(std::nan(""));
  film.add(0, sample);
  EXPECT_EQ(film.radiance(0), Rgb());
}

TEST(Film, HoldsSomeRowsOnly) {
  Film film(1, 4, {0, 2});
  PathSample sample;
  sample.scattered = Rgb(1);
  sample.features.albedo = Rgb(0.5);
  film.add(1, sample);
  FeatureSums more;
  more.add(sample);
  more.add(sample);
  film.set_features(0, more, 0);
  film.set_features(1, more, 3);
  film.hold({1, 4});
  EXPECT_EQ(film.size(), 3U);
  EXPECT_EQ(film.first_pixel(), 1U);
  EXPECT_EQ(film.radiance(1), Rgb(1));
  EXPECT_EQ(film.features(1).count, 2U);
  EXPECT_EQ(film.at(1).material, 3U);
  film.add(3, sample);
  EXPECT_EQ(film.at(2).samples, 0U);
  EXPECT_EQ(film.features(3).count, 1U);
  film.hold({2, 4});
  EXPECT_EQ(film.radiance(3), Rgb(1));
  EXPECT_EQ(film.features(2).count, 0U);
}

}  // namespace
}  // namespace gltfx::render
