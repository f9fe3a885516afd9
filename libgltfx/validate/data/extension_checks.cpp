// SPDX-License-Identifier: Apache-2.0
// Schema files state the formats of attributes, not what their numbers mean; so those that mean
// something stand here by their names.
#include "validate/data/extension_checks.hpp"

#include <cmath>

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

double length_of_steps(model::ComponentType type, unsigned components) {
  return model::is_integer(type) ? std::sqrt(components) / model::value_range(type).most : 0;
}

}  // namespace gltfx::validate
