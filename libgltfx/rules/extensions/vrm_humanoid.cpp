// SPDX-License-Identifier: Apache-2.0
// Bones of humanoid avatars (VRM 0.x, VRMC_vrm, VRMC_vrm_animation): whether each node is used
// once, and whether they are below each other like the bones of a body. The checks need the scene
// graph.
#include "rules/extensions/vrm_humanoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/scene_graph.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kFirstAvatar = "VRM";

// A bone and its parent bone; '*' is the side, the same for both.
struct BoneParent {
  std::string_view bone, parent;
};
constexpr BoneParent kBoneParents[] = {
    {"spine", "hips"},
    {"chest", "spine"},
    {"upperChest", "chest"},
    {"neck", "upperChest"},
    {"head", "neck"},
    {"jaw", "head"},
    {"*Eye", "head"},
    {"*UpperLeg", "hips"},
    {"*LowerLeg", "*UpperLeg"},
    {"*Foot", "*LowerLeg"},
    {"*Toes", "*Foot"},
    {"*Shoulder", "upperChest"},
    {"*UpperArm", "*Shoulder"},
    {"*LowerArm", "*UpperArm"},
    {"*Hand", "*LowerArm"},
    {"*ThumbMetacarpal", "*Hand"},
    {"*ThumbProximal", "*ThumbMetacarpal"},
    {"*ThumbDistal", "*ThumbProximal"},
    {"*IndexProximal", "*Hand"},
    {"*IndexIntermediate", "*IndexProximal"},
    {"*IndexDistal", "*IndexIntermediate"},
    {"*MiddleProximal", "*Hand"},
    {"*MiddleIntermediate", "*MiddleProximal"},
    {"*MiddleDistal", "*MiddleIntermediate"},
    {"*RingProximal", "*Hand"},
    {"*RingIntermediate", "*RingProximal"},
    {"*RingDistal", "*RingIntermediate"},
    {"*LittleProximal", "*Hand"},
    {"*LittleIntermediate", "*LittleProximal"},
    {"*LittleDistal", "*LittleIntermediate"},
};

// The bones required for an avatar of VRM 0.x. Later versions list bones by name, and their schema
// requires them.
constexpr std::string_view kFirstRequired[] = {
    "hips",          "spine",     "chest",         "neck",          "head",     "leftUpperArm",
    "leftLowerArm",  "leftHand",  "leftUpperLeg",  "leftLowerLeg",  "leftFoot", "rightUpperArm",
    "rightLowerArm", "rightHand", "rightUpperLeg", "rightLowerLeg", "rightFoot"};

std::string parent_bone(std::string_view bone) {
  std::string_view side;
  for (const std::string_view one : {"left", "right"}) {
    if (bone.substr(0, one.size()) == one) side = one;
  }
  const std::string_view rest = bone.substr(side.size());
  for (const auto& [child, parent] : kBoneParents) {
    const bool sided = child.front() == '*';
    if (sided == side.empty() || rest != (sided ? child.substr(1) : child)) continue;
    return parent.front() == '*' ? std::string(side) + std::string(parent.substr(1))
                                 : std::string(parent);
  }
  return {};
}

// Relative to the greatest scale, for programs that multiply floats.
constexpr double kUniform = 0.001;

