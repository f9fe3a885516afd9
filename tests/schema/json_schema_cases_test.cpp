// SPDX-License-Identifier: Apache-2.0
/// JSON Schema 2020-12: each keyword at its edges. The verdicts are those that the specification
/// states (https://json-schema.org/draft/2020-12).
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_schema_verdict.hpp"

namespace gltfx::schema {
namespace {

struct SchemaCase {
  std::string_view schema;
  std::vector<std::string_view> fit = {};  ///< values
  std::vector<std::string_view> fail = {};
};

void expect_verdicts(const std::vector<SchemaCase>& cases) {
  for (const SchemaCase& one : cases) {
    for (const std::string_view value : one.fit) {
      const Verdict found = check(one.schema, value);
      EXPECT_EQ(found.verdict, SchemaVerdict::fits)
          << one.schema << " on " << value << ": " << found.failure.reason;
    }
    for (const std::string_view value : one.fail) {
      const Verdict found = check(one.schema, value);
      EXPECT_EQ(found.verdict, SchemaVerdict::fails) << one.schema << " on " << value;
      EXPECT_NE(found.failure.reason, "") << one.schema << " on " << value;
    }
  }
}

TEST(JsonSchemaCases, BooleanSchemas) {
  expect_verdicts({
      {"true", {"null", "{}", "[]", "1"}},
      {"false", {}, {"null", "{}", "[]", "1"}},
      {"{}", {"null", "{}", "[1, \"a\"]", "\"a\""}},
      {R"({"not": false})", {"1", "null"}},
      {R"({"not": {}})", {}, {"1", "null"}},
  });
}

TEST(JsonSchemaCases, Type) {
  expect_verdicts({
      {R"({"type": "integer"})",
       {"1", "1.0", "1e2", "-0", "1e300"},
       {"1.5", "\"1\"", "true", "null"}},
      {R"({"type": "number"})", {"1", "1.5", "-1e-5"}, {"\"1\"", "false", "[1]"}},
      {R"({"type": "boolean"})", {"true", "false"}, {"0", "null", "\"true\""}},
      {R"({"type": "null"})", {"null"}, {"false", "0", "\"\"", "[]", "{}"}},
      {R"({"type": "array"})", {"[]", "[1]", "[{}]"}, {"{}", "\"[]\""}},
      {R"({"type": "object"})", {"{}", R"({"a": 1})"}, {"[]", "null"}},
      {R"({"type": "string"})", {"\"\"", "\"1\""}, {"1", "[]"}},
      {R"({"type": ["integer", "string"]})", {"1", "\"a\""}, {"1.5", "null"}},
      {R"({"items": {"type": "integer"}})", {"[1, 2.0]", "[]", "1"}, {"[1, 2.5]"}},
  });
}

TEST(JsonSchemaCases, ConstAndEnum) {
  expect_verdicts({
      {R"({"const": 1})", {"1", "1.0", "10e-1"}, {"true", "\"1\"", "[1]", "1.0000001"}},
      {R"({"const": 0})", {"0", "-0", "0.0", "-0.0"}, {"false", "null", "\"\""}},
      {R"({"const": false})", {"false"}, {"0", "null", "\"false\""}},
      {R"({"const": null})", {"null"}, {"0", "false", "\"\""}},
      {R"({"const": [0]})", {"[0]", "[0.0]", "[-0.0]"}, {"[false]", "0", "[]", "[0, 0]"}},
      {R"({"const": []})", {"[]"}, {"{}", "[[]]", "null"}},
      {R"({"const": {"a": 1, "b": [true]}})",
       {R"({"b": [true], "a": 1.0})"},
       {R"({"a": 1})", R"({"a": 1, "b": [true], "c": 1})", R"({"a": 1, "b": [1]})"}},
      {R"({"const": "\u00e4"})", {"\"ä\"", "\"\\u00E4\""}, {"\"a\"", "\"a\\u0308\""}},
      {R"({"const": 0.12345678901234568})", {"0.12345678901234568"}, {"0.123"}},
      {R"({"enum": [1, 2]})", {"1", "2.0"}, {"3", "[1, 2]", "\"1\"", "true"}},
      {R"({"enum": [[1, 2], 3]})", {"[1, 2]", "3"}, {"1", "2", "[2, 1]"}},
      {R"({"enum": ["a", 1, null, {}]})", {"\"a\"", "1", "null", "{}"}, {"\"A\"", "false", "[]"}},
      {R"({"enum": [false]})", {"false"}, {"0", "[false]"}},
  });
}

TEST(JsonSchemaCases, Numbers) {
  expect_verdicts({
      {R"({"minimum": 1.1})", {"1.1", "2", "\"0\"", "null"}, {"1.09999"}},
      {R"({"exclusiveMinimum": 0})", {"1e-300"}, {"0", "-0", "-1"}},
      {R"({"maximum": -2})", {"-2", "-2.0001"}, {"-1.9999", "0"}},
      {R"({"exclusiveMaximum": 3})", {"2.9999999"}, {"3", "3.0"}},
      {R"({"multipleOf": 2})",
       {"0", "-4", "1e20", "\"a\"", "9007199254740990"},
       {"1", "1000000001", "2.5", "9007199254740991"}},
      {R"({"multipleOf": 0.01})",
       {"0.07", "4.35", "1.1", "19.99", "1000000.01", "0"},
       {"0.075", "4.355", "1.005", "0.0000001"}},
      {R"({"multipleOf": 0.1})", {"0.3", "0.7", "-1.1", "3"}, {"0.35", "3.05"}},
      {R"({"multipleOf": 1e-8})", {"12391239123", "0.00000001"}, {"0.000000015"}},
      {R"({"multipleOf": 0.123456789})", {"0.246913578"}, {"1e308", "1"}},
      {R"({"multipleOf": 2.5})", {"5", "7.5", "-2.5"}, {"6", "1"}},
      {R"({"multipleOf": 10})", {"10000000000"}, {"10000000001"}},
  });
}

TEST(JsonSchemaCases, Texts) {
  expect_verdicts({
      {R"({"minLength": 2.0, "maxLength": 2})",
       {"\"ab\"", "\"äö\"", "\"\\ud83d\\ude00b\"", "\"\xF0\x9F\x98\x80\xF0\x9F\x98\x80\"", "12",
        "[]"},
       {"\"a\"", "\"abc\"", "\"\xF0\x9F\x98\x80\""}},
      {R"({"maxLength": 0})", {"\"\"", "{}"}, {"\" \""}},
      {R"({"pattern": "a+"})", {"\"xxaayy\"", "1", "null"}, {"\"\"", "\"b\""}},
      {R"({"pattern": "^.$"})",
       {"\"\xF0\x9F\x98\x80\"", "\"\\ud83d\\ude00\"", "\"ä\""},
       {"\"ab\"", "\"\""}},
      {R"({"pattern": "^[ä-ü]+$"})", {"\"äöü\"", "\"\\u00f6\""}, {"\"aou\""}},
      {R"({"pattern": "^\\u00e4\\w$"})", {"\"äb\""}, {"\"ää\"", "\"ab\""}},
      {R"({"pattern": "^\\S+$"})",
       {"\"a\xE2\x80\x8B\""},
       {"\"a b\"", "\"a\\u00a0\"", "\"a\\ufeff\""}},
      {R"({"pattern": "^\\d$"})", {"\"7\""}, {"\"\xD9\xA3\""}},
      {R"({"pattern": "^a$"})", {"\"a\""}, {"\"a\\n\"", "\"b\\na\""}},
  });
}

TEST(JsonSchemaCases, Arrays) {
  expect_verdicts({
      {R"({"minItems": 1, "maxItems": 2.0})", {"[1]", R"([1, "a"])", "{}"}, {"[]", "[1, 2, 3]"}},
      {R"({"items": false})", {"[]", "{}", "1"}, {"[1]", "[null]"}},
      {R"({"prefixItems": [{"type": "string"}, {"type": "number"}]})",
       {"[]", R"(["a"])", R"(["a", 1])", R"(["a", 1, null])", "{}"},
       {"[1]", R"(["a", "b"])"}},
      {R"({"prefixItems": [true], "items": {"type": "string"}})",
       {"[1]", R"([1, "a"])", "[]"},
       {"[1, 2]", R"(["a", "b", 3])"}},
      {R"({"prefixItems": [{"const": 1}], "items": false})", {"[1]", "[]"}, {"[1, 1]", "[2]"}},
      {R"({"allOf": [{"prefixItems": [{"minimum": 3}]}], "items": {"minimum": 5}})",
       {"[5, 5]"},
       {"[3, 5]", "[1, 5]"}},
      {R"({"items": {"items": {"type": "integer"}}})", {"[[1], [], [2, 3]]"}, {"[[1], [1.5]]"}},
  });
}

TEST(JsonSchemaCases, Contains) {
  expect_verdicts({
      {R"({"contains": {"const": 1}})", {"[1]", "[0, 1]", "{}"}, {"[]", "[0]"}},
      {R"({"contains": true})", {"[null]"}, {"[]"}},
      {R"({"contains": false})", {"1"}, {"[]", "[1]"}},
      {R"({"contains": {"const": 1}, "minContains": 0})", {"[]", "[0]", "[1, 1]"}},
      {R"({"contains": false, "minContains": 0})", {"[]", "[1]"}},
      {R"({"contains": {"const": 1}, "minContains": 0, "maxContains": 1})",
       {"[]", "[1, 0]"},
       {"[1, 1]"}},
      {R"({"contains": {"const": 1}, "minContains": 2.0, "maxContains": 3})",
       {"[1, 1]", "[1, 0, 1, 1]"},
       {"[1]", "[1, 1, 1, 1]", "[]"}},
      {R"({"contains": {"const": 1}, "minContains": 2, "maxContains": 1})",
       {},
       {"[]", "[1]", "[1, 1]"}},
  });
}

TEST(JsonSchemaCases, UniqueItems) {
  expect_verdicts({
      {R"({"uniqueItems": true})",
       {"[]", "[1, 2]", "[1, true]", "[0, false]", "[0, null]", R"(["1", 1])", "[[1], [true]]",
        R"([{"a": 1}, {"a": 2}])", R"([{"a": 1}, {"a": true}])", "[[], {}]", R"([1, "1"])",
        R"([{"a": [1, 2]}, {"a": [2, 1]}])"},
       {"[1, 1]", "[1, 1.0]", "[0, -0.0]", "[1e2, 100]", R"(["a", "\u0061"])", "[[1], [1.0]]",
        "[[0], [-0]]", R"([{"a": 1, "b": 2}, {"b": 2.0, "a": 1}])", "[{}, {}]", "[[], 1, []]",
        "[true, 1, true]", "[null, null]"}},
      {R"({"uniqueItems": false})", {"[1, 1]"}},
  });
}

TEST(JsonSchemaCases, Members) {
  expect_verdicts({
      {R"({"required": []})", {"{}", "1"}},
      {R"({"required": ["a\nb", "c"]})", {R"({"a\nb": 1, "c": null})"}, {R"({"a": 1, "c": 1})"}},
      {R"({"properties": {"a": false, "b": true}})", {"{}", R"({"b": 1})", "[]"}, {R"({"a": 1})"}},
      {R"({"minProperties": 1, "maxProperties": 2.0})",
       {R"({"a": 1})", "[]"},
       {"{}", R"({"a": 1, "b": 1, "c": 1})"}},
      {R"({"patternProperties": {"^a": {"type": "integer"}, "b$": {"minimum": 5}}})",
       {R"({"ab": 5})", R"({"a": 1})", R"({"b": 5.5})", R"({"c": "x"})"},
       {R"({"ab": 4})", R"({"ab": 5.5})", R"({"a": "x"})"}},
      {R"({"properties": {"a": {"maximum": 3}}, "patternProperties": {"a": {"minimum": 2}}})",
       {R"({"a": 2})"},
       {R"({"a": 1})", R"({"a": 4})"}},
      {R"({"additionalProperties": {"type": "boolean"}})",
       {"{}", R"({"x": true})"},
       {R"({"x": 1})"}},
      {R"({"properties": {"a": {}}, "patternProperties": {"^x": {}}, "additionalProperties": false})",
       {R"({"a": 1, "xy": 2})"},
       {R"({"b": 1})"}},
      {R"({"allOf": [{"properties": {"a": {}}}], "additionalProperties": false})",
       {"{}"},
       {R"({"a": 1})"}},
      {R"({"propertyNames": {"pattern": "^[a-z]+$", "maxLength": 3}})",
       {"{}", R"({"abc": 1})", "[]"},
       {R"({"abcd": 1})", R"({"A": 1})"}},
      {R"({"propertyNames": false})", {"{}", "1"}, {R"({"a": 1})"}},
      {R"({"propertyNames": {"enum": ["a", "b"]}})", {R"({"a": 1})"}, {R"({"c": 1})"}},
  });
}

TEST(JsonSchemaCases, Dependent) {
  expect_verdicts({
      {R"({"dependentRequired": {"a": [], "b": ["c", "d"]}})",
       {"{}", R"({"a": 1})", R"({"b": 1, "c": 1, "d": 1})", R"({"c": 1})", "[]"},
       {R"({"b": 1, "c": 1})"}},
      {R"({"dependentSchemas": {"a": {"properties": {"b": {"type": "integer"}}}, "x": false,
                                "y": true}})",
       {R"({"b": "s"})", R"({"a": 1, "b": 2})", R"({"y": 1})", "\"a\""},
       {R"({"a": 1, "b": "s"})", R"({"x": 1})"}},
      {R"({"dependentSchemas": {"a": {"minProperties": 2}, "b": {"required": ["c"]}}})",
       {R"({"a": 1, "b": 1, "c": 1})"},
       {R"({"a": 1})", R"({"a": 1, "b": 1})"}},
  });
}

