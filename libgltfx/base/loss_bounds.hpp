// SPDX-License-Identifier: Apache-2.0
/// Reads bounds of losses from text.
#pragma once

#include <gltfx/loss_bounds.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace gltfx {

/// A bound that a list may change, written with its unit, or "off".
struct NamedBound {
  std::string_view name;
  std::string_view unit;  ///< empty: a plain number or a fraction
  double factor;          ///< from the unit to the stored value
  std::string_view example;
  std::optional<double>* value;  ///< nothing: exact
};

/// The bounds of a loss, for changes of `bounds`.
std::vector<NamedBound> named_bounds(LossBounds& bounds);

/// Reads a list such as "position=0.01%,color=off" into the values of `bounds`. Returns an Error
/// (half a sentence) with the nearest name if a name is unknown.
std::optional<Error> read_bounds(std::string_view text, std::span<const NamedBound> bounds);

/// Reads a list such as "position=0.01%,normal=0.5deg,color=off". Bounds that are not in the list
/// have their defaults. Returns an Error (half a sentence) with the nearest name if a name is
/// unknown.
Result<LossBounds> parse_loss_bounds(std::string_view text);

}  // namespace gltfx
