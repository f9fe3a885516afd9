// SPDX-License-Identifier: Apache-2.0
/// Input and output of the steps that change elements of accessors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "json/edit.hpp"
#include "model/accessor_data.hpp"
#include "model/memory_budget.hpp"
#include "steps/accessor_contents.hpp"
#include "steps/geometry_input.hpp"
#include "steps/new_buffer.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Input of a step that replaces elements of accessors. Keeps a reference to the input.
struct StepData : GeometryInput {
  explicit StepData(const StepInput& input);
  StepData(const StepData&) = delete;
  StepData& operator=(const StepData&) = delete;

  /// Opens an accessor whose elements can be replaced. Returns why that is not possible, half a
  /// sentence. Empty: `data` contains the elements, which have a core component type and are all
  /// stored.
  std::string open(std::uint32_t accessor, std::optional<model::AccessorData>& data) const;

  const StepInput& input;
  /// Limits the bytes to read, so that accessors that share bytes do not take unlimited time.
  mutable model::MemoryBudget budget;
};

/// An unfinished change of accessors. `data` must outlive it.
struct StepChanges {
  explicit StepChanges(const StepData& data);
  StepChanges(const StepChanges&) = delete;
  StepChanges& operator=(const StepChanges&) = delete;

  /// Call it once, after the last edit. Returns an Error (half a sentence) if bytes are missing.
  Result<change::Change> finish();

  NewBuffer buffer;
  change::Additions additions;
  json::Editor editor;
  AccessorContents contents;
};

/// All elements of an accessor, packed.
std::string packed_bytes(const model::AccessorData& data);

}  // namespace gltfx::steps
