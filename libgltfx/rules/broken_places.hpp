// SPDX-License-Identifier: Apache-2.0
/// Objects with errors in their form or references, which own rules do not check.
#pragma once

#include <cstdint>
#include <vector>

#include "base/json_pointer.hpp"
#include "base/span.hpp"

namespace gltfx::validate {

/// Places of errors in a JSON text.
class BrokenPlaces {
 public:
  /// An error at `path` that marks `place`.
  void add(const Path& path, Span place);
  /// Sorts the places: call it once, after the last add().
  void finish();

  /// Whether the root object has an error outside of the elements of its arrays.
  bool in_root() const { return root_; }
  /// Whether there is an error within an object. Precondition: finish().
  bool inside(Span object) const;

 private:
  std::vector<std::uint32_t> begins_;
  bool root_ = false;
};

}  // namespace gltfx::validate
