// SPDX-License-Identifier: Apache-2.0
/// What findings say about limits.
#pragma once

#include <gltfx/limit.hpp>

#include <optional>
#include <string>
#include <string_view>

#include "measure/limit_texts.hpp"

namespace gltfx::validate {

/// What a value is of: "asset", "mesh". Material elements may be a group without a material.
struct Measured {
  std::string_view noun;
  bool plural = false;
};

/// "The mesh has 1,250 triangles; the limit is 1,000 (gltfx.toml:8)." `texts`: those of the
/// limit. `same_as`: for unique, the index of the element with the same text. Precondition: the
/// value breaks the limit.
std::string broken_limit(const Limit& limit, const measure::LimitTexts& texts, const Measured& of,
                         const MeasureValue& value, std::optional<std::size_t> same_as);

/// "The limit on open-edges of the mesh (gltfx.toml:8) is not checked: ..."
std::string unchecked_limit(const Limit& limit, const Measured& of, std::string_view why);

}  // namespace gltfx::validate
