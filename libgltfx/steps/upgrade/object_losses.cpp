// SPDX-License-Identifier: Apache-2.0
/// The losses of a legacy object, and the changes of vertex colours and animations that prevent a
/// loss.
// Also the extensions next to a legacy object, and whether the object has an effect there.
#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "change/lost_content.hpp"
#include "json/parse.hpp"
#include "schema/phrases.hpp"
#include "steps/upgrade/object_plan.hpp"

namespace gltfx::upgrade {

void ObjectPlan::lose(std::string note) {
  if (action_.outcome == UpgradeOutcome::safe) action_.outcome = UpgradeOutcome::unsafe;
  action_.notes.push_back(std::move(note));
}

void ObjectPlan::follow_animation(const schema::UpgradeStep& step,
                                  const std::vector<std::string>& path) {
  auto followers =
      find_followers(context_, host_, path, {"extensions", successor_.name, step.to}, step.take);
  if (!followers) {
    return lose(fmt::format("{} is animated, but {}; the copy in {} is not animated", step.from,
                            followers.error().message, step.to));
  }
  action_.notes.push_back(
      fmt::format("{} is animated; channels for {} are added", step.from, step.to));
  followers_.insert(followers_.end(), followers->begin(), followers->end());
}

void ObjectPlan::note_losses() {
  for (const schema::UpgradeLoss& loss : extension_.upgrade.losses) {
    if (!applies(loss.generations)) continue;
    if (!loss.vertex_attribute.empty()) {
      note_lost_attribute(loss);
    } else if (extension_.upgrade.opt_in.empty()) {
      lose(loss.because);
    } else {
      action_.lossy = true;
      action_.notes.push_back(loss.because);
    }
  }
}

void ObjectPlan::note_lost_attribute(const schema::UpgradeLoss& loss) {
  const std::string& name = loss.vertex_attribute;
  if (host_.array != "materials" || !context_.is_used_with(name, host_.index)) return;
  Problem problem = std::string("cannot be converted");
  if (name == "COLOR_0") problem = check_tint();
  if (problem) lose(fmt::format("{} {}: {}", name, *problem, schema::clause(loss.because)));
}

// Vertex colours multiply the base colour. A copy of the base colour is multiplied by them, if they
// are the same for all vertices.
ObjectPlan::Problem ObjectPlan::check_tint() {
  const auto& steps = extension_.upgrade.steps;
  const auto copy = std::find_if(steps.begin(), steps.end(), [this](const auto& step) {
    return step.kind == schema::UpgradeStep::Kind::copy && step.take == 3 &&
           step.from == "pbrMetallicRoughness/baseColorFactor" && applies(step.generations);
  });
  if (copy == steps.end()) return "cannot be converted";
  const Tint tint = find_tint(context_.asset, context_.values, context_.uses_of(host_.index));
  if (!tint.problem.empty()) return tint.problem;
  if (tint.parts.size() > 1 && is_pointed_at({})) {
    return "differs between primitives, but an animation or graph references the material";
  }
  return fold_tint(*copy, tint);
}

// The material keeps the first colour; copies of it get the others.
ObjectPlan::Problem ObjectPlan::fold_tint(const schema::UpgradeStep& step, const Tint& tint) {
  if (tint.parts.size() == 1 && tint.parts.front().color == tint_) return std::nullopt;  // white
  auto found = std::find_if(found_.begin(), found_.end(),
                            [&](const Found& each) { return each.step == &step; });
  if (found == found_.end()) {
    found_.emplace_back(&step, json::kNoNode);
    found = std::prev(found_.end());
    found->json = "[1,1,1]";
  }
  const json::Parsed base = json::parse(found->json);
  const std::vector<json::Number> factor = numbers_of(base.document, base.document.root());
  const auto product = [&](const Rgb& color) {
    return fmt::format("[{},{},{}]", number_text(factor[0].value * color[0]),
                       number_text(factor[1].value * color[1]),
                       number_text(factor[2].value * color[2]));
  };
  tint_ = tint.parts.front().color;
  found->json = product(tint_);
  action_.notes.push_back(fmt::format("COLOR_0 is multiplied into {}", step.to));
  for (std::size_t i = 1; i < tint.parts.size(); ++i) {
    splits_.push_back({host_.node,
                       {"extensions", successor_.name, step.to},
                       product(tint.parts[i].color),
                       tint.parts[i].users});
  }
  if (!splits_.empty()) {
    action_.notes.push_back(
        fmt::format("it differs between primitives; the material is duplicated ({})",
                    splits_.size() == 1 ? "1 copy" : fmt::format("{} copies", splits_.size())));
  }
  return std::nullopt;
}

bool ObjectPlan::is_blocked_by(const std::string& extension) const {
  const auto& conflicts = extension_.upgrade.blocked_by;
  return std::any_of(conflicts.begin(), conflicts.end(),
                     [&](const auto& other) { return other.extension == extension; });
}

ObjectPlan::Problem ObjectPlan::conflict() const {
  for (const schema::Relation& other : extension_.upgrade.blocked_by) {
    if (has_beside(other.extension)) {
      return fmt::format("the object also has {}: {}", other.extension,
                         schema::clause(other.because));
    }
  }
  return std::nullopt;
}

schema::TypeId ObjectPlan::own_type() const {
  const schema::ShapeId shape = extension_.shape_on(host_.type);
  return shape == schema::kNone ? schema::kNone : context_.set.shape(shape).type;
}

// The content of the object that does not belong to its extension.
std::vector<std::string> ObjectPlan::foreign() const {
  return change::foreign_content(document_, context_.set, host_.object, own_type());
}

void ObjectPlan::check_removal(const std::string& why) {
  if (is_own_pointed_at()) return refuse(why + ", but an animation or graph references it");
  action_.removed = true;
  action_.notes.insert(action_.notes.begin(), why);
  const std::vector<std::string> names = foreign();
  if (!names.empty()) lose(fmt::format("this also removes {}", join_and(names)));
}

// Why the object has no effect, if so.
ObjectPlan::Problem ObjectPlan::reason_to_go() {
  if (Problem why = hidden()) return why;
  if (conversion_ != nullptr) {
    if (Problem why = conversion_->reason_to_go(context())) return why;
  }
  const std::string& name = extension_.strength;
  if (name.empty() || is_pointed_at({"extensions", extension_.name, name})) return std::nullopt;
  const json::NodeId strength = document_.find(host_.object, name);
  const bool there = strength != json::kNoNode;
  const bool off =
      !there || (document_.is_number(strength) && document_.number(strength).value == 0);
  if (!off) return std::nullopt;
  std::string why = fmt::format("no effect: {}{}", there ? "" : "no ", name);
  if (there) why += " is 0";
  if (foreign().empty()) return why;
  action_.notes.push_back(
      fmt::format("{}; it is kept because it has {}", why, join_and(foreign())));
  return std::nullopt;
}

// If two extensions both replace the whole material, no specification defines which one counts.
ObjectPlan::Problem ObjectPlan::hidden() {
  for (const schema::Relation& hider : extension_.upgrade.hidden_by) {
    if (!has_beside(hider.extension)) continue;
    std::string_view because = hider.because;  // a sentence that is turned into a clause
    if (because.ends_with('.')) because.remove_suffix(1);
    const schema::ExtensionId other = context_.set.find_extension(hider.extension);
    const bool is_model = other != schema::kNone && context_.set.extensions()[other].standalone;
    if (is_model && extension_.standalone) {
      place_what_is_missing();
      lose(fmt::format("viewers that use {} instead of {} show a different result", extension_.name,
                       hider.extension));
    }
    return fmt::format("no effect: {}", schema::clause(std::string(because)));
  }
  return std::nullopt;
}

// The material that is used instead gets the values of this object, unless it has some of them.
void ObjectPlan::place_what_is_missing() {
  std::vector<const schema::UpgradeStep*> steps;
  for (const schema::UpgradeStep& step : extension_.upgrade.steps) {
    if (step.kind != schema::UpgradeStep::Kind::place || step.from.empty()) continue;
    if (find_path(document_, host_.node, split_path(step.to)) != json::kNoNode) return;
    if (document_.find(host_.object, step.from) != json::kNoNode) steps.push_back(&step);
  }
  for (const schema::UpgradeStep* step : steps) {
    if (find_placed(*step)) continue;
    action_.notes.push_back(fmt::format("{} becomes {}", step->from, step->to));
  }
}

// Extensions that the successor excludes are obstacles. Extensions that only the old one excludes
// become visible.
ObjectPlan::Problem ObjectPlan::check_neighbours() {
  for (const schema::Relation& excluded : successor_.excludes) {
    if (excluded.extension == extension_.name || !has_beside(excluded.extension)) continue;
    return fmt::format("{} and {} are mutually exclusive: {}", successor_.name, excluded.extension,
                       schema::clause(excluded.because));
  }
  for (const schema::Relation& excluded : extension_.excludes) {
    if (!has_beside(excluded.extension)) continue;
    lose(fmt::format("{} takes effect, which {} excluded: {}", excluded.extension, extension_.name,
                     schema::clause(excluded.because)));
  }
  return std::nullopt;
}

}  // namespace gltfx::upgrade
