// SPDX-License-Identifier: Apache-2.0
/// The last step of an upgrade: new bytes take the place of old ones.
#pragma once

#include <gltfx/upgrade.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "json/document.hpp"
#include "upgrade/settlement.hpp"

namespace gltfx {

/// The asset that was read.
struct UpgradeSource {
  const std::string& path;
  FileState state;  ///< before it was read
  const container::Container& container;
  const json::Document& document;
  const container::Resolver& resolver;
};

struct UpgradeFailure {
  UpgradeProblem problem = UpgradeProblem::none;
  std::string error;
};

/// Why an asset must not be written, or nothing.
using UpgradeCheck = std::function<std::optional<std::string>(const container::Container&)>;

/// Writes the pieces where the options say, and new files before the asset that refers to them. The
/// bytes are checked as they are on the disk, before they take their place; a null check passes.
/// Nothing when all is durable, else why it is not; then the old bytes are there still.
std::optional<UpgradeFailure> write_upgrade(const UpgradeSource& source,
                                            const UpgradeOptions& options,
                                            const std::vector<upgrade::NewFile>& files,
                                            const std::vector<container::Bytes>& pieces,
                                            const UpgradeCheck& check);

/// The folder that the asset at `path` is written to.
std::filesystem::path target_folder(const std::string& path, const UpgradeOptions& options);

/// The bytes of a new file, which they keep.
inline container::Bytes content_of(const upgrade::NewFile& file) {
  return {std::as_bytes(std::span(*file.bytes)), file.bytes};
}

}  // namespace gltfx
