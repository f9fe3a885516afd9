// SPDX-License-Identifier: Apache-2.0
// Animations: keyframes, targets, and whether they match (specification section 3.11).
#include "model/animation.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "model/skin.hpp"
#include "rules/context.hpp"
#include "rules/core/animation_output.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/khronos/animation_paths.hpp"

namespace gltfx::validate {
namespace {

class SameTargets {
 public:
  /// Compares existing nodes and properties of nodes; Deviations::targets_compare_as_written.
  SameTargets(const Context& context, const model::Animation& animation);

  /// Later channels with the target of `channel`: the next one; Deviations::each_finding_is_listed:
  /// all of them, up to a limit.
  std::vector<std::size_t> behind(std::size_t channel);

 private:
  bool all_;
  std::vector<std::vector<std::size_t>> groups_;
  /// By channel: its group and its position in the group.
  std::vector<std::pair<std::size_t, std::size_t>> place_;
  std::size_t left_;  ///< pairs that may be reported; their number is quadratic in the channels
};

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

using model::AnimationChannel;
using model::AnimationPath;
using model::AnimationSampler;

constexpr model::Format kTimes{model::ElementType::scalar, model::ComponentType::float32, false};

class AnimationCheck {
 public:
  explicit AnimationCheck(const Context& context)
      : context_(context),
        deformations_(
            model::read_deformations(context.views.meshes, context.version > schema::kVersion2)) {}

  void run() {
    AnimationPaths paths;
    const auto& animations = context_.views.animations;
    for (std::size_t i = 0; i < animations.size(); ++i) {
      if (animations[i].object == json::kNoNode) continue;
      paths.push(std::uint64_t{i});
      check(animations[i], paths);
      paths.pop();
    }
  }

 private:
  void check(const model::Animation& animation, AnimationPaths& paths) {
    if (!is_linked(context_, animation)) return;
    const Path samplers(paths.path(), "samplers");
    for (std::size_t i = 0; i < animation.samplers.size(); ++i) {
      check_sampler(animation.samplers[i], Path(samplers, i));
    }
    std::vector<std::uint8_t> used(animation.samplers.size(), 0);
    SameTargets same(context_, animation);
    paths.push("channels");
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const AnimationChannel& channel = animation.channels[i];
      const Path at(paths.path(), i);
      check_target(channel, at);
      report_references(context_, context_.document.find(channel.object, "sampler"));
      if (channel.sampler) {
        used[*channel.sampler] = 1;
        check_output(channel, animation.samplers[*channel.sampler], at);
      }
      const bool stray =
          context_.deviations.pointers_keep_stray_steps && !has_sampler_index(context_, channel);
      if (stray) paths.push(std::uint64_t{i});
      for (const std::size_t later : same.behind(i)) {
        if (!stray) report_duplicate(channel, later, at);
      }
    }
    paths.pop();
    report_unused(animation, used, Path(paths.path(), "samplers"));
  }

  void report_unused(const model::Animation& animation, const std::vector<std::uint8_t>& used,
                     const Path& samplers) {
    for (std::size_t i = 0; i < used.size() && unseen_.empty(); ++i) {
      if (used[i] != 0) continue;
      report_link(context_, Path(samplers, i), animation.samplers[i].object, Code::UNUSED_OBJECT,
                  "The sampler is not used by any channel.");
    }
  }

  void report_at(const Path& path, const AnimationSampler& sampler, std::string_view member,
                 Code code, std::string message) {
    report_member(context_.link_sink, context_, path, sampler.object, member, code,
                  std::move(message));
  }

  void check_sampler(const AnimationSampler& sampler, const Path& path) {
    check_use(sampler, sampler.input, "input", model::AccessorUse::animation_input, path);
    if (sampler.input) check_times(sampler, context_.views.accessors[*sampler.input], path);
    check_use(sampler, sampler.output, "output", model::AccessorUse::animation_output, path);
    if (!sampler.output || !context_.deviations.animation_outputs_count_twice) return;
    const auto view = context_.views.accessors[*sampler.output].buffer_view;
    if (view) {
      report_view_use(context_, *view, model::ViewUse::other,
                      context_.document.find(sampler.object, "output"), Path(path, "output"));
    }
  }

  void check_use(const AnimationSampler& sampler, std::optional<std::uint32_t> accessor,
                 std::string_view member, model::AccessorUse use, const Path& path) {
    const json::NodeId place = context_.document.find(sampler.object, member);
    report_references(context_, place);
    if (!accessor) return;
    report_use(context_, *accessor, use, place, Path(path, member));
    check_stride(sampler, *accessor, member, path);
  }

