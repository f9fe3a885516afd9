// SPDX-License-Identifier: Apache-2.0
/// What steps about geometry read, and the edits that they have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "change/name_list.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/resource_data.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// The objects and buffers of an asset, without its images. Refers to the asset and the schemas of
/// the input.
struct GeometryInput {
  explicit GeometryInput(const StepInput& input);

  /// Of a root array: "/bufferViews/3".
  std::string pointer(json::NodeId value) const;
  /// The index of the accessor whose member `bufferView` a reference is; nothing: something else.
  std::optional<std::uint32_t> accessor_of(const graph::Use& use) const;
  /// All accessors of a buffer view, in the order of the walk; nothing where it has other users.
  std::optional<std::vector<std::uint32_t>> accessors_of(json::NodeId view) const;
  /// Where the elements of an accessor end in its buffer view. Nothing where the members do not say
  /// it, or some bytes are outside of the view.
  std::optional<std::uint64_t> end_in_view(const model::Accessor& accessor) const;

  /// The elements of an accessor, packed without padding, sparse ones replaced. Nothing when they
  /// cannot be read, or are not stored.
  std::optional<std::string> elements_of(const model::Accessor& accessor) const;

  const model::Asset asset;
  const model::Views& views;
  const graph::Graph graph;
  const model::ResourceData resources;
};

/// Sets a member of an object to a number.
void set_number(const json::Document& document, json::Editor& editor, json::NodeId object,
                std::string_view name, std::uint64_t value);
/// Removes a member of an object, if it is there.
void remove_member(const json::Document& document, json::Editor& editor, json::NodeId object,
                   std::string_view name);
/// Adds the object of an extension that `host` does not have.
void add_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                   std::string_view name, std::string_view json);
/// Removes the object of an extension, and `extensions` with its last one.
void remove_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                      std::string_view name);
/// Names an extension in `extensionsUsed` and `extensionsRequired`. False: one is not a list.
bool require_extension(const json::Document& document, json::Editor& editor, std::string_view name);

}  // namespace gltfx::steps
