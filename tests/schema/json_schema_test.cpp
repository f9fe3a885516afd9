// SPDX-License-Identifier: Apache-2.0
/// JSON Schemas of users: verdicts of each keyword, mistakes, and limits.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_schema_verdict.hpp"

namespace gltfx::schema {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void expect_fits(std::string_view schema, std::string_view value) {
  const Verdict found = check(schema, value);
  EXPECT_EQ(found.verdict, SchemaVerdict::fits) << schema << " " << value << found.failure.reason;
}

// "pointer: reason" of the first failure.
std::string why_not(std::string_view schema, std::string_view value) {
  const Verdict found = check(schema, value);
  EXPECT_EQ(found.verdict, SchemaVerdict::fails) << schema << " " << value;
  return found.failure.pointer + ": " + found.failure.reason;
}

TEST(JsonSchema, ChecksTypes) {
  expect_fits(R"({"type": "object"})", "{}");
  expect_fits(R"({"type": ["array", "null"]})", "null");
  expect_fits(R"({"type": "integer"})", "3.0");
  EXPECT_EQ(why_not(R"({"type": "integer"})", "3.5"), ": it is a number and must be an integer");
  EXPECT_EQ(why_not(R"({"type": ["string", "null"]})", "[]"),
            ": it is an array and must be a string or null");
}

TEST(JsonSchema, ComparesValues) {
  expect_fits(R"({"const": {"a": [1, 2], "b": "x"}})", R"({"b": "x", "a": [1.0, 2]})");
  expect_fits(R"({"enum": [1, 2, 3]})", "2");
  expect_fits(R"({"items": {"enum": [0, 1]}})", "[0, 1, 1, 0.0]");
  expect_fits(R"({"enum": ["a", null]})", "null");
  EXPECT_EQ(why_not(R"({"items": {"enum": [0, 1]}})", "[0, 5]"), "/1: 5 is not 0 or 1");
  EXPECT_EQ(why_not(R"({"properties": {"a": {"const": "BLEND"}}})", R"({"a": "MASK"})"),
            R"(/a: "MASK" is not "BLEND")");
}

TEST(JsonSchema, LimitsNumbersAndLengths) {
  expect_fits(R"({"minimum": 1, "maximum": 2, "multipleOf": 0.5})", "1.5");
  EXPECT_EQ(why_not(R"({"minimum": 1})", "0.5"), ": 0.5 is less than 1");
  EXPECT_EQ(why_not(R"({"exclusiveMinimum": 1})", "1"), ": 1 is not greater than 1");
  EXPECT_EQ(why_not(R"({"maximum": 1})", "2"), ": 2 is greater than 1");
  EXPECT_EQ(why_not(R"({"exclusiveMaximum": 1})", "1"), ": 1 is not less than 1");
  EXPECT_EQ(why_not(R"({"multipleOf": 2})", "3"), ": 3 is not a multiple of 2");
  expect_fits(R"({"minLength": 2, "maxLength": 2})", "\"ää\"");
  EXPECT_EQ(why_not(R"({"minLength": 3})", "\"ää\""),
            ": it has 2 characters and must have at least 3");
  EXPECT_EQ(why_not(R"({"maxLength": 1})", "\"ää\""),
            ": it has 2 characters and must have at most 1");
  EXPECT_EQ(why_not(R"({"pattern": "^SM_"})", "\"Cube\""), ": 'Cube' does not match '^SM_'");
}

TEST(JsonSchema, ChecksArrays) {
  expect_fits(R"({"prefixItems": [{"type": "string"}], "items": {"type": "number"}})",
              R"(["a", 1, 2])");
  EXPECT_EQ(why_not(R"({"prefixItems": [{}], "items": false})", "[1, 2]"),
            "/1: nothing is allowed here");
  EXPECT_EQ(why_not(R"({"minItems": 3})", "[1, 2]"),
            ": it has 2 elements and must have at least 3");
  EXPECT_EQ(why_not(R"({"maxItems": 1})", R"(["a", "b"])"),
            ": it has 2 elements and must have at most 1");
  expect_fits(R"({"contains": {"minimum": 5}, "maxContains": 1})", "[1, 9]");
  EXPECT_THAT(why_not(R"({"contains": {"minimum": 5}})", "[1, 2]"), HasSubstr("0 of its elements"));
  EXPECT_THAT(why_not(R"({"contains": {}, "maxContains": 1})", "[1, 2]"), HasSubstr("more than 1"));
  expect_fits(R"({"contains": {"const": 7}, "minContains": 0})", "[1]");
}

TEST(JsonSchema, FindsEqualElements) {
  expect_fits(R"({"uniqueItems": true})", R"([{"a": 1}, {"a": 2}, [1, 2], [2, 1], "1", 1, null])");
  expect_fits(R"({"uniqueItems": false})", "[1, 1]");
  EXPECT_EQ(why_not(R"({"uniqueItems": true})", "[3, 1, 2, 1.0]"), ": elements 1 and 3 are equal");
  EXPECT_EQ(why_not(R"({"uniqueItems": true})", R"([{"a": 1, "b": [0]}, 5, {"b": [0.0], "a": 1}])"),
            ": elements 0 and 2 are equal");
}

TEST(JsonSchema, ChecksMembers) {
  EXPECT_EQ(why_not(R"({"required": ["name"]})", "{}"), ": 'name' is missing");
  EXPECT_EQ(why_not(R"({"properties": {"a": {"required": ["b"]}}})", R"({"a": {}})"),
            "/a: 'b' is missing");
  EXPECT_EQ(why_not(R"({"properties": {"a": {}}, "patternProperties": {"^x-": {}},
                        "additionalProperties": false})",
                    R"({"a": 1, "x-b": 2, "c": 3})"),
            ": 'c' is not allowed");
  EXPECT_EQ(why_not(R"({"patternProperties": {"^n": {"type": "number"}}})", R"({"n1": ""})"),
            "/n1: it is a string and must be a number");
  EXPECT_EQ(why_not(R"({"propertyNames": {"maxLength": 2}})", R"({"abc": 1})"),
            "/abc: the name is not allowed: it has 3 characters and must have at most 2");
  EXPECT_EQ(why_not(R"({"minProperties": 1})", "{}"),
            ": it has 0 members and must have at least 1");
  EXPECT_EQ(why_not(R"({"maxProperties": 0})", R"({"a": 1})"),
            ": it has 1 member and must have at most 0");
  EXPECT_EQ(why_not(R"({"dependentRequired": {"a": ["b"]}})", R"({"a": 1})"),
            ": 'b' is missing beside 'a'");
  EXPECT_EQ(why_not(R"({"dependentSchemas": {"a": {"required": ["c"]}}})", R"({"a": 1})"),
            ": 'c' is missing");
}

