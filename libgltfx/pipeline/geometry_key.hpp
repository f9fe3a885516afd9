// SPDX-License-Identifier: Apache-2.0
/// Which primitives have the same geometry: those of the same accessors, whatever their material.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "model/geometry.hpp"
#include "pipeline/scene_materials.hpp"
#include "render/scene.hpp"

namespace gltfx {

/// Equal for primitives with the same vertices and triangles.
using GeometryKey = std::vector<std::uint64_t>;

/// The pose of a primitive: weights of its morph targets, and its skin or render::kNone.
struct PrimitivePose {
  std::span<const float> weights;
  std::uint32_t skin = render::kNone;
};

/// By the accessors and bitstreams that the primitive reads, for a material with these needs.
GeometryKey geometry_key(const model::GeometrySource& source, const model::Primitive& primitive,
                         const PrimitivePose& pose, const MaterialNeeds& needs);

/// Geometry that several primitives have: its copies share their arrays.
class KeptGeometry {
 public:
  struct Entry {
    render::Mesh mesh;
    model::Vector3 origin{};  ///< of its positions
  };
  explicit KeptGeometry(const model::Views& views);

  /// Whether another primitive has its positions in the same accessor.
  bool may_repeat(const model::Primitive& primitive) const;
  /// Null when there is none.
  const Entry* find(const GeometryKey& key) const;
  void keep(GeometryKey key, Entry entry) { known_.emplace(std::move(key), std::move(entry)); }

 private:
  std::vector<std::uint32_t> users_;  // by accessor of positions
  std::map<GeometryKey, Entry> known_;
};

}  // namespace gltfx
