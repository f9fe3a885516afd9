// SPDX-License-Identifier: Apache-2.0
/// The last step of each verb that changes assets: new bytes replace old ones.
#pragma once

#include <gltfx/edited_file.hpp>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_state.hpp"
#include "base/replace_file.hpp"
#include "base/result.hpp"
#include "change/change.hpp"
#include "container/container.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::change {

/// The folder that the asset at `path` is written to.
std::filesystem::path target_folder(const std::string& path, const std::string& output);

/// Whether the asset at `path` is replaced, also if it is named as output.
bool is_in_place(const EditOptions& options, const std::string& path);

/// Why new bytes were not written. `refused`: they cannot become a file.
struct WriteFailure {
  bool refused = false;
  std::string error;
};

/// One asset of those that are written together. Refers to the old asset and the new container.
struct AssetWrite {
  const model::OpenedAsset& old;
  const FileState& state;      ///< of the old file, from before it was read
  const EditOptions& options;  ///< its destination
  /// The proven draft; null: the file is copied unchanged.
  const container::Container* now = nullptr;
  std::vector<NewFile> files = {};          ///< that it refers to
  std::vector<ReplacedFile> replaced = {};  ///< that it refers to, with other bytes than before
  std::set<std::string> referred = {};      ///< paths that the old asset may not refer to
  /// Files to copy next to it, by path; nothing: all files that the old asset refers to.
  std::optional<std::set<std::string>> companions = std::nullopt;
  /// The draft of the output, if it already holds the bytes of `now`; null: a draft is made.
  FileDraft* filled = nullptr;
};

/// Writes assets to their destinations, files before the assets that refer to them: a run that ends
/// between two files leaves old assets with new files. A file that is replaced in place is replaced
/// once, even if several assets refer to it, and only when all files can be; `replaced` is then the
/// same for all of these assets. A file in the folder of an old asset is not replaced unless the
/// asset is, because the asset refers to it, too. By position: nothing when all is durable, else
/// the reason; the old bytes then still exist.
std::vector<std::optional<WriteFailure>> commit(const std::vector<AssetWrite>& assets);

/// Writes a new asset file over any existing file; makes its folder.
std::optional<Error> write_new_asset_file(const std::filesystem::path& target,
                                          std::string_view bytes);

}  // namespace gltfx::change
