// SPDX-License-Identifier: Apache-2.0
/// The plan that makes an asset of glTF 2.0 one of glTF 2.1.
#pragma once

#include "steps/upgrade/plan.hpp"

namespace gltfx::upgrade {

/// The version that UpgradeOptions::gltf may ask for.
inline constexpr std::string_view kGltfVersion = "2.1";

/// A plan for the version alone: legacy extensions stay. What an asset of glTF 2.1 should not have,
/// and must keep, is an action that is not due. Precondition: the document is not glTF 1.0.
Plan plan_version(const json::Document& document, const schema::Set& set,
                  const UpgradeOptions& options);

}  // namespace gltfx::upgrade