TEST(JsonSchemaCases, Combinations) {
  expect_verdicts({
      {R"({"allOf": [{"minimum": 1}, {"maximum": 3}], "multipleOf": 2})", {"2"}, {"0", "4", "1"}},
      {R"({"anyOf": [{"type": "integer"}, {"minimum": 2}]})", {"1", "2.5", "3"}, {"1.5"}},
      {R"({"anyOf": [false, true]})", {"1"}},
      {R"({"oneOf": [{"type": "integer"}, {"minimum": 2}]})", {"1", "2.5"}, {"3", "1.5"}},
      {R"({"oneOf": [true, true, false]})", {}, {"1"}},
      {R"({"not": {"type": ["integer", "boolean"]}})", {"\"a\"", "1.5"}, {"1", "true"}},
      {R"({"not": {"not": {"type": "null"}}})", {"null"}, {"1"}},
      {R"({"if": {"const": 1}})", {"1", "2"}},
      {R"({"if": {"maximum": 0}, "then": {"minimum": -10}})", {"-1", "5"}, {"-100"}},
      {R"({"if": {"maximum": 0}, "else": {"multipleOf": 2}})", {"-1", "4"}, {"3"}},
      {R"({"if": true, "then": {"const": 1}, "else": {"const": 2}})", {"1"}, {"2"}},
      {R"({"if": false, "then": {"const": 1}, "else": {"const": 2}})", {"2"}, {"1"}},
  });
}

