// SPDX-License-Identifier: Apache-2.0
/// Who uses what, as the schemas know it: also by extensions that no code here has heard of.
#pragma once

#include <gltfx/inspect.hpp>

#include <cstdint>
#include <optional>
#include <vector>

#include "model/asset.hpp"
#include "schema/check.hpp"

namespace gltfx::inspect {

/// What bytes are for, and of which mesh, image, animation or skin they are part.
struct Owner {
  ByteUse use = ByteUse::other;
  std::uint32_t index = 0;
};

/// A buffer view in the hands of an owner, or of an accessor.
struct ViewUse {
  std::uint32_t view = 0;
  Owner owner;
  std::optional<std::uint32_t> accessor;  ///< set: the owner is that of this accessor
};

/// One walk over the document. Indices that lead nowhere are left out.
struct Uses {
  std::vector<std::optional<Owner>> accessors;  ///< the first in the order of ByteUse
  std::vector<ViewUse> views;                   ///< in the order of the walk
  schema::CheckResult checked;                  ///< texture slots, extensions
};

/// `document` is that of the asset. Takes time n log n.
Uses find_uses(const model::Asset& asset, const schema::Set& schemas);

}  // namespace gltfx::inspect
