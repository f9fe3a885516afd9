// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `gltfx edit --delete` can be asked for, and what it says of each value. The calls are in
/// <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_file.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace gltfx {

/// What a deletion is asked for.
struct DeleteOptions : EditOptions {
  /// JSON pointers (RFC 6901) to elements of arrays, or to members, of one asset: "/meshes/3". They
  /// count as the asset is before; the order does not matter.
  std::vector<std::string> pointers;
  /// Delete what refers to them, too: an entry of a list alone, a member alone where the object can
  /// be without it, else the object. Without it, an object that something refers to stays.
  bool cascade = false;
};

/// A value that goes, with all that is in it.
struct DeletedObject {
  std::string pointer;  ///< in the old document
  std::string cause;    ///< pointer to what it cannot be without; empty: it was asked for
};

/// What stands against a deletion, in the old document.
struct DeleteObstacle {
  std::string pointer;     ///< of a reference, or of an object that must have the member `target`
  std::string target;      ///< pointer to what was to go
  bool must_have = false;  ///< it is no reference: the object needs the member
};

/// What became of one file. A file with obstacles is refused as a whole.
struct DeleteReport : EditOutcome {
  std::vector<DeletedObject> deleted;      ///< first what was asked for
  std::vector<DeleteObstacle> obstacles;   ///< why nothing is deleted; empty where all can go
  std::uint64_t renumbered = 0;            ///< indices and JSON pointers that are counted anew
  std::uint64_t bytes = 0;                 ///< of the BIN chunk of a GLB that go, too
  std::vector<std::string> names_removed;  ///< extensions whose last object is deleted
  /// Pointers to what may be an index, in `extras`: it stays as it is.
  std::vector<std::string> doubtful;
  /// Warnings of `gltfx validate` that the new document has and the old one has not, one a code:
  /// "CODE at /pointer: message".
  std::vector<std::string> new_warnings;
};

}  // namespace gltfx
