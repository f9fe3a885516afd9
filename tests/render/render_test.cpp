// SPDX-License-Identifier: Apache-2.0
#include "render/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "preview/lighting.hpp"
#include "preview/picture.hpp"
#include "render/sampler.hpp"
#include "rendering.hpp"
#include "studio_stage.hpp"

namespace gltfx::render {
namespace {

// A square without noise and a ball with some, unless it is unlit, before nothing.
Stage square_and_ball(bool unlit_ball = false) {
  Scene scene = scene_of(quad(), matte(Rgb(1)));
  scene.materials[0].factors.unlit = true;
  scene.instances[0].to_world = {{{2, 0.3F, 0, -1.4F}, {-0.3F, 2, 0, 0}, {0, 0, 1, 0}}};  // turned
  scene.materials.push_back(matte(Rgb(0.8)));
  scene.materials[1].factors.unlit = unlit_ball;
  scene.meshes.push_back(sphere(0.8F, 16));
  scene.meshes[1].material = 1;
  scene.instances.push_back({1, moved(1.2F, 0, 0)});
  Stage stage(std::move(scene));
  stage.world.environment.emplace(preview::studio_environment({0, 0, 1}));
  stage.world.background = Background::transparent;
  return stage;
}

RenderOptions small(std::uint32_t samples) {
  RenderOptions options;
  options.width = 48;
  options.height = 40;
  options.samples = samples;
  return options;
}

Film render_film(const TraceContext& context, const View& view, const RenderOptions& options) {
  Film film(options.width, options.height);
  render_rows(context, view, options, SampleMap(options.samples), film.held(), film);
  return film;
}

Framebuffer plain_framebuffer(const Film& film) {
  Framebuffer buffer(film.width(), film.height(), {.alpha = true});
  resolve(film, film.held(), buffer);
  return buffer;
}

PictureOptions denoised(std::uint32_t samples, unsigned jobs = 1) {
  PictureOptions options;
  options.render = small(samples);
  options.render.jobs = jobs;
  options.layers.alpha = true;
  options.denoise = true;
  return options;
}

bool same(const Film& a, const Film& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a.at(i), &b.at(i), sizeof(PixelSums)) != 0) return false;
  }
  return a.size() == b.size();
}

void expect_same(const Framebuffer& a, const Framebuffer& b) {
  EXPECT_EQ(a.radiance, b.radiance);
  EXPECT_EQ(a.alpha, b.alpha);
  EXPECT_EQ(a.albedo, b.albedo);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.material, b.material);
}

// A picture with all layers and few samples of the features.
PictureOptions with_layers(std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
  PictureOptions options = denoised(samples);
  options.render.width = width;
  options.render.height = height;
  options.render.feature_samples = 32;
  options.layers = {true, true, true, true, true};
  return options;
}

TEST(Render, ATriangleBecomesAPicture) {
  Stage stage(scene_of(quad(), matte(Rgb(1))));
  stage.world.environment.emplace(even_light());
  stage.world.background = Background::transparent;
  View view;
  view.origin = {0, 0, 4};
  const Film film = render_film(stage.context(), view, small(4));
  EXPECT_NEAR(film.radiance(20 * 48 + 24).x, 1, 0.05);
  EXPECT_EQ(film.features(20 * 48 + 24).alpha, 4);
  EXPECT_EQ(film.features(0).alpha, 0);
  EXPECT_EQ(film.radiance(0), Rgb());
  EXPECT_EQ(film.at(20 * 48 + 24).material, 0U);
}

TEST(Render, TheNumberOfThreadsDoesNotShow) {
  const Stage stage = studio_stage();
  RenderOptions options = small(8);
  const Film one = render_film(stage.context(), front(), options);
  options.jobs = 2;
  const Film two = render_film(stage.context(), front(), options);
  EXPECT_TRUE(same(one, two));
  options.seed = 1;
  EXPECT_FALSE(same(one, render_film(stage.context(), front(), options)));
}

// Which rows come at a time does not show either: fewer for two jobs than for eight.
TEST(Draw, TheNumberOfThreadsDoesNotShow) {
  const Stage stage = studio_stage();
  PictureOptions options = with_layers(20, 600, 16);
  const Framebuffer one = render(stage.context(), front(), options);
  options.render.jobs = 8;
  expect_same(one, render(stage.context(), front(), options));
}

// A wide picture has fewer rows at a time than the denoiser uses around a pixel.
TEST(Draw, RowsAtATimeDoNotShow) {
  const Stage stage = studio_stage();
  PictureOptions options = with_layers(528, 44, 2);
  const Framebuffer rows = render(stage.context(), front(), options);
  options.render.seconds = 1e6;  // all rows at once
  expect_same(rows, render(stage.context(), front(), options));
}

