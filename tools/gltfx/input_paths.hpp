// SPDX-License-Identifier: Apache-2.0
/// The inputs of a run, from the paths that the user named.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "input_walk.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// Inputs in the order they are reported: that of the arguments, sorted within a folder or glob.
struct Inputs {
  /// Each once; "-" is standard input. A path that does not exist stays in the list, so that
  /// opening it gives the reason.
  std::vector<std::string> paths;
  /// By path: its place below the named folder, or its name when it was named itself.
  std::vector<std::string> places;
  /// The same for the inputs of other shards: names must not clash with theirs.
  std::vector<std::string> paths_of_others, places_of_others;
  /// Folders among the arguments and the results of globs.
  std::vector<std::string> folders;
  std::shared_ptr<const SearchedFolders> searched;  ///< as InputWalk has it
  bool several = false;  ///< there may be more than one file: a folder, a glob, two files
};

/// All inputs of an InputWalk, or the Error of nothing_found(). Notes go to standard error unless
/// `quiet`.
Result<Inputs> expand_paths(const NamedPaths& named, bool quiet);

/// Names the folders and globs without any asset on standard error. Call when `walk` is at its end.
void say_notes(const InputWalk& walk);

/// An Error when the inputs of all shards together hold no asset; nothing when they do, when
/// nothing was named at all (an empty list) and when NamedPaths::allow_empty. Stops at the first
/// asset.
std::optional<Error> nothing_found(const NamedPaths& named);

/// The list that `--files-from` names; "-" is standard input, an empty name an empty list.
Result<std::string> read_list(const std::string& file);

/// Visits the inputs before the run if an output exists already or `count` is true: an Error when
/// an output would replace an input, else the number of inputs (0 without a visit). Empty outputs
/// are skipped.
Result<std::uint64_t> look_ahead(const NamedPaths& named, std::vector<std::string> outputs,
                                 bool count);

/// Why `root` cannot be what --root names, or nothing; empty: no root.
std::optional<Error> check_root(const std::string& root);

}  // namespace gltfx::tool
