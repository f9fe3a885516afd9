// SPDX-License-Identifier: Apache-2.0
/// Materials on meshes whose vertices may have an alpha of their own.
#pragma once

#include <cstdint>
#include <set>

#include "validate/context.hpp"

namespace gltfx::validate {

/// Made once for an asset; linear in its primitives.
class VertexAlpha {
 public:
  explicit VertexAlpha(const Context& context);
  bool on(std::uint32_t material) const { return any_ || materials_.count(material) != 0; }

 private:
  void add(const Context& context, const model::Primitive& primitive);

  std::set<std::uint32_t> materials_;
  bool any_ = false;  // some primitive with such vertices may wear other materials too
};

}  // namespace gltfx::validate
