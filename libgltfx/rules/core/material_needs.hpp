// SPDX-License-Identifier: Apache-2.0
/// Attributes that materials require of their meshes, and materials whose meshes may have vertex
/// alpha.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "rules/context.hpp"
#include "rules/extension_walk.hpp"

namespace gltfx::validate {

/// Materials with vertex alpha. Made once for an asset; linear in its primitives.
class VertexAlpha {
 public:
  explicit VertexAlpha(const Context& context);
  bool on(std::uint32_t material) const { return any_ || materials_.count(material) != 0; }

 private:
  void add(const Context& context, const model::Primitive& primitive);

  std::set<std::uint32_t> materials_;
  bool any_ = false;  // some primitive with vertex alpha may have other materials too
};

/// The 12 of "/materials/12/normalTexture", or nothing if the slot is elsewhere.
std::optional<std::uint64_t> material_of(std::string_view pointer);

/// pointer of the texture info, or of the extension on it that names the set
struct TexCoordNeed {
  std::string pointer;  ///< of the texture info, or of the extension on it that names the set
  std::uint64_t set = 0;
};

struct MaterialNeed {
  std::vector<TexCoordNeed> texcoords;
  bool tangent_space = false;  ///< some texture is read in tangent space
  /// The core normal texture is present, from which missing tangents are computed.
  bool normal_texture = false;
};

/// Needs of all materials, from the texture slots found by the walk.
class MaterialNeeds {
 public:
  MaterialNeeds(const Context& context, const ActiveExtensions& active);
  const MaterialNeed& of(std::uint32_t material) const { return needs_[material]; }

 private:
  void add(const Context& context, const ActiveExtensions& active, const schema::SlotUse& use);
  void add_directions(const Context& context);

  std::vector<MaterialNeed> needs_;
};

}  // namespace gltfx::validate
