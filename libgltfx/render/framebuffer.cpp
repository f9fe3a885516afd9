// SPDX-License-Identifier: Apache-2.0
#include "render/framebuffer.hpp"

#include <algorithm>

#include "base/packed.hpp"

namespace gltfx::render {
namespace {

void resolve_features(const Film& film, std::size_t pixel, Framebuffer& buffer) {
  const FeatureSums& seen = film.features(pixel);
  const bool something = seen.alpha > 0;
  const std::uint32_t count = std::max(seen.count, 1U);
  const double share = something ? 1.0 / count : 0.0;
  if (!buffer.alpha.empty()) buffer.alpha[pixel] = seen.alpha / static_cast<float>(count);
  if (!buffer.albedo.empty()) buffer.albedo[pixel] = to_float3(to_vec(seen.albedo) * share);
  if (!buffer.normal.empty()) buffer.normal[pixel] = to_float3(to_vec(seen.normal) * share);
  if (!buffer.depth.empty()) buffer.depth[pixel] = something ? seen.depth / seen.alpha : 0;
  if (!buffer.material.empty()) buffer.material[pixel] = film.at(pixel).material;
}

}  // namespace

Framebuffer::Framebuffer(std::uint32_t w, std::uint32_t h, const Layers& layers)
    : width(w), height(h) {
  const std::size_t count = std::size_t{w} * h;
  radiance.resize(count);
  if (layers.alpha) alpha.resize(count);
  if (layers.albedo) albedo.resize(count);
  if (layers.normal) normal.resize(count);
  if (layers.depth) depth.resize(count);
  if (layers.material) material.resize(count);
}

void resolve(const Film& film, const Rows& rows, Framebuffer& buffer) {
  const bool any_layer = !(buffer.alpha.empty() && buffer.albedo.empty() && buffer.normal.empty() &&
                           buffer.depth.empty() && buffer.material.empty());
  const std::size_t last = std::size_t{rows.last} * film.width();
  for (std::size_t pixel = std::size_t{rows.first} * film.width(); pixel < last; ++pixel) {
    buffer.radiance[pixel] = to_float3(film.radiance(pixel));
    buffer.rays += film.at(pixel).rays;
    if (any_layer) resolve_features(film, pixel, buffer);
  }
}

}  // namespace gltfx::render