TEST(JsonSchema, CombinesSchemas) {
  EXPECT_EQ(why_not(R"({"allOf": [{}, {"required": ["a"]}]})", "{}"), ": 'a' is missing");
  EXPECT_THAT(why_not(R"({"anyOf": [{"type": "null"}, {"required": ["a"]}]})", "{}"),
              HasSubstr("none of the schemas in 'anyOf'; of the last: 'a' is missing"));
  EXPECT_THAT(why_not(R"({"oneOf": [{}, {}]})", "{}"), HasSubstr("2 of the schemas in 'oneOf'"));
  EXPECT_EQ(why_not(R"({"not": {"required": ["a"]}})", R"({"a": 1})"), ": a must not be there");
  EXPECT_THAT(why_not(R"({"not": {"minimum": 1}})", "2"), HasSubstr("the schema in 'not'"));
  const std::string branch = R"({"if": {"required": ["a"]}, "then": {"required": ["b"]},
                                 "else": {"required": ["c"]}})";
  expect_fits(branch, R"({"a": 1, "b": 1})");
  expect_fits(branch, R"({"c": 1})");
  EXPECT_EQ(why_not(branch, R"({"a": 1})"), ": 'b' is missing");
  EXPECT_EQ(why_not(branch, "{}"), ": 'c' is missing");
}

