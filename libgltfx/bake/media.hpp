// SPDX-License-Identifier: Apache-2.0
/// The media that a path is in, one inside of the other.
#pragma once

#include <gltfx/material.hpp>

#include <cstdint>
#include <vector>

#include "bake/medium.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// A path enters and leaves closed meshes, each known by its Hit::body(). A medium that is nested
/// deeper than some levels counts as the medium around it.
class MediaStack {
 public:
  bool empty() const { return entries_.empty(); }
  /// Precondition: not empty.
  const Medium& top() const { return entries_.back().medium; }

  void enter(const Material& material, std::uint64_t body);
  void leave(std::uint64_t body);
  /// The medium outside of a surface of the body; null in the open. Valid until the next
  /// change.
  const Medium* around(std::uint64_t body) const;
  /// The index of refraction of that medium.
  double ior_around(std::uint64_t body) const;

 private:
  struct Entry {
    Medium medium;
    double ior = 1;
    std::uint64_t body = 0;
  };
  const Entry* entry_around(std::uint64_t body) const;

  std::vector<Entry> entries_;  // most paths never have one
};

/// How far a path gets in a medium.
struct DistanceSample {
  bool scattered = false;
  double distance = 0;  ///< to the point where the path is scattered
  Rgb weight{1, 1, 1};  ///< by which its throughput is multiplied
};

/// From a point of the medium, `reach` metres before a surface. The throughput of the path chooses
/// the colour whose extinction decides the distance; the three are combined by multiple importance
/// sampling.
DistanceSample sample_distance(const Medium& medium, const Rgb& throughput, double reach,
                               const Float2& random);

}  // namespace gltfx::bake
