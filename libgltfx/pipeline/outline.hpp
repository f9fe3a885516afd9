// SPDX-License-Identifier: Apache-2.0
/// The outline of an asset, for programs that compare lines.
#pragma once

#include <gltfx/inspect.hpp>
#include <gltfx/pipeline.hpp>

#include <string>

namespace gltfx {

/// A line for each object of a .gltf or .glb: its kind, its name (of a node: those above it, too),
/// counts, and a hash of its values. Sorted; the same wherever objects stand in their lists, and in
/// each run of this version. Of an object with a name, others count the name, so that one edit
/// changes few lines. Of a file without objects, a line with the reason. Files that the asset
/// refers to are not read: git gives the old version of an asset without them. Printable. Does not
/// throw.
std::string outline_file(const std::string& path, const InspectOptions& options);

}  // namespace gltfx
