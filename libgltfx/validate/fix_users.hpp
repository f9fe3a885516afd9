// SPDX-License-Identifier: Apache-2.0
/// Who uses buffer views and accessors: what a fix must know before it changes one of them.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/usage.hpp"
#include "validate/fix.hpp"

namespace gltfx::validate {

/// Names of all extensions with an object in the document, but for those in extras.
class ExtensionsSeen {
 public:
  explicit ExtensionsSeen(Fixing& fixing);
  bool contains(std::string_view name) const { return names_.contains(name); }
  /// Whether schemas tell all that refers to something: none is unknown.
  bool all_known() const { return all_known_; }

 private:
  std::set<std::string, std::less<>> names_;
  bool all_known_ = true;
};

/// Indices or values of a sparse accessor.
struct SparseElements {
  std::uint64_t count, size;  ///< of elements, of one in bytes
};

/// By index of the root arrays.
class Users {
 public:
  explicit Users(Fixing& fixing);

  /// What a buffer view is used for by accessors and images.
  const std::set<model::ViewUse>& uses_of_view(std::uint32_t view) const { return uses_[view]; }
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
  void use(std::optional<std::uint32_t> accessor, model::AccessorUse kind);
  void find_others(Fixing& fixing);
  void find_overlaps();

  const model::Views& views_;
  std::vector<std::set<model::ViewUse>> uses_;
  std::vector<std::vector<std::uint32_t>> accessors_;
  std::vector<bool> others_, overlaps_;
  std::vector<std::vector<SparseElements>> sparse_parts_;
  std::vector<std::set<std::string>> roles_;
  bool unknown_ = false;
};

/// Primitives by the accessors of their attributes.
class PrimitivesByAttribute {
 public:
  explicit PrimitivesByAttribute(Fixing& fixing);
  const std::vector<const model::Primitive*>& of(std::uint32_t accessor) const;

 private:
  std::unordered_map<std::uint32_t, std::vector<const model::Primitive*>> users_;
};

/// Takes the byteStride of a buffer view away where that moves no element. Whether it did.
bool remove_stride(Fixing& fixing, std::uint32_t view);
/// Corrects the byteStride of a buffer view that nobody can follow, 0 or less than an element:
/// where packed elements fill the view, or there is only one.
bool mend_stride(Fixing& fixing, std::uint32_t view);

}  // namespace gltfx::validate