  void check_times(const AnimationSampler& sampler, const model::Accessor& times,
                   const Path& path) {
    if (is_judged(times.format) && times.format != kTimes) {
      report_at(path, sampler, "input", Code::ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT,
                fmt::format("Input accessor {} is {}; it must be {}.", *sampler.input,
                            format_text(times.format), format_text(kTimes)));
    }
    if (times.min == json::kNoNode || times.max == json::kNoNode) {
      report_at(path, sampler, "input", Code::ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS,
                fmt::format("Input accessor {} has no {}.", *sampler.input,
                            times.min == json::kNoNode ? "min" : "max"));
    }
    const bool few = context_.deviations.missing_integers_are_minus_one
                         ? times.count.value_or(0) < 2
                         : times.count == 1U;
    if (sampler.interpolation == model::Interpolation::cubic_spline && few) {
      report_at(path, sampler, "input", Code::ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS,
                "The CUBICSPLINE sampler has fewer than two keyframes.");
    }
  }

  bool is_judged(const model::Format& format) const {
    return format.known() || context_.deviations.unknown_formats_are_checked;
  }

  void check_stride(const AnimationSampler& sampler, std::uint32_t index, std::string_view member,
                    const Path& path) {
    const model::Accessor& accessor = context_.views.accessors[index];
    const model::BufferView* view = context_.views.view_of(accessor);
    if (view == nullptr || !view->byte_stride) return;
    report_at(path, sampler, member, Code::ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE,
              fmt::format("Accessor {} uses buffer view {}, which has a byteStride.", index,
                          *accessor.buffer_view));
  }

  void report_duplicate(const AnimationChannel& channel, std::size_t later, const Path& path) {
    report_link(context_, Path(path, "target"), channel.target, Code::ANIMATION_DUPLICATE_TARGETS,
                fmt::format("Channel {} has the same target.", later));
  }

  void check_target(const AnimationChannel& channel, const Path& path) {
    report_references(context_, context_.document.find(channel.target, "node"));
    if (!channel.node) return;
    const Path at(path, "target");
    const model::Node& node = context_.views.nodes[*channel.node];
    if (channel.path == AnimationPath::weights) {
      check_weights(channel, node, at);
    } else if (!model::animation_path_name(channel.path).empty()) {
      check_transform(channel, node, at);
    }
  }

  void check_transform(const AnimationChannel& channel, const model::Node& node, const Path& at) {
    if (model::float_array<16>(context_.document, node.matrix)) {
      report_link(context_, at, channel.target, Code::ANIMATION_CHANNEL_TARGET_NODE_MATRIX,
                  fmt::format("The channel animates the {} of {}, which has a matrix.",
                              model::animation_path_name(channel.path), node_label(*channel.node)));
    }
    if (node.skin) {
      report_member(
          context_.link_sink, context_, at, channel.target, "path",
          Code::ANIMATION_CHANNEL_TARGET_NODE_SKIN,
          fmt::format(
              "The channel animates {}, which has a skinned mesh: only its joints transform it.",
              node_label(*channel.node)));
    }
  }

  void check_weights(const AnimationChannel& channel, const model::Node& node, const Path& at) {
    const bool unresolved = node.mesh_value != json::kNoNode && !node.mesh;
    const bool known = node.mesh && deformations_[*node.mesh].known &&
                       !deformations_[*node.mesh].targets_are_broken;
    if (morph_targets(node) != 0) return;
    const bool broken = unresolved || (node.mesh && !known);
    if (broken && !context_.deviations.broken_values_are_absent) return;
    report_link(
        context_, at, channel.target, Code::ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS,
        fmt::format("The channel animates the weights of {}, which has no mesh with morph targets.",
                    node_label(*channel.node)));
  }

  std::string node_label(std::uint32_t node) const {
    return object_label(context_, model::RootArray::nodes, node);
  }

  std::uint64_t morph_targets(const model::Node& node) const {
    return node.mesh ? deformations_[*node.mesh].morph_targets : 0;
  }

  void check_output(const AnimationChannel& channel, const AnimationSampler& sampler,
                    const Path& path) {
    if (!sampler.output || model::animation_path_name(channel.path).empty()) return;
    const model::Format& format = context_.views.accessors[*sampler.output].format;
    if (is_judged(format) && !fits_path(channel.path, format)) {
      report_output_format(context_, sampler, model::animation_path_name(channel.path),
                           path_formats_text(channel.path), channel.object, path);
    }
    std::uint64_t values = 1;
    if (channel.path == AnimationPath::weights) {
      if (!channel.node) return;
      const model::Node& node = context_.views.nodes[*channel.node];
      const bool broken = node.mesh && deformations_[*node.mesh].targets_are_broken;
      if (broken && !context_.deviations.broken_values_are_absent) return;
      values = morph_targets(node);
    }
    check_output_count(context_, sampler, values, channel.object, path);
  }

  const Context& context_;
  std::string_view unseen_ = unseen_user(context_);
  std::vector<model::Deformation> deformations_;
};

void check_animations(const Context& context) {
  if (context.asset.count(model::RootArray::animations) != 0) AnimationCheck(context).run();
}

}  // namespace

const RuleGroup& animation_rules() {
  static constexpr LinkRule kLinkRules[] = {check_animations};
  static constexpr FixEntry kFixes[] = {
      {Code::ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE, remove_used_stride},
      {Code::ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS, add_bounds}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
