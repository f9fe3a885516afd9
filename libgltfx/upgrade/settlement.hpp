// SPDX-License-Identifier: Apache-2.0
/// Where the bytes of additions come to stand: in the BIN chunk of a GLB, in new files beside the
/// old ones, or in data URIs where the old ones stand in such.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "container/container.hpp"
#include "edit/new_file.hpp"
#include "json/edit.hpp"
#include "upgrade/additions.hpp"
#include "upgrade/asset_bytes.hpp"

namespace gltfx::upgrade {

struct Settlement {
  std::vector<json::Edit> edits;  ///< of the document; for json::merge_edits()
  std::string bin;                ///< follows the data of the BIN chunk; empty: it stays as it is
  std::vector<edit::NewFile> files;
};

/// Whether a new file may have that path: nothing is there, or exactly these bytes.
using IsFree = std::function<bool(const std::string& path, std::string_view bytes)>;

/// Finds places for all of `additions`; `images` are the files of its images, in their order. What
/// is put behind the BIN chunk is aligned to 4 bytes. Files are named after the ones they are made
/// of and their own content. An Error when there is no place.
Result<Settlement> settle(const Additions& additions,
                          const std::vector<std::shared_ptr<const std::string>>& images,
                          const container::Container& container, const AssetBytes& bytes,
                          const IsFree& is_free);

}  // namespace gltfx::upgrade
