// SPDX-License-Identifier: Apache-2.0
/// Takes all measures of an asset in memory.
#pragma once

#include <gltfx/measure.hpp>

#include <string>

#include <nlohmann/json.hpp>

#include "measure/take.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::measure::test {

/// Of the text of a .gltf or the bytes of a GLB.
Measurements measured(const std::string& asset, const Request& request = {});
/// Of an asset with the data in a GLB.
Measurements measured(const gltfx::test::AssetBuilder& asset, const Request& request = {});

/// A value as in `gltfx inspect --format json`; null for none, also where nothing has that name.
nlohmann::json value(const Measurements& measurements, MeasureScope on, std::string_view name,
                     std::size_t element = 0);

}  // namespace gltfx::measure::test
