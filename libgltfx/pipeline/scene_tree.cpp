// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_tree.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/asset_obstacle.hpp"
#include "model/variants.hpp"
#include "pipeline/bake_names.hpp"
#include "pipeline/scene_pose.hpp"

namespace gltfx {
namespace {

// A few small files can ask for any number of copies of each other.
constexpr std::uint32_t kDeepestPart = 64;
constexpr std::size_t kMostParts = 4096;
constexpr std::size_t kMostPlaces = 100'000;
constexpr std::uint64_t kMostPlacedNodes = 4'000'000;

std::optional<std::uint32_t> position_of(const std::string& name,
                                         const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (name.empty() || found == names.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - names.begin());
}

PartChoice choice_of_child(const model::OpenedAsset& child, const SceneOptions& options) {
  const model::Asset asset(child.document());
  const model::Views& views = child.views();
  const SceneOptions::InExternalAssets& wanted = options.external;
  PartChoice choice;
  choice.roots = model::attached_roots(asset, views);
  choice.variant = position_of(wanted.variant, model::variant_names(asset));
  choice.animation =
      wanted.pose ? find_pose(asset, views)
                  : position_of(wanted.animation, names_in(asset, model::RootArray::animations));
  return choice;
}

PartChoice choice_of_root(const model::OpenedAsset& root, const SceneOptions& options) {
  const model::Asset asset(root.document());
  return {model::choose_scene(asset, root.views(), options.scene), options.animation,
          options.variant, options.environment};
}

std::string label_of(std::uint32_t element) { return fmt::format("External asset {}", element); }

}  // namespace

SceneTree::SceneTree(const model::OpenedAsset& root, const SceneOptions& options,
                     const schema::Set& schemas)
    : options_(options), schemas_(schemas) {
  parts_.push_back({nullptr, std::make_unique<ScenePart>(root, choice_of_root(root, options),
                                                         options, schemas)});
  find_framed();
  placed_.push_back({parts_.front().part.get(), model::Affine()});
  members_.push_back(0);
  if (parts_.front().part->places.empty()) return;
  assets_.emplace(root);
  parts_.front().asset = &assets_->root();
  positions_.emplace(&assets_->root(), 0);
  for (std::uint32_t i = 0; i < placed_.size(); ++i) {
    for (const model::ExternalPlace& place : placed_[i].part->places) attach(i, place);
  }
}

void SceneTree::find_framed() {
  const ScenePart& part = root();
  if (!options_.frame || *options_.frame >= part.views.nodes.size()) return;
  framed_.resize(part.views.nodes.size(), 0);
  std::vector<model::NodeIndex> open{*options_.frame};
  while (!open.empty()) {
    const model::NodeIndex node = open.back();
    open.pop_back();
    if (std::exchange(framed_[node], 1) != 0) continue;
    model::for_each_index(part.asset, part.views.nodes[node].children, model::RootArray::nodes,
                          [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                            if (child) open.push_back(*child);
                          });
  }
}

void SceneTree::attach(std::uint32_t above, const model::ExternalPlace& place) {
  model::AssetInTree* const asset = open(above, place.external_asset);
  if (asset == nullptr) return;
  const auto member = member_of(*asset);
  const PlacedPart parent = placed_[above];
  ScenePart* const part = member ? parts_[*member].part.get() : nullptr;
  const std::uint64_t nodes = part == nullptr ? 0 : 1 + part->drawn.size() + part->places.size();
  if (part == nullptr || placed_.size() == kMostPlaces || nodes > kMostPlacedNodes - nodes_) {
    parent.part->notes.leave_out(label_of(place.external_asset),
                                 "is left out: there are too many external assets");
    return;
  }
  nodes_ += nodes;
  PlacedPart placed{part, parent.world(place.node), parent.depth + 1, above};
  placed.framed = frames(parent, place.node);
  placed_.push_back(placed);
  members_.push_back(*member);
}

// Null if it is not to be drawn there.
model::AssetInTree* SceneTree::open(std::uint32_t above, std::uint32_t element) {
  model::AssetInTree& parent = *parts_[members_[above]].asset;
  SceneNotes& notes = placed_[above].part->notes;
  const auto file = parent.file_of(element);
  if (!file) {
    notes.leave_out(label_of(element), "has no file");
    return nullptr;
  }
  const auto& child = assets_->asset(parent, *file);
  if (!child) {
    notes.leave_out(label_of(element), fmt::format("cannot be read: {}",
                                                   printable(without_stop(child.error().message))));
    return nullptr;
  }
  if (const std::string& obstacle = obstacle_of(**child); !obstacle.empty()) {
    notes.leave_out(label_of(element), "cannot be drawn: " + obstacle);
  } else if (is_above(above, **child)) {
    notes.leave_out(label_of(element), "is among its own external assets");
  } else if (placed_[above].depth == kDeepestPart) {
    notes.leave_out(label_of(element), fmt::format("is more than {} levels deep", kDeepestPart));
  } else {
    return *child;
  }
  return nullptr;
}

const std::string& SceneTree::obstacle_of(const model::AssetInTree& asset) {
  const auto [known, is_new] = obstacles_.try_emplace(&asset);
  if (is_new) {
    if (auto obstacle = model::find_obstacle_of_child(asset.asset())) {
      known->second = std::move(obstacle->message);
    }
  }
  return known->second;
}

// The same file with other aliases is no other asset here.
bool SceneTree::is_above(std::uint32_t placed, const model::AssetInTree& asset) const {
  for (std::uint32_t i = placed;; i = placed_[i].above) {
    if (parts_[members_[i]].asset->identity() == asset.identity()) return true;
    if (placed_[i].depth == 0) return false;
  }
}

// Nothing if there are too many.
std::optional<std::size_t> SceneTree::member_of(model::AssetInTree& asset) {
  const auto known = positions_.find(&asset);
  if (known != positions_.end()) return known->second;
  if (parts_.size() == kMostParts) return std::nullopt;
  positions_.emplace(&asset, parts_.size());
  const model::OpenedAsset& opened = asset.asset();
  parts_.push_back({&asset, std::make_unique<ScenePart>(opened, choice_of_child(opened, options_),
                                                        options_, schemas_)});
  return parts_.size() - 1;
}

SceneNotes SceneTree::take_notes() {
  SceneNotes all = std::move(root().notes);
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    all.add_all(parts_[i].part->notes, quoted(parts_[i].asset->asset().name(), 100));
  }
  return all;
}

std::vector<std::string> variant_names_below(const model::OpenedAsset& root) {
  std::set<std::string> names;
  model::for_each_external_asset(root, [&names](const model::OpenedAsset& asset) {
    for (std::string& name : model::variant_names(model::Asset(asset.document()))) {
      names.insert(std::move(name));
    }
  });
  return {names.begin(), names.end()};
}

}  // namespace gltfx
