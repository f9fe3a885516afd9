// SPDX-License-Identifier: Apache-2.0
/// A picture in linear values.
#pragma once

#include <cstdint>
#include <vector>

#include "render/film.hpp"

namespace gltfx::render {

/// The layers of a framebuffer in addition to the radiance: alpha, and features.
struct Layers {
  bool alpha = false;
  bool albedo = false, normal = false, depth = false, material = false;
};

/// Values by pixel, rows from the top; layers that were not requested are empty. Features are means
/// over the samples, and 0 beside the scene.
struct Framebuffer {
  Framebuffer(std::uint32_t width, std::uint32_t height, const Layers& layers = {});

  std::uint32_t width, height;
  std::vector<Float3> radiance;  ///< multiplied by alpha where the background is transparent
  std::vector<float> alpha;
  std::vector<Float3> albedo, normal;
  std::vector<float> depth;             ///< along the ray
  std::vector<std::uint32_t> material;  ///< of the scene; kNone: the default one, or nothing
  std::uint64_t rays = 0;               ///< that were traced for its samples

  std::size_t size() const { return radiance.size(); }
};

/// Resolves rows that the film holds to means, with their noise.
void resolve(const Film& film, const Rows& rows, Framebuffer& buffer);

}  // namespace gltfx::render
