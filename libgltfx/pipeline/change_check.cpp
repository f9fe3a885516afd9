// SPDX-License-Identifier: Apache-2.0
#include "pipeline/change_check.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>

#include "prove/compare.hpp"

namespace gltfx {
namespace {

// Rounding of numbers that went through a matrix, or of times.
constexpr double kRounded = 1e-6;

bool begins_with(std::string_view kind, std::initializer_list<std::string_view> families) {
  return std::any_of(families.begin(), families.end(),
                     [&](std::string_view family) { return kind.starts_with(family); });
}

CompareBounds bounds_of(const ConvertOptions& options) {
  const LossBounds none;
  const LossBounds& asked = options.quantize ? *options.quantize : none;
  const auto bound = [](const std::optional<double>& value) {
    return std::max(value.value_or(0), kRounded);
  };
  CompareBounds bounds;
  bounds.position = bound(asked.position);
  bounds.normal = std::max(asked.normal.value_or(0), 1e-4);
  bounds.texcoord = std::max(asked.texcoord.value_or(0), 1e-3);
  bounds.color = bound(asked.color);
  bounds.weight = bound(asked.weight);
  // Curves that are resampled are proven to one unit in the last place, which is a greater part of
  // the diagonal the farther away they are.
  const bool resampled = options.resample || options.shrink;
  bounds.animation = std::max(bound(asked.animation), resampled ? CompareBounds().animation : 0);
  bounds.factor = kRounded;
  bounds.image = 0;
  return bounds;
}

// Members that glTF 2.0 does not have, and what takes their place.
bool is_of_later_version(const Change& change) {
  const std::string& place = change.old_pointer ? *change.old_pointer : *change.new_pointer;
  return begins_with(change.kind, {"asset.value", "object.removed", "geometry.attribute"}) ||
         place.starts_with("/asset/extras") || place.ends_with("/boundingVolume");
}

}  // namespace

AllowedChanges changes_of_upgrade() {
  AllowedChanges allowed;
  allowed.bounds = {0, 0, 0, 0, 0, 0, 0, 0};
  allowed.others = [](const Change& change) {
    return begins_with(change.kind, {"material.", "texture.", "image.", "object.", "extension.list",
                                     "geometry.material", "animation.channel", "asset.value"}) ||
           (change.old_pointer && change.old_pointer->find("/extensions/") != std::string::npos) ||
           (change.new_pointer && change.new_pointer->find("/extensions/") != std::string::npos);
  };
  return allowed;
}

AllowedChanges changes_of_conversion(const ConvertOptions& options) {
  AllowedChanges allowed;
  allowed.bounds = bounds_of(options);
  // Targets, another size or place, and copies of external assets change what they are asked to.
  const bool free = !options.targets.empty() || options.placement.center ||
                    options.placement.scale != 1 || options.placement.rebase ||
                    options.later.flatten;
  const bool becomes_older = !options.later.gltf.empty();
  const bool images = !options.images.empty() || options.quality || options.texture_size;
  const bool merges = options.dedup || options.shrink;
  const bool prunes = options.prune || options.shrink;
  const bool simplifies = options.simplify.has_value();
  allowed.others = [=](const Change& change) {
    const std::string_view kind = change.kind;
    if (free || kind == "stored.name") return true;
    if (becomes_older && is_of_later_version(change)) return true;
    if (images && begins_with(kind, {"image.", "texture.value"})) return true;
    if (simplifies && begins_with(kind, {"geometry."})) return true;
    if (merges && (kind.ends_with(".removed") || kind.ends_with(".renamed"))) return true;
    return prunes && (kind.ends_with(".removed") || kind == "geometry.attribute" ||
                      kind == "extension.list" || kind == "animation.channel");
  };
  return allowed;
}

ChangeCheck check_changes(const model::OpenedAsset& before, const model::OpenedAsset& after,
                          const schema::Set& schemas, const AllowedChanges& allowed,
                          unsigned jobs) {
  CompareOptions options;
  options.bounds = allowed.bounds;
  options.jobs = jobs;
  CompareReport report;
  prove::compare_assets(before, after, schemas, options, report);
  ChangeCheck check;
  for (const Change& change : report.changes) {
    if (change.level != CompareLevel::differs || allowed.others(change)) continue;
    check.difference = fmt::format("{} would differ ({}): {}",
                                   change.old_pointer ? *change.old_pointer : *change.new_pointer,
                                   change.kind, change.what);
    return check;
  }
  if (!report.unproven.empty()) {
    check.unproven = report.unproven.front();
    if (check.unproven.ends_with('.')) check.unproven.pop_back();
  }
  return check;
}

}  // namespace gltfx
