// SPDX-License-Identifier: Apache-2.0
// Indices and names that refer to other objects.
// Shapes that apply to several members, or several shapes for one value.
#include <algorithm>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {

// The array that is meant at this place of the walk; null when the document does not have it.
ReferenceTargets::Array* Walker::array_of(const TargetPlan& plan, std::uint32_t target) {
  if (plan.target.base != Target::Base::enclosing) {
    ReferenceTargets::Array& array = targets_.from_root(target);
    return array.is_array ? &array : nullptr;
  }
  for (const Frame* frame = top_; frame != nullptr; frame = frame->parent) {
    if (frame->mode != Mode::object || frame->type == kNone ||
        set_.type(frame->type).origin != plan.target.enclosing)
      continue;
    ReferenceTargets::Array* array = targets_.below(plan.target, frame->node, frame->path);
    return array != nullptr && array->is_array ? array : nullptr;
  }
  return nullptr;
}

// The Khronos validator then reports the missing object of the extension at the root instead of the
// element.
bool Walker::lacks_root_extension(const Target& target) const {
  if (target.base != Target::Base::root_path || target.steps.front() != "extensions") return false;
  const json::NodeId extensions = document_.find(document_.root(), "extensions");
  return document_.find(extensions, target.steps[1]) == json::kNoNode;
}

// The element of a broken reference is unknown, so no element of its array is reported as unused.
// Returns whether the target is not an array, which has been reported already.
bool Walker::discard_reference(ShapeId shape) {
  if (deviations().broken_values_are_absent || tables_.shapes[shape].target == kNone) return false;
  const std::uint32_t target = tables_.shapes[shape].target;
  const TargetPlan& plan = tables_.targets[target];
  if (ReferenceTargets::Array* array = array_of(plan, target); array != nullptr) {
    array->used.mark_all();
    return false;
  }
  return plan.target.base != Target::Base::enclosing &&
         targets_.from_root(target).node != json::kNoNode;
}

void Walker::refer(ShapeId shape, std::uint64_t index, Value value, const Path& path) {
  const std::uint32_t target = tables_.shapes[shape].target;
  const TargetPlan& plan = tables_.targets[target];
  const bool of_root = top_ != nullptr && top_->parent == nullptr;
  result_.has_open_references = true;
  if (options_.part == (of_root ? Part::references : Part::form)) return;
  ReferenceTargets::Array* array = array_of(plan, target);
  if (options_.references != nullptr) {
    (*options_.references)({ReferenceUse::Kind::index, value.node, &plan.target,
                            plan.steps_over ? std::string_view() : plan.pointer, index,
                            values_.span(value), array == nullptr ? json::kNoNode : array->node});
  }
  const bool hole = array != nullptr && array->is_hole(index);
  if (array != nullptr && index < array->size && !(deviations().broken_values_are_absent && hole)) {
    if (index < array->used.size()) array->used.mark(index, tables_.shapes[shape].of_extension);
    if (!hole && !plan.steps_over) look_at_element(shape, *array, index, value, path);
    return;
  }
  if (array == nullptr && deviations().root_extension_is_a_dependency &&
      lacks_root_extension(plan.target)) {
    return;
  }
  if (discard_reference(shape)) return;
  Sink& sink = options_.part == Part::form ? schema_sink_ : reference_sink_;
  if (!sink.is_enabled()) return;
  const std::string& name = plan.target.steps.back();
  std::string message =
      name_of(path) + " refers to " + printable(name) + "[" + std::to_string(index) + "], but ";
  if (array == nullptr) {
    message += "there are no " + name + ".";
  } else if (index < array->size) {
    message += "that element is not an object.";
  } else {
    message += "the length of " + printable(name) + " is " + std::to_string(array->size) + ".";
  }
  sink.report(
      path,
      {Code::UNRESOLVED_REFERENCE, std::move(message), {}, values_.span(value), std::nullopt});
}

// Checks the members that the referenced element must have.
void Walker::look_at_element(ShapeId shape, ReferenceTargets::Array& array, std::uint64_t index,
                             Value value, const Path& path) {
  const std::vector<std::string>& steps = set_.shape(shape).ref_has;
  if (deviations().no_additional_rules) return;
  fit_element(shape, array, index, value, path);
  if (steps.empty()) return;
  if (targets_.has_member(array, index, shape, steps)) return;
  const std::string& name = set_.shape(shape).ref->steps.back();
  reference_sink_.report(path,
                         {Code::REFERENCE_MEMBER_MISSING,
                          fmt::format("{} refers to {}[{}], which does not have {}.", name_of(path),
                                      printable(name), index, quoted(steps.back())),
                          {},
                          values_.span(value),
                          std::nullopt});
}

