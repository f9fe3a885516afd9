// SPDX-License-Identifier: Apache-2.0
#include "pipeline/convert_places.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/commit.hpp"
#include "change/companions.hpp"
#include "pipeline/edit_asset.hpp"

namespace gltfx {

namespace fs = std::filesystem;

std::optional<std::string> find_taken_name(const model::OpenedAsset& before,
                                           const ConvertOptions& options,
                                           const std::vector<change::NewFile>& files) {
  if (!writes(options)) return std::nullopt;
  const fs::path folder =
      change::target_folder(before.name(), options.in_place ? "" : options.output);
  for (const change::NewFile& file : files) {
    std::error_code error;
    const fs::path target = folder / file.path;
    if (!fs::exists(fs::symlink_status(target, error))) continue;
    if (change::has_bytes(target, file.pieces)) continue;
    return fmt::format("{} is there already with other bytes", quoted(target.native(), 200));
  }
  return std::nullopt;
}

std::optional<std::string> find_other_reader(const model::OpenedAsset& before,
                                             const ConvertOptions& options,
                                             const std::vector<change::ReplacedFile>& files,
                                             FolderIndex& folders) {
  if (!change::is_in_place(options, before.name())) return std::nullopt;
  const fs::path folder = change::target_folder(before.name(), {});
  for (const change::ReplacedFile& file : files) {
    const auto identity = identity_of(file.state, (folder / file.path).native());
    for (const std::string& asset : folders.naming(folder, {identity})) {
      std::error_code error;
      if (fs::equivalent(asset, before.name(), error)) continue;
      return fmt::format("{} refers to {}, whose bytes would move; use -o", quoted(asset, 200),
                         quoted(file.path, 200));
    }
    if (std::string gap = folders.find_gap(folder); !gap.empty()) {
      return fmt::format("{}; another asset may refer to {}, whose bytes would move; use -o", gap,
                         quoted(file.path, 200));
    }
  }
  return std::nullopt;
}

}  // namespace gltfx
