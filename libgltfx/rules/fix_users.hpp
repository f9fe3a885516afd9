// SPDX-License-Identifier: Apache-2.0
/// Users of buffer views and accessors, which a fix needs before it changes one of them.
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
  std::uint64_t count, size;  ///< number of elements; bytes per element
};

/// Users by index in the root arrays.
class Users {
 public:
  explicit Users(Fixing& fixing);

  /// Accessors with elements in a buffer view, except sparse ones.
  const std::vector<std::uint32_t>& accessors_in(std::uint32_t view) const {
    return accessors_[view];
  }
  /// Whether objects other than accessors and images refer to a buffer view, unknown extensions may
  /// refer to it, or its bytes are compressed.
  bool has_others(std::uint32_t view) const { return others_[view] || unknown_; }
  /// Indices or values of sparse accessors that lie in a buffer view.
  const std::vector<SparseElements>& sparse_parts_in(std::uint32_t view) const {
    return sparse_parts_[view];
  }
  /// Names of members that refer to an accessor: "NORMAL", "input"; names of morph targets begin
  /// with "target ".
  const std::set<std::string>& roles_of(std::uint32_t accessor) const { return roles_[accessor]; }
  /// Whether the bytes of a view do not overlap those of other views.
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
  std::set<json::NodeId> sparse_objects_;  ///< `indices` and `values` of sparse accessors
};

/// Primitives with an attribute of that accessor; morph targets do not count.
std::vector<const model::Primitive*> primitives_with(Fixing& fixing, std::uint32_t accessor);

/// Deletes the byteStride of a buffer view if that moves no element. True if deleted.
bool remove_stride(Fixing& fixing, std::uint32_t view);
/// Corrects a byteStride of a buffer view that is invalid, 0 or less than an element, if packed
/// elements fill the view or there is only one.
bool fix_stride(Fixing& fixing, std::uint32_t view);

}  // namespace gltfx::validate
