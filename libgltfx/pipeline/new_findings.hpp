// SPDX-License-Identifier: Apache-2.0
/// Whether a change of an asset makes it worse.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "container/container.hpp"
#include "container/resolver.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// An asset and where its references lead.
struct Checked {
  const container::Container& container;
  const container::Resolver& resolver;
};

/// What an asset has that it had not, or not as often, by codes.
struct NewFindings {
  std::string_view error;             ///< the code of an error; empty: there is none
  std::vector<std::string> warnings;  ///< one a code: "CODE at /pointer: message"
};

/// What `after` has that `before` has not. `path` is the asset's name.
NewFindings new_findings(const Checked& before, const Checked& after, const std::string& path,
                         const std::shared_ptr<const schema::Set>& schemas);

}  // namespace gltfx
