// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_picture.hpp"

#include <utility>

#include "bake/denoise.hpp"
#include "bake/lighting.hpp"
#include "bake/render.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kLooks = 48;       // for edges, which are not smoothed
constexpr double kRendering = 0.9;         // of the time; denoising takes the rest
constexpr std::uint32_t kFewSamples = 32;  // which have to be chosen with care

bake::RenderOptions render_options(const BakeSize& size, const BakeOptions& options) {
  bake::RenderOptions result;
  result.width = size.width;
  result.height = size.height;
  result.samples = options.samples;
  result.looks = options.denoise ? kLooks : 0;
  result.seed = options.seed;
  result.jobs = options.jobs;
  result.seconds = options.seconds;
  result.noise = options.noise;
  return result;
}

std::vector<Rgb> plain(const bake::Film& film) {
  std::vector<Rgb> radiance;
  radiance.reserve(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) radiance.push_back(film.radiance(i));
  return radiance;
}

}  // namespace

DrawnPicture draw_picture(const BakeScene& loaded, const bake::View& view, const BakeSize& size,
                          const BakeOptions& options, std::function<void(double)> progress) {
  bake::LightingOptions lighting;
  lighting.lamps = static_cast<bake::Lamps>(options.lights);
  lighting.transparent = options.transparent;
  lighting.exposure = options.exposure;
  const bake::Setting setting = bake::make_setting(*loaded.scene, *loaded.subject, view, lighting);
  const bake::PathSetting paths{*loaded.scene,
                                *loaded.bvh,
                                setting,
                                static_cast<int>(options.bounces),
                                loaded.subject->size(),
                                options.literal_shader ? ShaderMode::spec : ShaderMode::conserving,
                                options.samples > kFewSamples ? 2U : 4U};
  bake::RenderOptions rendering = render_options(size, options);
  if (progress) {
    rendering.progress = [&progress](double part) { progress(part * kRendering); };
  }
  bake::Film film = bake::render(paths, view, rendering);
  std::vector<Rgb> radiance = options.denoise ? bake::denoise(film, options.jobs) : plain(film);
  if (progress) progress(1);
  return {std::move(film), std::move(radiance)};
}

}  // namespace gltfx
