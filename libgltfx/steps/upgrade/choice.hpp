// SPDX-License-Identifier: Apache-2.0
/// The legacy extensions of a run, and their successors.
#pragma once

#include <gltfx/upgrade.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "schema/set.hpp"

namespace gltfx::upgrade {

enum class Selection : std::uint8_t {
  no,       ///< the run is limited to other extensions
  offered,  ///< done only on request, and not requested
  yes,
};

struct Choice {
  Selection selection = Selection::no;
  std::string to;  ///< the successor; empty: none
};

/// The options `only` and `to` limit a run to the named extensions; without them, it includes all
/// that need no request. An extension with several successors becomes the first one unless `to`
/// names another.
Choice choose(const UpgradeOptions& options, const schema::Extension& extension);

/// All names that `only` and `to` of UpgradeOptions may hold.
std::vector<std::string> legacy_names(const schema::Set& set);
std::vector<std::string> successor_names(const schema::Set& set);

}  // namespace gltfx::upgrade