// What feature samples find has its material, also where no sample found it.
TEST(Draw, WhatIsSeenHasAMaterial) {
  const Stage stage = square_and_ball();
  PictureOptions options = denoised(16);
  options.render.feature_samples = 48;
  options.layers.material = true;
  const Framebuffer buffer = render(stage.context(), front(), options);
  for (std::size_t i = 0; i < buffer.size(); ++i) {
    EXPECT_EQ(buffer.alpha[i] > 0, buffer.material[i] != kNone) << i;
  }
}

TEST(Draw, ProgressEndsAtTheEnd) {
  const Stage stage = studio_stage();
  PictureOptions options = denoised(2);
  options.render.height = 300;
  double last = 0;
  options.render.progress = [&last](double part) {
    EXPECT_GE(part, last);
    last = part;
  };
  render(stage.context(), front(), options);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(Render, SamplesDoNotDependOnHowManyFollow) {
  const Stage stage = studio_stage();
  RenderOptions options = small(32);
  options.seconds = 1e6;  // in rounds
  const Film rounds = render_film(stage.context(), front(), options);
  options.seconds = 0;
  EXPECT_TRUE(same(rounds, render_film(stage.context(), front(), options)));
}

TEST(Render, EnoughIsEnough) {
  const Stage stage = studio_stage();
  RenderOptions options = small(256);
  options.noise = 0.05;
  const Film film = render_film(stage.context(), front(), options);
  EXPECT_LT(film.at(0).samples, 256U) << "a backdrop without noise";
  EXPECT_GE(film.at(0).samples, 16U);
}

// Shadow on the floor is noise too.
TEST(Render, ShadowHasNoise) {
  const Stage stage = studio_stage();
  const Film film = render_film(stage.context(), front(), small(16));
  double worst = 0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    const PixelSums& sums = film.at(i);
    if (sums.features.alpha <= 0 && sums.light.shadow[0] + sums.light.shadow[1] > 0) {
      worst = std::max(worst, film.error(i));
    }
  }
  EXPECT_GT(worst, 0.01);
}

TEST(Render, TimeRunsOut) {
  const Stage stage = studio_stage();
  RenderOptions options = small(4000000);
  options.seconds = 0.02;
  const Film film = render_film(stage.context(), front(), options);
  EXPECT_GT(film.at(0).samples, 0U);
  EXPECT_LT(film.at(0).samples, 4000000U);
}

TEST(Render, ProgressEndsAtTheEnd) {
  const Stage stage = studio_stage();
  RenderOptions options = small(2);
  double last = 0;
  options.progress = [&last](double part) {
    EXPECT_GE(part, last);
    last = part;
  };
  render_film(stage.context(), front(), options);
  EXPECT_DOUBLE_EQ(last, 1);
}

// Nearer to the picture of many samples than the noise was.
TEST(Denoise, ComesNearer) {
  const Stage stage = studio_stage();
  const Framebuffer noisy = plain_framebuffer(render_film(stage.context(), front(), small(16)));
  RenderOptions many = small(512);
  many.seed = 9;
  const Framebuffer wanted = plain_framebuffer(render_film(stage.context(), front(), many));
  const Framebuffer clean = render(stage.context(), front(), denoised(16));
  const preview::Picture reference =
      preview::tone_mapped_picture(wanted, false, preview::PixelType::bytes);
  const auto difference = [&](const Framebuffer& buffer) {
    const preview::Picture picture =
        preview::tone_mapped_picture(buffer, false, preview::PixelType::bytes);
    return std::transform_reduce(
        picture.bytes.begin(), picture.bytes.end(), reference.bytes.begin(), 0.0, std::plus<>(),
        [](int a, int b) { return static_cast<double>((a - b) * (a - b)); });
  };
  EXPECT_LT(difference(clean), difference(noisy) * 0.5);
}

// Most samples go to the ball, which has noise, but the edges of the square, which has none, are
// looked for.
TEST(Denoise, FewSamplesMissNoEdge) {
  const Stage stage = square_and_ball();
  PictureOptions options = denoised(16);
  options.render.feature_samples = 128;
  const Framebuffer few = render(stage.context(), front(), options);
  options.render.samples = 256;
  options.denoise = false;
  const Framebuffer many = render(stage.context(), front(), options);
  float worst = 0;
  for (std::size_t i = 0; i < few.size(); ++i) {
    worst = std::max(worst, std::fabs(few.alpha[i] - many.alpha[i]));
  }
  EXPECT_LT(worst, 0.1F);
}

