// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/payload/metadata/instance.hpp"
#include "rules/payload/metadata/phase.hpp"
#include "rules/payload/metadata/values.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataClass;
using model::MetadataEnum;
using model::MetadataProperty;
using model::MetadataSchema;

// Reports a string that an earlier object of the same list has.
class Repeats {
 public:
  Repeats(const json::Document& document, Sink& sink, std::string_view member)
      : document_(document), sink_(sink), member_(member) {}

  void see(json::NodeId object, const Path& path) {
    const json::NodeId value = document_.find(object, member_);
    if (value == json::kNoNode || !document_.is_string(value)) return;
    if (document_.insert_string(value, seen_)) return;
    report_in(sink_, Path(path, member_), document_, value, Code::METADATA_REPEATED,
              fmt::format("The {} {} is already taken.", member_,
                          gltfx::quoted(document_.string(value))));
  }

 private:
  const json::Document& document_;
  Sink& sink_;
  std::string_view member_;
  json::KeyTable seen_;
};

// Like model::integer_bits(), for a number in the range of 64 bits.
std::uint64_t integer_of(double number) {
  return number < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(number))
                    : static_cast<std::uint64_t>(number);
}

void check_enum_value(const json::Document& document, json::NodeId object, const Path& path,
                      const MetadataEnum& owner, json::KeyTable& seen, Sink& sink) {
  const json::NodeId value = document.find(object, "value");
  if (value == json::kNoNode || !document.is_number(value)) return;
  const json::Number number = document.number(value);
  const model::MetadataRange range = metadata_range(owner.component);
  if (owner.component == model::MetadataComponent::none) return;
  const Path member(path, "value");
  const std::string_view text = document.raw(value);
  const bool has_digits_alone = text.find_first_of(".eE") == std::string_view::npos;
  if (number.value < range.least || number.value > range.most ||
      (has_digits_alone && !model::integer_bits(text, owner.component))) {
    return report_in(
        sink, member, document, value, Code::METADATA_ENUM_OUT_OF_RANGE,
        fmt::format("{} cannot be stored as {}, the valueType of the enum.",
                    printable(document.raw(value)), metadata_component_name(owner.component)));
  }
  const std::string known = has_digits_alone
                                ? std::to_string(*model::integer_bits(text, owner.component))
                                : std::to_string(integer_of(number.value));
  if (seen.insert_copy(known)) return;
  report_in(sink, member, document, value, Code::METADATA_REPEATED,
            fmt::format("The value {} is already taken.", printable(document.raw(value))));
}

void check_enum(const json::Document& document, const MetadataEnum& each, const Path& path,
                Sink& sink) {
  const json::NodeId values = document.find(each.node, "values");
  if (values == json::kNoNode || document.kind(values) != json::Kind::array) return;
  const Path list(path, "values");
  Repeats names(document, sink, "name");
  json::KeyTable seen;
  std::uint64_t index = 0;
  for (const json::NodeId value : document.elements(values)) {
    const Path at(list, index++);
    names.see(value, at);
    check_enum_value(document, value, at, each, seen, sink);
  }
}

void check_property(const MetadataSchema& schema, const MetadataProperty& property,
                    const Path& path, Sink& sink) {
  const json::Document& document = schema.document();
  if (property.type == model::MetadataType::enumeration) {
    check_enum_type(schema, property, path, sink);
  }
  const MetadataObject owner{document, property.node, path, sink};
  check_metadata_limits(owner, property, false);
  check_metadata_value(owner, "default", document.find(property.node, "default"), property,
                       MetadataNumber::transformed);
  if (property.type == model::MetadataType::boolean) return;  // booleans have none
  check_metadata_value(owner, "noData", document.find(property.node, "noData"), property,
                       MetadataNumber::stored);
}

void check_class(const MetadataSchema& schema, const MetadataClass& each, const Path& path,
                 Sink& sink) {
  const Path list(path, "properties");
  Repeats names(schema.document(), sink, "name");
  Repeats semantics(schema.document(), sink, "semantic");
  for (const MetadataProperty& property : each.properties) {
    const Path at(list, property.id);
    names.see(property.node, at);
    semantics.see(property.node, at);
    check_property(schema, property, at, sink);
  }
}

}  // namespace

void check_metadata_schema(const MetadataSchema& schema, const Path& path, Sink& sink) {
  const Path enums(path, "enums");
  for (const MetadataEnum& each : schema.enums()) {
    check_enum(schema.document(), each, Path(enums, each.id), sink);
  }
  const Path classes(path, "classes");
  for (const MetadataClass& each : schema.classes()) {
    check_class(schema, each, Path(classes, each.id), sink);
  }
}

}  // namespace gltfx::validate
