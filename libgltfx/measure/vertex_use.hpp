// SPDX-License-Identifier: Apache-2.0
/// How primitives use their vertices.
#pragma once

#include <cstddef>
#include <vector>

#include "measure/shape.hpp"
#include "measure/take.hpp"

namespace gltfx::measure {

/// A primitive and its element.
struct Subject {
  const model::Primitive* primitive = nullptr;
  std::size_t element = 0;
};

/// duplicate-vertices of all primitives.
void count_duplicate_vertices(const Source& source, const std::vector<Subject>& subjects,
                              Column& column);

}  // namespace gltfx::measure
