// SPDX-License-Identifier: Apache-2.0
/// Deletes objects of a document: every index and JSON pointer to an object after them is
/// renumbered.
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
  /// Deletes references to deleted values, too: an entry of a list, an optional member, else the
  /// object.
  bool cascade = false;
  /// The container of the document, from whose BIN chunks unused bytes are cut; null: none.
  const container::Container* container = nullptr;
  /// Extensions without a schema count only where they hold an integer; otherwise any prevents a
  /// deletion.
  bool integers_only = false;
};

/// A value that is deleted, with all that it contains.
struct DeletedValue {
  std::string pointer;  ///< in the old document
  std::string cause;    ///< pointer to a deleted value that it needs; empty: requested
};

/// What prevents a deletion.
struct DeletionObstacle {
  std::string pointer;  ///< of a reference, or of the object that must have the member `target`
  std::string target;   ///< of the value to delete
  bool must_have = false;
};

struct Deletion {
  Change change;
  std::vector<DeletedValue> deleted;        ///< in the order of deletion
  std::vector<DeletionObstacle> obstacles;  ///< not empty: there is no change
  std::vector<std::string> names;           ///< of extensions that have lost their last object
  std::uint64_t renumbered = 0;             ///< indices and pointers
  /// Pointers to values that may be indices or pointers, in extras and members without a schema:
  /// they do not change.
  std::vector<std::string> doubtful;
};

/// Deletes the values that JSON pointers name: elements of arrays, or members. Lists that must not
/// be empty are deleted with their last element. An Error says why a value cannot be deleted: a
/// pointer is broken, a position has a meaning, or an extension without a schema may hold indices.
/// Linear in the document and the pointers; iterative. Precondition: no name occurs twice in an
/// object.
Result<Deletion> plan_deletion(const json::Document& document, const schema::Set& set,
                               std::span<const std::string> pointers,
                               const DeletionOptions& options);

}  // namespace gltfx::change
