// SPDX-License-Identifier: Apache-2.0
#include "steps/instance_places.hpp"

#include <array>
#include <utility>

#include "model/elements.hpp"
#include "model/instancing.hpp"

namespace gltfx::steps {
namespace {

using model::Affine;

void append_vector(std::string& bytes, const std::array<float, 3>& vector) {
  bytes.append(reinterpret_cast<const char*>(vector.data()), sizeof(vector));
}

// Why an attribute cannot change.
std::string open_vectors(const StepData& data, const AttributeRoles& roles, json::NodeId attributes,
                         std::string_view name, std::optional<std::uint32_t>& accessor) {
  if (data.document.find(attributes, name) == json::kNoNode) return {};
  accessor = data.asset.index(attributes, name, model::RootArray::accessors);
  if (!accessor) return "has instances that cannot be read";
  const model::Accessor& described = data.views.accessors[*accessor];
  if (data.graph.users(described.node).size() != 1 || !roles.find_unknown(*accessor).empty())
    return "shares transforms of instances with other objects";
  std::optional<model::AccessorData> elements;
  if (std::string why = data.open(*accessor, elements); !why.empty()) return why;
  const model::Format floats{model::ElementType::vec3, model::ComponentType::float32, false};
  return elements->format() == floats ? "" : "has transforms of instances that are integers";
}

}  // namespace

std::string read_instances(const StepData& data, const AttributeRoles& roles,
                           const model::Node& node, model::MemoryBudget& budget,
                           InstancePlaces& places) {
  places.attributes = model::instance_attributes(data.asset, node);
  if (places.attributes == json::kNoNode) return "has instances that cannot be read";
  for (const auto& [name, accessor] :
       {std::pair("TRANSLATION", &places.translations), std::pair("SCALE", &places.scales)}) {
    if (std::string why = open_vectors(data, roles, places.attributes, name, *accessor);
        !why.empty())
      return why;
  }
  auto copies = model::read_instancing(data.asset, data.views, data.resources, node, budget);
  if (!copies || !copies->readable) return "has instances that cannot be read";
  places.transforms = std::move(copies->transforms);
  return {};
}

Affine copy_with_grid(const Affine& copy, const Grid& grid) {
  Affine now = copy;
  for (std::size_t column = 0; column < 3; ++column) {
    for (double& each : now.columns[column]) each *= grid.step;
  }
  if (grid.origin == model::Vector3{}) return now;
  now.columns[3] = copy.point(grid.origin);
  for (double& each : now.columns[3]) each = static_cast<double>(static_cast<float>(each));
  return now;
}

void place_instances(const StepData& data, const InstancePlaces& places, const Grid& grid,
                     StepChanges& changes, FormatChanges& formats) {
  std::string translations, scales;
  std::vector<std::array<float, 3>> old(places.transforms.size(), {1, 1, 1});
  std::optional<model::AccessorData> elements;
  if (places.scales && data.open(*places.scales, elements).empty())
    model::read_elements(*elements, old);
  for (std::size_t i = 0; i < places.transforms.size(); ++i) {
    std::array<float, 3> translation{}, scale{};
    const Affine now = copy_with_grid(places.transforms[i], grid);
    for (std::size_t k = 0; k < 3; ++k) {
      translation[k] = static_cast<float>(now.columns[3][k]);
      scale[k] = static_cast<float>(static_cast<double>(old[i][k]) * grid.step);
    }
    append_vector(translations, translation);
    append_vector(scales, scale);
  }
  const auto set = [&](const char* name, const std::optional<std::uint32_t>& accessor,
                       std::string bytes) {
    if (accessor) return formats.set_plain(*accessor, std::move(bytes));
    const std::uint64_t added = formats.add_floats(model::ElementType::vec3, std::move(bytes));
    changes.editor.append_member(places.attributes, name, std::to_string(added));
  };
  if (grid.origin != model::Vector3{}) set("TRANSLATION", places.translations, translations);
  set("SCALE", places.scales, scales);
}

}  // namespace gltfx::steps
