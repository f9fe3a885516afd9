// SPDX-License-Identifier: Apache-2.0
/// The media that a path is in, one inside of the other.
#pragma once

#include <gltfx/material.hpp>

#include <cstdint>
#include <vector>

#include "bake/medium.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// A path enters and leaves closed meshes, each known by its Hit::body(). What is nested deeper
/// than some levels counts as the medium around it.
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
  /// Its index of refraction.
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

/// What becomes of a path inside of a medium.
struct MediumStep {
  bool scattered = false;
  double distance = 0;  ///< to where it is scattered
  Rgb weight{1, 1, 1};  ///< of the path, from here on
};

/// From a point of the medium on, `reach` metres before there is a surface. `throughput`: of the
/// path so far; by it the colour is chosen that decides the distance, and all three are weighed by
/// multiple importance sampling.
MediumStep walk(const Medium& medium, const Rgb& throughput, double reach, const Float2& random);

}  // namespace gltfx::bake
