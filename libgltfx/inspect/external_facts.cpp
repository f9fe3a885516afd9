// SPDX-License-Identifier: Apache-2.0
#include "inspect/external_facts.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "inspect/facts.hpp"
#include "model/asset_obstacle.hpp"
#include "model/external_assets.hpp"
#include "model/external_places.hpp"
#include "model/fields.hpp"
#include "model/scene_extent.hpp"
#include "schema/version.hpp"

namespace gltfx::inspect {
namespace {

using model::Affine;
using model::AssetInTree;

// Children of children that are listed, and rows in all: an asset may ask for any number.
constexpr std::size_t kDeepestChild = 64;
constexpr std::size_t kMostChildRows = 10'000;

/// What the default scene of an asset draws, external assets included.
struct DrawnTotal {
  std::optional<SceneBounds> bounds;
  std::uint64_t triangles = 0;
};

/// An asset whose external assets are being read.
struct ParentLevel {
  AssetInTree* asset = nullptr;
  std::uint32_t next = 0;                   // element of externalAssets
  std::vector<std::uint64_t> placed;        // by element: nodes that have it
  std::vector<std::vector<Affine>> places;  // by element: where the scene shows it
  DrawnTotal total;
};

class ExternalReader {
 public:
  ExternalReader(const model::OpenedAsset& opened, const schema::Set& schemas,
                 const InspectOptions& options, AssetFacts& facts)
      : assets_(opened), schemas_(schemas), facts_(facts) {
    child_options_.jobs = options.jobs;
  }

  void run() {
    AssetInTree& root = assets_.root();
    for (std::uint32_t i = 0; i < root.files().size(); ++i) add_file(root, i);
    const model::Asset asset(root.asset().document());
    enter(root, {facts_.bounds, facts_.drawn_triangles},
          model::choose_scene(asset, root.asset().views()));
    while (!levels_.empty()) {
      ParentLevel& level = levels_.back();
      if (level.next < level.placed.size() && !full()) {
        read(level, level.next++);
      } else {
        leave();
      }
    }
  }

 private:
  void add_file(AssetInTree& root, std::uint32_t index) {
    ReferredFileFacts& file = facts_.referred_files.emplace_back();
    const json::NodeId object = root.files()[index];
    if (object == json::kNoNode) return;
    const json::Document& document = root.asset().document();
    file.name = model::string_member(document, object, "name");
    file.uri = model::string_member(document, object, "uri");
    file.mime_type = model::string_member(document, object, "mimeType");
    const json::NodeId aliases = document.find(object, "aliases");
    if (aliases != json::kNoNode && document.kind(aliases) == json::Kind::array) {
      for (const json::NodeId each : document.elements(aliases)) {
        if (!document.is_object(each)) continue;
        file.aliases.push_back(model::string_member(document, each, "alias"));
      }
    }
    const auto& contents = assets_.file(root, index);
    if (contents) {
      file.bytes = contents->bytes.size();
    } else {
      file.problem = without_stop(contents.error().message);
    }
  }

  // Precondition: it is in no level yet.
  void enter(AssetInTree& asset, DrawnTotal own, const model::SceneRoots& roots) {
    ParentLevel level;
    level.asset = &asset;
    level.total = own;
    const model::OpenedAsset& opened = asset.asset();
    const model::Views& views = opened.views();
    level.placed.resize(asset.external_assets().size());
    level.places.resize(level.placed.size());
    const auto places = model::external_places(opened.document(), views);
    if (!places.empty()) {
      const model::Pose pose = model::compute_pose(model::Asset(opened.document()), views, roots);
      for (const auto& [node, element] : places) {
        ++level.placed[element];
        if (pose.visible[node] != 0) level.places[element].push_back(pose.world[node]);
      }
    }
    levels_.push_back(std::move(level));
  }

  void leave() {
    const ParentLevel level = std::move(levels_.back());
    levels_.pop_back();
    totals_[level.asset] = level.total;
    if (levels_.empty()) {
      facts_.bounds = level.total.bounds;
      facts_.drawn_triangles = level.total.triangles;
    } else {
      add_drawn(levels_.back(), levels_.back().next - 1, level.total);
    }
  }

  static void add_drawn(ParentLevel& parent, std::uint32_t element, const DrawnTotal& drawn) {
    for (const Affine& place : parent.places[element]) {
      parent.total.triangles = saturating_add(parent.total.triangles, drawn.triangles);
      if (drawn.bounds) model::include_bounds(*drawn.bounds, place, parent.total.bounds);
    }
  }

