// SPDX-License-Identifier: Apache-2.0
// Schema files state the formats of attributes, but not the meaning of their numbers; so attributes
// with a meaning are listed here by name.
#include "rules/payload/element_check.hpp"

#include "model/fields.hpp"

namespace gltfx::validate {
namespace {

struct Named {
  std::string_view name;
  CheckKind kind;
};

constexpr Named kVertexValues[] = {
    {"KHR_gaussian_splatting:ROTATION", CheckKind::splat_rotation},
    {"KHR_gaussian_splatting:SCALE", CheckKind::splat_scale},
    {"KHR_gaussian_splatting:OPACITY", CheckKind::splat_opacity},
};

bool is_rotation(const model::PropertyTarget& target) {
  return target.type == model::PropertyType::float4 && target.property.ends_with("/rotation");
}

bool is_numeric(model::PropertyType type) {
  return type != model::PropertyType::none && type != model::PropertyType::boolean;
}

}  // namespace

std::optional<CheckKind> vertex_value_check(std::string_view name) {
  for (const Named& each : kVertexValues) {
    if (each.name == name) return each.kind;
  }
  return std::nullopt;
}

std::optional<CheckKind> instance_value_check(std::string_view name, const model::Format& format) {
  const bool numbers = format.component == model::ComponentType::float32 || format.normalized;
  const bool quaternion = format.type == model::ElementType::vec4 && numbers;
  return name == "ROTATION" && quaternion ? std::optional(CheckKind::instance_rotation)
                                          : std::nullopt;
}

std::optional<Check> pointer_value_check(const Context& context, model::ObjectModel& model,
                                         const model::AnimationChannel& channel) {
  const json::NodeId object =
      model::extension_object(context.document, channel.target, "KHR_animation_pointer");
  if (object == json::kNoNode) return std::nullopt;
  if (context.deviations.animation_pointers_are_not_followed) return std::nullopt;
  const auto target = model.resolve(model::string_member(context.document, object, "pointer"));
  if (target.status != model::PropertyTarget::Status::mutable_property) return std::nullopt;
  Check check;
  check.kind = CheckKind::quaternion;
  if (is_rotation(target)) return check;
  if (target.numbers == schema::kNone || !is_numeric(target.type)) return std::nullopt;
  const schema::Shape& shape = context.schemas.shape(target.numbers);
  check.kind = CheckKind::limits;
  check.most = target.numbers;
  check.limits = {shape.minimum, shape.maximum, shape.exclusive_minimum, shape.exclusive_maximum};
  if (target.animated_minimum > shape.minimum) {
    check.limits.least = target.animated_minimum;
    check.limits.above_least = false;
  }
  return check.limits.any() ? std::optional(check) : std::nullopt;
}

double length_of_steps(model::ComponentType type, unsigned components) {
  return model::is_integer(type) ? std::sqrt(components) / model::value_range(type).most : 0;
}

}  // namespace gltfx::validate