TEST(JsonSchema, FollowsReferences) {
  const std::string tree = R"({"properties": {"children": {"items": {"$ref": "#"}},
                                "name": {"$ref": "#/$defs/name"}},
                               "$defs": {"name": {"type": "string"}}})";
  expect_fits(tree, R"({"name": "a", "children": [{"name": "b", "children": []}]})");
  EXPECT_EQ(why_not(tree, R"({"name": "a", "children": [{"name": 1}]})"),
            "/children/0/name: it is a number and must be a string");
}

// Keywords of the object's own members do not see it.
TEST(JsonSchema, ShowsOneMoreMemberToThoseWhoNameIt) {
  expect_fits(R"({"properties": {"gltfx": {"properties": {"index": {"const": 3}}}}})", "{}");
  expect_fits(R"({"required": ["gltfx"], "additionalProperties": false, "maxProperties": 0})",
              "{}");
  EXPECT_EQ(why_not(R"({"properties": {"gltfx": {"not": {"required": ["parent"]}}}})", "{}"),
            "/gltfx: parent must not be there");
  EXPECT_EQ(why_not(R"({"properties": {"a": {"required": ["gltfx"]}}})", R"({"a": {}})"),
            "/a: 'gltfx' is missing");
}

TEST(JsonSchema, RefusesWhatItWouldNotCheck) {
  EXPECT_THAT(mistakes_in(R"({"patern": "x"})"), ElementsAre(HasSubstr("did you mean 'pattern'")));
  EXPECT_THAT(mistakes_in(R"({"format": "uri"})"), ElementsAre(HasSubstr("write a 'pattern'")));
  EXPECT_THAT(mistakes_in(R"({"unevaluatedProperties": false})"),
              ElementsAre(HasSubstr("'additionalProperties'")));
  EXPECT_THAT(mistakes_in(R"({"properties": {"a": {"minimum": "1"}}})"),
              ElementsAre("'minimum' must be a number"));
  EXPECT_THAT(mistakes_in(R"({"then": {}})"), ElementsAre("'then' says nothing without 'if'"));
  EXPECT_THAT(mistakes_in(R"({"pattern": "a(?=x)b"})"), ElementsAre(HasSubstr("not understood")));
  EXPECT_THAT(mistakes_in(R"({"type": "text"})"), ElementsAre(HasSubstr("'type' must be object")));
  EXPECT_THAT(mistakes_in(R"({"$ref": "#/$defs/a"})"), ElementsAre(HasSubstr("'#/$defs/a'")));
  EXPECT_THAT(mistakes_in(R"({"$ref": "http://example.com/a.json"})"), testing::SizeIs(1));
  EXPECT_THAT(mistakes_in(R"({"$defs": {"unused": {"typ": 1}}})"),
              ElementsAre(HasSubstr("did you mean 'type'")));
  EXPECT_THAT(mistakes_in(R"({"$schema": "http://json-schema.org/draft-07/schema#"})"),
              ElementsAre(HasSubstr("2020-12")));
  EXPECT_THAT(mistakes_in(R"({"a": 1,})"), testing::Not(IsEmpty()));
  EXPECT_THAT(mistakes_in("[]"), ElementsAre(HasSubstr("an object, true or false")));
}

TEST(JsonSchema, KnowsAnnotations) {
  EXPECT_THAT(mistakes_in(R"({"$schema": "https://json-schema.org/draft/2020-12/schema",
      "$id": "x", "$comment": "c", "title": "t", "description": "d", "default": 1,
      "examples": [], "deprecated": true, "readOnly": true, "writeOnly": true})"),
              IsEmpty());
}

TEST(JsonSchema, RefusesLoopsThatLeadNowhere) {
  EXPECT_THAT(mistakes_in(R"({"$ref": "#"})"), ElementsAre(HasSubstr("refers to itself")));
  EXPECT_THAT(mistakes_in(R"({"allOf": [{"$ref": "#/$defs/a"}],
                              "$defs": {"a": {"not": {"$ref": "#/$defs/b"}},
                                        "b": {"if": {"$ref": "#/$defs/a"}}}})"),
              ElementsAre(HasSubstr("refers to itself")));
}

// A value of a megabyte costs something each time that it is compared.
TEST(JsonSchema, ComparesLongValuesWithinItsWork) {
  std::string words;
  for (int i = 0; i < 1000; ++i) words += (i == 0 ? "\"w" : ", \"w") + std::to_string(i) + '"';
  const std::string value = '"' + std::string(1'000'000, 'a') + '"';
  EXPECT_EQ(check("{\"enum\": [" + words + "]}", value).verdict, SchemaVerdict::undecided);
  EXPECT_EQ(check("{\"enum\": [" + words + "]}", "\"a\"").verdict, SchemaVerdict::fails);
}

TEST(JsonSchema, NamesTheValueThatDoesNotFit) {
  const auto place = [](std::string_view schema, std::string_view value) {
    const json::NodeId node = check(schema, value).failure.node;
    const json::Parsed parsed = json::parse(value);
    return node == json::kNoNode ? "none" : std::string(parsed.document.raw(node));
  };
  const std::string deep = R"({"properties": {"a": {"items": {"minimum": 1}}}})";
  EXPECT_EQ(place(deep, R"({"a": [0]})"), "[0]");
  EXPECT_EQ(place(deep, R"({"a": ["x", 0]})"), "0");
  EXPECT_EQ(place(R"({"required": ["b"]})", R"({"a": 1})"), R"({"a": 1})");
  EXPECT_EQ(place(R"({"propertyNames": {"maxLength": 1}})", R"({"a": 1, "bc": 2})"), "\"bc\"");
  EXPECT_EQ(place(R"({"properties": {"gltfx": {"properties": {"index": false}}}})", "{}"), "none");
}

// Each schema refers twice to the next one: without a limit, twice as much work for each.
TEST(JsonSchema, StopsAfterItsWork) {
  std::string text = R"({"$ref": "#/$defs/s0", "$defs": {)";
  for (int i = 0; i < 60; ++i) {
    const std::string next = "{\"$ref\": \"#/$defs/s" + std::to_string(i + 1) + "\"}";
    text += "\"s" + std::to_string(i) + "\": {\"allOf\": [" + next + "," + next + "]},";
  }
  text += R"("s60": {"type": "object"}}})";
  EXPECT_EQ(check(text, "{}").verdict, SchemaVerdict::undecided);
}

TEST(JsonSchema, StopsInsideDeepValues) {
  std::string deep;
  for (int i = 0; i < 900; ++i) deep += "{\"a\":";
  deep += '1' + std::string(900, '}');
  EXPECT_EQ(check(R"({"properties": {"a": {"$ref": "#"}}})", deep).verdict,
            SchemaVerdict::undecided);
}

TEST(JsonSchema, MatchesHostilePatternsInLinearTime) {
  const std::string name = '"' + std::string(20'000, 'a') + '"';
  EXPECT_EQ(check(R"({"pattern": "^(a+)+b$"})", name, 10'000'000).verdict, SchemaVerdict::fails);
  EXPECT_EQ(check(R"({"pattern": "(a{1,40}){1,10}$"})", name, 1000).verdict,
            SchemaVerdict::undecided);
}

TEST(JsonSchema, IsRefusedWhenItIsNestedTooDeeply) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += R"({"not": )";
  text += "{}" + std::string(100, '}');
  EXPECT_THAT(mistakes_in(text), ElementsAre(HasSubstr("nested too deeply")));
}

}  // namespace
}  // namespace gltfx::schema
