// SPDX-License-Identifier: Apache-2.0
/// The state of a path.
#pragma once

#include <gltfx/material.hpp>

#include "bake/media.hpp"
#include "bake/path_sampler.hpp"
#include "bake/ray.hpp"

namespace gltfx::bake {

/// Properties of all vertices of a path so far.
struct PathPrefix {
  bool specular = true;         ///< nothing but mirrors and clear glass
  bool straight = true;         ///< nothing but sheets of clear glass
  bool environment_in = false;  ///< the environment came in through a wall
};

/// A path up to one of its vertices, as a value: a path that splits is copied.
struct Path {
  Ray ray;
  PathSampler sampler;
  Rgb throughput{1, 1, 1};  ///< BSDFs, phase functions and cosines over densities
  double pdf = 0;         ///< of the ray's direction; 0: light sampling does not find what it hits
  int depth = 0;          ///< surfaces that scattered
  int channel = -1;       ///< the only colour that it carries, after dispersion; -1: all
  double weight = 1;      ///< of a branch in the throughput
  Rgb reflected_share{};  ///< part of the throughput that the first surface reflects
  PathPrefix prefix{};
  MediaStack media{};
};

}  // namespace gltfx::bake
