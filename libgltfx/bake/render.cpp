// SPDX-License-Identifier: Apache-2.0
#include "bake/render.hpp"

#include <algorithm>

#include "bake/denoise.hpp"
#include "bake/sample_map.hpp"
#include "base/parallel.hpp"

namespace gltfx::bake {
namespace {

// An estimate by a grid of rays.
DepthRange depth_range(const TraceContext& context, const View& view) {
  constexpr std::uint32_t kProbes = 96;  // along a side
  DepthRange range;
  for (std::uint32_t i = 0; i < kProbes * kProbes; ++i) {
    const std::uint32_t column = i % kProbes;
    const std::uint32_t row = i / kProbes;
    const auto hit =
        context.bvh.first_layer(view.ray((column + 0.5) / kProbes, (row + 0.5) / kProbes));
    if (!hit) continue;
    const auto z = static_cast<float>(hit->distance);
    range.nearest = range.nearest == 0 ? z : std::min(range.nearest, z);
    range.farthest = std::max(range.farthest, z);
  }
  return range;
}

// Enough tiles that few threads wait at the end. Values do not depend on it.
std::uint32_t rows_at_once(const RenderOptions& options) {
  constexpr std::uint32_t kTilesPerJob = 16;
  if (options.seconds > 0) return options.height;
  const std::uint32_t jobs = options.jobs == 0 ? default_jobs() : options.jobs;
  const std::uint32_t tiles = kTilesPerJob * std::clamp(jobs, 2U, 256U);
  const std::uint32_t columns = (options.width + kTileWidth - 1) / kTileWidth;
  return (tiles + columns - 1) / columns * kTileHeight;
}

// Progress of the picture by the progress of some rows.
RenderOptions part_of(const RenderOptions& options, const Rows& rows) {
  RenderOptions part = options;
  if (!options.progress) return part;
  part.progress = [&options, rows](double within) {
    options.progress((rows.first + within * (rows.last - rows.first)) / options.height);
  };
  return part;
}

}  // namespace

Framebuffer render(const TraceContext& context, const View& view, const PictureOptions& options) {
  const RenderOptions& render = options.render;
  Framebuffer buffer(render.width, render.height, options.layers);
  const DepthRange depths = options.denoise ? depth_range(context, view) : DepthRange();
  const SampleMap samples =
      options.denoise ? SampleMap(context, view, render) : SampleMap(render.samples);
  const std::uint32_t reach = options.denoise ? kDenoiseReach : 0;
  const std::uint32_t step = rows_at_once(render);
  Film film(render.width, render.height, {});
  film.reserve(std::min(step + 2 * reach, render.height));
  std::uint32_t finished = 0;
  while (finished < render.height) {
    const Rows fresh{film.held().last, std::min(film.held().last + step, render.height)};
    film.hold({finished - std::min(finished, reach), fresh.last});
    render_rows(context, view, part_of(render, fresh), samples, fresh, film);
    const bool last = fresh.last == render.height;
    const Rows ready{finished, last ? fresh.last : fresh.last - std::min(reach, fresh.last)};
    if (ready.first == ready.last) continue;
    resolve(film, ready, buffer);
    if (options.denoise) denoise(film, ready, depths, render.jobs, buffer);
    finished = ready.last;
  }
  return buffer;
}

}  // namespace gltfx::bake
