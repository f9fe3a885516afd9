// SPDX-License-Identifier: Apache-2.0
/// Whether two materials are drawn alike, whatever else they say: parameters of an effect that has
/// the strength 0, defaults of extensions, alpha that an opaque material does not read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/material.hpp"
#include "prove/changes.hpp"
#include "prove/equal_images.hpp"

namespace gltfx::prove {

class DrawnMaterials {
 public:
  explicit DrawnMaterials(const Comparison& comparison);

  /// By index; nothing: no material. An animated material is like no other.
  bool are_alike(std::optional<std::uint32_t> ours, std::optional<std::uint32_t> theirs);
  /// Whether that covers the value at a pointer into a material, or a texture or sampler.
  bool covers(const Content& content, const std::string& pointer) const;

 private:
  /// What is drawn with it.
  struct Looks {
    model::Material material;
    model::TextureSlot occlusion;
    float occlusion_strength = 1;
  };
  static Looks read(const Content& content, std::optional<std::uint32_t> material);
  bool same_slot(const model::TextureSlot& ours, const model::TextureSlot& theirs);
  bool same_texture(std::uint32_t ours, std::uint32_t theirs);

  const Comparison& all_;
  EqualImages images_;
  std::vector<bool> our_animated_, their_animated_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> known_;
};

}  // namespace gltfx::prove
