// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "schema/compiler/embed.hpp"

namespace gltfx::schema {
namespace {

using fmt::format;

std::string float_text(double value) {
  if (std::isinf(value)) return value < 0 ? "kLeast" : "kMost";
  const std::string text = format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text : text + "F";
}

// The default of a parameter as numbers: "[1, 1, 1]", or one number, "0.5".
std::string default_text(std::string text) {
  if (text.empty()) return "{kNone}";
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '[' || c == ',' || c == ']'; }, ' ');
  std::istringstream numbers(text);
  std::vector<std::string> all;
  for (double number = 0; numbers >> number;) all.push_back(float_text(number));
  return format("{{{}}}", fmt::join(all, ", "));
}

class Table {
 public:
  explicit Table(const Set& set) : set_(set) {}

  std::string text() {
    add_object("", set_.find_type("material"));
    for (const bool outdated : {true, false}) {
      for (const Extension& extension : set_.extensions()) {
        const ShapeId home = extension.shape_on(set_.find_type("material"));
        if (home == kNone || extension.successor.empty() == outdated) continue;
        add_object(extension.name, set_.shape(home).type);
      }
    }
    return written();
  }

 private:
  // One list of the header, with the names in it.
  struct List {
    std::vector<std::string> names;
    std::string rows;
    std::size_t count = 0;

