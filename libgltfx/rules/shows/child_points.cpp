// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/child_points.hpp"

#include <algorithm>
#include <utility>

#include "codec/client.hpp"
#include "container/opened_files.hpp"
#include "model/external_places.hpp"
#include "model/fields.hpp"
#include "model/instancing.hpp"
#include "model/pose.hpp"

namespace gltfx::validate {
namespace {

using model::Affine;
using model::NodeIndex;
using model::RootArray;

constexpr std::size_t kMostChildPoints = std::size_t{1} << 23U;  // of one node
constexpr std::size_t kMostPoints = std::size_t{1} << 24U;       // of all nodes
constexpr std::size_t kMostMoving = 4096;                        // of one node
constexpr std::size_t kMostNested = 32;
constexpr std::uint64_t kChildBytes = std::uint64_t{1} << 29U;  // of one mesh

class PointCollector final : public model::PointWatcher {
 public:
  explicit PointCollector(model::Vectors<3>& to) : to_(to) {}
  bool wants(const model::Box&) const override { return true; }
  void take(const model::Vector3& point, std::size_t) override {
    to_.push_back(
        {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])});
  }

 private:
  model::Vectors<3>& to_;
};

// Adds what a node draws at rest. False: it cannot be read, or there is too much.
bool add_mesh(const model::GeometrySource& source, NodeIndex index, const model::Pose& pose,
              const Affine& place, std::size_t most, model::Vectors<3>& points) {
  const model::Node& node = source.views.nodes[index];
  std::vector<Affine> joints;
  if (node.skin) {
    joints = model::joint_matrices(source.asset, source.views, source.resources, *node.skin, pose);
    if (joints.empty()) return false;
  }
  std::vector<Affine> copies{Affine()};
  model::MemoryBudget budget(kChildBytes);
  if (joints.empty()) {
    auto read = model::read_instancing(source.asset, source.views, source.resources, node, budget);
    if (read && !read->readable) return false;
    if (read) copies = std::move(read->transforms);
    for (Affine& each : copies) each = place * pose.world[index] * each;
  }
  const std::vector<float> weights = model::morph_weights(source.asset, source.views, index);
  const bool morphs = std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0; });
  const auto blocks = model::PointBlocks::read(source, source.views.meshes[*node.mesh],
                                               joints.size(), morphs, budget);
  if (points.size() > most || !blocks) return false;
  if (blocks->size() * copies.size() > most - points.size()) return false;
  for (Affine& each : joints) each = place * each;
  PointCollector collector(points);
  std::uint64_t work = UINT64_MAX;
  for (const Affine& copy : copies) {
    const std::span<const Affine> one(&copy, 1);
    const model::Placement placement{joints.empty() ? one : std::span<const Affine>(joints),
                                     weights};
    if (!blocks->visit(placement, work, collector)) return false;
  }
  return true;
}

}  // namespace

/// The external assets of an external asset.
class ChildPoints::Below final : public model::MorePoints {
 public:
  Below(ChildPoints& all, model::AssetInTree& asset) : all_(all), asset_(asset) {}
  const model::PointBlocks* of(NodeIndex node, bool& complete) override {
    Known* const known = all_.known_at(asset_, node, complete);
    return known == nullptr ? nullptr : &known->blocks;
  }
  // The node above has those of all levels.
  const std::vector<model::MovingPart>& moving(NodeIndex) override { return none_; }

 private:
  ChildPoints& all_;
  model::AssetInTree& asset_;
  std::vector<model::MovingPart> none_;
};

/// An external asset with the bytes of its buffers.
struct ChildPoints::Loaded {
  Loaded(ChildPoints& all, model::AssetInTree& asset)
      : tables(asset.asset().document()), views(asset.asset().views()), below(all, asset) {
    const model::OpenedAsset& opened = asset.asset();
    container::OpenedFiles files(opened.resolver());
    const std::vector<bool> no_images(tables.count(RootArray::images));
    data = model::load_resources(opened.container(), files, tables, views, 1, &no_images).data;
    draco.add_all(tables, views, data);
    draco.decode(codec::Client::shared(), 1);
    pose = model::compute_pose(tables, views, model::attached_roots(tables, views));
  }

