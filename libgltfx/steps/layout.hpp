// SPDX-License-Identifier: Apache-2.0
/// Places bytes after all steps: new bytes move to the buffers of the asset, and bytes that lost
/// their last user are removed.
#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "schema/set.hpp"
#include "steps/step.hpp"
#include "steps/used_bytes.hpp"

namespace gltfx::steps {

/// Lays out the asset of `now`, which the steps made from `before`: a change that removes the
/// buffers of steps and the bytes that steps freed. Buffers with the same file share it afterwards,
/// too. If no buffer of the asset can store new bytes, they get a buffer and a file. Bytes that had
/// no user in `before` stay. The order of bytes and their offsets modulo 8 do not change. A changed
/// file keeps its name in place and where keeps_file_names() allows it. Returns an Error (half a
/// sentence) if bytes cannot be moved.
Result<change::Change> lay_out(const UsedBytes& before, const StepInput& now);

/// The size of `now` in bytes, including all files, after lay_out().
std::uint64_t laid_out_size(const UsedBytes& before, const model::OpenedAsset& now,
                            const schema::Set& schemas);

}  // namespace gltfx::steps
