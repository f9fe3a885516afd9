// SPDX-License-Identifier: Apache-2.0
// Reads a schema of a user into assertions.
#include <algorithm>
#include <array>
#include <unordered_map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/parse.hpp"
#include "schema/form_check.hpp"
#include "schema/json_schema.hpp"
#include "schema/json_schema_keywords.hpp"
#include "schema/source.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {
namespace {

using Kind = Assertion::Kind;
using S = Shape2020;
using json::NodeId;

// Whether the schemas of a keyword apply to the same value, and not to a part of it.
bool is_in_place(Kind kind) {
  return kind == Kind::reference || kind == Kind::all_of || kind == Kind::any_of ||
         kind == Kind::one_of || kind == Kind::not_ || kind == Kind::condition ||
         kind == Kind::dependent_schemas;
}

}  // namespace

/// Compiles one text, with a list of schemas still to read.
class JsonSchemaCompiler {
 public:
  JsonSchemaCompiler(JsonSchema& schema, std::vector<JsonSchema::Mistake>& mistakes)
      : schema_(schema), document_(schema.document_), mistakes_(mistakes) {}

  void run() {
    request(document_.root());
    // Schemas are numbered when they are met, and read afterwards.
    for (std::size_t next = 0; next < sites_.size(); ++next) {
      Subschema made = read(sites_[next]);
      schema_.subschemas_[next] = std::move(made);
    }
    if (mistakes_.empty()) find_loop();
  }

 private:
  void mistake(NodeId at, std::string message) {
    constexpr std::size_t kMost = 20;
    if (mistakes_.size() < kMost) mistakes_.push_back({document_.span(at), std::move(message)});
  }

  std::uint32_t request(NodeId site) {
    const auto [known, fresh] = ids_.emplace(site, static_cast<std::uint32_t>(sites_.size()));
    if (fresh) {
      sites_.push_back(site);
      schema_.subschemas_.emplace_back();
    }
    return known->second;
  }

  Subschema read(NodeId site) {
    Subschema made;
    if (document_.is_boolean(site)) {
      made.never = document_.kind(site) == json::Kind::false_value;
      return made;
    }
    if (!document_.is_object(site)) {
      mistake(site, "a schema must be an object, true or false");
      return made;
    }
    for (const auto& member : document_.members(site)) {
      const std::string_view name = document_.key(member.key_id);
      const Keyword2020* keyword = find_keyword(name);
      if (keyword == nullptr) {
        mistake(member.key, unknown_keyword(name));
      } else {
        read_keyword(*keyword, site, member.value, made);
      }
    }
    check_companions(site);
    return made;
  }

  // Keywords that say nothing without another one.
  void check_companions(NodeId site) {
    constexpr std::array<std::array<std::string_view, 2>, 4> kPairs{
        {{"then", "if"}, {"else", "if"}, {"minContains", "contains"}, {"maxContains", "contains"}}};
    for (const auto& [name, other] : kPairs) {
      const NodeId value = document_.find(site, name);
      if (value == json::kNoNode || document_.find(site, other) != json::kNoNode) continue;
      mistake(value - 1, fmt::format("'{}' says nothing without '{}'", name, other));
    }
  }

  void read_keyword(const Keyword2020& keyword, NodeId site, NodeId value, Subschema& made) {
    if (keyword.shape == S::annotation) return check_annotation(keyword, site, value);
    if (keyword.name == "$defs") {
      // Also those that nothing refers to: a mistake in one is a mistake.
      for_members(keyword, value, [&](NodeId, NodeId inner) { request(inner); });
    }
    if (keyword.shape == S::consumed) return;
    Assertion assertion;
    assertion.kind = keyword.kind;
    read_value(keyword, value, assertion);
    if (keyword.kind == Kind::contains) read_contains(site, assertion);
    if (keyword.kind == Kind::condition) {
      for (const std::string_view branch : {"then", "else"}) {
        const NodeId node = document_.find(site, branch);
        assertion.schemas.push_back(node == json::kNoNode ? kNoSchema : request(node));
      }
    }
    if (keyword.kind == Kind::unique_items && assertion.most == 0) return;
    if (keyword.kind == Kind::items) assertion.least = prefix_size(site);
    if (keyword.kind == Kind::additional_properties) read_siblings(site, assertion);
    made.assertions.push_back(std::move(assertion));
  }

  void check_annotation(const Keyword2020& keyword, NodeId site, NodeId value) {
    if (keyword.name == "$id" && site != document_.root()) {
      // References below would start from there.
      return mistake(value, "only the whole schema may have an '$id'");
    }
    if (keyword.name != "$schema") return;
    if (const auto flaw = FormCheck(document_).flaw(Form::dialect, value)) {
      mistake(value, fmt::format("'$schema' {}", flaw->message));
    }
  }

