// SPDX-License-Identifier: Apache-2.0
/// Triangles by their places, so that equal ones are found without a comparison of all.
#pragma once

#include <cstdint>
#include <vector>

#include "model/node.hpp"
#include "rules/shows/triangle_reader.hpp"

namespace gltfx::validate {

/// The cell of a grid that a number is in: one for numbers that differ by rounding only, unless
/// they are at the border of a cell. Round numbers are not.
std::int64_t place_cell(double value, double cell);
/// Adds a number to a hash.
std::uint64_t joined_place(std::uint64_t hash, std::int64_t number);

/// A hash for each triangle with three places, sorted: the same for triangles with the same places
/// and front. `cell`: the side of the cells in which places are the same, from `origin` on.
std::vector<std::uint64_t> places_of_triangles(const TriangleReader& triangles,
                                               const model::Affine& world,
                                               const model::Vector3& origin, double cell);

}  // namespace gltfx::validate
