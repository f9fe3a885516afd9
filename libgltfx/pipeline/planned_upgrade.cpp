// SPDX-License-Identifier: Apache-2.0
#include "pipeline/planned_upgrade.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/pages.hpp"
#include "base/text.hpp"
#include "change/commit.hpp"
#include "change/companions.hpp"
#include "change/deletion.hpp"
#include "change/place.hpp"
#include "change/rewrite.hpp"
#include "graph/extras.hpp"
#include "graph/orphans.hpp"
#include "pipeline/edit_asset.hpp"
#include "steps/upgrade/ambiguity.hpp"
#include "steps/upgrade/asset_pictures.hpp"
#include "steps/upgrade/plan.hpp"
#include "steps/upgrade/render.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using model::OpenedAsset;

PlannedUpgrade without_plan(PlannedUpgrade planned, EditProblem problem, std::string error) {
  return {failed(std::move(planned.report), problem, std::move(error)), {}, {}};
}

bool is_lossless(const std::vector<UpgradeAction>& actions) {
  return std::all_of(actions.begin(), actions.end(), [](const UpgradeAction& action) {
    return !action.is_due() || (action.outcome == UpgradeOutcome::safe && !action.lossy);
  });
}

// A new name is one that is free, or taken by the same bytes, where the asset is and where it goes.
bool is_free(const OpenedAsset& asset, const std::string& output, const std::string& path,
             std::string_view content) {
  const container::Resolved here = asset.resolver().open(path);
  if (here.error == container::ResolveError::none
          ? here.bytes.text() != content
          : here.error != container::ResolveError::not_found &&
                here.error != container::ResolveError::no_root) {
    return false;
  }
  if (!asset.resolver().looks_on_disk()) return true;
  const fs::path there = change::target_folder(asset.name(), output) / path;
  std::error_code error;
  return !fs::exists(fs::symlink_status(there, error)) ||
         change::has_bytes(there,
                           {{std::as_bytes(std::span(content.data(), content.size())), nullptr}});
}

// Makes new images and finds a place for all that is added.
Result<change::Change> resolve(upgrade::Plan& plan, const OpenedAsset& asset,
                               const std::string& output, const model::AssetBytes& bytes,
                               upgrade::Pictures& pictures) {
  std::vector<change::Additions::Image>& images = plan.change.additions.images();
  for (std::size_t i = 0; i < images.size(); ++i) {
    const upgrade::ImageJob& job = plan.images[i];
    auto file = upgrade::render(job, pictures, upgrade::ImageCache::shared(), bytes.origin());
    if (!file) return file.error();
    images[i].png = *std::move(file);
    images[i].beside = bytes.image_file_uri(job.first_image());
  }
  return change::place(std::move(plan.change), asset,
                       [&](const std::string& path, std::string_view content) {
                         return is_free(asset, output, path, content);
                       });
}

/// Indices by root array, of what only textures lead to and of textures.
using Elements = std::map<std::string, std::set<std::uint64_t>>;

json::NodeId find_list(const graph::Tree& tree, const std::string& array) {
  const json::NodeId list = tree.member(tree.document().root(), array);
  return list != json::kNoNode && tree.document().is_array(list) ? list : json::kNoNode;
}

// What may become an orphan: elements that something refers to, and textures that were released,
// whatever refers to them.
Elements referred_elements(const json::Document& document,
                           const std::vector<std::uint64_t>& released, const schema::Set& schemas) {
  const graph::Graph graph(document, schemas);
  const graph::Tree& tree = graph.tree();
  const graph::Orphans orphans(graph);
  Elements referred;
  referred["textures"].insert(released.begin(), released.end());
  for (const char* array : {"textures", "images", "bufferViews"}) {
    const json::NodeId list = find_list(tree, array);
    const std::uint64_t size = list == json::kNoNode ? 0 : tree.size(list);
    for (std::uint64_t i = 0; i < size; ++i) {
      const json::NodeId element = tree.element(list, i);
      if (orphans.is_used(element)) referred[array].insert(i);
    }
  }
  return referred;
}

// Those of them to which nothing refers but others.
Elements find_orphans(const Elements& referred, const json::Document& now,
                      const schema::Set& schemas) {
  const graph::Graph graph(now, schemas);
  const graph::Tree& tree = graph.tree();
  std::vector<json::NodeId> candidates;
  for (const auto& [array, indices] : referred) {
    const json::NodeId list = find_list(tree, array);
    if (list == json::kNoNode) continue;
    for (const std::uint64_t index : indices) candidates.push_back(tree.element(list, index));
  }
  std::erase(candidates, json::kNoNode);
  std::sort(candidates.begin(), candidates.end());
  Elements orphans;
  for (const json::NodeId orphan : graph::find_orphans(graph, candidates)) {
    orphans[std::string(tree.name(tree.parent(orphan)))].insert(tree.position(orphan));
  }
  return orphans;
}

std::vector<UpgradeOrphan> listed(const Elements& orphans, const OpenedAsset& asset) {
  std::vector<UpgradeOrphan> list;
  const model::Asset elements(asset.document());
  model::AssetBytes bytes(elements, asset.container(), asset.resolver());
  for (const auto& [array, indices] : orphans) {
    for (const std::uint64_t index : indices) {
      UpgradeOrphan orphan{fmt::format("/{}/{}", array, index), 0, false};
      if (array == "images") {
        const auto content = bytes.image(index);
        orphan.bytes = content ? content->size() : 0;
      }
      list.push_back(std::move(orphan));
    }
  }
  return list;
}

SharedText new_text(const OpenedAsset& asset, const std::vector<json::Edit>& edits) {
  return share_text(json::apply_edits(*asset.container().json, edits));
}

