// SPDX-License-Identifier: Apache-2.0
/// What steps that change elements of accessors read, and how they store the result.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/accessor_data.hpp"
#include "model/asset.hpp"
#include "model/memory_budget.hpp"
#include "model/resource_data.hpp"
#include "steps/accessor_contents.hpp"
#include "steps/new_buffer.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// The buffers of the asset of a step, without images.
model::ResourceData load_buffers(const StepInput& input, const model::Asset& elements);

/// The references and the bytes of an asset. Refers to the input.
struct StepData {
  explicit StepData(const StepInput& input);
  StepData(const StepData&) = delete;
  StepData& operator=(const StepData&) = delete;

  const model::Views& views() const { return input.asset.views(); }
  std::string pointer(json::NodeId value) const { return graph.tree().pointer(value); }

  /// Why the elements of an accessor cannot be replaced, half a sentence; empty: `data` has them,
  /// packed components of a core type, and all of them are stored.
  std::string open(std::uint32_t accessor, std::optional<model::AccessorData>& data) const;

  const StepInput& input;
  const json::Document& document;
  const model::Asset elements;
  const graph::Graph graph;
  const model::ResourceData resources;  ///< without images
  /// Bytes that may be read: what many accessors share is not worth the time for each of them.
  mutable model::MemoryBudget budget;
};

/// A change of accessors in the making. `data` must outlive it.
struct StepChanges {
  explicit StepChanges(const StepData& data);
  StepChanges(const StepChanges&) = delete;
  StepChanges& operator=(const StepChanges&) = delete;

  /// Call it once, after the last edit. An Error: half a sentence.
  Result<change::Change> finish();

  NewBuffer buffer;
  change::Additions additions;
  json::Editor editor;
  AccessorContents contents;
};

/// All elements of an accessor, packed.
std::string packed_bytes(const model::AccessorData& data);

}  // namespace gltfx::steps
