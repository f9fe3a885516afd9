// SPDX-License-Identifier: Apache-2.0
#include "preview/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/tonemap.hpp"

namespace gltfx::preview {
namespace {

using testing::ElementsAre;
using testing::FloatEq;

// Two pixels: half covered by something grey, and nothing.
render::Framebuffer two_pixels() {
  render::Film film(2, 1);
  render::PathSample there;
  there.emitted = Rgb(0.5);
  there.alpha = 1;
  there.features.albedo = Rgb(0.25, 0.5, 1);
  there.features.normal = {0, 0, 2};
  there.features.depth = 4;
  there.features.material = 3;
  film.add(0, there);
  film.add(0, render::PathSample());
  film.add(1, render::PathSample());
  film.add(1, render::PathSample());
  render::Framebuffer buffer(2, 1, {true, true, true, true, true});
  render::resolve(film, {0, 1}, buffer);
  return buffer;
}

TEST(Framebuffer, HasTheLayersThatAreWanted) {
  render::Film film(1, 1);
  film.add(0, render::PathSample());
  render::Framebuffer buffer(1, 1, {.normal = true});
  render::resolve(film, {0, 1}, buffer);
  EXPECT_EQ(buffer.normal.size(), 1U);
  EXPECT_TRUE(buffer.albedo.empty() && buffer.depth.empty() && buffer.material.empty());
}

TEST(Develop, AlphaIsNotMultipliedIn) {
  const render::Framebuffer buffer = two_pixels();
  const Picture picture = tone_mapped_picture(buffer, true, PixelType::floats);
  EXPECT_EQ(picture.channels, 4U);
  EXPECT_THAT(picture.floats, ElementsAre(0.5F, 0.5F, 0.5F, 0.5F, 0, 0, 0, 0));
  EXPECT_TRUE(picture.bytes.empty());
}

TEST(Develop, BytesAreToneMapped) {
  const render::Framebuffer buffer = two_pixels();
  const Picture picture = tone_mapped_picture(buffer, false, PixelType::bytes);
  const auto expected =
      render::to_byte(render::srgb_encode(render::tone_map({0.25F, 0.25F, 0.25F})[0]));
  EXPECT_THAT(picture.bytes, ElementsAre(expected, expected, expected, 0, 0, 0));
}

TEST(Develop, Layers) {
  const render::Framebuffer buffer = two_pixels();
  EXPECT_THAT(layer_picture(buffer, Layer::albedo, PixelType::floats).floats,
              ElementsAre(0.125F, 0.25F, 0.5F, 0, 0, 0));
  EXPECT_THAT(layer_picture(buffer, Layer::normal, PixelType::bytes).bytes,
              ElementsAre(128, 128, 255, 0, 0, 0));
  EXPECT_THAT(layer_picture(buffer, Layer::depth, PixelType::floats).floats,
              ElementsAre(FloatEq(4), FloatEq(4), FloatEq(4), 0, 0, 0));
  EXPECT_EQ(layer_picture(buffer, Layer::depth, PixelType::bytes).bytes[0], 255);
  EXPECT_EQ(layer_picture(buffer, Layer::material, PixelType::floats).floats[0], 3);
}

}  // namespace
}  // namespace gltfx::preview
