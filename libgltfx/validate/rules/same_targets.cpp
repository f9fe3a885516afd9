// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/same_targets.hpp"

#include <algorithm>
#include <optional>

#include "model/fields.hpp"

namespace gltfx::validate {
namespace {

constexpr std::size_t kNoGroup = SIZE_MAX;

using Target = std::pair<std::uint64_t, std::string>;  // node, path

std::optional<Target> target_of(const Context& context, const model::AnimationChannel& channel) {
  if (context.deviations.targets_compare_as_written) {
    const auto node = model::unsigned_member(context.document, channel.target, "node");
    if (!node) return std::nullopt;
    return Target{*node, model::string_member(context.document, channel.target, "path")};
  }
  const std::string_view path = model::animation_path_name(channel.path);
  if (!channel.node || path.empty()) return std::nullopt;
  return Target{*channel.node, std::string(path)};
}

}  // namespace

SameTargets::SameTargets(const Context& context, const model::Animation& animation)
    : all_(context.deviations.each_finding_is_listed),
      left_(std::max<std::size_t>(1000, animation.channels.size())) {
  std::map<Target, std::size_t> known;
  for (std::size_t i = 0; i < animation.channels.size(); ++i) {
    const auto target = target_of(context, animation.channels[i]);
    place_.emplace_back(kNoGroup, 0);
    if (!target) continue;
    const auto [group, is_new] = known.emplace(*target, groups_.size());
    if (is_new) groups_.emplace_back();
    place_.back() = {group->second, groups_[group->second].size()};
    groups_[group->second].push_back(i);
  }
}

std::vector<std::size_t> SameTargets::behind(std::size_t channel) {
  const auto [group, place] = place_[channel];
  if (group == kNoGroup) return {};
  const std::vector<std::size_t>& channels = groups_[group];
  const std::size_t first = place + 1;
  const std::size_t found = channels.size() - first;
  const std::size_t count = all_ ? std::min(found, left_) : std::min<std::size_t>(found, 1);
  if (all_) left_ -= count;
  const auto begin = channels.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace gltfx::validate
