// SPDX-License-Identifier: Apache-2.0
/// The last step of an edit: new bytes take the place of old ones.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "edit/new_file.hpp"
#include "json/document.hpp"

namespace gltfx::edit {

/// The asset that was read.
struct OldAsset {
  std::string path;
  FileState state;  ///< before it was read
  const container::Container& container;
  std::function<const json::Document&()> document;
  const container::Resolver& resolver;
};

/// Where new bytes go.
struct Destination {
  std::string output;     ///< empty: where the old ones are
  bool in_place = false;  ///< where the old ones are
  bool backup = false;    ///< in place: keep the old bytes as ASSET.bak
};

/// The folder that the asset at `path` is written to.
std::filesystem::path target_folder(const std::string& path, const std::string& output);

/// Whether the asset at `path` is what is replaced, also where it is named as output.
bool is_in_place(const Destination& to, const std::string& path);

/// What is to be written.
struct NewBytes {
  std::vector<container::Bytes> pieces;     ///< one behind the other, of the asset
  std::vector<NewFile> files = {};          ///< that it refers to
  std::vector<ReplacedFile> replaced = {};  ///< that it refers to, with other bytes than before
  std::set<std::string> referred = {};      ///< paths that the old asset may not refer to
};

/// Why new bytes were not written. `refused`: the check said so.
struct WriteFailure {
  bool refused = false;
  std::string error;
};

/// Why an asset must not be written, or nothing.
using WriteCheck = std::function<std::optional<std::string>(container::Container)>;

/// One asset of those that are written together. Refers to what it is made of.
struct AssetWrite {
  OldAsset old;
  Destination to;
  NewBytes bytes;
  WriteCheck check;  ///< of the asset as it is on the disk, before it takes its place; null: passes
};

/// Writes assets to their destinations, files before the assets that refer to them: somebody who
/// stops between two files leaves old assets with new files. What is to be replaced in place is
/// replaced once, whoever refers to it, and only when all of it can be; `replaced` is the same then
/// for all that refer to a file. A file is not replaced in the folder of an old asset unless the
/// asset is, which refers to it, too. By position: nothing when all is durable, else why it is not;
/// then the old bytes are there still.
std::vector<std::optional<WriteFailure>> write_assets(const std::vector<AssetWrite>& assets);

}  // namespace gltfx::edit