// Elements are judged once: many references may lead to one.
void Walker::fit_element(ShapeId id, ReferenceTargets::Array& array, std::uint64_t index,
                         Value value, const Path& path) {
  const Shape& shape = set_.shape(id);
  if (shape.ref_holds == kNone) return;
  const auto [known, is_new] = array.having.try_emplace(shape.ref_holds);
  if (is_new) {
    for (const json::NodeId element : document_.elements(array.node)) {
      known->second.push_back(holds_(shape.ref_holds, {element}));
    }
  }
  if (known->second[index]) return;
  reference_sink_.report(path, {Code::REFERENCE_MISMATCH,
                                fmt::format("{} refers to {}[{}]; it must be {}.", name_of(path),
                                            printable(shape.ref->steps.back()), index,
                                            set_.shape(shape.ref_holds).description),
                                {},
                                values_.span(value),
                                std::nullopt});
}

// A missing part of an extension's object at the root may be in a separate file.
bool Walker::is_elsewhere(const Target& target) const {
  if (target.base != Target::Base::root_path || target.steps.front() != "extensions") return false;
  if (std::find(target.steps.begin(), target.steps.end(), "*") != target.steps.end()) return false;
  json::NodeId node = document_.root();
  for (std::size_t i = 0; i + 1 < target.steps.size(); ++i) {
    node = document_.find(node, target.steps[i]);
    if (node == json::kNoNode) return i > 1;
  }
  return false;
}

void Walker::refer_name(ShapeId shape, std::string_view name, Value value, const Path& path) {
  result_.has_open_references = true;
  const std::uint32_t target = tables_.name_target_of[shape];
  if (options_.references != nullptr) {
    (*options_.references)({ReferenceUse::Kind::name,
                            value.node,
                            &*set_.shape(shape).ref_name,
                            {},
                            0,
                            {},
                            json::kNoNode});
  }
  if (targets_.has_name(target, name) || is_elsewhere(*set_.shape(shape).ref_name)) return;
  reference_sink_.report(path,
                         {Code::UNRESOLVED_NAME,
                          name_of(path) + " is " + shown(values_, value) + ", but no object at " +
                              set_.shape(shape).ref_name->text + " has this name.",
                          {},
                          values_.span(value),
                          std::nullopt});
}

// What a property asks of its value and of the other members.
void Walker::advise(const Frame& frame, std::uint32_t index, json::NodeId node) {
  const Property& property = set_.type(frame.type).properties[index];
  const auto& should = property.should;
  if (should && should->since <= version_ && !holds_(should->shape, {node})) {
    report({frame.path, key_of(node)}, Code::NOT_RECOMMENDED, document_.span(node - 1),
           should->because);
  }
  for (const std::string& other : property.without) {
    if (document_.find(frame.node, other) == json::kNoNode) continue;
    report(frame.path, Code::ONE_OF_MISMATCH, opening(frame.node),
           quoted(property.name) + " and " + quoted(other) + " are mutually exclusive.");
  }
}

void Walker::constraints(const Frame& frame) {
  if (frame.mode == Mode::object && frame.type != kNone) dependencies(frame);
  if (!tables_.shapes[frame.shape].combined) return;
  const std::size_t before = pending_.size();
  combine(frame.shape, {frame.node}, frame.path, true);
  std::reverse(pending_.begin() + static_cast<std::ptrdiff_t>(before), pending_.end());
}

// `walked`: the value is a container on the walk, so its further shapes are put on the list.
void Walker::combine(ShapeId id, Value value, const Path& path, bool walked) {
  const Shape& shape = set_.shape(id);
  for (const ShapeId all : shape.all_of) further(all, value, path, walked);
  if (!shape.any_of.empty()) alternatives(id, shape.any_of, false, value, path, walked);
  if (!shape.one_of.empty()) alternatives(id, shape.one_of, true, value, path, walked);
  if (shape.not_shape != kNone && holds_(shape.not_shape, value))
    forbidden(set_.shape(shape.not_shape), value, path);
  for (const Condition& condition : shape.conditions) {
    const bool then = holds_(condition.if_shape, value);
    further(then ? condition.then_shape : condition.else_shape, value, path, walked);
  }
}

// Another shape that must hold for the value. Recursive only for scalars and number arrays, with
// the depth of nested combinators that the compiler allows.
void Walker::further(ShapeId id, Value value, const Path& path, bool walked) {
  if (id == kNone) return;
  if (walked) {
    pending_.push_back(id);
  } else if (values_.kind(value) != json::Kind::number_array) {
    check(id, value, path);
  } else if (!holds_(id, value)) {
    report(path, Code::CONDITION_MISMATCH, values_.span(value),
           name_of(path) + " does not have the required form.");
  }
}

