// SPDX-License-Identifier: Apache-2.0
/// All that a scene is made of: an asset, and its external assets (glTF 2.1) in their places.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/external_assets.hpp"
#include "pipeline/scene_builder.hpp"
#include "pipeline/scene_part.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// A part at one of its places.
struct PlacedPart {
  ScenePart* part = nullptr;
  model::Affine to_scene;   ///< from the space of its roots
  std::uint32_t depth = 0;  ///< 0: the asset itself
  std::uint32_t above = 0;  ///< position of its parent in placed()
  bool framed = false;      ///< the picture is of it

  model::Affine world(model::NodeIndex node) const {
    return depth == 0 ? part->pose.world[node] : to_scene * part->pose.world[node];
  }
};

/// Opens each external asset that is visible once. A branch that leads back to an asset above it is
/// left out, as is what cannot be read or exceeds a limit; notes of the parts name all of them.
class SceneTree {
 public:
  /// Keeps references to all of them.
  SceneTree(const model::OpenedAsset& root, const SceneOptions& options,
            const schema::Set& schemas);

  ScenePart& root() const { return *parts_.front().part; }
  /// From the asset down; never empty.
  const std::vector<PlacedPart>& placed() const { return placed_; }
  /// By node of the asset, whether the picture is of it; empty: it is of all.
  const std::vector<std::uint8_t>& framed() const { return framed_; }
  bool frames(const PlacedPart& placed, model::NodeIndex node) const {
    if (framed_.empty()) return false;
    return placed.depth == 0 ? framed_[node] != 0 : placed.framed;
  }
  /// Calls `use(part)` for each part, the asset first.
  template <class Use>
  void for_each_part(const Use& use) const {
    for (const Member& each : parts_) use(*each.part);
  }
  /// The notes of all parts.
  SceneNotes take_notes();

 private:
  struct Member {
    model::AssetInTree* asset;  ///< null: there are no others
    std::unique_ptr<ScenePart> part;
  };

  void find_framed();
  void attach(std::uint32_t above, const model::ExternalPlace& place);
  model::AssetInTree* open(std::uint32_t above, std::uint32_t element);
  const std::string& obstacle_of(const model::AssetInTree& asset);
  bool is_above(std::uint32_t placed, const model::AssetInTree& asset) const;
  std::optional<std::size_t> member_of(model::AssetInTree& asset);

  const SceneOptions& options_;
  const schema::Set& schemas_;
  std::optional<model::ExternalAssets> assets_;  ///< nothing: none is visible
  std::vector<Member> parts_;
  std::map<const model::AssetInTree*, std::size_t> positions_;  ///< in parts_
  std::map<const model::AssetInTree*, std::string> obstacles_;  ///< empty: there is none
  std::vector<PlacedPart> placed_;
  std::vector<std::size_t> members_;  ///< by placed_, in parts_
  std::vector<std::uint8_t> framed_;
  std::uint64_t nodes_ = 0;  ///< of all places
};

/// The names of the variants of all assets below this one, each once.
std::vector<std::string> variant_names_below(const model::OpenedAsset& root);

}  // namespace gltfx