TEST(JsonSchemaCases, References) {
  expect_verdicts({
      // Keywords beside '$ref' apply.
      {R"({"properties": {"a": {"$ref": "#/$defs/list", "maxItems": 2}},
           "$defs": {"list": {"type": "array"}}})",
       {R"({"a": []})", "{}"},
       {R"({"a": [1, 2, 3]})", R"({"a": "b"})"}},
      {R"({"$ref": "#/$defs/a", "$defs": {"a": {"$ref": "#/$defs/b", "minimum": 2},
                                          "b": {"type": "integer"}}})",
       {"2"},
       {"1", "2.5"}},
      {R"({"properties": {"next": {"$ref": "#"}}, "additionalProperties": false})",
       {R"({"next": {"next": {}}})"},
       {R"({"next": {"last": 1}})"}},
      {R"({"$ref": "#/properties/a", "properties": {"a": {"type": "object"}}})",
       {R"({"a": {}})", "{}"},
       {"1", R"({"a": 1})"}},
      {R"({"$ref": "#/allOf/1", "allOf": [true, {"minimum": 1}]})", {"1"}, {"0"}},
      {R"({"$ref": "#/$defs/a~1b~0c", "$defs": {"a/b~c": {"const": 1}}})", {"1"}, {"2"}},
      {R"({"$ref": "#/$defs/yes", "$defs": {"yes": true, "no": false}})", {"1"}},
      {R"({"$ref": "#/$defs/no", "$defs": {"yes": true, "no": false}})", {}, {"1"}},
      // A member that is named '$ref' is none.
      {R"({"properties": {"$ref": {"type": "string"}}})", {R"({"$ref": "a"})"}, {R"({"$ref": 2})"}},
      // A reference inside a value is none.
      {R"({"const": {"$ref": "#/$defs/a"}, "$defs": {"a": true}})",
       {R"({"$ref": "#/$defs/a"})"},
       {"1"}},
  });
}

// What a rule cannot have, whatever its value: none of it passes unseen.
TEST(JsonSchemaCases, KeywordsThatAreOutAreMistakes) {
  for (const char* const keyword :
       {"$anchor", "$dynamicAnchor", "$dynamicRef", "$vocabulary", "unevaluatedItems",
        "unevaluatedProperties", "format", "contentEncoding", "contentMediaType", "contentSchema",
        "$recursiveRef", "$recursiveAnchor", "definitions", "dependencies", "additionalItems"}) {
    const std::string name(keyword);
    EXPECT_THAT(mistakes_in("{\"" + name + "\": true}"),
                testing::ElementsAre(
                    testing::HasSubstr("'" + name + "' is a keyword that rules do not have")));
    EXPECT_THAT(mistakes_in("{\"items\": {\"allOf\": [{\"" + name + "\": \"a\"}]}}"),
                testing::SizeIs(1))
        << name;
    // As the name of a member it is like any other.
    EXPECT_THAT(mistakes_in("{\"properties\": {\"" + name + "\": {}}}"), testing::IsEmpty());
  }
}

TEST(JsonSchemaCases, ValuesThatTheSpecificationForbidsAreMistakes) {
  for (const char* const schema :
       {R"({"type": []})",
        R"({"type": ["text"]})",
        R"({"type": 1})",
        R"({"enum": 1})",
        R"({"minimum": null})",
        R"({"multipleOf": 0})",
        R"({"multipleOf": -1})",
        R"({"minLength": -1})",
        R"({"maxLength": 1.5})",
        R"({"minItems": "1"})",
        R"({"pattern": 1})",
        R"({"pattern": "["})",
        R"({"uniqueItems": 1})",
        R"({"items": []})",
        R"({"items": [{}]})",
        R"({"prefixItems": {}})",
        R"({"prefixItems": []})",
        R"({"contains": 1})",
        R"({"contains": {}, "minContains": -1})",
        R"({"required": "a"})",
        R"({"required": [1]})",
        R"({"properties": []})",
        R"({"properties": {"a": 1}})",
        R"({"patternProperties": {"(": {}}})",
        R"({"additionalProperties": 1})",
        R"({"dependentRequired": {"a": "b"}})",
        R"({"dependentSchemas": {"a": ["b"]}})",
        R"({"allOf": []})",
        R"({"anyOf": {}})",
        R"({"oneOf": [1]})",
        R"({"not": []})",
        R"({"if": 1})",
        R"({"$ref": 1})",
        R"({"$ref": "a.json"})",
        R"({"$ref": "#a"})",
        R"({"$ref": "#/$defs/a%20b", "$defs": {"a b": {}, "a%20b": {}}})",
        R"({"$defs": []})",
        R"({"items": {"$id": "https://example.com/part"}})",
        R"({"$schema": "http://json-schema.org/draft-07/schema#"})"}) {
    EXPECT_THAT(mistakes_in(schema), testing::Not(testing::IsEmpty())) << schema;
  }
}

// Keywords that assert nothing without another one, which JSON Schema ignores.
TEST(JsonSchemaCases, KeywordsWithoutTheirPartnerAreMistakes) {
  for (const char* const keyword : {"then", "else", "minContains", "maxContains"}) {
    EXPECT_THAT(mistakes_in("{\"" + std::string(keyword) + "\": 1}"),
                testing::ElementsAre(testing::HasSubstr("says nothing without")))
        << keyword;
  }
}

}  // namespace
}  // namespace gltfx::schema
