// SPDX-License-Identifier: Apache-2.0
/// The elements of a document's accessors, read when a plan asks for them.
#pragma once

#include <cstdint>
#include <optional>

#include "model/accessor_data.hpp"
#include "upgrade/asset_bytes.hpp"

namespace gltfx::upgrade {

/// Keeps references to what it is made of. Not thread-safe.
class AccessorValues {
 public:
  /// Null bytes: nothing can be read.
  AccessorValues(const model::Asset& asset, AssetBytes* bytes) : asset_(asset), bytes_(bytes) {}

  /// The elements as they lie in a buffer; nothing where they do not all lie there, or an extension
  /// says that they are to be decoded first.
  std::optional<model::AccessorData> open(std::uint64_t accessor);

 private:
  bool is_plain(const model::Accessor& accessor) const;
  void read_all();

  const model::Asset& asset_;
  AssetBytes* bytes_;
  std::optional<model::Views> views_;  ///< nothing until somebody asked
  model::ResourceData resources_;
};

}  // namespace gltfx::upgrade
