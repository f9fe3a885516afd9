// SPDX-License-Identifier: Apache-2.0
// Skins: their joints and the matrices that bind them (specification section 3.7.3).
#include "model/skin.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/accessor.hpp"
#include "model/scene_graph.hpp"
#include "rules/context.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

constexpr model::Format kInverseBindMatrix{model::ElementType::mat4, model::ComponentType::float32,
                                           false};

class SkinCheck {
 public:
  explicit SkinCheck(const Context& context) : context_(context), ancestry_(context.graph) {}

  void run() {
    const Path root;
    const Path list(root, "skins");
    const auto& objects = context_.asset.elements(model::RootArray::skins);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] != json::kNoNode)
        check(model::read_skin(context_.asset, objects[i]), {list, i});
    }
  }

 private:
  void check(const model::Skin& skin, const Path& path) {
    report_references(context_, skin.joints);
    const bool common = have_common_root(skin.joint_nodes);
    if (!common && may_check_joints(skin)) {
      report(path, "joints", skin.joints, Code::SKIN_NO_COMMON_ROOT, joints_apart(skin));
    }
    check_matrices(skin, path);
    report_references(context_, skin.skeleton_value);
    const bool reported = !common;
    if (skin.skeleton && (!reported || context_.deviations.consequences_are_reported)) {
      check_skeleton(skin, path);
    }
  }

  bool may_check_joints(const model::Skin& skin) const {
    if (skin.joint_count == 0) return false;
    return context_.deviations.broken_values_are_absent ||
           skin.joint_nodes.size() == skin.joint_count;
  }

  bool have_common_root(const std::vector<model::NodeIndex>& joints) const {
    if (context_.deviations.common_root_starts_anew) {
      return !model::joints_of_last_root(joints, context_.graph).empty();
    }
    for (const model::NodeIndex joint : joints) {
      if (context_.graph.component(joint) != context_.graph.component(joints.front())) return false;
    }
    return !joints.empty();
  }

  std::string label(model::NodeIndex node) const {
    return object_label(context_, model::RootArray::nodes, node);
  }

  std::string joints_apart(const model::Skin& skin) const {
    const auto& graph = context_.graph;
    for (const model::NodeIndex joint : skin.joint_nodes) {
      const model::NodeIndex first = skin.joint_nodes.front();
      if (graph.component(joint) == graph.component(first)) continue;
      return fmt::format("The joints {} and {} have no common root.", label(first), label(joint));
    }
    return "The joints have no common root: none of them is a node.";
  }

  void check_matrices(const model::Skin& skin, const Path& path) {
    constexpr std::string_view kMember = "inverseBindMatrices";
    const json::NodeId place = skin.inverse_bind_matrices_value;
    report_references(context_, place);
    if (!skin.inverse_bind_matrices) return;
    report_use(context_, *skin.inverse_bind_matrices, model::AccessorUse::inverse_bind_matrices,
               place, Path(path, kMember));
    const model::Accessor& accessor = context_.views.accessors[*skin.inverse_bind_matrices];
    const model::BufferView* view = context_.views.view_of(accessor);
    if (view != nullptr && view->byte_stride) {
      report(path, kMember, place, Code::SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE,
             fmt::format("Buffer view {} contains inverse bind matrices, but has a byteStride.",
                         *accessor.buffer_view));
    }
    const bool checked = accessor.format.known() || context_.deviations.unknown_formats_are_checked;
    if (checked && accessor.format != kInverseBindMatrix) {
      report(path, kMember, place, Code::SKIN_IBM_INVALID_FORMAT,
             fmt::format("Accessor {} is {}; it must be {}.", *skin.inverse_bind_matrices,
                         format_text(accessor.format), format_text(kInverseBindMatrix)));
    }
    if (!accessor.count && !context_.deviations.missing_integers_are_minus_one) return;
    if (accessor.count.value_or(0) < skin.joint_count) {
      report(path, kMember, place, Code::INVALID_IBM_ACCESSOR_COUNT,
             fmt::format("The skin has {} joints, but only {} inverse bind matrices.",
                         skin.joint_count, accessor.count.value_or(0)));
    }
  }

  void check_skeleton(const model::Skin& skin, const Path& path) {
    const model::NodeIndex root = *skin.skeleton;
    const bool anew = context_.deviations.common_root_starts_anew;
    const auto joints = anew ? model::joints_of_last_root(skin.joint_nodes, context_.graph)
                             : std::span(skin.joint_nodes);
    if (anew && joints.empty()) {
      report(path, "skeleton", skin.skeleton_value, Code::SKIN_SKELETON_INVALID,
             fmt::format("The skeleton root, {}, is not an ancestor of the joints.", label(root)));
    }
    for (const model::NodeIndex joint : joints) {
      // Ancestors are undefined on a loop, which is reported as such.
      if (context_.graph.root(joint) == model::kNoNodeIndex) return;
      if (ancestry_.is_ancestor_or_self(root, joint)) continue;
      report(path, "skeleton", skin.skeleton_value, Code::SKIN_SKELETON_INVALID,
             fmt::format("The skeleton root, {}, is not an ancestor of the joint {}.", label(root),
                         label(joint)));
      return;
    }
  }

  void report(const Path& skin, std::string_view member, json::NodeId place, Code code,
              std::string message) {
    report_link(context_, Path(skin, member), place, code, std::move(message));
  }

  const Context& context_;
  model::Ancestry ancestry_;
};

void check_skins(const Context& context) {
  if (context.asset.count(model::RootArray::skins) != 0) SkinCheck(context).run();
}

}  // namespace

const RuleGroup& skin_rules() {
  static constexpr LinkRule kLinkRules[] = {check_skins};
  static constexpr FixEntry kFixes[] = {
      {Code::SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE, remove_used_stride},
      {Code::SKIN_SKELETON_INVALID, remove_marked}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
