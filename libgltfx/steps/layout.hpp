// SPDX-License-Identifier: Apache-2.0
/// Where bytes lie once all steps have run: those that steps made go to the buffers of the asset,
/// and those that lost their last user go.
#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::steps {

/// The change of `now`, which steps made of `before`, that leaves no buffer of a step and no byte
/// that only they freed. What nothing named before stays. The order of bytes and their distances
/// modulo 8 stay. An Error, half a sentence: the bytes cannot be moved.
Result<change::Change> lay_out(const model::OpenedAsset& before, const model::OpenedAsset& now,
                               const schema::Set& schemas);

/// The size of `now`, text and all files, after lay_out().
std::uint64_t laid_out_size(const model::OpenedAsset& before, const model::OpenedAsset& now,
                            const schema::Set& schemas);

/// The size of an asset, text and all files that it refers to.
std::uint64_t stored_size(const model::OpenedAsset& asset);

}  // namespace gltfx::steps
