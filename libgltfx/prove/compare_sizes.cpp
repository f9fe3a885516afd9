// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_sizes.hpp"

#include <numeric>
#include <set>
#include <string>

#include <fmt/format.h>

#include "container/opened_files.hpp"
#include "measure/byte_count.hpp"
#include "prove/storage.hpp"

namespace gltfx::prove {
namespace {

ByteShares shares_of(const Side& side, const model::OpenedAsset& opened) {
  container::OpenedFiles files(opened.resolver());
  return measure::count_bytes(opened.container(), files, side.asset(), side.views(),
                              side.resources(), side.graph())
      .shares;
}

// Names of extensionsUsed that only say how something is stored.
std::set<std::string> used_for_storage(const Side& side) {
  const schema::Set& set = side.graph().set();
  const auto storage = storage_extensions(set, Types(set));
  const json::Document& document = side.document();
  const json::NodeId array = document.find(document.root(), "extensionsUsed");
  std::set<std::string> names;
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return names;
  for (const json::NodeId element : document.elements(array)) {
    if (!document.is_string(element)) continue;
    std::string name = document.string(element);
    if (storage.contains(name)) names.insert(std::move(name));
  }
  return names;
}

}  // namespace

std::vector<CompareSize> compare_sizes(const Comparison& all, const model::OpenedAsset& ours,
                                       const model::OpenedAsset& theirs) {
  const std::set<std::string> before = used_for_storage(all.ours.side());
  const std::set<std::string> after = used_for_storage(all.theirs.side());
  for (const std::string& name : before) {
    if (!after.contains(name)) all.log.note_storage(fmt::format("{} is no longer used", name));
  }
  for (const std::string& name : after) {
    if (!before.contains(name)) all.log.note_storage(fmt::format("{} is used now", name));
  }
  const ByteShares here = shares_of(all.ours.side(), ours);
  const ByteShares there = shares_of(all.theirs.side(), theirs);
  const auto total = [](const ByteShares& shares) {
    return std::accumulate(shares.begin(), shares.end(), std::uint64_t{0});
  };
  std::vector<CompareSize> sizes{{"files", total(here), total(there)}};
  for (std::size_t i = 0; i < kByteUseCount; ++i) {
    if (here[i] == there[i]) continue;
    sizes.push_back({byte_use_name(static_cast<ByteUse>(i)), here[i], there[i]});
  }
  return sizes;
}

}  // namespace gltfx::prove