// An Error says why the orphans stay.
Result<change::Deletion> plan_pruning(const json::Document& document, const Elements& orphans,
                                      const container::Container& container,
                                      const schema::Set& schemas) {
  for (const json::NodeId value :
       graph::likely_indices(document, {"texture", "image", "bufferview"})) {
    if (!document.is_number(value)) continue;
    return Error{fmt::format("{} may be an index", printable(document.pointer_of(value)))};
  }
  std::vector<std::string> pointers;
  for (const auto& [array, indices] : orphans) {
    for (const std::uint64_t i : indices) pointers.push_back(fmt::format("/{}/{}", array, i));
  }
  auto deletion = change::plan_deletion(document, schemas, pointers, {false, &container});
  if (!deletion || deletion->obstacles.empty()) return deletion;
  return Error{fmt::format("{} refers to {}", printable(deletion->obstacles.front().pointer),
                           printable(deletion->obstacles.front().target))};
}

// What additions refer to is not missed: they stand behind everything that was there before. The
// old and the new document are not looked at together.
void look_for_orphans(const OpenedAsset& asset, const Elements& referred,
                      const UpgradeOptions& options, const schema::Set& schemas,
                      PlannedUpgrade& planned) {
  planned.now.parsed = json::parse(planned.now.text);
  const json::Document& now = planned.now.parsed.document;
  const Elements orphans = find_orphans(referred, now, schemas);
  if (orphans.empty()) return;
  std::optional<Result<change::Deletion>> pruned;
  if (options.prune) pruned = plan_pruning(now, orphans, asset.container(), schemas);
  if (asset.is_large()) planned.now.parsed = {};
  UpgradeReport& report = planned.report;
  report.orphans = listed(orphans, asset);
  if (!pruned) return;
  if (!*pruned) {
    report.orphans_kept = pruned->error().message;
    return;
  }
  std::vector<json::Edit>& edits = planned.change.edits;
  edits = json::chain_edits(*asset.container().json, edits, (*pruned)->change.edits);
  for (auto& [position, bin] : (*pruned)->change.bins) {
    if (!bin.cut.empty()) planned.change.bins[position].cut = std::move(bin.cut);
  }
  for (UpgradeOrphan& orphan : report.orphans) orphan.removed = true;
  report.names_removed = std::move((*pruned)->names);
  planned.now = {new_text(asset, edits), {}};
}

// Said with the plan: what is valid may still not be seen.
void note_targets(const std::vector<TargetChoice>& targets, std::vector<UpgradeAction>& actions) {
  for (UpgradeAction& action : actions) {
    if (!action.is_due()) continue;
    for (const TargetChoice& choice : targets) {
      const auto found = choice.target->features.find(action.to);
      if (found == choice.target->features.end()) continue;
      const TargetRange* range = outcome_of(found->second.used, choice.version);
      if (range == nullptr || range->outcome != TargetOutcome::ignored) continue;
      action.notes.push_back(fmt::format("{} ignores {}", choice.label(), action.to));
    }
  }
}

}  // namespace

UpgradeReport failed(UpgradeReport report, EditProblem problem, std::string error) {
  note_failure(report, problem, std::move(error));
  for (UpgradeAction& action : report.actions) action.done = false;
  report.new_files.clear();
  report.new_warnings.clear();
  report.verified = false;
  report.orphans.clear();
  return report;
}

PlannedUpgrade plan_upgrade(const validate::ValidatedAsset& validated,
                            const UpgradeOptions& options,
                            const std::shared_ptr<const schema::Set>& schemas,
                            const std::function<void()>& release) {
  const OpenedAsset& asset = validated.asset();
  const model::Asset elements(asset.document());
  model::AssetBytes bytes(elements, asset.container(), asset.resolver());
  upgrade::AssetPictures pictures(bytes, upgrade::ImageCache::shared());
  upgrade::Plan plan = upgrade::make_plan(asset.document(), *schemas, options, &pictures, &bytes);
  PlannedUpgrade planned;
  UpgradeReport& report = planned.report;
  report.path = asset.name();
  if (const std::string why = pictures.failure(); !why.empty()) {
    return without_plan(std::move(planned), EditProblem::unreadable, why);
  }
  const auto ambiguity = upgrade::find_ambiguity(asset.parsed(), plan);
  report.actions = std::move(plan.actions);
  note_targets(options.targets, report.actions);
  if (report.due() == 0) return planned;
  const auto refuse = [&planned](std::string why) {
    return without_plan(std::move(planned), EditProblem::refused, std::move(why));
  };
  if (ambiguity) return refuse(*ambiguity);
  const auto obstacle = change::find_glb_obstacle(asset.container());
  if (obstacle && !plan.change.edits.empty())
    return refuse("it cannot be written anew: " + *obstacle);
  report.changes = !plan.change.empty();
  if (options.strict && !is_lossless(report.actions)) {
    return refuse("not everything can be upgraded without loss (--strict)");
  }
  auto placed = resolve(plan, asset, options.output, bytes, pictures);
  if (!placed) return refuse(placed.error().message);
  planned.change = *std::move(placed);
  for (const change::NewFile& file : planned.change.files) report.new_files.push_back(file.path);
  if (!report.changes) return planned;
  planned.now.text = new_text(asset, planned.change.edits);
  std::optional<Elements> referred;
  if (elements.count(model::RootArray::textures) > 0) {
    referred = referred_elements(asset.document(), plan.released, *schemas);
  }
  release();
  if (!options.prune && !options.diff) planned.change.edits = {};
  give_back_memory();
  if (referred) look_for_orphans(asset, *referred, options, *schemas, planned);
  release();
  if (options.diff) report.diff = diff_of(asset, planned.change.edits);
  return planned;
}

}  // namespace gltfx
