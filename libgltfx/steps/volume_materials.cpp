// SPDX-License-Identifier: Apache-2.0
#include "steps/volume_materials.hpp"

#include <string_view>

#include "base/number.hpp"
#include "model/fields.hpp"

namespace gltfx::steps {
namespace {

constexpr std::string_view kVolume = "KHR_materials_volume";

}  // namespace

VolumeMaterials::VolumeMaterials(const StepData& data) : data_(data) {
  const auto& materials = data.asset.elements(model::RootArray::materials);
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    if (materials[i] == json::kNoNode) continue;
    const json::NodeId volume = model::extension_object(data.document, materials[i], kVolume);
    const json::NodeId value = data.document.find(volume, "thicknessFactor");
    if (value == json::kNoNode || !data.document.is_number(value)) continue;
    if (data.document.number(value).value != 0) thickness_.emplace(i, value);
  }
  std::map<json::NodeId, std::uint32_t> materials_of;
  for (const auto& [material, value] : thickness_) materials_of.emplace(value, material);
  for (const graph::PointerText& pointer : data.graph.pointers()) {
    if (pointer.steps.empty() || pointer.steps[0] != "materials") continue;
    any_is_pointed_ |= pointer.varying != json::kNoNode;
    for (const json::NodeId value : pointer.way) {
      const auto found = materials_of.find(value);
      if (found != materials_of.end()) pointed_.insert(found->second);
    }
  }
}

std::vector<std::uint32_t> VolumeMaterials::of(const model::Primitive& primitive) const {
  std::set<std::uint32_t> found;
  if (thickness_.empty()) return {};
  const auto& materials = data_.asset.elements(model::RootArray::materials);
  data_.graph.each_use_in(primitive.node, [&](const graph::Use& use) {
    const json::NodeId element = data_.graph.tree().root_element(use.target);
    if (element != use.target) return;
    const std::uint32_t index = data_.graph.tree().position(element);
    const bool is_material = index < materials.size() && materials[index] == element;
    if (is_material && thickness_.contains(index)) found.insert(index);
  });
  return {found.begin(), found.end()};
}

void VolumeMaterials::set_unit(std::uint32_t material, double unit, json::Editor& editor) const {
  const json::NodeId value = thickness_.at(material);
  editor.replace_scalar(value, number_text(data_.document.number(value).value / unit));
}

}  // namespace gltfx::steps
