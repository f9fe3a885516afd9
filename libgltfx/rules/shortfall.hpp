// SPDX-License-Identifier: Apache-2.0
/// What targets lack for an asset.
#pragma once

#include <gltfx/targets.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::validate {

/// A feature of an asset that a target refuses or ignores.
struct Shortfall {
  std::size_t target = 0;  ///< position in the list of targets
  std::string feature;     ///< its name
  std::string pointer;     ///< of the first object with the feature; empty: the asset
  std::string message;     ///< of the finding: one sentence
  std::string help;        ///< imperative; may be empty
  bool refused = false;
  /// The target ignores the feature, but the picture stays, or the asset has a fallback.
  bool harmless = false;
  /// The target refuses or ignores an extension only if it is required.
  bool only_required = false;
};

/// The shortfalls of these targets, in their order. Validates the asset.
std::vector<Shortfall> find_shortfalls(model::OpenedAsset& asset,
                                       const std::vector<TargetChoice>& targets,
                                       const std::shared_ptr<const schema::Set>& schemas,
                                       unsigned jobs);

}  // namespace gltfx::validate
