// SPDX-License-Identifier: Apache-2.0
/// Compares skins: joints by what they became, and their matrices.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/skin.hpp"
#include "prove/changes.hpp"

namespace gltfx::prove {

/// Two skins of matched nodes.
struct SkinPair {
  std::vector<double> our_joints, their_joints;  ///< equal numbers for joints that are partners
  /// Whether all matrices of the new skin are those of the old one times one transform, which
  /// restores the positions of its meshes: `place`.
  bool has_place = false;
  model::Affine place;
  double scale = 1;  ///< from the space of the mesh to that of the scene, at most
};

/// All skins of a comparison.
class SkinPairs {
 public:
  explicit SkinPairs(const Comparison& comparison) : all_(comparison) {}

  const SkinPair& get(std::uint32_t ours, std::uint32_t theirs);
  /// The transform of this pair was found in its meshes: its matrices are no change.
  void explain(std::uint32_t ours, std::uint32_t theirs) { explained_.insert({ours, theirs}); }
  /// Adds the changes of all matched skins.
  void tell_rest();

 private:
  void compare(std::uint32_t ours, std::uint32_t theirs);
  std::string find_gained(const model::Skin& ours, const model::Skin& theirs) const;

  const Comparison& all_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, SkinPair> pairs_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> explained_;
};

}  // namespace gltfx::prove
