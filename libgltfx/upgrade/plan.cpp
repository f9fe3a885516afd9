// SPDX-License-Identifier: Apache-2.0
#include "upgrade/plan.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "edit/name_list.hpp"
#include "edit/removal.hpp"
#include "json/writer.hpp"
#include "model/asset.hpp"
#include "upgrade/ambiguity.hpp"
#include "upgrade/choice.hpp"
#include "upgrade/context.hpp"
#include "upgrade/generation.hpp"
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
    case UpgradeFate::on_request:
      return "on request";
    case UpgradeFate::no_successor:
      return "no successor";
    case UpgradeFate::impossible:
      break;
  }
  return "not possible";
}

std::uint64_t UpgradeReport::due() const {
  return static_cast<std::uint64_t>(std::count_if(
      actions.begin(), actions.end(), [](const UpgradeAction& action) { return action.is_due(); }));
}

std::uint64_t UpgradeReport::left() const {
  return static_cast<std::uint64_t>(
      std::count_if(actions.begin(), actions.end(),
                    [](const UpgradeAction& action) { return action.is_due() && !action.done; }));
}

}  // namespace gltfx

namespace gltfx::upgrade {
namespace {

/// One legacy extension in one document.
class ExtensionPlan {
 public:
  ExtensionPlan(Context& context, const schema::Extension& extension)
      : context_(context),
        document_(context.document),
        extension_(extension),
        choice_(choose(context.options, extension)) {
    if (choice_.selection == Selection::no) return;
    for (Carrier& carrier : carriers_of(document_, context_.set, extension_)) {
      judged_.push_back({std::move(carrier), {}, nullptr});
    }
  }

  // Does what can be done as things stand; whether that was anything. What is done may open the
  // way for other objects, so this is asked again until nothing more is done anywhere.
  bool attempt() {
    for (Judged& one : judged_) {
      if (!one.action.done) judge(one);
    }
    if (extension_.upgrade.together || has_template()) hold_together();
    bool any = false;
    for (Judged& one : judged_) any = settle(one) || any;
    return any;
  }

  void finish(edit::NameList& used, edit::NameList& required) {
    if (judged_.empty()) drop_unused_name(used, required);
    for (Judged& one : judged_) context_.plan.actions.push_back(std::move(one.action));
    if (converted_ + removed_ == 0) return;
    settle_names(used, required);
    settle_pointers();
  }

 private:
  struct Judged {
    Carrier carrier;
    UpgradeAction action;
    std::unique_ptr<ObjectPlan> plan;  ///< null where nothing can be done
  };

  bool is_doable(const UpgradeAction& action) const {
    return action.fate == UpgradeFate::safe ||
           (action.fate == UpgradeFate::unsafe && context_.options.unsafe);
  }

  void judge(Judged& one) {
    if (auto action = action_without_plan(one.carrier)) {
      one.action = *std::move(action);
      return;
    }
    const schema::Extension& successor =
        context_.set.extensions()[context_.set.find_extension(choice_.to)];
    one.plan = std::make_unique<ObjectPlan>(context_, extension_, successor, one.carrier);
    one.action = one.plan->judge();
  }

  // What has no successor, or is not done unless somebody asks for it.
  std::optional<UpgradeAction> action_without_plan(const Carrier& carrier) const {
    const Decision decision =
        decide_generation(document_, extension_, carrier.object, context_.options.generation);
    const std::string generation = decision.generation ? decision.generation->name : "";
    UpgradeAction action;
    action.pointer = carrier.pointer() + "/extensions/" + extension_.name;
    action.from = extension_.name;
    action.to = choice_.to;
    for (const schema::UpgradeStay& stay : extension_.upgrade.stays) {
      const auto& names = stay.generations;
      if (!names.empty() && std::find(names.begin(), names.end(), generation) == names.end()) {
        continue;
      }
      const bool named = !context_.options.only.empty() || !context_.options.to.empty();
      action.fate = named ? UpgradeFate::impossible : UpgradeFate::no_successor;
      action.to.clear();
      action.generation = generation;
      action.decision = decision.because;
      action.notes.push_back(stay.because);
      return action;
    }
    if (choice_.selection != Selection::offered) return std::nullopt;
    action.fate = UpgradeFate::on_request;
    action.notes.push_back("--only " + extension_.name + ": " + extension_.upgrade.opt_in);
    return action;
  }

  bool is_into(const edit::PointerUse& use) const {
    return use.steps.size() > 3 && use.steps[2] == "extensions" && use.steps[3] == extension_.name;
  }

