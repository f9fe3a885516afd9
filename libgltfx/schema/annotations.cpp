// SPDX-License-Identifier: Apache-2.0
// Values inside x-gltfx, behind the vocabulary check: their forms can be relied on.
#include "schema/shape_builder.hpp"

namespace gltfx::schema {
namespace {

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> steps;
  while (true) {
    const std::size_t end = std::min(text.find('/'), text.size());
    steps.emplace_back(text.substr(0, end));
    if (end == text.size()) return steps;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

Slot read_slot(const Build& build, Site at) {
  Slot slot;
  slot.channels = build.text(build.member(at, "channels"));
  slot.srgb = build.text(build.member(at, "colorSpace")) == "srgb";
  const Site scaled_by = build.member(at, "scaledBy");
  if (scaled_by.exists()) slot.scaled_by = build.text(scaled_by);
  const Site factors = build.member(at, "factors");
  if (!factors.exists()) return slot;
  const json::Document& document = build.document(factors);
  for (const auto& member : document.members(factors.node)) {
    slot.factors.emplace_back(document.key(member.key_id), document.string(member.value));
  }
  return slot;
}

// "accessors", "/extensions/KHR_x/things" or "animation/samplers"; the type's id is found later.
Target read_target(const Build& build, Site at) {
  Target target;
  target.text = build.text(at);
  const std::string_view text = target.text;
  if (text.substr(0, 1) == "/") {
    target.base = Target::Base::root_path;
    target.steps = split(text.substr(1));
    return target;
  }
  target.steps = split(text);
  if (target.steps.size() > 1) {
    target.base = Target::Base::enclosing;
    target.steps.erase(target.steps.begin());
  }
  return target;
}

std::vector<std::string> read_names(const Build& build, Site list) {
  std::vector<std::string> names;
  if (!list.exists()) return names;
  const json::Document& document = build.document(list);
  if (document.is_string(list.node)) return {document.string(list.node)};
  if (document.kind(list.node) != json::Kind::array) return names;
  for (const json::NodeId name : document.elements(list.node))
    names.push_back(document.string(name));
  return names;
}

Literal read_literal(const json::Document& document, json::NodeId node) {
  Literal literal;
  switch (document.kind(node)) {
    case json::Kind::string:
      literal.kind = Literal::Kind::string;
      literal.string = document.string(node);
      break;
    case json::Kind::number:
      literal.kind = Literal::Kind::number;
      literal.number = document.number(node).value;
      break;
    case json::Kind::true_value:
    case json::Kind::false_value:
      literal.kind = Literal::Kind::boolean;
      literal.number = document.kind(node) == json::Kind::true_value ? 1 : 0;
      break;
    default:
      break;
  }
  return literal;
}

std::vector<Literal> read_literals(const Build& build, Site list) {
  const json::Document& document = build.document(list);
  std::vector<Literal> all;
  if (document.kind(list.node) == json::Kind::number_array) {
    for (json::NumberCursor at(document, list.node); at.valid(); at.advance()) {
      all.emplace_back().kind = Literal::Kind::number;
      all.back().number = at.number().value;
    }
    return all;
  }
  for (const json::NodeId item : document.elements(list.node))
    all.push_back(read_literal(document, item));
  return all;
}

}  // namespace gltfx::schema
