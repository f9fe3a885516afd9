// SPDX-License-Identifier: Apache-2.0
/// Input of the steps that change geometry.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graph/graph.hpp"
#include "model/resource_data.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Loads the buffers of the asset, without images. Buffers that cannot be read are added to
/// StepInput::unread. Of views with a stream and a plain copy, the copy is read.
model::ResourceData load_plain_buffers(const StepInput& input, const model::Asset& elements);
/// The same, but streams are read in place of plain copies, as readers of the extension do.
model::ResourceData load_buffers(const StepInput& input, const model::Asset& elements);

/// The objects and buffers of an asset, without its images. Keeps references to the asset and the
/// schemas of the input.
struct GeometryInput {
  explicit GeometryInput(const StepInput& input);

  /// The JSON pointer of a value, such as "/bufferViews/3".
  std::string pointer(json::NodeId value) const;
  /// The index of the accessor if a reference is the member `bufferView` of one; otherwise nothing.
  std::optional<std::uint32_t> accessor_of(const graph::Use& use) const;
  /// All accessors of a buffer view, in the order of the references; nothing if it has other users.
  std::optional<std::vector<std::uint32_t>> accessors_of(json::NodeId view) const;
  /// The end of the elements of an accessor in its buffer view, in bytes. Nothing if its members
  /// are incomplete, or if some bytes are outside the view.
  std::optional<std::uint64_t> end_in_view(const model::Accessor& accessor) const;

  /// The elements of an accessor, packed without padding, after sparse replacement. Nothing if they
  /// cannot be read or are not stored.
  std::optional<std::string> elements_of(const model::Accessor& accessor) const;
  /// The elements at `positions`, in that order. Nothing also if a position is out of range.
  std::optional<std::string> elements_of(const model::Accessor& accessor,
                                         const std::vector<std::uint32_t>& positions) const;

  const json::Document& document;
  const model::Asset asset;
  const model::Views& views;
  const graph::Graph graph;
  const model::ResourceData resources;
};

/// Packs indices into bytes. Precondition: each index fits into the component type.
std::string index_bytes(std::span<const std::uint32_t> indices, model::ComponentType type);

}  // namespace gltfx::steps
