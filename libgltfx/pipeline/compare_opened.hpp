// SPDX-License-Identifier: Apache-2.0
/// Compares assets from anywhere, such as the commits of a repository.
#pragma once

#include <gltfx/compare.hpp>

#include <functional>
#include <string>

#include "base/result.hpp"
#include "model/opened_asset.hpp"

namespace gltfx {

/// Opens one of two assets. The Error is half a sentence.
using OpenCompared = std::function<Result<model::OpenedAsset>()>;

/// Opens both, one after the other, compares and draws them. Without a name there is no asset.
/// `root` and `searched` of the options are not used.
CompareReport compare_opened(std::string old_name, std::string new_name,
                             const CompareOptions& options, const OpenCompared& open_old,
                             const OpenCompared& open_new);

}  // namespace gltfx
