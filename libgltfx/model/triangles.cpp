// SPDX-License-Identifier: Apache-2.0
#include "model/triangles.hpp"

#include <algorithm>

namespace gltfx::model {

bool draws_triangles(Mode mode) { return mode >= Mode::triangles; }

void TriangleAssembly::emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const bool there = std::max({a, b, c}) < vertices_;
  if (there && a != b && b != c && c != a) triangles_.push_back({a, b, c});
}

void TriangleAssembly::add(std::uint32_t index) {
  if (index == restart_) {
    count_ = 0;
    return;
  }
  if (count_ < 2) {
    held_[count_++] = index;
    return;
  }
  const auto [a, b] = held_;
  const bool odd = mode_ == Mode::triangle_strip && count_ % 2 == 1;
  emit(odd ? b : a, odd ? a : b, index);
  ++count_;
  if (mode_ == Mode::triangles) count_ = 0;
  if (mode_ == Mode::triangle_strip) held_[0] = b;
  if (mode_ != Mode::triangles) held_[1] = index;
}

}  // namespace gltfx::model
