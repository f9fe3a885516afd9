// SPDX-License-Identifier: Apache-2.0
/// Materials with a thickness, which is a length in the space of the mesh.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "json/edit.hpp"
#include "model/mesh.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// All materials with a thickness other than 0. `data` must outlive it.
class VolumeMaterials {
 public:
  explicit VolumeMaterials(const StepData& data);

  /// Those that a primitive may show, also through variants.
  std::vector<std::uint32_t> of(const model::Primitive& primitive) const;
  /// Whether a JSON pointer may lead to the thickness.
  bool is_pointed(std::uint32_t material) const {
    return any_is_pointed_ || pointed_.contains(material);
  }
  /// Divides the thickness by the length of a unit of the mesh.
  void set_unit(std::uint32_t material, double unit, json::Editor& editor) const;

 private:
  const StepData& data_;
  std::map<std::uint32_t, json::NodeId> thickness_;  ///< the number, by material
  std::set<std::uint32_t> pointed_;
  bool any_is_pointed_ = false;  ///< a pointer is completed at run time
};

}  // namespace gltfx::steps
