// SPDX-License-Identifier: Apache-2.0
/// Primitives whose vertices can be replaced, by the accessors that hold the vertices.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/accessor_data.hpp"
#include "model/mesh.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// The elements of an accessor.
struct VertexColumn {
  std::uint32_t accessor = 0;
  model::AccessorData data;
};

/// An index accessor of a set, once for all primitives that share it.
struct IndexList {
  std::uint32_t accessor = 0;
  model::AccessorData data;
};

/// Vertices, and all primitives that use them. Nothing else uses their accessors.
struct VertexSet {
  std::vector<std::uint32_t> accessors;  ///< of attributes and targets; sorted, each once
  std::vector<const model::Primitive*> primitives;  ///< in the order of the document
  std::string obstacle;                             ///< why vertices stay; empty: there is none
};

/// The vertices of a set, opened.
struct OpenedVertices {
  std::uint64_t count = 0;
  std::vector<VertexColumn> columns;
  std::vector<IndexList> indices;  ///< in the order in which primitives name them
};

/// All sets, in the order of their first primitives. Primitives in `data` must outlive them.
std::vector<VertexSet> find_vertex_sets(const StepData& data);

/// Opens a set without an obstacle; why it cannot be opened, half a sentence, or nothing. Indices
/// may be any numbers.
std::string open_vertices(const StepData& data, const VertexSet& set, OpenedVertices& opened);

/// The indices of a list as numbers.
std::vector<std::uint32_t> read_index_list(const model::AccessorData& data);
/// The reverse, packed. Precondition: each number fits into the component type.
std::string index_bytes(const std::vector<std::uint32_t>& indices, model::ComponentType type);
/// The index that restarts a primitive, where it may; no vertex has it.
std::uint32_t restart_index(const model::AccessorData& indices);

/// Finds extensions of primitives and meshes that may know vertices by their numbers. Takes time
/// for each extension once. `data` must outlive it.
class VertexNumbers {
 public:
  explicit VertexNumbers(const StepData& data);

  /// Which extension does, half a sentence; empty: none.
  std::string find(const VertexSet& set);

 private:
  std::string in_extensions(json::NodeId object, bool is_primitive) const;
  bool refers_to_accessors(json::NodeId extension) const;

  const StepData& data_;
  const json::NodeId accessors_;
  std::vector<json::NodeId> unknown_;                     ///< sorted
  std::unordered_map<json::NodeId, std::string> meshes_;  ///< what was found, by mesh
};

/// Where a note about a set belongs.
std::string place_of(const StepData& data, const VertexSet& set);

}  // namespace gltfx::steps
