// SPDX-License-Identifier: Apache-2.0
/// @file
/// The result of a verb that changes an asset in memory. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <map>
#include <string>

namespace gltfx {

/// A report and the new asset. Owns all its data. Nothing is written; `written` and `written_to` of
/// the report stay empty.
template <class Report>
struct EditedBytes {
  Report report;      ///< as that on a file
  std::string bytes;  ///< of the .gltf or .glb; the given ones if unchanged; empty with a problem
  /// New files and those that get other bytes, by their paths from the asset's folder: '/'
  /// separated, not percent-encoded.
  std::map<std::string, std::string> files = {};
};

}  // namespace gltfx
