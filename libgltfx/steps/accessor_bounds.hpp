// SPDX-License-Identifier: Apache-2.0
/// `min` and `max` of an accessor with new elements.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "json/edit.hpp"
#include "model/accessor.hpp"

namespace gltfx::steps {

enum class Bound : std::uint8_t { least, greatest };

/// The bound of each component, as a JSON array; empty if an element is not finite. `bytes`: packed
/// elements without padding, with a component type of core glTF 2.0.
std::string bound_text(Bound bound, const model::Format& format, std::string_view bytes);

/// Whether `array` already contains that bound.
bool is_bound(const json::Document& document, json::NodeId array, Bound bound,
              const model::Format& format, std::string_view bytes);

/// Replaces the declared bounds of an accessor that do not match `bytes`, unless an element is not
/// finite: JSON has no such numbers.
void mend_bounds(const json::Document& document, json::Editor& editor,
                 const model::Accessor& accessor, std::string_view bytes);

/// Members of a new accessor that differ from the copied one.
struct AccessorMembers {
  std::optional<std::uint64_t> buffer_view;
  std::uint64_t count = 0;
  model::ComponentType component = model::ComponentType::none;  ///< none: unchanged
};

/// The JSON of a new accessor: a copy of `accessor` with these members, without `byteOffset`, and
/// with bounds computed from `bytes` if `accessor` declares bounds and all elements are finite.
std::string accessor_like(const json::Document& document, const model::Accessor& accessor,
                          const AccessorMembers& members, std::string_view bytes);

}  // namespace gltfx::steps
