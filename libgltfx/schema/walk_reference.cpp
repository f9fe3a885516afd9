// SPDX-License-Identifier: Apache-2.0
// Indices and names that refer to other objects.
#include "base/codes.hpp"
#include "base/text.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {

// The array that is meant at this place of the walk; null when the document does not have it.
Targets::Array* Walker::array_of(const TargetPlan& plan, std::uint32_t target) {
  if (plan.target->base != Target::Base::enclosing) {
    Targets::Array& array = targets_.from_root(target);
    return array.is_array ? &array : nullptr;
  }
  for (const Frame* frame = top_; frame != nullptr; frame = frame->parent) {
    if (frame->mode != Mode::object || frame->type == kNone ||
        set_.type(frame->type).origin != plan.target->enclosing)
      continue;
    Targets::Array* array = targets_.below(*plan.target, frame->node, frame->path);
    return array != nullptr && array->is_array ? array : nullptr;
  }
  return nullptr;
}

// The Khronos validator then misses the extension's object at the root rather than the element.
bool Walker::lacks_root_extension(const Target& target) const {
  if (target.base != Target::Base::root_path || target.steps.front() != "extensions") return false;
  const json::NodeId extensions = document_.find(document_.root(), "extensions");
  return document_.find(extensions, target.steps[1]) == json::kNoNode;
}

// Nobody knows which element a broken reference means: then none is called unused. Returns whether
// what it points into is something else than an array, of which enough has been said.
bool Walker::discard_reference(ShapeId shape) {
  if (deviations().broken_values_are_absent || tables_.shapes[shape].target == kNone) return false;
  const std::uint32_t target = tables_.shapes[shape].target;
  const TargetPlan& plan = tables_.targets[target];
  if (Targets::Array* array = array_of(plan, target); array != nullptr) {
    array->used.mark_all();
    return false;
  }
  return plan.target->base != Target::Base::enclosing &&
         targets_.from_root(target).node != json::kNoNode;
}

void Walker::refer(ShapeId shape, std::uint64_t index, Value value, const Path& path) {
  const std::uint32_t target = tables_.shapes[shape].target;
  const TargetPlan& plan = tables_.targets[target];
  const bool of_root = top_ != nullptr && top_->parent == nullptr;
  if (options_.part == (of_root ? Part::references : Part::form)) return;
  if (options_.references != nullptr) {
    (*options_.references)(plan.steps_over ? std::string_view() : plan.pointer, index,
                           values_.span(value));
  }
  Targets::Array* array = array_of(plan, target);
  const bool hole = array != nullptr && array->is_hole(index);
  if (array != nullptr && index < array->size && !(deviations().broken_values_are_absent && hole)) {
    if (index < array->used.size()) array->used.mark(index);
    return;
  }
  if (array == nullptr && deviations().root_extension_is_a_dependency &&
      lacks_root_extension(*plan.target)) {
    return;
  }
  if (discard_reference(shape)) return;
  const std::string& name = plan.target->steps.back();
  std::string message =
      name_of(path) + " refers to " + printable(name) + "[" + std::to_string(index) + "], but ";
  if (array == nullptr) {
    message += "there are no " + name + ".";
  } else if (index < array->size) {
    message += "that element is not an object.";
  } else {
    message += "the length of " + printable(name) + " is " + std::to_string(array->size) + ".";
  }
  Sink& sink = options_.part == Part::form ? schema_sink_ : reference_sink_;
  sink.report(
      path,
      {Code::UNRESOLVED_REFERENCE, std::move(message), {}, values_.span(value), std::nullopt});
}

void Walker::refer_name(ShapeId shape, std::string_view name, Value value, const Path& path) {
  const std::uint32_t target = tables_.name_target_of[shape];
  if (targets_.has_name(target, name)) return;
  reference_sink_.report(path,
                         {Code::UNRESOLVED_NAME,
                          name_of(path) + " is " + shown(values_, value) + ", but no object at " +
                              set_.shape(shape).ref_name->text + " has this name.",
                          {},
                          values_.span(value),
                          std::nullopt});
}

}  // namespace gltfx::schema