    void add(const std::string& name, const std::string& row) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      rows += row;
      ++count;
    }
  };

  void add_object(const std::string& extension, TypeId type) {
    if (type == kNone) return;
    const std::size_t parameters = parameters_.count;
    const std::size_t slots = slots_.count;
    add_members(type, "", "");
    if (parameters_.count == parameters && slots_.count == slots) return;
    texts_ +=
        format("    {{\"{}\", {{kRows + {}, {}}}, {{kSlotRows + {}, std::size_t{{{}}}}}}},\n",
               extension, parameters, parameters_.count - parameters, slots, slots_.count - slots);
  }

  // `prefix`: prefix of parameter names inside a texture slot.
  void add_members(TypeId type, const std::string& owner, const std::string& prefix) {
    for (const Property& property : set_.type(type).properties) {
      const Shape& shape = set_.shape(property.shape);
      if (shape.slot) {
        const std::string slot = add_slot(set_.type(type), property, owner);
        if (!slot.empty()) add_members(shape.type, property.name, slot + "_");
      } else if (shape.type != kNone && owner.empty()) {
        add_members(shape.type, property.name, "");
      } else if (!property.parameter.empty()) {
        add_parameter(property, owner, prefix + property.parameter);
      }
    }
  }

  void add_parameter(const Property& property, const std::string& owner, const std::string& name) {
    const Shape& shape = set_.shape(property.shape);
    const bool list = shape.items != kNone;
    const Shape& number = list ? set_.shape(shape.items) : shape;
    parameters_.add(name, format("    {{\"{}\", \"{}\", \"{}\", MaterialParameter::{}, {}, {}, {}, "
                                 "{}}},\n",
                                 owner, property.name, alias(property), name,
                                 list ? shape.max_items : 1, default_text(property.default_json),
                                 float_text(number.minimum), float_text(number.maximum)));
  }

  // The name of the slot, or an empty text when the shader does not read it.
  std::string add_slot(const ObjectType& type, const Property& property, const std::string& owner) {
    const Slot& slot = *set_.shape(property.shape).slot;
    const Property* const factor = find(type, slot.scaled_by);
    const std::string name =
        property.parameter.empty() && factor != nullptr ? factor->parameter : property.parameter;
    if (name.empty()) return name;
    const bool first =
        std::find(slots_.names.begin(), slots_.names.end(), name) == slots_.names.end();
    slots_.add(name, format("    {{\"{}\", \"{}\", \"{}\", MaterialSlot::{}}},\n", owner,
                            property.name, alias(property), name));
    if (first) readings_ += format("    {{{}, {}}},\n", slot.srgb, scales(type, slot));
    return name;
  }

  // A number cannot be scaled by a colour: the shader handles such a slot itself.
  std::string scales(const ObjectType& type, const Slot& slot) {
    std::vector<std::pair<std::string, std::string>> factors = slot.factors;
    if (!slot.scaled_by.empty()) factors.emplace_back(slot.channels, slot.scaled_by);
    const std::size_t before = scale_count_;
    for (const auto& [channels, name] : factors) {
      const Property* const factor = find(type, name);
      const bool color = set_.shape(factor->shape).items != kNone;
      if (factor->parameter.empty() || color != (channels.size() > 1)) continue;
      scales_ += format("    {{MaterialParameter::{}, {}}},\n", factor->parameter,
                        std::string_view("rgba").find(channels.front()));
      ++scale_count_;
    }
    return format("{{kScales + {}, std::size_t{{{}}}}}", before, scale_count_ - before);
  }

  static const Property* find(const ObjectType& type, const std::string& name) {
    const auto found = std::find_if(type.properties.begin(), type.properties.end(),
                                    [&](const Property& each) { return each.name == name; });
    return found == type.properties.end() ? nullptr : &*found;
  }

  static std::string alias(const Property& property) {
    return property.aliases.empty() ? std::string() : property.aliases.front();
  }

  static std::string enumeration(std::string_view name, const List& list) {
    return format("enum class {} : std::uint8_t {{\n  {},\n  count\n}};\n\n", name,
                  fmt::join(list.names, ",\n  "));
  }

  std::string members() const {
    std::string text;
    for (const std::string& name : parameters_.names) {
      text += format(
          "    [] {{ if constexpr (requires {{ &M::{0}; }}) return Member(&M::{0}); "
          "else return Member(&N::{0}); }}(),\n",
          name);
    }
    return text;
  }

  std::string written() const {
    return "// Written by gltfx_schema_compiler from schema/.\n#pragma once\n\n"
           "#include <cstddef>\n#include <limits>\n\n#include \"base/material_row.hpp\"\n\n"
           "namespace gltfx {\n\n" +
           enumeration("MaterialParameter", parameters_) + enumeration("MaterialSlot", slots_) +
           "inline constexpr auto kMaterialParameters = "
           "static_cast<std::size_t>(MaterialParameter::count);\n"
           "inline constexpr auto kMaterialSlots = "
           "static_cast<std::size_t>(MaterialSlot::count);\n\n"
           "namespace material_table {\n"
           "inline constexpr float kLeast = std::numeric_limits<float>::lowest();\n"
           "inline constexpr float kMost = std::numeric_limits<float>::max();\n"
           "inline constexpr float kNone = std::numeric_limits<float>::infinity();\n"
           "inline constexpr ParameterRow kRows[]{\n" +
           parameters_.rows +
           "};\n"
           "inline constexpr SlotRow kSlotRows[]{\n" +
           slots_.rows +
           "};\n"
           "inline constexpr Scaling kScales[]{\n" +
           scales_ +
           "};\n"
           "inline constexpr MaterialText kTexts[]{\n" +
           texts_ +
           "};\n"
           "/// By slot.\ninline constexpr SlotReading kReadings[]{\n" +
           readings_ +
           "};\n"
           "}  // namespace material_table\n\n"
           "/// By parameter: the member of that name of M, else of N.\n"
           "template <class Member, class M, class N>\n"
           "constexpr std::array<Member, kMaterialParameters> material_members() {\n"
           "  return {\n" +
           members() +
           "  };\n}\n\n"
           "}  // namespace gltfx\n";
  }

  const Set& set_;
  List parameters_, slots_;
  std::string texts_, readings_, scales_;
  std::size_t scale_count_ = 0;
};

}  // namespace

std::string material_table(const Set& set) { return Table(set).text(); }

}  // namespace gltfx::schema
