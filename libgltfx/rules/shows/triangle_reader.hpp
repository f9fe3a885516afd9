// SPDX-License-Identifier: Apache-2.0
/// Single triangles of a primitive, wherever they are: rules look at few of many.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/packed.hpp"
#include "model/accessor_data.hpp"
#include "model/mesh.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {

class TriangleReader {
 public:
  /// Nothing: the primitive has no triangles, or no elements that can be read.
  static std::optional<TriangleReader> open(const DataPhase& phase,
                                            const model::Primitive& primitive);

  std::uint64_t count() const;
  /// The corners of a triangle, counter-clockwise seen from its front; nothing: a vertex is missing
  /// (or begins a new strip).
  std::optional<std::array<std::uint32_t, 3>> corners(std::uint64_t triangle) const;
  Float3 position(std::uint32_t vertex) const { return read(positions_, vertex); }
  std::uint64_t vertex_count() const { return positions_.count(); }
  const model::AccessorData& positions() const { return positions_; }
  bool has_normals() const { return normals_.has_value(); }
  /// Precondition: there are normals.
  Float3 normal(std::uint32_t vertex) const { return read(*normals_, vertex); }

 private:
  TriangleReader(model::Mode mode, model::AccessorData positions)
      : mode_(mode), positions_(std::move(positions)) {}

  static Float3 read(const model::AccessorData& data, std::uint32_t vertex);
  std::uint64_t corner_count() const { return indices_ ? indices_->count() : positions_.count(); }
  std::uint64_t index(std::uint64_t corner) const;
  std::array<std::uint64_t, 3> indices_of_list(std::uint64_t triangle) const;

  model::Mode mode_;
  model::AccessorData positions_;
  std::optional<model::AccessorData> indices_;
  std::optional<model::AccessorData> normals_;
  bool plain_ = false;  ///< the indices can be read in any order, several at once
};

}  // namespace gltfx::validate
