// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_external.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/asset_obstacle.hpp"
#include "model/external_assets.hpp"
#include "model/external_places.hpp"
#include "prove/changes.hpp"

namespace gltfx::prove {
namespace {

/// An asset of a tree.
struct InSide {
  const model::OpenedAsset* asset = nullptr;
  /// The element of `externalAssets` of the first asset that leads to it; nothing: it is the first.
  std::optional<std::uint32_t> through;
  std::vector<bool> opened;  ///< by external asset of this one
};

/// All assets of one side, by their paths from the folder of the first one on.
class ExternalSide {
 public:
  explicit ExternalSide(const model::OpenedAsset& first) : assets_(first), name_(first.name()) {
    std::vector<model::AssetInTree*> open;
    add(assets_.root(), std::nullopt, open);
    for (std::size_t next = 0; next < open.size(); ++next) read(*open[next], open);
  }

  const std::map<std::string, InSide>& found() const { return found_; }

 private:
  std::string relative(const std::string& name) const {
    if (name.starts_with(name_)) return name.substr(name_.size());
    return name.substr(name_.rfind('/') + 1);
  }

  InSide* add(model::AssetInTree& asset, std::optional<std::uint32_t> through,
              std::vector<model::AssetInTree*>& open) {
    const auto [entry, is_new] = found_.try_emplace(relative(asset.asset().name()));
    if (!is_new) return nullptr;
    entry->second = {&asset.asset(), through, {}};
    open.push_back(&asset);
    return &entry->second;
  }

  void read(model::AssetInTree& parent, std::vector<model::AssetInTree*>& open) {
    if (!model::has_external_assets(parent.asset().document())) return;
    InSide& entry = found_.at(relative(parent.asset().name()));
    for (std::uint32_t i = 0; i < parent.external_assets().size(); ++i) {
      const auto file = parent.file_of(i);
      const auto* const child = file ? &assets_.asset(parent, *file) : nullptr;
      const bool readable =
          child != nullptr && *child && !model::find_obstacle_of_child((**child)->asset());
      entry.opened.push_back(readable);
      if (readable) add(***child, entry.through.value_or(i), open);
    }
  }

  model::ExternalAssets assets_;
  const std::string name_;
  std::map<std::string, InSide> found_;
};

// "'red' baseColorFactor 0 -> 1, at /materials/0", and how many more there are. Of the changes of
// the greatest level, it is the one that is the most of its bound.
std::string summary_of(const CompareReport& report) {
  if (report.changes.empty()) return "it differs";
  const auto first = std::max_element(
      report.changes.begin(), report.changes.end(), [](const Change& a, const Change& b) {
        return a.level != b.level ? a.level < b.level : share_of_bound(a) < share_of_bound(b);
      });
  std::string text = first->name.empty()
                         ? first->what
                         : fmt::format("{} {}", gltfx::quoted(first->name), first->what);
  text += fmt::format(", at {}", first->new_pointer ? *first->new_pointer : *first->old_pointer);
  const std::size_t more = report.changes.size() - 1;
  return more == 0 ? text
                   : fmt::format("{}, and {} more change{}", text, more, more == 1 ? "" : "s");
}

Change change_at(const InSide& here, const InSide& there, std::uint32_t otherwise,
                 std::string what) {
  Change change;
  change.kind = "external.asset";
  change.old_pointer = fmt::format("/externalAssets/{}", here.through.value_or(otherwise));
  change.new_pointer = fmt::format("/externalAssets/{}", there.through.value_or(otherwise));
  change.what = std::move(what);
  return change;
}

// Files that only one side has, of assets that are the same.
void compare_presence(const std::string& name, const InSide& here, const InSide& there,
                      ExternalChanges& found) {
  if (here.asset->document().text() != there.asset->document().text()) return;
  for (std::uint32_t i = 0; i < std::min(here.opened.size(), there.opened.size()); ++i) {
    if (here.opened[i] == there.opened[i]) continue;
    const std::string of = name.empty() ? std::string() : fmt::format(" of {}", name);
    found.changes.push_back(
        change_at(here, there, i,
                  fmt::format("external asset {}{} {}", i, of,
                              there.opened[i] ? "can be read now" : "can no longer be read")));
  }
}

}  // namespace

ExternalChanges compare_external_assets(const model::OpenedAsset& ours,
                                        const model::OpenedAsset& theirs,
                                        const ComparePlain& compare) {
  ExternalChanges found;
  if (!model::has_external_assets(ours.document()) ||
      !model::has_external_assets(theirs.document())) {
    return found;
  }
  const ExternalSide before(ours);
  const ExternalSide after(theirs);
  for (const auto& [name, here] : before.found()) {
    const auto there = after.found().find(name);
    if (there == after.found().end()) continue;
    compare_presence(name, here, there->second, found);
    if (!here.through || !there->second.through) continue;
    const CompareReport report = compare(*here.asset, *there->second.asset);
    for (const std::string& each : report.unproven) {
      found.unproven.push_back(fmt::format("External asset {}: {}", name, each));
    }
    if (report.level == CompareLevel::storage) {
      found.storage.push_back(fmt::format("external asset {} is stored differently", name));
    }
    if (report.level <= CompareLevel::storage) continue;
    Change change =
        change_at(here, there->second, 0, fmt::format("{}: {}", name, summary_of(report)));
    change.level = report.level;
    found.changes.push_back(std::move(change));
  }
  return found;
}

}  // namespace gltfx::prove