  // A pointer to all objects, which cannot lead to two names.
  bool has_template() const {
    const auto& all = context_.pointers.all();
    return std::any_of(all.begin(), all.end(), [this](const edit::PointerUse& use) {
      return edit::Pointers::is_template(use) && is_into(use);
    });
  }

  // All objects or none: one that stays, or stands where nobody expects it, keeps the others.
  void hold_together() {
    const auto doable = static_cast<std::size_t>(
        std::count_if(judged_.begin(), judged_.end(),
                      [this](const Judged& one) { return is_doable(one.action); }));
    if (doable == count_occurrences()) return;
    for (Judged& one : judged_) {
      if (!is_doable(one.action)) continue;
      one.action.fate = UpgradeFate::impossible;
      one.action.notes.emplace_back(
          "other objects of the asset cannot be upgraded, and only all together can");
    }
  }

  bool settle(Judged& one) {
    if (one.action.done || !is_doable(one.action)) return false;
    one.action.done = true;
    one.plan->apply();
    (one.action.removed ? removed_ : converted_) += 1;
    if (one.action.removed) return true;
    done_.insert(one.carrier.pointer());
    for (std::string& name : one.plan->further_extensions()) given_.insert(std::move(name));
    return true;
  }

  // Objects of the extension, also where they should not be.
  std::size_t count_occurrences() const {
    const json::KeyId name = document_.key_id(extension_.name);
    const json::KeyId extras = document_.key_id("extras");
    std::size_t count = 0;
    for (json::NodeId id = 0; id < document_.node_count();) {
      const json::Node& node = document_.node(id);
      const bool key = node.kind == json::Kind::key;
      count += key && node.next == name ? 1U : 0U;
      id = key && node.next == extras ? document_.next(id + 1) : id + 1;
    }
    return count;
  }

  // A name in a list that no object goes with. Where the upgrade is only offered, a name may stay
  // unless it is one of the past.
  void drop_unused_name(edit::NameList& used, edit::NameList& required) {
    using schema::Status;
    const Status status = extension_.status;
    const bool past = status == Status::legacy || status == Status::archived;
    const bool wanted =
        choice_.selection == Selection::yes || (choice_.selection == Selection::offered && past);
    if (!wanted || extension_.attachment_points.empty() || count_occurrences() > 0) return;
    for (edit::NameList* list : {&used, &required}) {
      for (std::string& place : list->places(extension_.name)) {
        UpgradeAction action;
        action.pointer = std::move(place);
        action.from = extension_.name;
        action.to = choice_.to;
        action.removed = action.done = true;
        action.notes.push_back(fmt::format("no object has {}", extension_.name));
        context_.plan.actions.push_back(std::move(action));
      }
      list->remove(extension_.name);
    }
  }

  void settle_names(edit::NameList& used, edit::NameList& required) {
    const std::string& from = extension_.name;
    const std::string& to = choice_.to;
    left_ = count_occurrences() - converted_ - removed_;
    const bool was_required = required.has(from);
    for (edit::NameList* list : {&used, &required}) {
      if (left_ == 0 && converted_ > 0) list->replace(from, to);
      if (left_ == 0 && converted_ == 0) list->remove(from);
    }
    if (converted_ == 0) return;
    given_.insert(to);
    used.add(to);
    if (was_required) required.add(to);
    for (const std::string& name : given_) {
      used.add(name);
      if (was_required) required.add(name);
    }
  }

  // "/materials/3/extensions/OLD/member/..." becomes "/materials/3/extensions/NEW/other/...".
  void settle_pointers() {
    for (const edit::PointerUse& use : context_.pointers.all()) {
      if (!is_into(use)) continue;
      const bool every = edit::Pointers::is_template(use) && left_ == 0 && removed_ == 0;
      if (every || done_.count("/" + use.steps[0] + "/" + use.steps[1]) > 0) rename(use);
    }
  }

  void rename(const edit::PointerUse& use) {
    std::string pointer;
    const std::string_view member = use.steps.size() > 4 ? use.steps[4] : std::string_view();
    std::vector<std::string> steps(use.steps.begin(), use.steps.begin() + 2);
    for (std::string& step : new_place(member)) steps.push_back(std::move(step));
    const std::size_t rest = std::min<std::size_t>(use.steps.size(), 5);
    steps.insert(steps.end(), use.steps.begin() + static_cast<std::ptrdiff_t>(rest),
                 use.steps.end());
    for (const std::string& step : steps) append_pointer_step(pointer, step);
    std::string json;
    json::append_string(json, pointer);
    context_.editor.replace_scalar(use.node, std::move(json));
  }

