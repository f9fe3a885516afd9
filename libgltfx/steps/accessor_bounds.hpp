// SPDX-License-Identifier: Apache-2.0
/// The `min` and `max` of an accessor with new elements.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "json/edit.hpp"
#include "model/accessor.hpp"

namespace gltfx::steps {

enum class Bound : std::uint8_t { least, greatest };

/// The bound of each component as a JSON array. `bytes`: packed elements without padding, of one of
/// the component types of glTF 2.0 itself.
std::string bound_text(Bound bound, const model::Format& format, std::string_view bytes);

/// Whether `array` is that bound already.
bool is_bound(const json::Document& document, json::NodeId array, Bound bound,
              const model::Format& format, std::string_view bytes);

/// Replaces those bounds that an accessor declares and that are other ones now.
void mend_bounds(const json::Document& document, json::Editor& editor,
                 const model::Accessor& accessor, std::string_view bytes);

/// Where a new accessor has its elements.
struct AccessorMembers {
  std::optional<std::uint64_t> buffer_view;
  std::uint64_t count = 0;
  model::ComponentType component = model::ComponentType::none;  ///< none: as the other one
};

/// A new accessor with the members of another one but for these, its own bounds where the other has
/// some, and no `byteOffset`.
std::string accessor_like(const json::Document& document, const model::Accessor& accessor,
                          const AccessorMembers& members, std::string_view bytes);

}  // namespace gltfx::steps
