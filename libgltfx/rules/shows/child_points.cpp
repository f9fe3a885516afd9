// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/child_points.hpp"

#include <algorithm>

#include "codec/client.hpp"
#include "container/opened_files.hpp"
#include "model/fields.hpp"
#include "model/instancing.hpp"
#include "model/pose.hpp"

namespace gltfx::validate {
namespace {

using model::Affine;
using model::NodeIndex;
using model::RootArray;

constexpr std::size_t kMostChildPoints = std::size_t{1} << 23U;  // of one node
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
              const Affine& place, model::Vectors<3>& points) {
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
  if (!blocks || blocks->size() * copies.size() > kMostChildPoints - points.size()) return false;
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

ChildPoints::ChildPoints(const model::OpenedAsset& asset) : assets_(asset) {
  above_.push_back(assets_.root().identity());
}

const model::PointBlocks* ChildPoints::of(NodeIndex node, bool& complete) {
  model::AssetInTree& root = assets_.root();
  if (root.external_assets().empty()) return nullptr;
  const json::NodeId object = root.asset().views().nodes[node].object;
  model::AssetInTree* const child = asset_at(root, object, complete);
  if (child == nullptr) return nullptr;
  const auto [known, is_new] = known_.try_emplace(child);
  if (is_new) {
    Points points;
    known->second.complete = add(*child, Affine(), points);
    known->second.blocks = model::PointBlocks(std::move(points));
  }
  complete = complete && known->second.complete;
  return &known->second.blocks;
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

bool ChildPoints::add(model::AssetInTree& asset, const Affine& place, Points& points) {
  const bool is_cycle = std::find(above_.begin(), above_.end(), asset.identity()) != above_.end();
  if (is_cycle || above_.size() > kMostNested) return false;
  above_.push_back(asset.identity());
  const bool complete = add_own(asset, place, points);
  above_.pop_back();
  return complete;
}

bool ChildPoints::add_own(model::AssetInTree& asset, const Affine& place, Points& points) {
  const model::OpenedAsset& opened = asset.asset();
  const json::Document& document = opened.document();
  if (document.empty() || !document.is_object(document.root())) return false;
  const model::Asset tables(document);
  const model::Views& views = opened.views();
  if (tables.count(RootArray::scenes) == 0) return true;  // nothing becomes part of the parent
  container::OpenedFiles files(opened.resolver());
  const std::vector<bool> no_images(tables.count(RootArray::images));
  const auto loaded =
      model::load_resources(opened.container(), files, tables, views, 1, &no_images);
  model::DracoMeshes draco;
  draco.add_all(tables, views, loaded.data);
  draco.decode(codec::Client::shared(), 1);
  const model::GeometrySource source{tables, views, loaded.data, draco};
  const model::Pose pose = model::compute_pose(tables, views, model::choose_scene(tables, views));
  bool complete = true;
  for (NodeIndex i = 0; i < views.nodes.size() && complete; ++i) {
    if (pose.in_scene[i] == 0) continue;
    if (views.nodes[i].mesh) complete = add_mesh(source, i, pose, place, points);
    if (!complete || asset.external_assets().empty()) continue;
    model::AssetInTree* const child = asset_at(asset, views.nodes[i].object, complete);
    if (child != nullptr) complete = complete && add(*child, place * pose.world[i], points);
  }
  return complete;
}

}  // namespace gltfx::validate
