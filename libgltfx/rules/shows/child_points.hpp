// SPDX-License-Identifier: Apache-2.0
/// The geometry of external assets, for the bounding volumes above them.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "model/external_assets.hpp"
#include "model/volume_contents.hpp"
#include "schema/set.hpp"

namespace gltfx::validate {

/// The vertices of the default scenes of external assets at rest, and of those below them; and
/// which of these assets have animations. Assets that cannot be read, cycles, and more than some
/// millions of vertices are left out: then not all points are known.
class ChildPoints final : public model::MorePoints {
 public:
  explicit ChildPoints(const model::OpenedAsset& asset);
  ~ChildPoints() override;
  const model::PointBlocks* of(model::NodeIndex node, bool& complete) override;
  const std::vector<model::MovingPart>& moving(model::NodeIndex node) override;

 private:
  class Below;
  struct Loaded;
  struct Collected {
    model::Vectors<3> points;
    std::vector<model::MovingPart> moving;
  };
  struct Known {
    bool complete = true;
    model::PointBlocks blocks;
    std::vector<model::MovingPart> moving;
  };

  /// Of the external asset at a node; null: the node has none, or it cannot be opened.
  Known* known_at(model::AssetInTree& parent, model::NodeIndex node, bool& complete);
  model::AssetInTree* asset_at(model::AssetInTree& parent, json::NodeId node, bool& complete);
  /// Adds an asset and those below it, moved by `place`.
  bool add(model::AssetInTree& asset, const model::Affine& place, Collected& to);
  bool add_nodes(model::AssetInTree& asset, const Loaded& loaded, const model::Affine& place,
                 Collected& to);

  model::ExternalAssets assets_;
  std::map<const model::AssetInTree*, std::unique_ptr<Loaded>> animated_;
  std::map<const model::AssetInTree*, Known> known_;
  const Known none_;
  std::vector<FileIdentity> above_;  ///< the assets on the way to the one that is read
  std::size_t points_left_;
};

}  // namespace gltfx::validate
