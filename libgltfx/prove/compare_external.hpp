// SPDX-License-Identifier: Apache-2.0
/// External assets (glTF 2.1) of two assets.
#pragma once

#include <gltfx/compare.hpp>

#include <functional>
#include <string>
#include <vector>

#include "model/opened_asset.hpp"

namespace gltfx::prove {

/// What differs in external assets, at any depth.
struct ExternalChanges {
  std::vector<Change> changes;        ///< one for each external asset that differs
  std::vector<std::string> storage;   ///< as CompareReport has them
  std::vector<std::string> unproven;  ///< likewise
  bool empty() const { return changes.empty() && storage.empty() && unproven.empty(); }
};

/// Compares two assets without their external ones.
using ComparePlain =
    std::function<CompareReport(const model::OpenedAsset&, const model::OpenedAsset&)>;

/// External assets are matched by their paths, from the folder of the first asset on. Those that
/// only one side refers to are a matter of the assets that refer to them.
ExternalChanges compare_external_assets(const model::OpenedAsset& ours,
                                        const model::OpenedAsset& theirs,
                                        const ComparePlain& compare);

}  // namespace gltfx::prove
