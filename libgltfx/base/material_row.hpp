// SPDX-License-Identifier: Apache-2.0
/// The form of the table of material parameters. Its readers include base/material_table.hpp, which
/// the build writes from schema/: each property with the word `parameter` there has a row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace gltfx {

/// A parameter of the shader.
enum class MaterialParameter : std::uint8_t;
/// A texture slot of the shader.
enum class MaterialSlot : std::uint8_t;

/// A property that gives a parameter its value.
struct ParameterRow {
  std::string_view owner;  ///< the member whose object has the property; empty: the object itself
  std::string_view property;
  std::string_view alias;  ///< its name in an earlier draft, or empty
  MaterialParameter parameter;
  std::uint8_t numbers;         ///< at most 4
  std::array<float, 4> absent;  ///< the default; infinite if there is none
  float least, most;            ///< range of each number
};

/// A property that gives a slot its texture.
struct SlotRow {
  std::string_view owner, property, alias;  ///< as above
  MaterialSlot slot;
};

/// The rows of the core or one extension.
struct MaterialText {
  std::string_view extension;  ///< empty: the core
  std::span<const ParameterRow> parameters;
  std::span<const SlotRow> slots;
};

/// A parameter that a texel multiplies: a number by one channel, a colour by RGB.
struct Scaling {
  MaterialParameter parameter;
  std::uint8_t channel;  ///< 0 to 3: the first, or only, one
};

/// The parameters that a slot scales.
struct SlotReading {
  bool srgb;  ///< R, G and B are sRGB
  std::span<const Scaling> scales;
};

}  // namespace gltfx
