// SPDX-License-Identifier: Apache-2.0
/// Sets of formats of attributes, and formats that extensions add to those of the specification.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "model/asset.hpp"
#include "model/views.hpp"
#include "schema/set.hpp"

namespace gltfx::model {

/// Component types of formats, and their names in schema files.
struct ComponentName {
  ComponentType type;
  std::string_view name;
};
inline constexpr ComponentName kComponentNames[] = {
    {ComponentType::int8, "BYTE"},     {ComponentType::uint8, "UBYTE"},
    {ComponentType::int16, "SHORT"},   {ComponentType::uint16, "USHORT"},
    {ComponentType::int32, "INT"},     {ComponentType::uint32, "UINT"},
    {ComponentType::float32, "FLOAT"}, {ComponentType::float64, "DOUBLE"},
    {ComponentType::float16, "HALF"}};

/// Combinations of element types and component types.
struct FormatSet {
  /// The components are named as in schema files: "UBYTE_NORM".
  static FormatSet of(std::initializer_list<ElementType> types,
                      std::initializer_list<std::string_view> components);
  static FormatSet of(const schema::AttributeFormat& format);

  bool has_type(ElementType type) const;
  bool has_component(ComponentType type, bool normalized) const;
  bool allows(const Format& format) const {
    return has_type(format.type) && has_component(format.component, format.normalized);
  }

  std::uint16_t types = 0;       ///< bit n: ElementType n
  std::uint32_t components = 0;  ///< two bits per component type: plain, normalized
};

/// Whether the extension adds that format to those of an attribute of a primitive, or of a morph
/// target.
bool adds_format(const schema::Extension& extension, const Attribute& attribute, bool target,
                 const Format& format);

/// Number of accessors whose format the extension adds to their attribute, of primitives and of
/// morph targets.
std::uint64_t count_with_added_format(const Asset& asset, const Views& views,
                                      const schema::Extension& extension);

}  // namespace gltfx::model
