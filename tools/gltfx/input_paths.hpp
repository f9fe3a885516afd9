// SPDX-License-Identifier: Apache-2.0
/// What the user named, as the list of inputs to open.
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
  /// opening it says why it cannot be read.
  std::vector<std::string> paths;
  /// By path: where it stands below the folder that was named, or its name when it was named
  /// itself.
  std::vector<std::string> places;
  /// The same of what other shards take: names must not clash with theirs.
  std::vector<std::string> paths_of_others, places_of_others;
  /// Folders among the arguments, and among what globs gave.
  std::vector<std::string> folders;
  std::shared_ptr<const SearchedFolders> searched;  ///< as InputWalk has it
  bool several = false;  ///< what was named may be more than one file: a folder, a glob, two files
};

/// All that an InputWalk gives; the Error of nothing_found(). Notes go to standard error unless
/// `quiet`.
Result<Inputs> expand_paths(const NamedPaths& named, bool quiet);

/// Names the folders and globs without any asset on standard error. Call when `walk` is at its end.
void say_notes(const InputWalk& walk);

/// An Error when the inputs of all shards together hold no asset; nothing when they do, when
/// nothing was named at all (an empty list) and when NamedPaths::allow_empty. Stops at the first
/// asset.
std::optional<Error> nothing_found(const NamedPaths& named);

/// What `--files-from` names; "-" is standard input, nothing an empty list.
Result<std::string> read_list(const std::string& file);

/// Goes through the inputs before anything is done with them, where one of the outputs is there
/// already or `count` asks for it: an Error when an output would take the place of an input, else
/// the number of inputs (0 when nobody asked). Empty outputs are none.
Result<std::uint64_t> look_ahead(const NamedPaths& named, std::vector<std::string> outputs,
                                 bool count);

/// Why `root` cannot be what --root names, or nothing; empty is no root at all.
std::optional<Error> check_root(const std::string& root);

}  // namespace gltfx::tool