void Walker::alternatives(ShapeId id, const std::vector<ShapeId>& branches, bool exactly_one,
                          Value value, const Path& path, bool walked) {
  const auto fits = [&](ShapeId branch) { return holds_(branch, value); };
  const auto first = std::find_if(branches.begin(), branches.end(), fits);
  if (first == branches.end()) return no_alternative(branches, exactly_one, value, path);
  if (exactly_one && std::any_of(first + 1, branches.end(), fits)) {
    std::vector<std::string> both;
    for (const ShapeId branch : branches) {
      for (const std::string& name : required_only(branch)) {
        const bool there = document_.find(value.node, name) != json::kNoNode;
        if (there && std::find(both.begin(), both.end(), name) == both.end()) both.push_back(name);
      }
    }
    report(path, both.empty() ? Code::CONDITION_MISMATCH : Code::ONE_OF_MISMATCH,
           both.empty() || value.element != nullptr ? values_.span(value) : opening(value.node),
           both.empty() ? name_of(path) + " matches several forms that are mutually exclusive."
                        : all_of_phrase(both) + " are mutually exclusive.");
    return;
  }
  // The branch that holds may have references to follow; a scalar has only that of its own shape.
  if (*first != kNone && walked && tables_.shapes[*first].plan != Plan::any && *first != id) {
    if (required_only(*first).empty()) further(*first, value, path, true);
  }
}

void Walker::no_alternative(const std::vector<ShapeId>& branches, bool exactly_one, Value value,
                            const Path& path) {
  std::vector<std::string> wanted;
  std::vector<std::string> forms;
  for (const ShapeId branch : branches) {
    const std::vector<std::string> names = required_only(branch);
    if (!names.empty()) wanted.push_back(all_of_phrase(names));
    forms.push_back(branch == kNone ? "anything" : scalar_phrase(set_, set_.shape(branch)));
  }
  const json::Kind kind = values_.kind(value);
  if (kind == json::Kind::object && wanted.size() == branches.size()) {
    report(path, exactly_one ? Code::ONE_OF_MISMATCH : Code::UNDEFINED_PROPERTY,
           opening(value.node),
           name_of(path) + " must have " + join_or(wanted) + "; it has " +
               (wanted.size() == 2 ? "neither" : "none") + ".");
    return;
  }
  const bool number = kind == json::Kind::number;
  const auto listed = [&](ShapeId b) { return b != kNone && !set_.shape(b).literals.empty(); };
  const bool list = std::all_of(branches.begin(), branches.end(), listed);
  const Span span = kind == json::Kind::object ? opening(value.node) : values_.span(value);
  std::string message =
      name_of(path) + " is " + shown(values_, value) + "; it must be " + join_or(forms) + ".";
  if (list) return report_unlisted(path, span, std::move(message), {});
  report(path, number ? Code::VALUE_NOT_IN_RANGE : Code::CONDITION_MISMATCH, span,
         std::move(message));
}

void Walker::forbidden(const Shape& shape, Value value, const Path& path) {
  const bool object = values_.kind(value) == json::Kind::object;
  if (!shape.description.empty()) {
    report(path, Code::CONDITION_MISMATCH, object ? opening(value.node) : values_.span(value),
           shape.description);
    return;
  }
  std::vector<std::string> names;
  if (object && shape.type != kNone) {
    for (const Property& property : set_.type(shape.type).properties) {
      if (property.required) names.push_back(property.name);
    }
  }
  if (names.size() == 1) {
    const json::NodeId member = document_.find(value.node, names.front());
    const Path place(path, key_of(member));
    report(place, Code::CONDITION_MISMATCH, document_.span(member - 1),
           quoted(names.front()) + " is not allowed with the other members.", "remove the member");
  } else if (names.size() > 1) {
    report(path, Code::ONE_OF_MISMATCH, opening(value.node),
           all_of_phrase(names) + " are mutually exclusive.");
  } else {
    report(path, Code::CONDITION_MISMATCH, object ? opening(value.node) : values_.span(value),
           name_of(path) + " is " + shown(values_, value) + ", which is not allowed here.");
  }
}

void Walker::dependencies(const Frame& frame) {
  const auto value_of = [&](std::uint32_t property, const std::string& name) {
    return property == kNone ? document_.find(frame.node, name)
                             : members_[frame.scratch + property];
  };
  for (const DependencyPlan& plan : tables_.types[frame.type].dependencies) {
    const json::NodeId member = value_of(plan.property, plan.name);
    const json::NodeId needed = value_of(plan.needed, plan.other);
    if (member == json::kNoNode || is_hidden(member)) continue;
    if (needed != json::kNoNode && !is_hidden(needed)) continue;
    const std::string name = quoted(plan.name);
    const std::string other = quoted(plan.other);
    report({frame.path, key_of(member)}, Code::UNSATISFIED_DEPENDENCY, document_.span(member - 1),
           fmt::format("{} requires {}.", name, other),
           fmt::format("add {}, or remove {}", other, name));
  }
}

// The names of a shape that only requires members.
std::vector<std::string> Walker::required_only(ShapeId id) const {
  std::vector<std::string> names;
  if (id == kNone) return names;
  const Shape& shape = set_.shape(id);
  if (shape.type == kNone || tables_.shapes[id].combined) return names;
  for (const Property& property : set_.type(shape.type).properties) {
    if (!property.required || property.shape != kNone) return {};
    names.push_back(property.name);
  }
  return names;
}

}  // namespace gltfx::schema
