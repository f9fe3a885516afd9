// SPDX-License-Identifier: Apache-2.0
/// Rendering of a scene: to samples, pixel by pixel, and to a framebuffer, in memory that does not
/// grow with the samples.
#pragma once

#include <cstdint>
#include <functional>

#include "render/film.hpp"
#include "render/framebuffer.hpp"
#include "render/integrator.hpp"
#include "render/sample_map.hpp"
#include "render/view.hpp"

namespace gltfx::render {

/// Pixels that are rendered together, and have enough samples together.
constexpr std::uint32_t kTileWidth = 16;
constexpr std::uint32_t kTileHeight = 8;

struct RenderOptions {
  std::uint32_t width = 512, height = 512;
  std::uint32_t samples = 64;  ///< of each pixel; with an adaptive SampleMap on average, at most
  /// Pixels whose samples have this standard deviation, as part of the range of the finished
  /// picture, get `samples`; others get more or fewer in proportion. The average is at most
  /// `samples`, and with shared sky samples at least 11/32 of it, or 14/32 where a material
  /// transmits light; without them, or if 0, it is `samples`.
  double deviation = 0;
  /// Maximum number of feature samples of a pixel, including those of the light: edges of the
  /// subject take all, finer differences fewer. In a tile full of edges and textures each pixel
  /// takes at most a quarter of them, or 8 if that is more. Pixels near edges between bodies take
  /// up to 64 to detect differences within them. A power of two is stratified best. 0: no more than
  /// the samples of the light.
  std::uint32_t feature_samples = 0;
  std::uint32_t seed = 0;
  unsigned jobs = 1;
  /// Seconds after which no more samples are begun; 0: no limit. What is rendered then depends on
  /// the machine.
  double seconds = 0;
  /// Standard error, as part of the range of the finished picture, at which a tile of pixels has
  /// enough samples; 0: all samples.
  double noise = 0;
  /// Called now and then with the part that is done, from 0 to 1, one call at a time.
  std::function<void(double)> progress;
};

/// Renders rows that the film holds and that are new to it. Without a time limit the values do not
/// depend on the number of jobs, or on how many rows are rendered at a time.
void render_rows(const TraceContext& context, const View& view, const RenderOptions& options,
                 const SampleMap& samples, const Rows& rows, Film& film);

struct PictureOptions {
  RenderOptions render;  ///< progress is that of the whole picture
  Layers layers;
  bool denoise = false;
};

/// Renders, resolves and denoises some rows after the others, so that the film holds few rows;
/// with a time limit, which all rows share, it holds all. Without one the values are the same for
/// any number of jobs.
Framebuffer render(const TraceContext& context, const View& view, const PictureOptions& options);

}  // namespace gltfx::render
