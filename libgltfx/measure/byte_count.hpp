// SPDX-License-Identifier: Apache-2.0
/// Counts the bytes of an asset's files by use.
#pragma once

#include <gltfx/inspect.hpp>

#include <cstdint>
#include <vector>

#include "container/container.hpp"
#include "container/opened_files.hpp"
#include "graph/graph.hpp"
#include "model/asset.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::measure {

/// Bytes of the files, in total and by object.
struct ByteCount {
  std::vector<FileFacts>
      files;            ///< the asset first, then the others in the order of their first reference
  ByteShares shares{};  ///< add up to the files
  std::vector<std::uint64_t> meshes, images, animations, skins;  ///< by index
};

/// Missing files and broken references count nothing. Takes time n log n.
ByteCount count_bytes(const container::Container& container, container::OpenedFiles& files,
                      const model::Asset& asset, const model::Views& views,
                      const model::ResourceData& resources, const graph::Graph& graph);

}  // namespace gltfx::measure
