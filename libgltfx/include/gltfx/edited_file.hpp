// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options common to all verbs that change files, and their outcome for one file.
#pragma once

#include <gltfx/searched_folders.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace gltfx {

namespace schema {
class Set;
}

/// Where new bytes go, and the schemas.
struct EditOptions {
  bool diff = false;      ///< fill EditOutcome::diff
  bool in_place = false;  ///< replace the file
  bool backup = false;    ///< in place: keep the old bytes beside it, with ".bak" after the name
  /// Write here instead; empty: nowhere. Files that the asset refers to are copied beside it when
  /// the folder is another one. Folders are made.
  std::string output;
  /// Folder that the asset and its files may come from; empty: the asset's own.
  std::string root;
  /// Folders that were searched: without a `root`, an asset below one is opened beneath it. Null:
  /// none. Not changed during a call.
  std::shared_ptr<const SearchedFolders> searched;
  /// Schemas; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
};

/// Why a file was not processed.
enum class EditProblem : std::uint8_t {
  none,
  unreadable,   ///< it could not be read, or is not glTF
  refused,      ///< it could be read, but not be changed safely
  not_written,  ///< the new bytes could not be written; the old ones are still there
};
/// "none", "unreadable", "refused", "not written".
std::string_view edit_problem_name(EditProblem problem);

/// Outcome for one file. Owns its text.
struct EditOutcome {
  std::string path;                         ///< as the user named it
  EditProblem problem = EditProblem::none;  ///< why it was not processed, if so
  std::string error;                        ///< the problem, one sentence
  bool changes = false;                     ///< the new file differs from the old one
  bool written = false;                     ///< the new bytes are durable at `written_to`
  std::string written_to;                   ///< path of the file that was written; may be empty
  /// Unified, of the JSON text, for `git apply` and `patch -p1` in the working folder; of a binary
  /// file as a comment, which both skip. Raw asset text.
  std::string diff;
};

/// A file and where its new bytes go; `output` as in EditOptions.
struct EditInput {
  std::string path, output;  ///< of the two files
};

}  // namespace gltfx
