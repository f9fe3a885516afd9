// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/metadata/values.hpp"

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "rules/payload/metadata/phase.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataProperty;
using model::MetadataType;

// "3 numbers", "a number".
std::string numbers_phrase(unsigned components) {
  return components == 1 ? "a number" : fmt::format("an array of {} numbers", components);
}

std::string element_phrase(const MetadataProperty& property, bool many) {
  switch (property.type) {
    case MetadataType::string:
      return many ? "strings" : "a string";
    case MetadataType::enumeration:
      return many ? "names of enum values" : "the name of an enum value";
    case MetadataType::boolean:
      return many ? "flags" : "true or false";
    default:
      break;
  }
  const unsigned components = metadata_components(property.type);
  if (!many) return numbers_phrase(components);
  return components == 1 ? "numbers" : fmt::format("arrays of {} numbers", components);
}

std::string form_phrase(const MetadataProperty& property) {
  if (!property.array) return element_phrase(property, false);
  const std::string count = property.count != 0 ? fmt::format("{} ", property.count) : "";
  return fmt::format("an array of {}{}", count, element_phrase(property, true));
}

bool is_number_array(const json::Document& document, json::NodeId value, std::uint64_t count) {
  return document.kind(value) == json::Kind::number_array && document.array_size(value) == count;
}

bool is_element(const json::Document& document, json::NodeId value,
                const MetadataProperty& property) {
  switch (property.type) {
    case MetadataType::string:
    case MetadataType::enumeration:
      return document.is_string(value);
    case MetadataType::boolean:
      return document.is_boolean(value);
    case MetadataType::scalar:
      return document.is_number(value);
    default:
      return is_number_array(document, value, metadata_components(property.type));
  }
}

bool has_form(const json::Document& document, json::NodeId value,
              const MetadataProperty& property) {
  if (!property.array) return is_element(document, value, property);
  if (!document.is_array(value)) return false;
  if (property.count != 0 && document.array_size(value) != property.count) return false;
  if (document.kind(value) == json::Kind::number_array) {
    return property.type == MetadataType::scalar;
  }
  for (const json::NodeId element : document.elements(value)) {
    if (!is_element(document, element, property)) return false;
  }
  return true;
}

// Calls `use(node)` for each element, or for the value itself.
template <typename Use>
void for_each_element(const json::Document& document, json::NodeId value,
                      const MetadataProperty& property, Use use) {
  if (!property.array || document.kind(value) == json::Kind::number_array) return use(value);
  for (const json::NodeId element : document.elements(value)) use(element);
}

// Calls `use` with each number of a value of the correct form.
template <typename Use>
void for_each_number(const json::Document& document, json::NodeId value,
                     const MetadataProperty& property, Use use) {
  for_each_element(document, value, property, [&](json::NodeId node) {
    if (document.is_number(node)) return use(document.number(node));
    if (document.kind(node) != json::Kind::number_array) return;
    for (json::NumberCursor at(document, node); at.valid(); at.advance()) use(at.number());
  });
}

// The greatest numbers of 64 bits are not doubles: a number written as an integer is read as one.
bool is_representable(const json::Document& document, const json::Number& number,
                      const MetadataProperty& property) {
  const model::MetadataRange range = metadata_range(property.component);
  if (number.value < range.least || number.value > range.most) return false;
  if (!is_integer(property.component)) return true;
  const std::string_view text = number.span.in(document.text());
  if (text.find_first_of(".eE") == std::string_view::npos) {
    return model::integer_bits(text, property.component).has_value();
  }
  return number.value == std::floor(number.value);
}

void check_numbers(const MetadataObject& owner, const Path& path, json::NodeId value,
                   const MetadataProperty& property, MetadataNumber number) {
  if (number == MetadataNumber::factor) return;
  if (number == MetadataNumber::transformed && property.normalized) return;
  std::optional<json::Number> wrong;
  for_each_number(owner.document, value, property, [&](const json::Number& each) {
    if (!wrong && !is_representable(owner.document, each, property)) wrong = each;
  });
  if (!wrong) return;
  report_in(owner.sink, path, owner.document, value, Code::METADATA_VALUE_OUT_OF_RANGE,
            fmt::format("{} cannot be stored as {}.", number_text(wrong->value),
                        metadata_component_name(property.component)));
}