  template <class Use>
  void for_members(const Keyword2020& keyword, NodeId value, const Use& use) {
    if (!document_.is_object(value)) {
      return mistake(value, fmt::format("'{}' must be an object", keyword.name));
    }
    for (const auto& member : document_.members(value)) use(member.key, member.value);
  }

  void read_value(const Keyword2020& keyword, NodeId value, Assertion& into) {
    switch (keyword.shape) {
      case S::type:
        return read_types(value, into);
      case S::literal:
        return into.literals.push_back(value);
      case S::literals:
        return read_literals(keyword, value, into);
      case S::number:
        return read_number(keyword, value, into);
      case S::count:
        return read_count(keyword, value, into);
      case S::flag:
        if (!document_.is_boolean(value)) mistake(value, "'uniqueItems' must be true or false");
        into.most = document_.kind(value) == json::Kind::true_value ? 1 : 0;
        return;
      case S::pattern:
        if (!document_.is_string(value)) return mistake(value, "'pattern' must be a string");
        return add_pattern(value, document_.string(value), into);
      case S::names:
        into.names = names(keyword, value);
        return;
      default:
        return read_schemas(keyword, value, into);
    }
  }

  void read_schemas(const Keyword2020& keyword, NodeId value, Assertion& into) {
    switch (keyword.shape) {
      case S::schema:
        return into.schemas.push_back(request(value));
      case S::schemas:
        if (document_.kind(value) != json::Kind::array || document_.array_size(value) == 0) {
          return mistake(value, fmt::format("'{}' must be a list of schemas", keyword.name));
        }
        for (const NodeId one : document_.elements(value)) into.schemas.push_back(request(one));
        return;
      case S::schema_map:
        return for_members(keyword, value, [&](NodeId key, NodeId inner) {
          into.names.push_back(document_.string(key));
          into.schemas.push_back(request(inner));
        });
      case S::pattern_map:
        return for_members(keyword, value, [&](NodeId key, NodeId inner) {
          add_pattern(key, document_.string(key), into);
          into.schemas.push_back(request(inner));
        });
      case S::names_map:
        return for_members(keyword, value, [&](NodeId key, NodeId inner) {
          into.names.push_back(document_.string(key));
          into.lists.push_back(names(keyword, inner));
        });
      default:
        return read_reference(value, into);
    }
  }

  void read_types(NodeId value, Assertion& into) {
    const auto add = [&](NodeId word) {
      const std::string name = document_.is_string(word) ? document_.string(word) : std::string();
      const std::uint8_t bit = type_bit(name);
      if (bit == 0) {
        mistake(word,
                "'type' must be object, array, string, number, integer, boolean or null, or a list "
                "of them");
      }
      into.types = static_cast<std::uint8_t>(into.types | bit);
    };
    if (document_.kind(value) != json::Kind::array) return add(value);
    for (const NodeId word : document_.elements(value)) add(word);
    if (into.types == 0) mistake(value, "'type' must name a type");
  }

  // A list of numbers is one node without elements; its values are compared as a whole list.
  void read_literals(const Keyword2020& keyword, NodeId value, Assertion& into) {
    if (!document_.is_array(value)) {
      return mistake(value, fmt::format("'{}' must be a list of values", keyword.name));
    }
    if (document_.kind(value) == json::Kind::number_array) {
      into.literals.push_back(value);
      into.least = 1;  // each of its numbers is a literal
      return;
    }
    for (const NodeId one : document_.elements(value)) into.literals.push_back(one);
  }

  void read_number(const Keyword2020& keyword, NodeId value, Assertion& into) {
    if (!document_.is_number(value)) {
      return mistake(value, fmt::format("'{}' must be a number", keyword.name));
    }
    into.number = document_.number(value).value;
    if (keyword.kind == Kind::multiple_of && into.number <= 0) {
      mistake(value, "'multipleOf' must be greater than 0");
    }
  }

  std::uint64_t count(std::string_view name, NodeId value) {
    const auto number = document_.is_number(value) ? document_.unsigned_integer(value)
                                                   : std::optional<std::uint64_t>();
    if (!number) mistake(value, fmt::format("'{}' must be a whole number of at least 0", name));
    return number.value_or(0);
  }

  void read_count(const Keyword2020& keyword, NodeId value, Assertion& into) {
    into.least = into.most = count(keyword.name, value);
  }

  void read_contains(NodeId site, Assertion& into) {
    into.least = 1;
    if (const NodeId least = document_.find(site, "minContains"); least != json::kNoNode) {
      into.least = count("minContains", least);
    }
    if (const NodeId most = document_.find(site, "maxContains"); most != json::kNoNode) {
      into.most = count("maxContains", most);
    }
  }

