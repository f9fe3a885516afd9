// SPDX-License-Identifier: Apache-2.0
/// What options of a conversion would save.
#pragma once

#include <gltfx/convert.hpp>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"
#include "steps/image_encodings.hpp"

namespace gltfx {

/// Whether the options ask for nothing, so that the run can only tell what they would do.
bool asks_nothing(const ConvertOptions& options);

/// Fills `savings` and the sizes beside them. Runs each step once; encodes no images and no Draco
/// bitstreams.
void find_savings(const model::OpenedAsset& asset, const schema::Set& schemas,
                  const ConvertOptions& options, steps::ImageEncodings& encodings,
                  ConvertReport& report);

}  // namespace gltfx