// Noise of edges is not denoised: they take the most feature samples.
TEST(Denoise, EdgesHaveTheMostSamples) {
  const Stage stage = square_and_ball();
  const auto alpha_of = [&](std::uint32_t features) {
    PictureOptions options = denoised(16);
    options.render.feature_samples = features;
    options.render.seed = features;  // no picture is part of another one
    return render(stage.context(), front(), options).alpha;
  };
  const std::vector<float> exact = alpha_of(2048);
  const auto error = [&](std::uint32_t features) {
    const std::vector<float> alpha = alpha_of(features);
    double sum = 0;
    int edges = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (exact[i] <= 0 || exact[i] >= 1) continue;
      const auto apart = static_cast<double>(alpha[i] - exact[i]);
      sum += apart * apart;
      ++edges;
    }
    EXPECT_GT(edges, 50);
    return std::sqrt(sum / edges);
  };
  const double many = error(128);
  EXPECT_LT(many, 0.012);
  EXPECT_LT(many, error(0) / 3);
}

// A square whose texels, all almost the same grey, are finer than the pixels.
Stage grainy_square(bool unlit) {
  constexpr std::uint32_t kSide = 256;
  static const auto kTexels = [] {
    std::array<std::uint8_t, kSide * kSide> texels{};
    for (std::uint32_t i = 0; i < texels.size(); ++i) {
      texels[i] = static_cast<std::uint8_t>(120 + mix_bits(i) % 16);
    }
    return texels;
  }();
  Scene scene = scene_of(quad(4), matte(Rgb(1)));
  scene.materials[0].factors.unlit = unlit;
  scene.materials[0].use(Slot::base_color).texture = 0;
  scene.textures.push_back({kSide, kSide, 1, 8, std::as_bytes(std::span(kTexels)), nullptr});
  Stage stage(std::move(scene));
  stage.world.environment.emplace(even_light());
  return stage;
}

// Feature samples that make a mean certain are part of it.
class DenoiseTexture : public testing::TestWithParam<bool> {};

TEST_P(DenoiseTexture, HasMoreSamples) {
  const auto albedo_of = [](const Stage& stage, std::uint32_t samples, std::uint32_t features) {
    PictureOptions options = denoised(samples);
    options.layers.albedo = true;
    options.render.feature_samples = features;
    options.render.seed = samples + features;  // no picture is part of another one
    return render(stage.context(), front(), options).albedo;
  };
  const std::vector<Float3> exact = albedo_of(grainy_square(true), 1024, 0);
  const Stage stage = grainy_square(GetParam());
  const auto error = [&](std::uint32_t features) {
    const std::vector<Float3> albedo = albedo_of(stage, 8, features);
    double sum = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const auto apart = static_cast<double>(albedo[i][0] - exact[i][0]);
      sum += apart * apart;
    }
    return std::sqrt(sum / static_cast<double>(exact.size()));
  };
  EXPECT_LT(error(256), error(0) * 0.7);
}

INSTANTIATE_TEST_SUITE_P(UnlitOrLit, DenoiseTexture, testing::Bool());

// A pixel of which an edge cuts off a twentieth may seem whole to 16 samples.
TEST(Denoise, FewSamplesMissNoSliver) {
  const Stage stage = square_and_ball(true);
  PictureOptions options = denoised(256);
  options.render.width = 192;
  options.render.height = 160;
  options.denoise = false;
  const Framebuffer exact = render(stage.context(), front(), options);
  options.denoise = true;
  options.render.samples = 16;
  options.render.feature_samples = 64;
  const Framebuffer few = render(stage.context(), front(), options);
  int slivers = 0;
  int missed = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const float sliver = std::min(exact.alpha[i], 1 - exact.alpha[i]);
    if (sliver < 0.04F || sliver > 0.08F) continue;
    ++slivers;
    if (few.alpha[i] <= 0 || few.alpha[i] >= 1) ++missed;
  }
  EXPECT_GT(slivers, 100);
  EXPECT_LT(missed, slivers / 20);
}

TEST(Denoise, WhatHasNoNoiseStays) {
  Stage stage(scene_of(quad(), matte(Rgb(0.5))));
  Light light;
  light.kind = Light::Kind::directional;
  light.intensity = {2, 2, 2};
  stage.world.lights = {light};
  stage.world.background = Background::transparent;
  View view;
  view.origin = {0, 0, 4};
  view.half_width = view.half_height = 0.2;
  const Framebuffer noisy = plain_framebuffer(render_film(stage.context(), view, small(4)));
  const Framebuffer clean = render(stage.context(), view, denoised(4));
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    EXPECT_NEAR(clean.radiance[i][0], noisy.radiance[i][0], 1e-3F);
  }
}

}  // namespace
}  // namespace gltfx::render
