// SPDX-License-Identifier: Apache-2.0
/// Assets with data, built accessor by accessor.
#pragma once

#include <string>

#include "model/packed_bytes.hpp"
#include "rules/selected.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

enum Component { kInt8 = 5120, kUint8, kInt16, kUint16, kUint32 = 5125, kFloat };

class DataAsset {
 public:
  /// Adds an accessor with `bytes` in a view of its own and returns its index. Without bytes it has
  /// no view. `more`: further members, each beginning with a comma.
  std::size_t accessor(const std::string& type, Component component, std::size_t count,
                       const std::string& bytes, const std::string& more = {},
                       const std::string& view_more = {}) {
    return made_.accessor(type, component, count, bytes, AssetBuilder::members_of(more),
                          AssetBuilder::members_of(view_more));
  }
  std::size_t view(const std::string& bytes, const std::string& more = {}) {
    return made_.view(bytes, AssetBuilder::members_of(more));
  }
  /// The text of the asset, with further `members` of its root.
  std::string text(const std::string& members = {}) const {
    return made_.text(buffer_uri(made_.bytes), members);
  }

 private:
  AssetBuilder made_;
};

/// The members of a mesh with one primitive.
inline std::string mesh(const std::string& attributes, const std::string& more = {}) {
  return R"("meshes": [{"primitives": [{"attributes": {)" + attributes + "}" + more + "}]}]";
}

inline const std::set<std::string, std::less<>>& data_codes() {
  static const std::set<std::string, std::less<>> codes{
      "ACCESSOR_ANIMATION_INPUT_NEGATIVE",
      "ACCESSOR_ANIMATION_INPUT_NON_INCREASING",
      "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION",
      "ACCESSOR_DATA_NOT_CHECKED",
      "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND",
      "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND",
      "ACCESSOR_INDEX_OOB",
      "ACCESSOR_INDEX_PRIMITIVE_RESTART",
      "ACCESSOR_INDEX_TRIANGLE_DEGENERATE",
      "ACCESSOR_INVALID_FLOAT",
      "ACCESSOR_INVALID_IBM",
      "ACCESSOR_INVALID_SIGN",
      "ACCESSOR_JOINTS_INDEX_DUPLICATE",
      "ACCESSOR_JOINTS_INDEX_OOB",
      "ACCESSOR_JOINTS_USED_ZERO_WEIGHT",
      "ACCESSOR_MAX_MISMATCH",
      "ACCESSOR_MIN_MISMATCH",
      "ACCESSOR_NON_CLAMPED",
      "ACCESSOR_SPARSE_INDEX_OOB",
      "ACCESSOR_SPARSE_INDICES_NON_INCREASING",
      "ACCESSOR_VECTOR3_NON_UNIT",
      "ACCESSOR_WEIGHTS_NEGATIVE",
      "ACCESSOR_WEIGHTS_NON_NORMALIZED",
  };
  return codes;
}

/// The findings on the data of an asset.
inline Lines about_data(const std::string& asset, Profile profile = Profile::standard) {
  return selected(asset, data_codes(), profile);
}

}  // namespace gltfx::test
