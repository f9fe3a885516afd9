// SPDX-License-Identifier: Apache-2.0
/// Verdicts of JSON Schemas of users.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "json/parse.hpp"
#include "schema/json_schema.hpp"

namespace gltfx::schema {

/// The messages of compile().
inline std::vector<std::string> mistakes_in(std::string_view text) {
  std::vector<JsonSchema::Mistake> mistakes;
  JsonSchema::compile(text, mistakes);
  std::vector<std::string> messages;
  for (const JsonSchema::Mistake& one : mistakes) {
    EXPECT_LE(one.span.end, text.size());
    messages.push_back(one.message);
  }
  return messages;
}

struct Verdict {
  SchemaVerdict verdict = SchemaVerdict::undecided;
  SchemaFailure failure;
};

/// Checks a value that has one more member, `gltfx`, if it is an object.
inline Verdict check(std::string_view schema, std::string_view value,
                     std::uint64_t work = 1'000'000) {
  std::vector<JsonSchema::Mistake> mistakes;
  const auto compiled = JsonSchema::compile(schema, mistakes);
  EXPECT_TRUE(compiled) << schema << (mistakes.empty() ? "" : mistakes.front().message);
  if (!compiled) return {};
  const json::Parsed parsed = json::parse(value);
  const json::Parsed more = json::parse(R"({"index": 3, "parent": "hall"})");
  Verdict found;
  const CheckedObject object{parsed.document, parsed.document.root(), "gltfx",
                             [&]() -> const json::Document& { return more.document; }};
  found.verdict = compiled->check(object, work, found.failure);
  return found;
}

}  // namespace gltfx::schema