void check_names(const MetadataObject& owner, const Path& path, json::NodeId value,
                 const MetadataProperty& property) {
  if (property.enumeration == nullptr) return;
  for_each_element(owner.document, value, property, [&](json::NodeId node) {
    std::string buffer;
    const std::string_view name = owner.document.string(node, buffer);
    if (property.enumeration->names.contains(name)) return;
    report_in(owner.sink, path, owner.document, node, Code::METADATA_VALUE_INVALID,
              fmt::format("{} is not the name of a value of enum {}.", gltfx::quoted(name),
                          gltfx::quoted(property.enumeration->id)));
  });
}

// The reason why a property has no offset and scale, or no bounds, as the end of a sentence; empty:
// it may have them.
std::string_view refusal(const MetadataProperty& property, bool factor) {
  if (!property.is_numeric()) return "its type has no components";
  if (property.is_variable()) return "its arrays vary in length";
  if (factor && is_integer(property.component) && !property.normalized) {
    return "it is neither floating-point nor normalized";
  }
  return {};
}

void check_order(const MetadataObject& owner, const MetadataProperty& property) {
  const auto least =
      metadata_numbers(owner.document, owner.document.find(owner.node, "min"), property);
  const json::NodeId member = owner.document.find(owner.node, "max");
  const auto most = metadata_numbers(owner.document, member, property);
  if (!least || !most) return;
  for (std::size_t i = 0; i < least->size() && i < most->size(); ++i) {
    if ((*least)[i] <= (*most)[i]) continue;
    report_in(owner.sink, Path(owner.path, "max"), owner.document, member,
              Code::METADATA_MIN_ABOVE_MAX,
              fmt::format("max is {}; it must not be less than min, {}.", number_text((*most)[i]),
                          number_text((*least)[i])));
    return;
  }
}

}  // namespace

void report_in(Sink& sink, const Path& path, const json::Document& document, json::NodeId node,
               Code code, std::string message, std::optional<Severity> severity) {
  Finding finding(code, std::move(message));
  const bool compound = document.is_object(node) || document.is_array(node);
  finding.span = compound ? first_character(document, node) : document.span(node);
  finding.severity = severity;
  sink.report(path, std::move(finding));
}

std::optional<std::vector<double>> metadata_numbers(const json::Document& document,
                                                    json::NodeId value,
                                                    const MetadataProperty& property) {
  if (value == json::kNoNode || !property.is_numeric() || property.is_variable()) return {};
  if (!has_form(document, value, property)) return {};
  std::vector<double> numbers;
  for_each_number(document, value, property,
                  [&](const json::Number& each) { numbers.push_back(each.value); });
  return numbers;
}

void check_metadata_value(const MetadataObject& owner, std::string_view member, json::NodeId value,
                          const MetadataProperty& property, MetadataNumber number) {
  if (value == json::kNoNode || !property.is_sound()) return;
  const Path path(owner.path, member);
  if (!has_form(owner.document, value, property)) {
    report_in(owner.sink, path, owner.document, value, Code::METADATA_VALUE_INVALID,
              fmt::format("{} does not fit the property; it must be {}.", gltfx::quoted(member),
                          form_phrase(property)));
  } else if (property.is_numeric()) {
    check_numbers(owner, path, value, property, number);
  } else if (property.type == MetadataType::enumeration) {
    check_names(owner, path, value, property);
  }
}

void check_metadata_limits(const MetadataObject& owner, const MetadataProperty& property,
                           bool stored) {
  constexpr std::array<std::string_view, 4> kMembers{"offset", "scale", "min", "max"};
  if (!property.is_sound()) return;
  for (const std::string_view member : kMembers) {
    const json::NodeId value = owner.document.find(owner.node, member);
    if (value == json::kNoNode) continue;
    const bool factor = member == "offset" || member == "scale";
    const std::string_view why = refusal(property, factor);
    if (why.empty()) {
      check_metadata_value(owner, member, value, property,
                           factor ? MetadataNumber::factor : MetadataNumber::transformed);
    } else if (stored) {
      report_in(owner.sink, Path(owner.path, member), owner.document, value,
                Code::METADATA_LIMIT_NOT_ALLOWED,
                fmt::format("{} is not allowed for property {}, because {}.", gltfx::quoted(member),
                            gltfx::quoted(property.id), why));
    }
  }
  check_order(owner, property);
}

}  // namespace gltfx::validate
