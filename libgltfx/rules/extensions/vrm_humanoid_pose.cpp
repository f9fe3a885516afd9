// SPDX-License-Identifier: Apache-2.0
// The pose in which a humanoid avatar is saved (VRM 0.x, VRMC_vrm, VRMC_vrm_animation): the
// positions of bones depend on the transforms of all their ancestors.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/pose.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/extensions/vrm_humanoid.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::Vector3;

constexpr std::string_view kFirst = "VRM";  // faces -Z, the others face +Z

// Arms that are 37 degrees or more below horizontal are not a T-pose.
constexpr double kOutstretched = 0.8;
constexpr double kNear = 1e-6;

class BonePlaces {
 public:
  BonePlaces(const Context& context, const std::vector<HumanBone>& bones) {
    const model::Pose pose = model::compute_pose(context.asset, context.views,
                                                 model::choose_scene(context.asset, context.views));
    for (const HumanBone& bone : bones) places_[bone.name] = pose.world[bone.node].columns[3];
  }

  // From one bone to another; nothing if one is missing, or both have the same position.
  std::optional<Vector3> between(const std::string& from, const std::string& to) const {
    const auto a = places_.find(from);
    const auto b = places_.find(to);
    if (a == places_.end() || b == places_.end()) return std::nullopt;
    const Vector3 way{b->second[0] - a->second[0], b->second[1] - a->second[1],
                      b->second[2] - a->second[2]};
    const double length = std::hypot(way[0], way[1], way[2]);
    return std::isfinite(length) && length > kNear ? std::optional(way) : std::nullopt;
  }

 private:
  std::unordered_map<std::string, Vector3> places_;
};

// Whether the bones are arranged like those of a body: head above hips, feet below.
bool is_upright(const BonePlaces& places) {
  const auto head = places.between("hips", "head");
  const auto left = places.between("hips", "leftFoot");
  const auto right = places.between("hips", "rightFoot");
  return head && left && right && (*head)[1] > 0 && (*left)[1] < 0 && (*right)[1] < 0;
}

// The number of bones whose left one is on the side of `left` on X, relative to the right one.
int bones_on_side(const BonePlaces& places, double left) {
  int count = 0;
  for (const std::string bone : {"UpperLeg", "UpperArm", "Hand"}) {
    const auto way = places.between("right" + bone, "left" + bone);
    count += way && (*way)[0] * left > kNear ? 1 : 0;
  }
  return count;
}

// The problem of the pose, as a sentence; empty: none, or unknown. `left`: the side of X where the
// left half of the body must be.
std::string pose_problem(const BonePlaces& places, double left) {
  constexpr int kAll = 3;
  if (!is_upright(places)) return {};
  if (bones_on_side(places, -left) == kAll) {
    return fmt::format("The avatar does not face {}Z.", left > 0 ? '+' : '-');
  }
  if (bones_on_side(places, left) != kAll) return {};
  for (const std::string side : {"left", "right"}) {
    const auto arm = places.between(side + "UpperArm", side + "Hand");
    if (!arm) continue;
    const double along = std::abs((*arm)[0]) / std::hypot((*arm)[0], (*arm)[1], (*arm)[2]);
    if (along < kOutstretched) {
      return fmt::format("The {} arm is not stretched out to the side, as that of a T-pose.", side);
    }
  }
  return {};
}

// A part of a local transform that bones of VRM 0.x should not have.
std::string_view local_transform(const Context& context, model::NodeIndex node) {
  constexpr double kRounding = 1e-3;
  const model::Transform transform =
      model::read_transform(context.document, context.views.nodes[node]);
  if (transform.rotation) {
    const auto& q = *transform.rotation;
    if (std::hypot(q[0], q[1], q[2]) > kRounding) return "rotation";
  }
  if (transform.scale) {
    for (const float part : *transform.scale) {
      if (std::abs(part - 1) > kRounding) return "scale";
    }
  }
  return {};
}

void check_pose(const Context& context, std::string_view extension) {
  const json::NodeId object = root_extension(context, extension);
  if (object == json::kNoNode) return;
  const std::vector<HumanBone> bones = read_human_bones(context, object);
  if (bones.empty()) return;
  const std::string place = fmt::format("/extensions/{}/humanoid/humanBones", extension);
  const bool is_first = extension == kFirst;
  const std::string problem = pose_problem(BonePlaces(context, bones), is_first ? -1 : 1);
  if (!problem.empty()) {
    const json::NodeId humanoid = model::object_member(context.document, object, "humanoid");
    report_at(context.link_sink, place,
              finding_on(context, context.document.find(humanoid, "humanBones"),
                         Code::HUMANOID_POSE, problem));
    return;
  }
  if (!is_first) return;
  for (const HumanBone& bone : bones) {
    const std::string_view part = local_transform(context, bone.node);
    if (part.empty()) continue;
    report_at(context.link_sink, place + bone.place,
              finding_on(context, bone.value, Code::HUMANOID_POSE,
                         fmt::format(
                             "{}, the bone {}, has a {}; bones should have none.",
                             capitalized(object_label(context, model::RootArray::nodes, bone.node)),
                             gltfx::quoted(bone.name), part)));
    return;
  }
}

void check_poses(const Context& context) {
  for (const std::string_view extension : {"VRMC_vrm", "VRMC_vrm_animation", "VRM"}) {
    check_pose(context, extension);
  }
}

}  // namespace

const RuleGroup& vrm_humanoid_pose_rules() {
  static constexpr LinkRule kLinkRules[] = {check_poses};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
