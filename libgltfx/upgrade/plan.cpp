// SPDX-License-Identifier: Apache-2.0
#include "upgrade/plan.hpp"

#include <algorithm>
#include <optional>
#include <unordered_set>
#include <utility>

#include "base/json_pointer.hpp"
#include "json/writer.hpp"
#include "upgrade/context.hpp"
#include "upgrade/name_list.hpp"
#include "upgrade/object_plan.hpp"

namespace gltfx {

std::string_view upgrade_fate_name(UpgradeFate fate) {
  switch (fate) {
    case UpgradeFate::safe:
      return "safe";
    case UpgradeFate::unsafe:
      return "unsafe";
    case UpgradeFate::needs_image:
      return "needs an image";
    case UpgradeFate::impossible:
      break;
  }
  return "not possible";
}

std::uint64_t UpgradeReport::left() const {
  return static_cast<std::uint64_t>(std::count_if(
      actions.begin(), actions.end(), [](const UpgradeAction& action) { return !action.done; }));
}

}  // namespace gltfx

namespace gltfx::upgrade {
namespace {

// Root arrays whose elements carry an extension.
std::vector<std::string> arrays_of(const schema::Set& set, const schema::Extension& extension) {
  std::vector<std::string> arrays;
  const schema::TypeId root = set.find_type("glTF");
  if (root == schema::kNone) return arrays;
  for (const schema::Property& property : set.type(root).properties) {
    if (property.shape == schema::kNone) continue;
    const schema::ShapeId items = set.shape(property.shape).items;
    if (items == schema::kNone) continue;
    for (const auto& [home, shape] : extension.homes) {
      if (set.shape(items).type == home) arrays.push_back(property.name);
    }
  }
  return arrays;
}

/// One legacy extension in one document.
class ExtensionPlan {
 public:
  ExtensionPlan(Context& context, const schema::Extension& extension)
      : context_(context), document_(context.document), extension_(extension) {}

  void run(NameList& used, NameList& required) {
    for (const std::string& array : arrays_of(context_.set, extension_)) plan_array(array);
    if (converted_ + removed_ == 0) return;
    settle_names(used, required);
    settle_pointers();
  }

 private:
  void plan_array(const std::string& array) {
    const json::NodeId list = document_.find(document_.root(), array);
    if (list == json::kNoNode || document_.kind(list) != json::Kind::array) return;
    std::uint64_t index = 0;
    for (const json::NodeId host : document_.elements(list)) {
      const json::NodeId extensions = document_.find(host, "extensions");
      const json::NodeId object = document_.find(extensions, extension_.name);
      if (object != json::kNoNode) plan_object({array, index, host, extensions, object});
      ++index;
    }
  }

  void plan_object(const Carrier& carrier) {
    ObjectPlan object(context_, extension_, carrier);
    UpgradeAction action = object.judge();
    action.done = action.fate == UpgradeFate::safe ||
                  (action.fate == UpgradeFate::unsafe && context_.options.unsafe);
    if (action.done) {
      object.apply();
      (action.removed ? removed_ : converted_) += 1;
      if (!action.removed) done_.insert(carrier.array + "/" + std::to_string(carrier.index));
    }
    context_.plan.actions.push_back(std::move(action));
  }

  // Objects of the extension that stay, also where they should not be.
  std::size_t count_left() const {
    const json::KeyId name = document_.key_id(extension_.name);
    std::size_t count = 0;
    for (json::NodeId id = 0; id < document_.node_count(); ++id) {
      const json::Node& node = document_.node(id);
      count += node.kind == json::Kind::key && node.next == name ? 1U : 0U;
    }
    return count - converted_ - removed_;
  }

  void settle_names(NameList& used, NameList& required) {
    const std::string& from = extension_.name;
    const std::string& to = extension_.upgrade.to;
    left_ = count_left();
    const bool was_required = required.has(from);
    for (NameList* list : {&used, &required}) {
      if (left_ == 0 && converted_ > 0) list->replace(from, to);
      if (left_ == 0 && converted_ == 0) list->remove(from);
    }
    if (converted_ == 0) return;
    used.add(to);
    if (was_required) required.add(to);
  }

  // "/materials/3/extensions/OLD/member/..." becomes "/materials/3/extensions/NEW/other/...".
  void settle_pointers() {
    for (const PointerUse& use : context_.pointers.all()) {
      if (use.steps.size() < 4 || use.steps[2] != "extensions" || use.steps[3] != extension_.name) {
        continue;
      }
      const bool every = Pointers::is_template(use) && left_ == 0 && removed_ == 0;
      if (every || done_.count(use.steps[0] + "/" + use.steps[1]) > 0) rename(use);
    }
  }

  void rename(const PointerUse& use) {
    std::string pointer;
    for (std::size_t i = 0; i < use.steps.size(); ++i) {
      std::string_view step = use.steps[i];
      if (i == 3) step = extension_.upgrade.to;
      if (i == 4) step = new_name(step);
      append_pointer_step(pointer, step);
    }
    std::string json;
    json::append_string(json, pointer);
    context_.editor.replace_scalar(use.node, std::move(json));
  }

  std::string_view new_name(std::string_view member) const {
    for (const schema::UpgradeStep& step : extension_.upgrade.steps) {
      if (!step.copy && step.from == member) return step.to;
    }
    return member;
  }

  Context& context_;
  const json::Document& document_;
  const schema::Extension& extension_;
  std::size_t converted_ = 0;
  std::size_t removed_ = 0;
  std::size_t left_ = 0;
  std::unordered_set<std::string> done_;  ///< "materials/3"
};

void settle_dropped(Context& context) {
  for (const auto& [host, keys] : context.dropped) {
    const json::NodeId extensions = context.document.find(host, "extensions");
    if (context.document.object_size(extensions) == keys.size()) {
      context.editor.remove(host, extensions - 1);
      continue;
    }
    for (const json::NodeId key : keys) context.editor.remove(extensions, key);
  }
}

}  // namespace

Plan make_plan(const json::Document& document, const schema::Set& set,
               const UpgradeOptions& options, Pictures* pictures) {
  std::vector<const schema::Extension*> legacy;
  for (const schema::Extension& extension : set.extensions()) {
    const bool named = document.key_id(extension.name) != json::kNoKey;
    if (!extension.upgrade.to.empty() && named) legacy.push_back(&extension);
  }
  if (legacy.empty()) return {};
  Context context(document, set, options, pictures);
  NameList used(document, "extensionsUsed");
  NameList required(document, "extensionsRequired");
  for (const schema::Extension* extension : legacy) {
    ExtensionPlan(context, *extension).run(used, required);
  }
  settle_dropped(context);
  used.apply(context.editor);
  required.apply(context.editor);
  context.plan.edits = context.editor.take();
  return std::move(context.plan);
}

}  // namespace gltfx::upgrade
