// SPDX-License-Identifier: Apache-2.0
/// Where the bytes of an asset's files go.
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

namespace gltfx::inspect {

/// Of files, all of them and object by object.
struct ByteCount {
  std::vector<FileFacts> files;  ///< the asset first, then others by the first that names them
  ByteShares shares{};           ///< add up to the files
  std::vector<std::uint64_t> meshes, images, animations, skins;  ///< by index
};

/// Files that are not there, and references that lead nowhere, count nothing. Takes time n log n.
ByteCount count_bytes(const container::Container& container, container::OpenedFiles& files,
                      const model::Asset& asset, const model::Views& views,
                      const model::ResourceData& resources, const graph::Graph& graph);

}  // namespace gltfx::inspect
