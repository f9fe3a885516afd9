// SPDX-License-Identifier: Apache-2.0
/// Facts about an asset for a report.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>

#include "model/asset.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// Size of a primitive as accessors declare it: the count of the first attribute, and triangles by
/// the mode.
struct PrimitiveSize {
  std::uint64_t vertices = 0, triangles = 0;
};
PrimitiveSize primitive_size(const Views& views, const Primitive& primitive);

/// Bytes of one vertex, uncompressed and without padding: all attributes, without morph targets.
std::uint64_t vertex_bytes(const Views& views, const Primitive& primitive);

/// The `info` block of the Khronos report, counted as in that validator; `resources` stays empty,
/// because it needs the files. Malformed members count as absent. Linear in the document.
AssetInfo asset_info(const Asset& asset, const Views& views);

}  // namespace gltfx::model
