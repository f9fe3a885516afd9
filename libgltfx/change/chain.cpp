// SPDX-License-Identifier: Apache-2.0
#include "change/chain.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "change/companions.hpp"
#include "json/edit.hpp"
#include "json/parse.hpp"

namespace gltfx::change {

namespace {

// The position of a chunk before changes.
std::size_t position_before(const BinChanges& changes, std::size_t position) {
  if (position == kNewBin) return position;
  if (changes.contains(kNewBin)) {
    if (position == 1) return kNewBin;
    if (position > 1) --position;
  }
  for (const auto& [old, change] : changes) {
    if (change.drop && old <= position) ++position;
  }
  return position;
}

}  // namespace

void append(Change& all, const Change& next, std::string_view text) {
  if (all.empty()) {
    all = next;
    return;
  }
  all.edits = json::chain_edits(text, all.edits, next.edits);
  all.files.insert(all.files.end(), next.files.begin(), next.files.end());
  all.replaced.insert(all.replaced.end(), next.replaced.begin(), next.replaced.end());
  if (next.format) {  // with all bytes of the asset before it
    all.format = next.format;
    all.glb_version = next.glb_version;
    all.bins.clear();
  }
  std::vector<std::pair<std::size_t, BinChange>> bins;
  for (const auto& [position, bin] : next.bins) {
    bins.emplace_back(position_before(all.bins, position), bin);
  }
  for (auto& [position, bin] : bins) all.bins[position] = std::move(bin);
}

NewText drop_unnamed_files(Change& all, std::string_view text) {
  if (all.files.empty() && all.replaced.empty()) return {};
  NewText now;
  now.text = share_text(json::apply_edits(text, all.edits));
  now.parsed = json::parse(now.text);
  const std::set<std::string> named = referred_paths(now.parsed.document);
  std::erase_if(all.files, [&](const NewFile& file) { return !named.contains(file.path); });
  std::erase_if(all.replaced, [&](const ReplacedFile& file) { return !named.contains(file.path); });
  return now;
}

}  // namespace gltfx::change