  bool full() {
    if (facts_.external_assets.size() < kMostChildRows) return false;
    if (!std::exchange(told_, true)) {
      facts_.problems.push_back(
          fmt::format("More than {} external assets: the others are not listed.", kMostChildRows));
    }
    return true;
  }

  void read(ParentLevel& level, std::uint32_t element) {
    ExternalAssetFacts row;
    row.depth = levels_.size() - 1;
    row.index = element;
    row.placed = level.placed[element];
    AssetInTree& parent = *level.asset;
    const auto file = parent.file_of(element);
    const json::Document& document = parent.asset().document();
    row.path = fmt::format("{}#/externalAssets/{}", parent.asset().name(), element);
    if (file && parent.files()[*file] != json::kNoNode) {
      const std::string uri = model::string_member(document, parent.files()[*file], "uri");
      if (!uri.empty() && !uri.starts_with("data:")) row.path = uri;
      row.mime_type = model::string_member(document, parent.files()[*file], "mimeType");
    }
    AssetInTree* const child = open(parent, file, row);
    if (child != nullptr) row.path = child->asset().name();
    if (child != nullptr && row.problem.empty()) choose_state(*child, row);
    if (row.state == ExternalAssetState::read) return read_child(*child, std::move(row));
    if (row.state == ExternalAssetState::repeated) add_drawn(level, element, totals_.at(child));
    facts_.external_assets.push_back(std::move(row));
  }

  // Null, or a problem in the row, if it cannot be read.
  AssetInTree* open(AssetInTree& parent, const std::optional<std::uint32_t>& file,
                    ExternalAssetFacts& row) {
    row.state = ExternalAssetState::unread;
    if (!file) {
      row.problem = "it has no file";
      return nullptr;
    }
    const auto& child = assets_.asset(parent, *file);
    if (!child) {
      row.problem = without_stop(child.error().message);
      return nullptr;
    }
    if (const auto obstacle = model::find_obstacle_of_child((*child)->asset())) {
      row.problem = obstacle->message;
    } else if (levels_.size() > kDeepestChild) {
      row.problem = fmt::format("it is more than {} levels deep", kDeepestChild);
    }
    return *child;
  }

  void choose_state(const AssetInTree& child, ExternalAssetFacts& row) const {
    row.state = totals_.count(&child) > 0 ? ExternalAssetState::repeated : ExternalAssetState::read;
    for (const ParentLevel& level : levels_) {
      if (level.asset->identity() == child.identity()) row.state = ExternalAssetState::cycle;
    }
  }

  void read_child(AssetInTree& child, ExternalAssetFacts row) {
    const AssetFacts own = collect_own_facts(child.asset(), schemas_, child_options_);
    row.nodes = own.nodes;
    row.meshes = own.meshes.size();
    row.triangles = own.triangles;
    row.bytes = own.total_bytes();
    for (const std::string& problem : own.problems) {
      facts_.problems.push_back(fmt::format("{}: {}", row.path, problem));
    }
    facts_.external_assets.push_back(std::move(row));
    const model::Asset asset(child.asset().document());
    const model::SceneRoots roots = model::attached_roots(asset, child.asset().views());
    DrawnTotal total;
    if (roots.scene) total = {own.bounds, own.drawn_triangles};
    enter(child, total, roots);
  }

  model::ExternalAssets assets_;
  const schema::Set& schemas_;
  InspectOptions child_options_;
  AssetFacts& facts_;
  std::vector<ParentLevel> levels_;  // from the asset down
  std::map<const AssetInTree*, DrawnTotal> totals_;
  bool told_ = false;
};

std::uint64_t count_objects(const json::Document& document, std::string_view array) {
  const json::NodeId list = document.find(document.root(), array);
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return 0;
  return document.array_size(list);
}

}  // namespace

void add_external_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                        const InspectOptions& options, AssetFacts& facts) {
  const json::Document& document = opened.document();
  if (schema::stated_version(document) <= schema::kVersion2) return;
  facts.shapes = count_objects(document, "shapes");
  for (const model::Node& node : opened.views().nodes) {
    if (node.object == json::kNoNode) continue;
    const bool has = model::object_member(document, node.object, "boundingVolume") != json::kNoNode;
    facts.bounding_volumes += has ? 1 : 0;
  }
  ExternalReader(opened, schemas, options, facts).run();
}

}  // namespace gltfx::inspect