  const model::Asset tables;
  const model::Views& views;
  model::ResourceData data;
  model::DracoMeshes draco;
  const model::GeometrySource source{tables, views, data, draco};
  model::Pose pose;
  Below below;
};

ChildPoints::ChildPoints(const model::OpenedAsset& asset)
    : assets_(asset), points_left_(kMostPoints) {
  above_.push_back(assets_.root().identity());
}

ChildPoints::~ChildPoints() = default;

const model::PointBlocks* ChildPoints::of(NodeIndex node, bool& complete) {
  Known* const known = known_at(assets_.root(), node, complete);
  return known == nullptr ? nullptr : &known->blocks;
}

const std::vector<model::MovingPart>& ChildPoints::moving(NodeIndex node) {
  bool complete = true;
  Known* const known = known_at(assets_.root(), node, complete);
  return known == nullptr ? none_.moving : known->moving;
}

ChildPoints::Known* ChildPoints::known_at(model::AssetInTree& parent, NodeIndex node,
                                          bool& complete) {
  if (parent.external_assets().empty()) return nullptr;
  const json::NodeId object = parent.asset().views().nodes[node].object;
  model::AssetInTree* const child = asset_at(parent, object, complete);
  if (child == nullptr) return nullptr;
  const auto [known, is_new] = known_.try_emplace(child);
  if (is_new) {
    Collected collected;
    known->second.complete = add(*child, Affine(), collected);
    points_left_ -= collected.points.size();
    known->second.blocks = model::PointBlocks(std::move(collected.points));
    known->second.moving = std::move(collected.moving);
  }
  complete = complete && known->second.complete;
  return &known->second;
}

model::AssetInTree* ChildPoints::asset_at(model::AssetInTree& parent, json::NodeId node,
                                          bool& complete) {
  const auto index = model::unsigned_member(parent.asset().document(), node, "externalAsset");
  if (!index || *index >= parent.external_assets().size()) return nullptr;
  const auto file = parent.file_of(static_cast<std::uint32_t>(*index));
  const auto* const opened = file ? &assets_.asset(parent, *file) : nullptr;
  const bool found = opened != nullptr && *opened;
  if (!found) complete = false;
  return found ? **opened : nullptr;
}

bool ChildPoints::add(model::AssetInTree& asset, const Affine& place, Collected& to) {
  const bool is_cycle = std::find(above_.begin(), above_.end(), asset.identity()) != above_.end();
  if (is_cycle || above_.size() > kMostNested) return false;
  const json::Document& document = asset.asset().document();
  if (document.empty() || !document.is_object(document.root())) return false;
  const auto kept = animated_.find(&asset);
  std::unique_ptr<Loaded> fresh;
  if (kept == animated_.end()) fresh = std::make_unique<Loaded>(*this, asset);
  const Loaded& loaded = fresh ? *fresh : *kept->second;
  const bool moves = !loaded.views.animations.empty();
  if (fresh && moves) animated_.emplace(&asset, std::move(fresh));
  above_.push_back(asset.identity());
  bool complete = add_nodes(asset, loaded, place, to);
  above_.pop_back();
  if (!moves) return complete;
  if (to.moving.size() >= kMostMoving) return false;
  const std::string& first = assets_.root().asset().name();
  to.moving.push_back({&loaded.source, place, loaded.pose.in_scene, &animated_.at(&asset)->below,
                       asset.asset().name().substr(first.rfind('/') + 1)});
  return complete;
}

bool ChildPoints::add_nodes(model::AssetInTree& asset, const Loaded& loaded, const Affine& place,
                            Collected& to) {
  const auto& nodes = loaded.views.nodes;
  bool complete = true;
  for (NodeIndex i = 0; i < nodes.size() && complete; ++i) {
    if (loaded.pose.in_scene[i] == 0) continue;
    if (nodes[i].mesh) {
      const std::size_t most = std::min(kMostChildPoints, points_left_);
      complete = add_mesh(loaded.source, i, loaded.pose, place, most, to.points);
    }
    if (!complete || asset.external_assets().empty()) continue;
    model::AssetInTree* const child = asset_at(asset, nodes[i].object, complete);
    if (child != nullptr) complete = complete && add(*child, place * loaded.pose.world[i], to);
  }
  return complete;
}

}  // namespace gltfx::validate
