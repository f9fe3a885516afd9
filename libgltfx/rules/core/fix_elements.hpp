// SPDX-License-Identifier: Apache-2.0
/// The elements of an accessor in the bytes of a buffer, to be changed in place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/accessor_writer.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {

using Elements = model::AccessorWriter;

/// The elements of an accessor that can be changed: plain ones, neither sparse nor compressed, with
/// bytes that do not overlap those of any other accessor. `role` as in Users::roles_of(): nothing
/// if the accessor has another use as well. An empty role allows any use. Nothing if it was changed
/// before.
std::optional<Elements> open_elements(Fixing& fixing, std::uint32_t accessor,
                                      std::string_view role);

/// Claims an accessor whose elements changed, and corrects its declared bounds.
void follow_with_bounds(Fixing& fixing, std::uint32_t accessor, const Elements& elements);

/// The maximum number of numbers that are read in one run: accessors may share their bytes.
class ReadBudget {
 public:
  explicit ReadBudget(Fixing& fixing);
  bool take(std::uint64_t count, unsigned components);

 private:
  std::uint64_t left_ = std::uint64_t{1} << 24U;
};

/// A bound as written in the text.
std::string bound_text(model::ComponentType type, double value);
/// Replaces the numbers of an array that differ from the wanted ones.
void correct_numbers(Fixing& fixing, model::ComponentType type, json::NodeId array,
                     const std::vector<double>& wanted);

}  // namespace gltfx::validate