  std::uint64_t prefix_size(NodeId site) const {
    const NodeId prefix = document_.find(site, "prefixItems");
    return prefix != json::kNoNode && document_.is_array(prefix) ? document_.array_size(prefix) : 0;
  }

  // Names and patterns of members that additionalProperties does not apply to.
  void read_siblings(NodeId site, Assertion& into) {
    const NodeId named = document_.find(site, "properties");
    if (named != json::kNoNode && document_.is_object(named)) {
      for (const auto& member : document_.members(named)) {
        into.names.emplace_back(document_.key(member.key_id));
      }
      std::sort(into.names.begin(), into.names.end());
    }
    const NodeId patterns = document_.find(site, "patternProperties");
    if (patterns == json::kNoNode || !document_.is_object(patterns)) return;
    for (const auto& member : document_.members(patterns)) {
      auto compiled = Pattern::compile(document_.key(member.key_id));
      if (compiled) into.patterns.push_back(*std::move(compiled));
    }
  }

  void add_pattern(NodeId at, std::string_view expression, Assertion& into) {
    auto compiled = Pattern::compile(expression);
    if (!compiled) {
      return mistake(at, fmt::format("the pattern {} is not understood: {}", quoted(expression),
                                     compiled.error().message));
    }
    into.patterns.push_back(*std::move(compiled));
  }

  std::vector<std::string> names(const Keyword2020& keyword, NodeId value) {
    std::vector<std::string> all;
    if (document_.kind(value) != json::Kind::array) {
      mistake(value, fmt::format("'{}' must have lists of names", keyword.name));
      return all;
    }
    for (const NodeId name : document_.elements(value)) {
      if (!document_.is_string(name)) {
        mistake(name, fmt::format("'{}' must have lists of names", keyword.name));
      } else {
        all.push_back(document_.string(name));
      }
    }
    return all;
  }

  void read_reference(NodeId value, Assertion& into) {
    const std::string text = document_.is_string(value) ? document_.string(value) : std::string();
    NodeId target = json::kNoNode;
    std::optional<std::uint64_t> element;
    if (text.starts_with('#')) target = document_.resolve(text.substr(1), &element);
    const bool escaped = text.find('%') != std::string::npos;  // "%20" may stand for a space
    if (target == json::kNoNode || element || escaped) {
      return mistake(value, fmt::format("'$ref' must name a schema of this page, as in "
                                        "'#/$defs/NAME'; there is no {}",
                                        quoted(text)));
    }
    into.schemas.push_back(request(target));
  }

  // A schema that is part of itself for one and the same value says nothing.
  void find_loop() {
    enum class State : std::uint8_t { fresh, open, done };
    std::vector<State> states(sites_.size(), State::fresh);
    std::vector<std::pair<std::uint32_t, bool>> stack;  // true: all below it is done
    for (std::uint32_t start = 0; start < states.size(); ++start) {
      stack.emplace_back(start, false);
      while (!stack.empty()) {
        const auto [id, leave] = stack.back();
        stack.pop_back();
        if (leave) {
          states[id] = State::done;
        } else if (states[id] == State::open) {
          return mistake(sites_[id], "the schema refers to itself without a member in between");
        } else if (states[id] == State::fresh) {
          states[id] = State::open;
          stack.emplace_back(id, true);
          for_in_place(id, [&](std::uint32_t inner) {
            if (states[inner] != State::done) stack.emplace_back(inner, false);
          });
        }
      }
    }
  }

  template <class Use>
  void for_in_place(std::uint32_t id, const Use& use) const {
    for (const Assertion& assertion : schema_.subschemas_[id].assertions) {
      if (!is_in_place(assertion.kind)) continue;
      for (const std::uint32_t inner : assertion.schemas) {
        if (inner != kNoSchema) use(inner);
      }
    }
  }

  JsonSchema& schema_;
  const json::Document& document_;
  std::vector<JsonSchema::Mistake>& mistakes_;
  std::vector<NodeId> sites_;
  std::unordered_map<NodeId, std::uint32_t> ids_;
};

std::optional<JsonSchema> JsonSchema::compile(std::string_view text,
                                              std::vector<Mistake>& mistakes) {
  const json::Limits limits{.depth = kDeepestText};
  json::Parsed parsed = json::parse(text, limits);
  for (const json::ParseError& error : parsed.errors) {
    mistakes.push_back({error.span, json_mistake(error)});
  }
  if (!mistakes.empty()) return std::nullopt;
  JsonSchema schema;
  schema.document_ = std::move(parsed.document);
  JsonSchemaCompiler(schema, mistakes).run();
  if (!mistakes.empty()) return std::nullopt;
  return schema;
}

}  // namespace gltfx::schema