// The scale of a matrix is the length of its columns; a mirroring matrix has a negative one.
std::array<float, 3> scale_of(const model::Transform& transform) {
  if (transform.scale) return *transform.scale;
  if (!transform.matrix) return {1, 1, 1};
  const auto& m = *transform.matrix;
  std::array<float, 3> scale{};
  for (std::size_t i = 0; i < 3; ++i) {
    scale[i] = std::hypot(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
  }
  const float determinant = m[0] * (m[5] * m[10] - m[6] * m[9]) -
                            m[4] * (m[1] * m[10] - m[2] * m[9]) +
                            m[8] * (m[1] * m[6] - m[2] * m[5]);
  if (determinant < 0) scale[0] = -scale[0];
  return scale;
}

class Humanoid {
 public:
  Humanoid(const Context& context, json::NodeId object, std::string_view extension)
      : context_(context),
        bones_(read_human_bones(context, object)),
        place_(fmt::format("/extensions/{}/humanoid/humanBones", extension)),
        list_(model::object_member(context.document, object, "humanoid")) {
    for (const HumanBone& bone : bones_) by_name_.emplace(bone.name, bone.node);
  }

  void check_repeated() const {
    std::unordered_map<model::NodeIndex, std::string_view> used;
    std::unordered_set<std::string_view> names;
    for (const HumanBone& bone : bones_) {
      const bool is_new = names.insert(bone.name).second;
      const auto [first, fresh] = used.emplace(bone.node, bone.name);
      if (is_new && fresh) continue;
      report(bone, Code::HUMANOID_BONE_REPEATED,
             is_new ? fmt::format("{} is already the bone {}.", label(bone),
                                  gltfx::quoted(first->second))
                    : fmt::format("The bone {} is listed twice.", gltfx::quoted(bone.name)));
    }
  }

  void check_required() const {
    for (const std::string_view bone : kFirstRequired) {
      if (by_name_.count(std::string(bone)) != 0) continue;
      report_at(context_.link_sink, place_,
                finding_on(context_, list_, Code::HUMANOID_BONE_MISSING,
                           fmt::format("The bone {} is missing.", gltfx::quoted(bone))));
    }
  }

  void check_hierarchy() const {
    const model::Ancestry ancestry(context_.graph);
    for (const HumanBone& bone : bones_) {
      std::string parent = parent_bone(bone.name);
      while (!parent.empty() && by_name_.count(parent) == 0) parent = parent_bone(parent);
      if (parent.empty()) continue;
      const model::NodeIndex above = by_name_.at(parent);
      if (above == bone.node || ancestry.is_ancestor_or_self(above, bone.node)) continue;
      report(bone, Code::HUMANOID_HIERARCHY,
             fmt::format("{}, the bone {}, is not below {}, the bone {}.", label(bone),
                         gltfx::quoted(bone.name),
                         object_label(context_, model::RootArray::nodes, above),
                         gltfx::quoted(parent)));
    }
  }

  void check_scales() const {
    for (const HumanBone& bone : bones_) {
      const auto scale =
          scale_of(model::read_transform(context_.document, context_.views.nodes[bone.node]));
      const auto [least, most] = std::minmax_element(scale.begin(), scale.end());
      const bool positive = *least > 0;
      if (positive && *most - *least <= kUniform * *most) continue;
      report(bone, Code::HUMANOID_SCALE,
             fmt::format("{}, the bone {}, has a scale of [{}, {}, {}]; it must be {}.",
                         label(bone), gltfx::quoted(bone.name), scale[0], scale[1], scale[2],
                         positive ? "the same on all axes" : "positive"),
             positive ? std::optional(Severity::warning) : std::nullopt);
    }
  }

 private:
  std::string label(const HumanBone& bone) const {
    return capitalized(object_label(context_, model::RootArray::nodes, bone.node));
  }

  void report(const HumanBone& bone, Code code, std::string message,
              std::optional<Severity> severity = {}) const {
    Finding finding = finding_on(context_, bone.value, code, std::move(message));
    finding.severity = severity;
    report_at(context_.link_sink, place_ + bone.place, std::move(finding));
  }

  const Context& context_;
  std::vector<HumanBone> bones_;
  std::string place_;
  json::NodeId list_;
  std::unordered_map<std::string, model::NodeIndex> by_name_;
};

void check_humanoids(const Context& context) {
  for (const std::string_view extension : {kAvatar, kAvatarAnimation, kFirstAvatar}) {
    const json::NodeId object = root_extension(context, extension);
    if (model::object_member(context.document, object, "humanoid") == json::kNoNode) {
      // The schemas of other extensions require it, if they need it.
      if (extension != kFirstAvatar || object == json::kNoNode) continue;
      report_at(context.link_sink, fmt::format("/extensions/{}", extension),
                finding_on(context, object, Code::HUMANOID_BONE_MISSING,
                           "The avatar has no humanoid, and so no bones."));
      continue;
    }
    const Humanoid humanoid(context, object, extension);
    humanoid.check_repeated();
    if (extension == kFirstAvatar) {
      humanoid.check_required();
    } else {
      humanoid.check_hierarchy();
      humanoid.check_scales();
    }
  }
}

// Eyes turn by their bones only if the bones exist.
void check_look_at(const Context& context) {
  const json::NodeId object = root_extension(context, kAvatar);
  const json::Document& document = context.document;
  const json::NodeId look = model::object_member(document, object, "lookAt");
  if (model::string_member(document, look, "type") != "bone") return;
  for (const HumanBone& bone : read_human_bones(context, object)) {
    if (bone.name == "leftEye" || bone.name == "rightEye") return;
  }
  report_at(context.link_sink, fmt::format("/extensions/{}/lookAt/type", kAvatar),
            finding_on(context, document.find(look, "type"), Code::LOOK_AT_WITHOUT_EYES,
                       "The type is bone, but the avatar has neither leftEye nor rightEye."));
}

// Animations of avatars: other bodies have bones of other lengths than the original one.
void check_animation_paths(const Context& context) {
  const json::NodeId object = root_extension(context, kAvatarAnimation);
  if (object == json::kNoNode) return;
  std::unordered_map<model::NodeIndex, std::string> bones;
  for (const HumanBone& bone : read_human_bones(context, object)) {
    bones.emplace(bone.node, bone.name);
  }
  const json::Document& document = context.document;
  for (std::size_t a = 0; a < context.views.animations.size(); ++a) {
    const auto channels =
        object_list(document, context.asset.elements(model::RootArray::animations)[a], "channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const json::NodeId target = model::object_member(document, channels[c], "target");
      const auto node = context.asset.index(target, "node", model::RootArray::nodes);
      const std::string path = model::string_member(document, target, "path");
      if (!node || bones.count(*node) == 0) continue;
      const std::string& bone = bones.at(*node);
      if (path != "scale" && (path != "translation" || bone == "hips")) continue;
      report_at(
          context.link_sink, fmt::format("/animations/{}/channels/{}/target/path", a, c),
          finding_on(context, document.find(target, "path"), Code::HUMANOID_ANIMATION_PATH,
                     fmt::format("The channel animates the {} of the bone {}; it must be {}.", path,
                                 gltfx::quoted(bone),
                                 bone == "hips" ? "its rotation or translation" : "its rotation")));
    }
  }
}

void check_animation_alone(const Context& context) {
  const json::NodeId object = root_extension(context, kAvatarAnimation);
  if (object == json::kNoNode || root_extension(context, kAvatar) == json::kNoNode) return;
  report_at(context.link_sink, fmt::format("/extensions/{}", kAvatarAnimation),
            finding_on(context, object, Code::HUMANOID_ANIMATION_IN_AVATAR,
                       "The asset is an avatar, and an animation for avatars."));
}

}  // namespace

