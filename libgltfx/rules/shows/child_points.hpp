// SPDX-License-Identifier: Apache-2.0
/// The geometry of external assets, for the bounding volumes above them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "model/external_assets.hpp"
#include "model/volume_contents.hpp"
#include "schema/set.hpp"

namespace gltfx::validate {

/// The vertices of the default scenes of external assets at rest, and of those below them. Assets
/// that cannot be read, cycles, and more than some millions of vertices are left out: then not all
/// points are known.
class ChildPoints final : public model::MorePoints {
 public:
  explicit ChildPoints(const model::OpenedAsset& asset);
  const model::PointBlocks* of(model::NodeIndex node, bool& complete) override;

 private:
  using Points = model::Vectors<3>;
  struct Known {
    bool complete = true;
    model::PointBlocks blocks;
  };

  /// The asset at a node of another; null: the node has none, or it cannot be opened.
  model::AssetInTree* asset_at(model::AssetInTree& parent, json::NodeId node, bool& complete);
  /// Adds the points of an asset and those below it, moved by `place`.
  bool add(model::AssetInTree& asset, const model::Affine& place, Points& points);
  bool add_own(model::AssetInTree& asset, const model::Affine& place, Points& points);

  model::ExternalAssets assets_;
  std::map<const model::AssetInTree*, Known> known_;
  std::vector<FileIdentity> above_;  ///< the assets on the way to the one that is read
};

}  // namespace gltfx::validate
