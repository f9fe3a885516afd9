// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options common to all verbs that change files, and their outcome for one file.
#pragma once

#include <gltfx/searched_folders.hpp>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

namespace schema {
class Set;
}

/// The destination of new bytes, and the schemas.
struct EditOptions {
  bool diff = false;      ///< fill EditOutcome::diff
  bool in_place = false;  ///< replace the file
  bool backup = false;    ///< in place: keep the old bytes next to it, with ".bak" after the name
  /// Write here instead; empty: nowhere. If the folder is a different one, files that the asset
  /// refers to are copied to it. Missing folders are made.
  std::string output;
  /// The outputs of all assets of the run, lexically normal. They are not copied, as other files
  /// are, for an asset that refers to them. Null: only `output`.
  std::shared_ptr<const std::set<std::string>> outputs;
  /// Folder that must contain the asset and its files; empty: the asset's folder.
  std::string root;
  /// Searched folders: without a `root`, the root of an asset below one of them is that folder.
  /// Null: none. Not changed during a call.
  std::shared_ptr<const SearchedFolders> searched;
  /// Schemas; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
};

/// Why a file was not processed.
enum class EditProblem : std::uint8_t {
  none,
  unreadable,   ///< it could not be read, or it is not glTF
  refused,      ///< it could be read, but cannot be changed safely
  not_written,  ///< the new bytes could not be written; the old ones still exist
};
/// "none", "unreadable", "refused", "not written".
std::string_view edit_problem_name(EditProblem problem);

/// Outcome for one file. Owns its text.
struct EditOutcome {
  std::string path;                         ///< as given by the user
  EditProblem problem = EditProblem::none;  ///< why it was not processed, if so
  std::string error;                        ///< the problem, one sentence
  bool changes = false;                     ///< the new file differs from the old one
  bool written = false;                     ///< the new bytes are durable at `written_to`
  std::string written_to;                   ///< path of the file that was written; may be empty
  /// External assets (glTF 2.1), at any depth, that stay as they are although the verb could do
  /// something: of `fix` those with findings that have a safe fix, of `upgrade` those that name
  /// legacy extensions, of `convert` all.
  std::vector<std::string> external_assets;
  /// Unified diff of the JSON text, for `git apply` and `patch -p1` in the working folder; for a
  /// binary file as a comment, which both skip. Raw asset text.
  std::string diff;
};

/// A file and the destination of its new bytes; `output` as in EditOptions.
struct EditInput {
  std::string path, output;  ///< paths of the two files
};

}  // namespace gltfx
