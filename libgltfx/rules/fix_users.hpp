// SPDX-License-Identifier: Apache-2.0
/// Who uses buffer views and accessors: what a fix must know before it changes one of them.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/views.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {

/// Indices or values of a sparse accessor.
struct SparseElements {
  std::uint64_t count, size;  ///< of elements, of one in bytes
};

/// By index of the root arrays.
class Users {
 public:
  explicit Users(Fixing& fixing);

  /// Accessors whose elements lie in a buffer view, but for sparse ones.
  const std::vector<std::uint32_t>& accessors_in(std::uint32_t view) const {
    return accessors_[view];
  }
  /// Whether others than accessors and images refer to a buffer view, may do so unseen, or its
  /// bytes are compressed.
  bool has_others(std::uint32_t view) const { return others_[view] || unknown_; }
  /// Indices or values of sparse accessors that lie in a buffer view.
  const std::vector<SparseElements>& sparse_parts_in(std::uint32_t view) const {
    return sparse_parts_[view];
  }
  /// Names of members that refer to an accessor: "NORMAL", "input"; those of morph targets begin
  /// with "target ".
  const std::set<std::string>& roles_of(std::uint32_t accessor) const { return roles_[accessor]; }
  /// Whether the bytes of a view lie apart from those of all others.
  bool lies_apart(std::uint32_t view) const { return !overlaps_[view]; }

 private:
  void read(Fixing& fixing);
  void find_others(Fixing& fixing);
  void find_roles(Fixing& fixing);
  void find_overlaps();

  const model::Views& views_;
  std::vector<std::vector<std::uint32_t>> accessors_;
  std::vector<bool> others_, overlaps_;
  std::vector<std::vector<SparseElements>> sparse_parts_;
  std::vector<std::set<std::string>> roles_;
  bool unknown_ = false;
  std::set<json::NodeId> sparse_objects_;  ///< with the views of sparse accessors
};

/// Primitives with an attribute of that accessor, but for those of morph targets.
std::vector<const model::Primitive*> primitives_with(Fixing& fixing, std::uint32_t accessor);

/// Takes the byteStride of a buffer view away where that moves no element. Whether it did.
bool remove_stride(Fixing& fixing, std::uint32_t view);
/// Corrects the byteStride of a buffer view that nobody can follow, 0 or less than an element:
/// where packed elements fill the view, or there is only one.
bool fix_stride(Fixing& fixing, std::uint32_t view);

}  // namespace gltfx::validate
