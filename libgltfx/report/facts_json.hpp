// SPDX-License-Identifier: Apache-2.0
/// Facts about an asset as JSON. schema/meta/inspect.schema.json describes them.
#pragma once

#include <gltfx/inspect.hpp>

#include <cstddef>

#include "json/writer.hpp"

namespace gltfx::report {

/// One object. `most`: entries of each list of meshes, materials, images and animations, those that
/// take most bytes; 0: all.
void write_facts(json::Writer& writer, const AssetFacts& facts, std::size_t most = 0);

/// An array.
void write_upgrade_facts(json::Writer& writer, const std::vector<UpgradeFact>& upgrade);

}  // namespace gltfx::report
