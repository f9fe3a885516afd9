// SPDX-License-Identifier: Apache-2.0
/// Texture coordinates of primitives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "measure/uv_plane.hpp"
#include "rules/payload/phases.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {

/// A primitive and its place.
struct PlacedPrimitive {
  std::uint32_t mesh = 0, index = 0;
  const model::Primitive* primitive = nullptr;
};
/// By material: the primitives that have it. Those of variants are not among them.
std::vector<std::vector<PlacedPrimitive>> primitives_of_materials(const Context& context);

/// The accessor of TEXCOORD_n, or nothing: it is absent or not a pair of numbers, or has no data of
/// its own, or the primitive does not draw triangles.
std::optional<model::AccessorData> open_uvs(DataPhase& phase, const model::Primitive& primitive,
                                            std::uint64_t set);

/// A few triangles of a primitive, evenly spread; empty: they cannot be read.
struct UvSample {
  std::vector<measure::UvTriangle> triangles;
  std::uint64_t of = 0;  ///< the number of triangles of the primitive
};
UvSample sample_uvs(DataPhase& phase, const model::Primitive& primitive,
                    const model::AccessorData& uvs);

/// All triangles. Nothing: they cannot be read, or exceed the budget of the phase.
std::optional<measure::UvSurface> read_uvs(DataPhase& phase, const model::Primitive& primitive,
                                           const model::AccessorData& uvs);

/// The n of the TEXCOORD_n that a mapping reads.
inline std::uint64_t set_of(const UvMapping& mapping) {
  constexpr double kMost = 1U << 20U;
  return mapping.texcoord > 0 ? static_cast<std::uint64_t>(std::min(mapping.texcoord, kMost)) : 0;
}

/// Coordinates as a texture slot maps them: scaled, rotated, moved.
inline std::array<double, 2> mapped(const measure::UvPoint& uv, const UvMapping& mapping) {
  const double u = static_cast<double>(uv[0]) * mapping.scale[0];
  const double v = static_cast<double>(uv[1]) * mapping.scale[1];
  if (mapping.rotation == 0) return {u + mapping.offset[0], v + mapping.offset[1]};
  const double cosine = std::cos(mapping.rotation);
  const double sine = std::sin(mapping.rotation);
  return {cosine * u + sine * v + mapping.offset[0], cosine * v - sine * u + mapping.offset[1]};
}

}  // namespace gltfx::validate
