// SPDX-License-Identifier: Apache-2.0
/// Copies of meshes (model/instancing.hpp) whose transforms take up another grid of coordinates.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/node.hpp"
#include "steps/attribute_roles.hpp"
#include "steps/quantize_store.hpp"
#include "steps/quantize_values.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// The copies that a node draws, and the accessors of their transforms.
struct InstancePlaces {
  json::NodeId attributes = json::kNoNode;  ///< object
  std::optional<std::uint32_t> translations, scales;
  std::vector<model::Affine> transforms;  ///< in the space of the node
};

/// Reads the copies of a node that has some. Returns why their transforms cannot change, half a
/// sentence, or an empty string.
std::string read_instances(const StepData& data, const AttributeRoles& roles,
                           const model::Node& node, model::MemoryBudget& budget,
                           InstancePlaces& places);

/// The transform of a copy after it took up a grid, in single precision.
model::Affine copy_with_grid(const model::Affine& copy, const Grid& grid);

/// Stores these transforms.
void place_instances(const StepData& data, const InstancePlaces& places, const Grid& grid,
                     StepChanges& changes, FormatChanges& formats);

}  // namespace gltfx::steps
