// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/object_plan.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/lost_content.hpp"
#include "json/parse.hpp"
#include "steps/upgrade/generation.hpp"

namespace gltfx::upgrade {

std::vector<json::Number> numbers_of(const json::Document& document, json::NodeId list) {
  std::vector<json::Number> numbers;
  if (document.kind(list) != json::Kind::number_array) return numbers;
  for (json::NumberCursor at(document, list); at.valid(); at.advance()) {
    numbers.push_back(at.number());
  }
  return numbers;
}

ObjectPlan::ObjectPlan(Context& context, const schema::Extension& extension,
                       const schema::Extension& successor, const Host& host, UpgradeAction& action)
    : context_(context),
      document_(context.document),
      extension_(extension),
      successor_(successor),
      host_(host),
      placements_(context, host_),
      conversion_(make_conversion(extension.upgrade.conversion)),
      action_(action) {}

void ObjectPlan::refuse(std::string why) {
  action_.outcome = UpgradeOutcome::impossible;
  action_.notes.push_back(std::move(why));
}

void ObjectPlan::prepare() {
  action_ = {};
  action_.pointer = fmt::format("{}/extensions/{}", host_.pointer(), extension_.name);
  action_.from = extension_.name;
  action_.to = extension_.upgrade.to.empty() ? std::string() : successor_.name;
  if (!document_.is_object(host_.object)) return refuse("it is not an object");
  const bool in_array = !host_.array.empty() && !host_.single;
  if (!in_array && is_own_pointed_at()) return refuse("an animation or graph references it");
  if (const schema::Extension* other = replacement()) return check_duplicate(*other);
  if (const Problem why = reason_to_go()) return check_removal(*why);
  if (Problem problem = conflict()) return refuse(*std::move(problem));
  const Decision decision =
      decide_generation(document_, extension_, host_.object, context_.options.generation);
  if (!decision.problem.empty()) return refuse(decision.problem);
  if (decision.generation != nullptr) action_.generation = decision.generation->name;
  action_.decision = decision.because;
  if (Problem problem = check_neighbours()) return refuse(*std::move(problem));
  if (Problem problem = check_steps()) return refuse(*std::move(problem));
  if (conversion_ != nullptr) {
    if (Problem problem = conversion_->prepare(context())) return refuse(*std::move(problem));
  }
  if (joins()) note_lost_members();
  if (action_.removed && placements_.empty()) return;
  action_.removed = false;
  if (context_.options.pack) pack();
  note_overwritten();
  note_losses();
}

bool ObjectPlan::is_pointed_at(std::initializer_list<std::string_view> steps) const {
  if (context_.pointers.all().empty()) return false;  // as in most documents
  const std::vector<std::string> path(steps.begin(), steps.end());
  return context_.is_pointed_at(host_, path);
}

bool ObjectPlan::is_own_pointed_at() const {
  return is_pointed_at({"extensions", extension_.name});
}

bool ObjectPlan::has_beside(const std::string& extension) const {
  return context_.has_beside(host_, extension);
}

bool ObjectPlan::applies(const std::vector<std::string>& generations) const {
  return is_meant(generations, action_.generation);
}

ObjectPlan::Problem ObjectPlan::check_steps() {
  for (const schema::UpgradeStep& step : extension_.upgrade.steps) {
    if (!applies(step.generations)) continue;
    const bool place = step.kind == schema::UpgradeStep::Kind::place;
    if (!place && step.to != step.from && document_.find(host_.object, step.to) != json::kNoNode) {
      return fmt::format("it already has a member {}", gltfx::quoted(step.to));
    }
    if (Problem problem = find(step)) return problem;
  }
  return std::nullopt;
}

ObjectPlan::Problem ObjectPlan::find(const schema::UpgradeStep& step) {
  switch (step.kind) {
    case schema::UpgradeStep::Kind::copy:
      return find_copied(step);
    case schema::UpgradeStep::Kind::place:
      return find_placed(step);
    case schema::UpgradeStep::Kind::move:
      break;
  }
  return find_moved(step);
}

// Moves a value of the object, or another text, to a member of the host; the old value is removed.
ObjectPlan::Problem ObjectPlan::find_placed(const schema::UpgradeStep& step) {
  const std::vector<std::string> path = split_path(step.to);
  if (context_.is_pointed_at(host_, path)) {
    return fmt::format("an animation targets {}, which has no effect before the upgrade", step.to);
  }
  const json::NodeId value =
      step.from.empty() ? json::kNoNode : document_.find(host_.object, step.from);
  if (value == json::kNoNode) return placements_.put(step.to, step.otherwise);
  if (Problem problem = check_value(step.from, value)) return problem;
  found_.emplace_back(&step, value);
  return placements_.put(step.to, std::string(document_.raw(value)));
}

// For an object whose values become part of another object.
void ObjectPlan::note_lost_members() {
  const std::vector<std::string> others =
      change::foreign_members(document_, context_.set, host_.object, own_type());
  if (!others.empty()) lose(fmt::format("this also removes {}", join_and(others)));
}

void ObjectPlan::note_overwritten() {
  for (std::size_t i = 0; i < placements_.overwritten().size(); ++i) {
    const std::string note = fmt::format("{} is overwritten", placements_.overwritten()[i]);
    const std::vector<std::string> others =
        change::foreign_below(document_, context_.set, placements_.taken_out()[i]);
    if (others.empty()) {
      action_.notes.push_back(note);
    } else {
      lose(fmt::format("{}, which also removes its {}", note, join_and(others)));
    }
  }
}

ObjectPlan::Problem ObjectPlan::check_value(const std::string& name, json::NodeId value) {
  const schema::TypeId type = context_.set.shape(extension_.attachment_points.front().second).type;
  const schema::Property* property =
      type == schema::kNone ? nullptr : context_.set.find_property(type, name);
  if (property == nullptr) return std::nullopt;
  if (!context_.holds(property->shape, {value})) {
    return fmt::format("its {} is invalid; see 'gltfx validate'", name);
  }
  const json::NodeId index = document_.find(value, "index");
  return index == json::kNoNode ? std::nullopt : check_texture(name, index);
}

ObjectPlan::Problem ObjectPlan::check_texture(const std::string& name, json::NodeId index) {
  const auto texture = document_.unsigned_integer(index);
  if (texture && *texture < context_.texture_count()) return std::nullopt;
  return fmt::format("its {} does not reference a texture", name);
}

ObjectPlan::Problem ObjectPlan::find_moved(const schema::UpgradeStep& step) {
  const json::NodeId value = document_.find(host_.object, step.from);
  if (value == json::kNoNode) {
    if (step.otherwise.empty()) return std::nullopt;
    found_.emplace_back(&step, value);
    found_.back().json = step.otherwise;
    return std::nullopt;
  }
  Found found{&step, value};
  if (step.accept_index && document_.is_number(value)) {
    if (Problem problem = check_texture(step.from, value)) return problem;
    found.json = fmt::format(R"({{"index":{}}})", document_.raw(value));
    action_.notes.push_back(step.from + " is an index and becomes an object");
  } else if (Problem problem = check_value(step.from, value)) {
    return problem;
  }
  if (!step.swizzle.empty()) {
    if (Problem problem = find_channel(step, found)) return problem;
  }
  found_.push_back(std::move(found));
  return std::nullopt;
}

ObjectPlan::Problem ObjectPlan::find_copied(const schema::UpgradeStep& step) {
  const MemberSource origin = context_.source_of(host_, step.from);
  Found found{&step, origin.value};
  if (origin.value != json::kNoNode) {
    if (Problem problem = fill_copy(found, origin.path)) return problem;
    if (!found.json.empty()) found_.push_back(std::move(found));
  }
  const bool copied = origin.value != json::kNoNode || step.take > 0;
  if (copied && context_.is_pointed_at(host_, origin.path)) follow_animation(step, origin.path);
  return std::nullopt;
}

// The new text of a copied value; none if it is the default.
ObjectPlan::Problem ObjectPlan::fill_copy(Found& found, const std::vector<std::string>& path) {
  const schema::UpgradeStep& step = *found.step;
  const schema::TypeId type = context_.set.shape(successor_.attachment_points.front().second).type;
  const schema::ShapeId shape = context_.set.find_property(type, step.to)->shape;
  const std::string problem = fmt::format("{} is invalid; see 'gltfx validate'", step.from);
  if (step.take == 0) {
    if (!context_.holds(shape, {found.value})) return problem;
    found.json = document_.raw(found.value);
    const json::NodeId index = document_.find(found.value, "index");
    return index == json::kNoNode ? std::nullopt : check_texture(step.from, index);
  }
  std::vector<json::Number> numbers = numbers_of(document_, found.value);
  if (numbers.size() < step.take) return problem;
  numbers.resize(step.take);
  const schema::ShapeId items = shape == schema::kNone ? shape : context_.set.shape(shape).items;
  std::string list;
  for (const json::Number& number : numbers) {
    if (!context_.holds(items, {found.value, &number})) return problem;
    list.append(1, list.empty() ? '[' : ',').append(number.span.in(document_.text()));
  }
  const bool animated = context_.is_pointed_at(host_, path);
  if (animated || !is_default(step.to, numbers)) found.json = std::move(list).append(1, ']');
  return std::nullopt;
}

bool ObjectPlan::is_default(const std::string& property,
                            const std::vector<json::Number>& numbers) const {
  const schema::TypeId type = context_.set.shape(successor_.attachment_points.front().second).type;
  const schema::Property* described = context_.set.find_property(type, property);
  if (described == nullptr || described->default_json.empty()) return false;
  const json::Parsed fallback = json::parse(described->default_json);
  const std::vector<json::Number> usual = numbers_of(fallback.document, fallback.document.root());
  return std::equal(numbers.begin(), numbers.end(), usual.begin(), usual.end(),
                    [](const auto& a, const auto& b) { return a.value == b.value; });
}

void ObjectPlan::apply() {
  const json::NodeId key = host_.object - 1;
  context_.gone.insert(host_.object);
  for (const json::NodeId value : placements_.taken_out()) take_out(value);
  if (action_.removed) {
    context_.dropped[host_.node].push_back(key);
    take_out_members();
    if (extension_.upgrade.to.empty()) conversion_->apply(context());
    return placements_.apply();
  }
  if (joins()) {
    context_.dropped[host_.node].push_back(key);
    const json::NodeId extensions = document_.find(host_.object, "extensions");
    if (extensions != json::kNoNode) take_out(extensions);
    return conversion_->apply(context());
  }
  for (const Follower& follower : followers_) follow(context_, follower, tint_);
  for (MaterialSplit& split : splits_) split_material(context_, std::move(split));
  context_.given[{host_.node, context_.interned(successor_.name)}] = host_.object;
  context_.editor.rename(key, successor_.name);
  context_.takeovers.emplace(
      host_.node, Takeover{host_.object, &extension_, context_.interned(action_.generation)});
  for (const Found& found : found_) apply(found);
  if (conversion_ != nullptr) conversion_->apply(context());
  placements_.apply();
}

void ObjectPlan::take_out(json::NodeId value) {
  context_.taken_out.emplace_back(value, host_.object);
}

// Removes all members except those that are placed elsewhere.
void ObjectPlan::take_out_members() {
  for (const auto member : document_.members(host_.object)) {
    const bool moved = std::any_of(found_.begin(), found_.end(), [&](const Found& found) {
      return found.value == member.value && found.step->kind == schema::UpgradeStep::Kind::place;
    });
    if (!moved) take_out(member.value);
  }
}

void ObjectPlan::apply(const Found& found) {
  const schema::UpgradeStep& step = *found.step;
  json::Editor& editor = context_.editor;
  if (found.image || found.gone) release(found);
  if (found.gone) {
    take_out(found.value);
    return editor.remove(host_.object, found.value - 1);
  }
  if (step.kind == schema::UpgradeStep::Kind::place) {
    return editor.remove(host_.object, found.value - 1);
  }
  if (step.kind == schema::UpgradeStep::Kind::copy || found.value == json::kNoNode) {
    if (found.image) return show_copy(found);
    return editor.append_member(host_.object, step.to, found.json);
  }
  if (step.to != step.from) editor.rename(found.value - 1, step.to);
  if (found.image) {
    show(found);
  } else if (!found.json.empty()) {
    editor.replace(host_.object, found.value, found.json);
  }
}

}  // namespace gltfx::upgrade
