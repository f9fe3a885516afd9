// SPDX-License-Identifier: Apache-2.0
#include "json/oracle.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <simdjson.h>

#include "base/text.hpp"
#include "json/lines.hpp"
#include "json/parse.hpp"

namespace gltfx::fuzz {
namespace {

using json::Document;
using json::Kind;
using json::NodeId;
using json::Parsed;
using json::SyntaxError;
using Nlohmann = nlohmann::json;
using Simd = simdjson::dom::element;

bool has(const Parsed& parsed, SyntaxError error) {
  return std::any_of(parsed.errors.begin(), parsed.errors.end(),
                     [&](const json::ParseError& found) { return found.error == error; });
}

// Neither judge minds repeated names; both refuse everything else that is an error for us.
bool is_valid_json(const Parsed& parsed) {
  return std::all_of(parsed.errors.begin(), parsed.errors.end(), [](const json::ParseError& found) {
    return found.error == SyntaxError::duplicate_key;
  });
}

// simdjson refuses integers beyond 64 bits.
bool has_huge_integer(const Document& document) {
  const auto is_huge = [](std::string_view raw, double value) {
    return raw.find_first_of(".eE") == std::string_view::npos && std::fabs(value) > 9.2e18;
  };
  for (NodeId id = 0; id < document.node_count(); ++id) {
    if (document.is_number(id) && is_huge(document.raw(id), document.number(id).value)) return true;
    if (document.kind(id) != Kind::number_array) continue;
    for (json::NumberCursor at(document, id); at.valid(); at.advance()) {
      if (is_huge(at.number().span.in(document.text()), at.number().value)) return true;
    }
  }
  return false;
}

bool equals(const Document& document, NodeId id, const Nlohmann& other);

bool equal_arrays(const Document& document, NodeId id, const Nlohmann& other) {
  if (!other.is_array() || other.size() != document.array_size(id)) return false;
  std::size_t index = 0;
  if (document.kind(id) == Kind::number_array) {
    for (json::NumberCursor at(document, id); at.valid(); at.advance()) {
      const Nlohmann& number = other[index++];
      if (!number.is_number() || number.get<double>() != at.number().value) return false;
    }
    return index == other.size();
  }
  for (const NodeId element : document.elements(id)) {
    if (!equals(document, element, other[index++])) return false;
  }
  return true;
}

// nlohmann keeps one member of a name, the last, as `find` does.
bool equal_objects(const Document& document, NodeId id, const Nlohmann& other) {
  if (!other.is_object() || other.size() > document.object_size(id)) return false;
  for (const json::Members::Member& member : document.members(id)) {
    const std::string name = document.string(member.key);
    const auto found = other.find(name);
    if (found == other.end() || document.key(member.key_id) != name) return false;
    const NodeId last = document.find(id, name);
    if (last == member.value && !equals(document, last, *found)) return false;
  }
  return true;
}

bool equals(const Document& document, NodeId id, const Nlohmann& other) {
  switch (document.kind(id)) {
    case Kind::null:
      return other.is_null();
    case Kind::true_value:
    case Kind::false_value:
      return other.is_boolean() && other.get<bool>() == (document.kind(id) == Kind::true_value);
    case Kind::number:
      return other.is_number() && other.get<double>() == document.number(id).value;
    case Kind::string:
      return other.is_string() && other.get<std::string>() == document.string(id);
    case Kind::object:
      return equal_objects(document, id, other);
    default:
      return equal_arrays(document, id, other);
  }
}

bool equals(const Document& document, NodeId id, Simd other);

bool equal_arrays(const Document& document, NodeId id, const simdjson::dom::array& other) {
  auto at = other.begin();
  if (document.kind(id) == Kind::number_array) {
    for (json::NumberCursor own(document, id); own.valid(); own.advance(), ++at) {
      double value = 0;
      if (!(at != other.end()) || (*at).get(value) != simdjson::SUCCESS) return false;
      if (value != own.number().value) return false;
    }
    return !(at != other.end());
  }
  for (const NodeId element : document.elements(id)) {
    if (!(at != other.end()) || !equals(document, element, *at)) return false;
    ++at;
  }
  return !(at != other.end());
}

// All members of a name are found, also hidden ones.
bool equal_objects(const Document& document, NodeId id, const simdjson::dom::object& other) {
  auto at = other.begin();
  for (NodeId key = id + 1; key < document.next(id); key = document.next(key + 1)) {
    if (!(at != other.end()) || at.key() != document.string(key)) return false;
    if (!equals(document, key + 1, at.value())) return false;
    ++at;
  }
  return !(at != other.end());
}

bool equals(const Document& document, NodeId id, Simd other) {
  switch (document.kind(id)) {
    case Kind::null:
      return other.is_null();
    case Kind::true_value:
    case Kind::false_value: {
      bool value = false;
      const bool read = other.get(value) == simdjson::SUCCESS;
      return read && value == (document.kind(id) == Kind::true_value);
    }
    case Kind::number: {
      double value = 0;
      return other.get(value) == simdjson::SUCCESS && value == document.number(id).value;
    }
    case Kind::string: {
      std::string_view value;
      return other.get(value) == simdjson::SUCCESS && value == document.string(id);
    }
    case Kind::object:
      return other.is_object() && equal_objects(document, id, other.get_object().value_unsafe());
    default:
      return other.is_array() && equal_arrays(document, id, other.get_array().value_unsafe());
  }
}

std::string compare_with_nlohmann(const Parsed& parsed, std::string_view text) {
  // It takes a NUL for the end of its input.
  if (text.find('\0') != std::string_view::npos) return {};
  const Nlohmann other = Nlohmann::parse(text, nullptr, false);
  const bool accepted = !other.is_discarded();
  if (accepted != is_valid_json(parsed)) return accepted ? "nlohmann accepts" : "nlohmann refuses";
  if (accepted && !equals(parsed.document, 0, other)) return "nlohmann reads other values";
  return {};
}

std::string compare_with_simdjson(const Parsed& parsed, std::string_view text) {
  // It reads some lone surrogates and refuses others.
  if (has(parsed, SyntaxError::lone_surrogate) || has_huge_integer(parsed.document)) return {};
  simdjson::dom::parser parser;
  if (parser.allocate(text.size() + 64, text.size() + 2) != simdjson::SUCCESS) return {};
  const auto other = parser.parse(text.data(), text.size());
  const bool accepted = other.error() == simdjson::SUCCESS;
  if (accepted != is_valid_json(parsed)) {
    return accepted ? "simdjson accepts" : "simdjson refuses";
  }
  if (accepted && !equals(parsed.document, 0, other.value_unsafe())) {
    return "simdjson reads other values";
  }
  return {};
}

std::string check_nodes(const Document& document) {
  const auto count = static_cast<NodeId>(document.node_count());
  std::vector<NodeId> open;
  for (NodeId id = 0; id < count; ++id) {
    const json::Node& node = document.node(id);
    if (node.begin >= node.end || node.end > document.text().size()) return "span outside the text";
    while (!open.empty() && id == document.next(open.back())) open.pop_back();
    if (!open.empty() && node.end >= document.node(open.back()).end)
      return "span outside its parent";
    if (id > 0 && open.empty()) return "node after the root";
    if (id > 0 && node.begin <= document.node(id - 1).begin) return "nodes out of order";
    if (node.kind == Kind::key) {
      if (node.next >= document.key_count() || id + 1 == count) return "key without name or value";
      continue;
    }
    const bool holds = node.kind == Kind::array || node.kind == Kind::object;
    if (node.next <= id || node.next > count || (!holds && node.next != id + 1))
      return "next is wrong";
    if (holds && node.next > id + 1) open.push_back(id);
  }
  return {};
}

std::string check_pointers(const Parsed& parsed) {
  const Document& document = parsed.document;
  if (has(parsed, SyntaxError::duplicate_key) || document.node_count() > 200) return {};
  for (NodeId id = 0; id < document.node_count(); ++id) {
    const NodeId value = document.kind(id) == Kind::key ? id + 1 : id;
    if (document.resolve(document.pointer_of(id)) != value) return "pointer leads elsewhere";
  }
  return {};
}

std::string check_errors(const Parsed& parsed, std::string_view text) {
  const json::LineIndex lines(text);
  std::size_t fatal = 0;
  std::uint32_t before = 0;
  for (const json::ParseError& error : parsed.errors) {
    fatal += json::is_recoverable(error.error) ? 0 : 1;
    const bool inside = error.span.begin <= error.span.end && error.span.end <= text.size();
    if (!inside || error.other.end > text.size()) return "fault outside the text";
    if (error.span.empty() && error.span.end != text.size()) return "fault without a mark";
    if (error.span.begin < before) return "faults out of order";
    before = error.span.begin;
    if (error.detail.empty() || printable(error.detail) != error.detail)
      return "words unfit to print";
    if (lines.locate(error.span).line == 0) return "fault without a line";
    if (lines.excerpt(error.span, 20).width == 0) return "fault without an excerpt";
  }
  if (fatal > 1 || (fatal == 1) != parsed.document.empty()) return "document despite a fatal fault";
  return {};
}

}  // namespace

std::string check_json(std::string_view text) {
  json::Limits limits;
  limits.depth = UINT32_MAX;
  limits.recorded_errors = UINT32_MAX;
  const Parsed parsed = json::parse(text, limits);
  for (const std::string& problem :
       {check_errors(parsed, text), check_nodes(parsed.document), check_pointers(parsed)}) {
    if (!problem.empty()) return problem;
  }
  // One parser accepts a byte order mark and the other refuses it: compare after it.
  if (has(parsed, SyntaxError::byte_order_mark)) return check_json(text.substr(3));
  std::string problem = compare_with_nlohmann(parsed, text);
  return problem.empty() ? compare_with_simdjson(parsed, text) : problem;
}

}  // namespace gltfx::fuzz
