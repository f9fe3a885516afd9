// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_trials.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/checked.hpp"

namespace gltfx {

std::uint64_t affordable_trials(const model::OpenedAsset& asset) {
  constexpr std::uint64_t kTrialBytes = 32U << 20U, kLeast = 8, kMost = 256;
  std::uint64_t size = asset.container().bytes.size() + 1;
  if (!asset.document().empty()) {
    for (const model::BufferView& view : asset.views().buffer_views) {
      size = saturating_add(size, view.byte_length.value_or(0));
    }
  }
  return std::clamp(kTrialBytes / size, kLeast, kMost);
}

std::vector<SitePositions> parts_of(const SitePositions& group, const validate::Sites& sites,
                                    const std::vector<json::NodeId>& shared) {
  std::map<Code, SitePositions> by_code;
  for (const std::size_t i : group) by_code[sites[i].code].push_back(i);
  std::vector<SitePositions> parts;
  if (by_code.size() > 1) {
    for (auto& [code, part] : by_code) parts.push_back(std::move(part));
  } else {
    SitePositions begins;  // where a half may begin
    for (std::size_t i = 0; i < group.size(); ++i) {
      const json::NodeId value = shared[group[i]];
      if (i == 0 || value == json::kNoNode || value != shared[group[i - 1]]) begins.push_back(i);
    }
    const auto middle = group.begin() + static_cast<std::ptrdiff_t>(begins[begins.size() / 2]);
    if (middle != group.begin()) parts.emplace_back(group.begin(), middle);
    parts.emplace_back(middle, group.end());
  }
  return parts;
}

}  // namespace gltfx
