// SPDX-License-Identifier: Apache-2.0
/// Which legacy extensions a run is about, and what each is to become.
#pragma once

#include <gltfx/upgrade.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "schema/set.hpp"

namespace gltfx::upgrade {

enum class Selection : std::uint8_t {
  no,       ///< the run is limited to others
  offered,  ///< it would be done on request, and nobody asked
  yes,
};

struct Choice {
  Selection selection = Selection::no;
  std::string to;  ///< the successor; empty: there is none
};

/// `only` and `to` of the options limit a run to what they name; without them it is about all that
/// need not be asked for. An extension with several successors becomes the first unless `to` names
/// another.
Choice choose(const UpgradeOptions& options, const schema::Extension& extension);

/// All names that `only` and `to` of UpgradeOptions may hold.
std::vector<std::string> legacy_names(const schema::Set& set);
std::vector<std::string> successor_names(const schema::Set& set);

}  // namespace gltfx::upgrade
