// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/plan.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "change/lost_content.hpp"
#include "change/name_list.hpp"
#include "json/writer.hpp"
#include "model/asset.hpp"
#include "steps/upgrade/ambiguity.hpp"
#include "steps/upgrade/choice.hpp"
#include "steps/upgrade/context.hpp"
#include "steps/upgrade/generation.hpp"
#include "steps/upgrade/object_plan.hpp"
#include "steps/upgrade/version.hpp"

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
    hosts_ = hosts_of(document_, context_.set, extension_);
    first_ = context.plan.actions.size();
    context.plan.actions.resize(first_ + hosts_.size());
  }

  // Does all actions that are possible now; returns whether there were any. They may make other
  // actions possible, so this is called until nothing is done in any plan.
  bool attempt() {
    const bool together = extension_.upgrade.together || has_template();
    std::vector<std::unique_ptr<ObjectPlan>> plans;  // a plan is large and kept only if needed
    bool any = false;
    for (std::size_t i = 0; i < hosts_.size(); ++i) {
      std::unique_ptr<ObjectPlan> plan;
      if (!actions()[i].done) plan = prepare(i);
      if (together) plans.push_back(std::move(plan));
      if (!together && plan) any = resolve(*plan, i) || any;
    }
    if (together) hold_together();
    for (std::size_t i = 0; i < plans.size(); ++i) {
      if (plans[i]) any = resolve(*plans[i], i) || any;
    }
    return any;
  }

  void finish(change::NameList& used, change::NameList& required) {
    if (hosts_.empty()) drop_unused_name(used, required);
    if (converted_ + removed_ == 0) return;
    resolve_names(used, required);
    resolve_pointers();
  }

  // The actions, by their legacy objects.
  void list_actions(std::unordered_map<json::NodeId, UpgradeAction*>& by_object) const {
    for (std::size_t i = 0; i < hosts_.size(); ++i) {
      by_object[hosts_[i].object] = &actions()[i];
    }
  }

  // Adds the actions for names to the others, which changes the positions in the plan. Later plans
  // are called first.
  void add_dropped() {
    std::vector<UpgradeAction>& all = context_.plan.actions;
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(first_),
               std::make_move_iterator(dropped_.begin()), std::make_move_iterator(dropped_.end()));
  }

 private:
  std::span<UpgradeAction> actions() const {
    return std::span(context_.plan.actions).subspan(first_, hosts_.size());
  }

  bool is_doable(const UpgradeAction& action) const {
    return action.outcome == UpgradeOutcome::safe ||
           (action.outcome == UpgradeOutcome::unsafe && context_.options.unsafe);
  }

  // Null if there is nothing to do.
  std::unique_ptr<ObjectPlan> prepare(std::size_t i) {
    if (auto action = action_without_plan(hosts_[i])) {
      actions()[i] = *std::move(action);
      return nullptr;
    }
    const schema::Extension& successor =
        choice_.to.empty() ? extension_
                           : context_.set.extensions()[context_.set.find_extension(choice_.to)];
    auto plan =
        std::make_unique<ObjectPlan>(context_, extension_, successor, hosts_[i], actions()[i]);
    plan->prepare();
    return plan;
  }

  // For extensions without a successor, or with an upgrade only on request.
  std::optional<UpgradeAction> action_without_plan(const Host& host) const {
    const bool offered = choice_.selection == Selection::offered;
    if (extension_.upgrade.stays.empty() && !offered) return std::nullopt;
    const Decision decision =
        decide_generation(document_, extension_, host.object, context_.options.generation);
    const std::string generation = decision.generation ? decision.generation->name : "";
    UpgradeAction action;
    action.pointer = host.pointer() + "/extensions/" + extension_.name;
    action.from = extension_.name;
    action.to = choice_.to;
    for (const schema::UpgradeStay& stay : extension_.upgrade.stays) {
      if (!is_meant(stay.generations, generation)) continue;
      const bool named = !context_.options.only.empty() || !context_.options.to.empty();
      action.outcome = named ? UpgradeOutcome::impossible : UpgradeOutcome::no_successor;
      action.to.clear();
      action.generation = generation;
      action.decision = decision.because;
      action.notes.push_back(stay.because);
      return action;
    }
    if (!offered) return std::nullopt;
    action.outcome = UpgradeOutcome::on_request;
    action.notes.push_back("--only " + extension_.name + ": " + extension_.upgrade.opt_in);
    return action;
  }

  bool is_into(const graph::PointerUse& use) const {
    return use.steps.size() > 3 && use.steps[2] == "extensions" && use.steps[3] == extension_.name;
  }

  // A pointer to all objects requires that they all get the same name.
  bool has_template() const {
    const auto& all = context_.pointers.all();
    return std::any_of(all.begin(), all.end(), [this](const graph::PointerUse& use) {
      return graph::Pointers::is_template(use) && is_into(use);
    });
  }

  // All objects or none: one that cannot be upgraded, or is at an undefined place, prevents the
  // upgrade of the others.
  void hold_together() {
    const auto doable = static_cast<std::size_t>(
        std::count_if(actions().begin(), actions().end(),
                      [this](const UpgradeAction& action) { return is_doable(action); }));
    if (doable == count_occurrences()) return;
    for (UpgradeAction& action : actions()) {
      if (!is_doable(action)) continue;
      action.outcome = UpgradeOutcome::impossible;
      action.notes.emplace_back(
          "other objects of the asset cannot be upgraded, and all must be upgraded together");
    }
  }

  bool resolve(ObjectPlan& plan, std::size_t i) {
    UpgradeAction& action = actions()[i];
    if (!is_doable(action)) return false;
    action.done = true;
    plan.apply();
    (action.removed ? removed_ : converted_) += 1;
    if (action.removed) return true;
    for (std::string& name : plan.further_extensions()) given_.insert(std::move(name));
    return true;
  }

  // Objects of the extension, also at undefined places.
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

  // Removes a name from the lists if there is no object. If the upgrade is only on request, the
  // name stays unless the extension is legacy or archived.
  void drop_unused_name(change::NameList& used, change::NameList& required) {
    using schema::Status;
    const Status status = extension_.status;
    const bool past = status == Status::legacy || status == Status::archived;
    const bool wanted =
        choice_.selection == Selection::yes || (choice_.selection == Selection::offered && past);
    if (!wanted || extension_.attachment_points.empty() || count_occurrences() > 0) return;
    for (change::NameList* list : {&used, &required}) {
      for (std::string& place : list->places(extension_.name)) {
        UpgradeAction action;
        action.pointer = std::move(place);
        action.from = extension_.name;
        action.to = choice_.to;
        action.removed = action.done = true;
        action.notes.push_back(fmt::format("no object has {}", extension_.name));
        dropped_.push_back(std::move(action));
      }
      list->remove(extension_.name);
    }
  }

  void resolve_names(change::NameList& used, change::NameList& required) {
    const std::string& from = extension_.name;
    const std::string& to = choice_.to;
    left_ = count_occurrences() - converted_ - removed_;
    const bool was_required = required.has(from);
    for (change::NameList* list : {&used, &required}) {
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
  void resolve_pointers() {
    if (context_.pointers.all().empty()) return;
    std::unordered_set<std::string> done;  // "/materials/3"
    for (std::size_t i = 0; i < hosts_.size(); ++i) {
      if (actions()[i].done && !actions()[i].removed) done.insert(hosts_[i].pointer());
    }
    for (const graph::PointerUse& use : context_.pointers.all()) {
      if (!is_into(use)) continue;
      const bool every = graph::Pointers::is_template(use) && left_ == 0 && removed_ == 0;
      if (every || done.count("/" + use.steps[0] + "/" + use.steps[1]) > 0) rename(use);
    }
  }

  void rename(const graph::PointerUse& use) {
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

  // The new place of a member of the old object, from the host; without a name, of the object.
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
  std::vector<Host> hosts_;
  std::size_t first_ = 0;               ///< position of the first host's action in the plan
  std::vector<UpgradeAction> dropped_;  ///< for names in lists
  std::size_t converted_ = 0;
  std::size_t removed_ = 0;
  std::size_t left_ = 0;
  std::set<std::string> given_;  ///< names of new extensions in the document
};

void resolve_dropped(Context& context) {
  for (const auto& [host, keys] : context.dropped) {
    const json::NodeId extensions = context.document.find(host, "extensions");
    if (context.document.object_size(extensions) == keys.size()) {
      context.editor.remove(host, extensions - 1);
      continue;
    }
    for (const json::NodeId key : keys) context.editor.remove(extensions, key);
  }
}

// Removes names of extensions whose last object was inside a removed value.
void resolve_taken_out(Context& context, const std::deque<ExtensionPlan>& plans,
                       change::NameList& used, change::NameList& required) {
  std::vector<json::NodeId> values;
  for (const auto& [value, object] : context.taken_out) values.push_back(value);
  const auto gone = change::extensions_taken_out(context.document, std::move(values));
  std::set<std::string> listed = used.remove_all(gone);
  listed.merge(required.remove_all(gone));
  if (listed.empty()) return;
  const std::unordered_map<json::NodeId, json::NodeId> owners(context.taken_out.begin(),
                                                              context.taken_out.end());
  std::unordered_map<json::NodeId, UpgradeAction*> actions;
  for (const ExtensionPlan& plan : plans) plan.list_actions(actions);
  for (const std::string& name : listed) {
    actions.at(owners.at(gone.at(name)))
        ->notes.push_back(fmt::format("{} is no longer used; its declaration is removed", name));
  }
}

// Extensions that may be in the document, in the order of their dependencies: those that add values
// to their host come before those that copy such values.
std::vector<const schema::Extension*> legacy_of(const json::Document& document,
                                                const schema::Set& set,
                                                const change::NameList& used,
                                                const change::NameList& required) {
  std::vector<const schema::Extension*> legacy;
  for (const schema::Extension& extension : set.extensions()) {
    const std::string& name = extension.name;
    const bool named =
        document.key_id(name) != json::kNoKey || used.has(name) || required.has(name);
    const bool known = extension.upgrade.does_something() || !extension.upgrade.stays.empty();
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
  const change::NameList used(document, "extensionsUsed");
  const change::NameList required(document, "extensionsRequired");
  return model::is_gltf_1(document) || !legacy_of(document, set, used, required).empty();
}

Plan make_plan(const json::Document& document, const schema::Set& set,
               const UpgradeOptions& options, Pictures* pictures, model::AssetBytes* bytes) {
  if (auto action = find_old_format(document, options)) {
    Plan plan;
    plan.actions.push_back(*std::move(action));
    return plan;
  }
  if (!options.gltf.empty()) return plan_version(document, set, options);
  change::NameList used(document, "extensionsUsed");
  change::NameList required(document, "extensionsRequired");
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
  resolve_dropped(context);
  resolve_taken_out(context, plans, used, required);
  std::for_each(plans.rbegin(), plans.rend(), [](ExtensionPlan& plan) { plan.add_dropped(); });
  used.apply(context.editor);
  required.apply(context.editor);
  context.plan.change.edits = context.editor.take();
  resolve_splits(context);
  return std::move(context.plan);
}

}  // namespace gltfx::upgrade