  // Where a member of the old object, or with no name the object, is now from the carrier.
  std::vector<std::string> new_place(std::string_view member) const {
    std::vector<std::string> path{"extensions", choice_.to};
    if (member.empty()) return path;
    path.emplace_back(member);
    for (const schema::UpgradeStep& step : extension_.upgrade.steps) {
      if (step.kind == schema::UpgradeStep::Kind::copy || step.from != member) continue;
      if (step.kind == schema::UpgradeStep::Kind::place) return split_path(step.to);
      path.back() = step.to;
      return path;
    }
    return path;
  }

  Context& context_;
  const json::Document& document_;
  const schema::Extension& extension_;
  const Choice choice_;
  std::vector<Judged> judged_;
  std::size_t converted_ = 0;
  std::size_t removed_ = 0;
  std::size_t left_ = 0;
  std::set<std::string> given_;           ///< names of extensions that the document has now
  std::unordered_set<std::string> done_;  ///< "/materials/3"
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

// Extensions whose last object went with something that was taken out.
void settle_taken_out(Context& context, edit::NameList& used, edit::NameList& required) {
  std::vector<json::NodeId> values;
  for (const auto& [value, action] : context.taken_out) values.push_back(value);
  const auto gone = edit::extensions_taken_out(context.document, std::move(values));
  std::set<std::string> listed = used.remove_all(gone);
  listed.merge(required.remove_all(gone));
  if (listed.empty()) return;
  std::map<std::string_view, UpgradeAction*> actions;
  for (UpgradeAction& action : context.plan.actions) actions[action.pointer] = &action;
  for (const std::string& name : listed) {
    actions[context.taken_out[gone.at(name)]]->notes.push_back(
        fmt::format("{} is no longer used; its declaration is removed", name));
  }
}

// Extensions that may stand in the document, those first on whose results others build: what puts
// values into its carrier before what copies them from there.
std::vector<const schema::Extension*> legacy_of(const json::Document& document,
                                                const schema::Set& set, const edit::NameList& used,
                                                const edit::NameList& required) {
  std::vector<const schema::Extension*> legacy;
  for (const schema::Extension& extension : set.extensions()) {
    const std::string& name = extension.name;
    const bool named =
        document.key_id(name) != json::kNoKey || used.has(name) || required.has(name);
    const bool known = !extension.upgrade.to.empty() || !extension.upgrade.stays.empty();
    if (known && named) legacy.push_back(&extension);
  }
  const auto order = [](const schema::Extension* extension) {
    const auto& steps = extension->upgrade.steps;
    const bool places = std::any_of(steps.begin(), steps.end(), [](const auto& step) {
      return step.kind == schema::UpgradeStep::Kind::place;
    });
    if (!extension->upgrade.opt_in.empty()) return 2;
    return places ? 0 : 1;
  };
  std::stable_sort(legacy.begin(), legacy.end(),
                   [&](const auto* a, const auto* b) { return order(a) < order(b); });
  return legacy;
}

}  // namespace

bool names_legacy(const json::Document& document, const schema::Set& set) {
  const edit::NameList used(document, "extensionsUsed");
  const edit::NameList required(document, "extensionsRequired");
  return model::is_gltf_1(document) || !legacy_of(document, set, used, required).empty();
}

Plan make_plan(const json::Document& document, const schema::Set& set,
               const UpgradeOptions& options, Pictures* pictures, AssetBytes* bytes) {
  if (auto action = find_old_format(document, options)) {
    Plan plan;
    plan.actions.push_back(*std::move(action));
    return plan;
  }
  edit::NameList used(document, "extensionsUsed");
  edit::NameList required(document, "extensionsRequired");
  const std::vector<const schema::Extension*> legacy = legacy_of(document, set, used, required);
  if (legacy.empty()) return {};
  Context context(document, set, options, pictures, bytes);
  std::deque<ExtensionPlan> plans;
  for (const schema::Extension* extension : legacy) plans.emplace_back(context, *extension);
  for (bool more = true; more;) {
    more = false;
    for (ExtensionPlan& plan : plans) more = plan.attempt() || more;
  }
  for (ExtensionPlan& plan : plans) plan.finish(used, required);
  settle_dropped(context);
  settle_taken_out(context, used, required);
  used.apply(context.editor);
  required.apply(context.editor);
  context.plan.edits = context.editor.take();
  settle_splits(context);
  return std::move(context.plan);
}

}  // namespace gltfx::upgrade
