// SPDX-License-Identifier: Apache-2.0
#include "bake/canvas.hpp"

#include <algorithm>

#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

void expose_layers(const Film& film, std::size_t pixel, Canvas& canvas) {
  const FeatureSums seen = film.feature_sums(pixel);
  const bool something = seen.alpha > 0;
  const std::uint32_t count = std::max(seen.count, 1U);
  const double share = something ? 1.0 / count : 0.0;
  if (!canvas.alpha.empty()) canvas.alpha[pixel] = seen.alpha / static_cast<float>(count);
  if (!canvas.albedo.empty()) canvas.albedo[pixel] = to_float3(to_vec(seen.albedo) * share);
  if (!canvas.normal.empty()) canvas.normal[pixel] = to_float3(to_vec(seen.normal) * share);
  if (!canvas.depth.empty()) canvas.depth[pixel] = something ? seen.depth / seen.alpha : 0;
  if (!canvas.material.empty()) canvas.material[pixel] = film.at(pixel).material;
}

}  // namespace

Canvas::Canvas(std::uint32_t w, std::uint32_t h, const Layers& layers) : width(w), height(h) {
  const std::size_t count = std::size_t{w} * h;
  radiance.resize(count);
  if (layers.alpha) alpha.resize(count);
  if (layers.albedo) albedo.resize(count);
  if (layers.normal) normal.resize(count);
  if (layers.depth) depth.resize(count);
  if (layers.material) material.resize(count);
}

void resolve(const Film& film, const Rows& rows, Canvas& canvas) {
  const bool any_layer = !(canvas.alpha.empty() && canvas.albedo.empty() && canvas.normal.empty() &&
                           canvas.depth.empty() && canvas.material.empty());
  const std::size_t last = std::size_t{rows.last} * film.width();
  for (std::size_t pixel = std::size_t{rows.first} * film.width(); pixel < last; ++pixel) {
    canvas.radiance[pixel] = to_float3(film.radiance(pixel));
    canvas.rays += film.at(pixel).rays;
    if (any_layer) expose_layers(film, pixel, canvas);
  }
}

}  // namespace gltfx::bake
