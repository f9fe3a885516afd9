// SPDX-License-Identifier: Apache-2.0
/// Whether a change of an asset makes it worse.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "container/container.hpp"
#include "container/resolver.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// An asset and where its references lead.
struct Checked {
  const container::Container& container;
  const container::Resolver& resolver;
};

/// The code of an error that `after` has and `before` has not, or not as often; nothing when there
/// is none. `path` is the asset's name.
std::optional<std::string_view> new_error(const Checked& before, const Checked& after,
                                          const std::string& path,
                                          const std::shared_ptr<const schema::Set>& schemas);

}  // namespace gltfx