std::vector<HumanBone> read_human_bones(const Context& context, json::NodeId extension) {
  const json::Document& document = context.document;
  const json::NodeId humanoid = model::object_member(document, extension, "humanoid");
  const json::NodeId list = document.find(humanoid, "humanBones");
  std::vector<HumanBone> bones;
  const auto add = [&](std::string name, json::NodeId bone, std::string_view key) {
    const auto node = context.asset.index(bone, "node", model::RootArray::nodes);
    if (!node) return;
    std::string place;
    append_pointer_step(place, key);
    bones.push_back({std::move(name), place + "/node", document.find(bone, "node"), *node});
  };
  if (list == json::kNoNode) return bones;
  if (document.is_object(list)) {
    for (const auto member : document.members(list)) {
      const std::string_view name = document.key(member.key_id);
      add(std::string(name), member.value, name);
    }
  }
  const auto listed = object_list(document, humanoid, "humanBones");
  for (std::size_t i = 0; i < listed.size(); ++i) {
    if (listed[i] == json::kNoNode) continue;
    add(model::string_member(document, listed[i], "bone"), listed[i], std::to_string(i));
  }
  return bones;
}

const RuleGroup& vrm_humanoid_rules() {
  static constexpr LinkRule kLinkRules[] = {check_humanoids, check_look_at, check_animation_paths,
                                            check_animation_alone};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
