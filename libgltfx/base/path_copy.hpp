// SPDX-License-Identifier: Apache-2.0
/// A path that outlives the walk it comes from.
#pragma once

#include <vector>

#include "base/json_pointer.hpp"

namespace gltfx {

/// Owns the steps of a path, but not their names: the document must outlive it.
class PathCopy {
 public:
  /// The steps of `path`, below those of `before` when it is given.
  explicit PathCopy(const Path& path, const Path* before = nullptr) {
    std::vector<const Path*> steps;
    collect(path, steps);
    if (before != nullptr) collect(*before, steps);
    steps_.reserve(steps.size() + 1);
    steps_.emplace_back();
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      const Path& parent = steps_.back();
      if ((*step)->is_index()) {
        steps_.emplace_back(parent, (*step)->index());
      } else {
        steps_.emplace_back(parent, (*step)->key());
      }
    }
  }
  PathCopy(PathCopy&&) = default;
  PathCopy& operator=(PathCopy&&) = default;
  PathCopy(const PathCopy&) = delete;
  PathCopy& operator=(const PathCopy&) = delete;
  ~PathCopy() = default;

  const Path& path() const { return steps_.back(); }

 private:
  static void collect(const Path& path, std::vector<const Path*>& steps) {
    for (const Path* at = &path; at->parent() != nullptr; at = at->parent()) steps.push_back(at);
  }

  std::vector<Path> steps_;  // reserved before it is filled: steps point to each other
};

}  // namespace gltfx
