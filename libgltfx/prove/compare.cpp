// SPDX-License-Identifier: Apache-2.0
#include "prove/compare.hpp"

#include <algorithm>

#include "prove/compare_drawn.hpp"
#include "prove/compare_external.hpp"
#include "prove/compare_motion.hpp"
#include "prove/compare_nodes.hpp"
#include "prove/compare_poses.hpp"
#include "prove/compare_sizes.hpp"
#include "prove/compare_texels.hpp"
#include "prove/compare_values.hpp"
#include "prove/drawn_items.hpp"
#include "prove/forget_undrawn.hpp"
#include "prove/shared_causes.hpp"

namespace gltfx::prove {
namespace {

bool same_optional(const std::optional<container::Bytes>& a,
                   const std::optional<container::Bytes>& b) {
  return a.has_value() == b.has_value() && (!a || container::same_bytes(*a, *b));
}

// Of equal texts: all files that both refer to.
bool same_resources(const model::OpenedAsset& ours, const model::OpenedAsset& theirs,
                    unsigned jobs) {
  const auto load = [&](const model::OpenedAsset& opened) {
    container::OpenedFiles files(opened.resolver());
    const model::Asset asset(opened.document());
    return model::load_resources(opened.container(), files, asset, opened.views(), jobs).data;
  };
  const model::ResourceData here = load(ours);
  const model::ResourceData there = load(theirs);
  bool same = here.buffers.size() == there.buffers.size();
  for (std::size_t i = 0; same && i < here.buffers.size(); ++i) {
    same = same_optional(here.buffers[i], there.buffers[i]);
  }
  same = same && here.images.size() == there.images.size();
  for (std::size_t i = 0; same && i < here.images.size(); ++i) {
    same = same_optional(here.images[i].bytes, there.images[i].bytes);
  }
  return same;
}

void add_external(const ExternalChanges& external, ChangeLog& log) {
  for (const Change& change : external.changes) log.add(change);
  for (const std::string& each : external.storage) log.note_storage(each);
  for (const std::string& each : external.unproven) log.leave_out(each);
}

std::vector<ChangedBoxes> compare_plain(const model::OpenedAsset& ours,
                                        const model::OpenedAsset& theirs,
                                        const schema::Set& schemas, const CompareOptions& options,
                                        const ExternalChanges& external, CompareReport& report) {
  // A draft with another text has the bytes of its asset.
  const bool same_bytes = ours.document().text() == theirs.document().text() &&
                          container::same_bytes(ours.container().bytes, theirs.container().bytes);
  if (same_bytes && external.empty() && same_resources(ours, theirs, options.jobs)) {
    report.level = CompareLevel::identical;
    return {};
  }
  const Side here(ours, schemas, Scope::all, options.jobs);
  const Side there(theirs, schemas, Scope::all, options.jobs);
  const Content before(here);
  const Content after(there);
  const NodeTree our_nodes(before);
  const NodeTree their_nodes(after);
  const Matching match(before, our_nodes, after, their_nodes, !options.drawn);
  const std::vector<TextureUse> uses = texture_uses(before);
  ChangeLog log(options);
  const double one = our_nodes.diagonal();
  const double other = their_nodes.diagonal();
  const double diagonal = one > 0 && other > 0 ? std::min(one, other) : std::max(one, other);
  std::optional<DrawnItems> our_drawn, their_drawn;
  if (options.drawn) {
    our_drawn.emplace(before, our_nodes);
    their_drawn.emplace(after, their_nodes);
  }
  const Comparison all{before,
                       after,
                       our_nodes,
                       their_nodes,
                       match,
                       options,
                       log,
                       uses,
                       diagonal,
                       our_drawn ? &*our_drawn : nullptr,
                       their_drawn ? &*their_drawn : nullptr};
  const Helpers helpers = find_helpers(all);
  compare_values(all, helpers);
  compare_presence(all, helpers);
  compare_nodes(all, helpers);
  compare_motion(all, helpers);
  compare_image_texels(all);
  compare_stored_objects(all);
  if (options.drawn) forget_undrawn(all);
  if (options.drawn && log.differs()) compare_drawn(all);
  compare_poses(all);
  merge_shared_causes(all);
  add_external(external, log);
  if (options.count.contains("order")) compare_order_of_lists(all);
  if (match.is_renumbered()) log.note_storage("objects have other numbers");
  report.sizes = compare_sizes(all, ours, theirs);
  log.take(report);
  locate_changes(all, ours.container().json_offset, theirs.container().json_offset, report);
  if (options.picture_size == 0) return {};
  return find_changed_boxes(all, report);
}

}  // namespace

std::vector<ChangedBoxes> compare_assets(const model::OpenedAsset& ours,
                                         const model::OpenedAsset& theirs,
                                         const schema::Set& schemas, const CompareOptions& options,
                                         CompareReport& report) {
  CompareOptions without_pictures = options;
  without_pictures.picture_size = 0;
  const auto compare = [&](const model::OpenedAsset& before, const model::OpenedAsset& after) {
    CompareReport one;
    compare_plain(before, after, schemas, without_pictures, {}, one);
    return one;
  };
  const ExternalChanges external = compare_external_assets(ours, theirs, compare);
  return compare_plain(ours, theirs, schemas, options, external, report);
}

}  // namespace gltfx::prove
