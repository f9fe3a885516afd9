// SPDX-License-Identifier: Apache-2.0
/// Groups primitives by the accessors of their vertices, so that the vertices can be replaced.
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

/// An index accessor of a set. Primitives that share it share this entry.
struct IndexList {
  std::uint32_t accessor = 0;
  model::AccessorData data;
};

/// Vertices with one numbering, and all primitives that use them: primitives that share an
/// accessor, directly or through others. Unless there is an obstacle, nothing else uses their
/// accessors.
struct VertexSet {
  std::vector<std::uint32_t> accessors;  ///< of attributes and targets; sorted and unique
  std::vector<const model::Primitive*> primitives;  ///< in document order
  std::string obstacle;                             ///< why vertices do not change; or empty
};

/// The opened vertices of a set.
struct OpenedVertices {
  std::uint64_t count = 0;
  std::vector<VertexColumn> columns;
  std::vector<IndexList> indices;  ///< in the order of the primitives
};

/// All sets, in the order of their first primitives. `data` must outlive them.
std::vector<VertexSet> find_vertex_sets(const StepData& data);

/// Opens a set without an obstacle. Returns why it cannot be opened, half a sentence, or an empty
/// string. Does not check the range of indices.
std::string open_vertices(const StepData& data, const VertexSet& set, OpenedVertices& opened);

/// Reads the indices of a list.
std::vector<std::uint32_t> read_index_list(const model::AccessorData& data);
/// The index value that is reserved for primitive restart: the maximum of the component type.
std::uint32_t restart_index(const model::AccessorData& indices);

/// Replaces vertices by some of them in another order, and all index lists, which may be shorter.
/// `order`: old numbers. `other_values`: the bounds of attributes may change. Precondition:
/// `indices` fit into their component types.
void store_vertices(StepChanges& changes, const OpenedVertices& vertices,
                    const std::vector<std::uint32_t>& order,
                    const std::vector<std::vector<std::uint32_t>>& indices, bool other_values);

/// Finds extensions of primitives and meshes that may refer to vertices by number. Visits each
/// extension of a mesh once. `data` must outlive it.
class VertexNumbers {
 public:
  explicit VertexNumbers(const StepData& data);

  /// The first such extension, as half a sentence; empty: none.
  std::string find(const VertexSet& set);

 private:
  std::string in_extensions(json::NodeId object, bool is_primitive) const;
  bool refers_to_accessors(json::NodeId extension) const;

  const StepData& data_;
  const json::NodeId accessors_;
  std::vector<json::NodeId> unknown_;                     ///< sorted
  std::unordered_map<json::NodeId, std::string> meshes_;  ///< results by mesh
};

/// The JSON pointer for notes about a set.
std::string place_of(const StepData& data, const VertexSet& set);

}  // namespace gltfx::steps
