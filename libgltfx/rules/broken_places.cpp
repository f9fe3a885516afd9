// SPDX-License-Identifier: Apache-2.0
#include "rules/broken_places.hpp"

#include <algorithm>

namespace gltfx::validate {

void BrokenPlaces::add(const Path& path, Span place) {
  // The second step from the root is an index for an element of a root array.
  const Path* second = nullptr;
  for (const Path* step = &path; step->parent() != nullptr; step = step->parent()) {
    if (step->parent()->parent() != nullptr) second = step;
  }
  root_ = root_ || second == nullptr || !second->is_index();
  if (begins_.empty() || begins_.back() != place.begin) begins_.push_back(place.begin);
}

void BrokenPlaces::finish() { std::sort(begins_.begin(), begins_.end()); }

bool BrokenPlaces::inside(Span object) const {
  const auto first = std::lower_bound(begins_.begin(), begins_.end(), object.begin);
  return first != begins_.end() && *first < object.end;
}

}  // namespace gltfx::validate
