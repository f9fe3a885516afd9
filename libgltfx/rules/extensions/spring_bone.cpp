// SPDX-License-Identifier: Apache-2.0
// VRMC_springBone: chains of nodes that swing. Whether joints are below each other, and the spring
// of a node between two joints, depend on the scene graph.
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/node.hpp"
#include "model/scene_graph.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/extensions/vrm_humanoid.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kSpringBone = "VRMC_springBone";
constexpr std::string_view kAvatarOf = "VRMC_vrm";
constexpr std::uint32_t kNoSpring = UINT32_MAX;

// The springs that nodes belong to.
class Springs {
 public:
  Springs(const Context& context, json::NodeId object)
      : context_(context),
        springs_(object_list(context.document, object, "springs")),
        owner_(context.graph.size(), kNoSpring) {
    for (const HumanBone& bone : read_human_bones(context, root_extension(context, kAvatarOf))) {
      bones_.emplace(bone.node, bone.name);
    }
  }

  void run() {
    const model::Ancestry ancestry(context_.graph);
    for (std::uint32_t s = 0; s < springs_.size(); ++s) check_joints(s, ancestry);
    find_owners_above();
    for (std::uint32_t s = 0; s < springs_.size(); ++s) check_center(s, ancestry);
  }

 private:
  void check_joints(std::uint32_t spring, const model::Ancestry& ancestry) {
    const auto joints = object_list(context_.document, springs_[spring], "joints");
    std::optional<std::uint32_t> last;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto node = context_.asset.index(joints[j], "node", model::RootArray::nodes);
      const json::NodeId value = context_.document.find(joints[j], "node");
      const std::string place =
          fmt::format("/extensions/{}/springs/{}/joints/{}/node", kSpringBone, spring, j);
      const bool below =
          node && (!last || (*last != *node && ancestry.is_ancestor_or_self(*last, *node)));
      if (node && !below) {
        report(place, value, Code::SPRING_CHAIN_BROKEN,
               fmt::format("{} is not below {}, the joint before it.", label(*node),
                           object_label(context_, model::RootArray::nodes, *last)));
      } else if (node) {
        claim(spring, *node, last, place, value);
      }
      last = node;
    }
    check_bones(spring, joints);
    if (joints.size() != 1) return;
    report(fmt::format("/extensions/{}/springs/{}/joints", kSpringBone, spring),
           context_.document.find(springs_[spring], "joints"), Code::SPRING_TOO_SHORT,
           "The spring has one joint; the last one only ends a chain, so that nothing swings.");
  }

  // Bones are moved by the pose; a bone that also swings moves twice.
  void check_bones(std::uint32_t spring, const std::vector<json::NodeId>& joints) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto node = context_.asset.index(joints[j], "node", model::RootArray::nodes);
      const auto bone = node ? bones_.find(*node) : bones_.end();
      if (bone == bones_.end()) continue;
      return report(fmt::format("/extensions/{}/springs/{}/joints/{}/node", kSpringBone, spring, j),
                    context_.document.find(joints[j], "node"), Code::SPRING_ON_BONE,
                    fmt::format("{} swings, and is the bone {} of the avatar.", label(*node),
                                gltfx::quoted(bone->second)));
    }
  }

  // Claims the node and the nodes between it and the previous joint. Ends at a node that belongs to
  // a spring already, so that each is visited once.
  void claim(std::uint32_t spring, model::NodeIndex node, std::optional<std::uint32_t> last,
             const std::string& place, json::NodeId value) {
    const model::NodeIndex end = last ? *last : context_.graph.parent(node);
    for (model::NodeIndex at = node; at != end && at != model::kNoNodeIndex;
         at = context_.graph.parent(at)) {
      if (owner_[at] == spring) return;
      if (owner_[at] != kNoSpring) {
        report(place, value, Code::SPRING_JOINT_SHARED,
               fmt::format("{} already belongs to spring {}.", label(at), owner_[at]));
        return;
      }
      owner_[at] = spring;
    }
  }

  // For each node, two different springs at it or its ancestors; kNoSpring: there are fewer.
  void find_owners_above() {
    const std::size_t count = owner_.size();
    above_.assign(count, {kNoSpring, kNoSpring});
    std::vector<bool> done(count, false);
    std::vector<model::NodeIndex> way;
    for (model::NodeIndex start = 0; start < count; ++start) {
      for (model::NodeIndex at = start; at != model::kNoNodeIndex && !done[at];
           at = context_.graph.parent(at)) {
        done[at] = true;
        way.push_back(at);
      }
      for (; !way.empty(); way.pop_back()) {
        const model::NodeIndex at = way.back();
        const model::NodeIndex parent = context_.graph.parent(at);
        if (parent != model::kNoNodeIndex) above_[at] = above_[parent];
        auto& [one, other] = above_[at];
        if (owner_[at] == kNoSpring || owner_[at] == one) continue;
        other = one;
        one = owner_[at];
      }
    }
  }

  void check_center(std::uint32_t spring, const model::Ancestry& ancestry) {
    const json::NodeId object = springs_[spring];
    const auto center = context_.asset.index(object, "center", model::RootArray::nodes);
    const auto joints = object_list(context_.document, object, "joints");
    const auto first = joints.empty()
                           ? std::nullopt
                           : context_.asset.index(joints.front(), "node", model::RootArray::nodes);
    if (!center || !first) return;
    const auto& [one, other] = above_[*center];
    const std::uint32_t stranger = one != spring ? one : other;
    const bool placed = ancestry.is_ancestor_or_self(*center, *first);
    if (placed && stranger == kNoSpring) return;
    report(fmt::format("/extensions/{}/springs/{}/center", kSpringBone, spring),
           context_.document.find(object, "center"), Code::SPRING_CENTER_INVALID,
           placed ? fmt::format("{} swings with spring {}; the center must not swing.",
                                label(*center), stranger)
                  : fmt::format("{} is not the first joint, {}, or above it.", label(*center),
                                object_label(context_, model::RootArray::nodes, *first)));
  }

  std::string label(model::NodeIndex node) const {
    return capitalized(object_label(context_, model::RootArray::nodes, node));
  }

  void report(std::string_view place, json::NodeId value, Code code, std::string message) const {
    report_at(context_.link_sink, place, finding_on(context_, value, code, std::move(message)));
  }

  const Context& context_;
  std::vector<json::NodeId> springs_;
  std::vector<std::uint32_t> owner_;
  std::unordered_map<model::NodeIndex, std::string> bones_;  // bones of the avatar
  std::vector<std::pair<std::uint32_t, std::uint32_t>> above_;
};

void check_springs(const Context& context) {
  const json::NodeId object = root_extension(context, kSpringBone);
  if (object != json::kNoNode) Springs(context, object).run();
}

}  // namespace

const RuleGroup& spring_bone_rules() {
  static constexpr LinkRule kLinkRules[] = {check_springs};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
