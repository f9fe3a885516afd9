// SPDX-License-Identifier: Apache-2.0
/// Takes objects out of a document: every index and JSON pointer that leads behind them is counted
/// anew.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "container/container.hpp"
#include "schema/set.hpp"

namespace gltfx::change {

struct DeletionOptions {
  /// What refers to something that goes, goes as well: an entry of a list alone, a member alone
  /// where the object can be without it, else the object.
  bool cascade = false;
  /// The document's; null: of no interest. Of a BIN chunk, what nobody needs any more is cut out.
  const container::Container* container = nullptr;
};

/// A value that goes, with all that is in it.
struct DeletedValue {
  std::string pointer;  ///< in the old document
  std::string cause;    ///< pointer to what it could not be without; empty: it was asked for
};

/// What stands against a deletion.
struct DeletionObstacle {
  std::string pointer;  ///< of a reference, or of the object that must have the member `target`
  std::string target;   ///< of what was to go
  bool must_have = false;
};

struct Deletion {
  Change change;
  std::vector<DeletedValue> deleted;        ///< in the order of their going
  std::vector<DeletionObstacle> obstacles;  ///< not empty: there is no change
  std::vector<std::string> names;           ///< of extensions that have lost their last object
  std::uint64_t renumbered = 0;             ///< indices and pointers
  /// Pointers to what may be an index or a pointer, in extras and members without a schema: that
  /// stays as it is.
  std::vector<std::string> doubtful;
};

/// Deletes the values that JSON pointers name: elements of arrays, or members. Lists that lose
/// their last element go themselves where they must not be empty. An Error says why something
/// cannot be deleted: a pointer leads nowhere, a position has a meaning, or an extension that no
/// schema describes may hold indices. Linear in the document and the pointers; iterative.
/// Precondition: no name occurs twice in an object.
Result<Deletion> plan_deletion(const json::Document& document, const schema::Set& set,
                               std::span<const std::string> pointers,
                               const DeletionOptions& options);

}  // namespace gltfx::change
