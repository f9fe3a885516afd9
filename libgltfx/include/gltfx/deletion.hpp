// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options and report of `gltfx edit --delete`. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_file.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace gltfx {

/// Options of a deletion.
struct DeleteOptions : EditOptions {
  /// JSON pointers (RFC 6901) to elements of arrays, or to members, of one asset: "/meshes/3". They
  /// refer to the asset before the deletion; the order does not matter.
  std::vector<std::string> pointers;
  /// Delete references to them, too: an entry of a list, an optional member, else the object. If
  /// false, an object with references stays.
  bool cascade = false;
};

/// A value that is deleted, with all that it contains.
struct DeletedObject {
  std::string pointer;  ///< in the old document
  std::string cause;    ///< pointer to a deleted value that it needs; empty: requested
};

/// What prevents a deletion, in the old document.
struct DeleteObstacle {
  std::string pointer;     ///< of a reference, or of an object that must have the member `target`
  std::string target;      ///< pointer to the value to delete
  bool must_have = false;  ///< not a reference: the object needs the member
};

/// Outcome for one file. A file with obstacles is refused as a whole.
struct DeleteReport : EditOutcome {
  std::vector<DeletedObject> deleted;     ///< first the requested ones
  std::vector<DeleteObstacle> obstacles;  ///< why nothing is deleted; empty if there is no obstacle
  std::uint64_t renumbered = 0;           ///< indices and JSON pointers that are renumbered
  std::uint64_t bytes = 0;                ///< removed from the BIN chunk of a GLB
  std::vector<std::string> names_removed;  ///< extensions whose last object is deleted
  /// Pointers to members of `extras` that may be indices: they stay unchanged.
  std::vector<std::string> doubtful;
  /// Warnings of `gltfx validate` on the new document that the old one does not have, one per code:
  /// "CODE at /pointer: message".
  std::vector<std::string> new_warnings;
};

}  // namespace gltfx
