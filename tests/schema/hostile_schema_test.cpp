// SPDX-License-Identifier: Apache-2.0
// Untrusted schema files: parts that are missing, of a wrong type or empty, and parts that
// multiply. Each is refused with its place, or is safe to use.
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sanitized.hpp"
#include "schema/findings.hpp"
#include "schema/leaf.hpp"

namespace gltfx::test {
namespace {

using nlohmann::json;
using schema::Compiled;
using testing::HasSubstr;

// Has every word of the vocabulary that an extension can have.
const char* const kEverything = R"({
"$schema": "https://json-schema.org/draft/2020-12/schema",
"$id": "gltfx:ext/ACME_x", "title": "x", "description": "x", "type": "object",
"$defs": {"part": {"type": "object", "properties": {"p": {"type": "integer", "x-gltfx": {"ref": "accessors"}}}},
          "list": {"type": "array", "items": {"$ref": "#/$defs/part"}, "minItems": 1, "uniqueItems": true}},
"required": ["a"], "dependentRequired": {"a": ["b"], "z": ["a"]}, "propertyNames": {"pattern": "^[a-z]"},
"patternProperties": {"^y": {"type": "number"}}, "additionalProperties": {"type": "string"},
"properties": {
  "a": {"type": "number", "minimum": 0, "maximum": 1, "multipleOf": 0.5, "default": 1, "description": "a",
        "x-gltfx": {"parameter": "a", "mutable": "float", "animatedMinimum": 0, "aliases": ["old"], "unit": "m", "hint": "h"}},
  "b": {"allOf": [{"$ref": "#/$defs/list"}], "anyOf": [{"minItems": 1}, true], "oneOf": [{"type": "array"}, false]},
  "c": {"if": {"type": "string"}, "then": {"minLength": 1}, "else": {"enum": [1, 2], "x-gltfx": {"enumNames": {"1": "ONE"}}}},
  "d": {"not": {"const": "d"}, "format": "json-pointer", "deprecated": true},
  "n": {"type": "string", "x-gltfx": {"refName": "/materials/*/name"}},
  "v": {"enum": ["x"], "x-gltfx": {"since": "2.1", "openSince": "2.1", "without": ["a"],
        "should": {"since": "2.1", "value": {"minLength": 1}, "because": "b"}}},
  "h": {"type": "integer", "x-gltfx": {"ref": "nodes", "refHolds": {"description": "d", "properties": {"mesh": {"type": "integer"}}}}},
  "t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": {"channels": "r", "colorSpace": "linear", "scaledBy": "a", "factors": {"r": "a"}}}}},
"x-gltfx": {"extension": "ACME_x", "on": {"material": "#", "node": "#/$defs/part"}, "status": "legacy",
  "spec": "https://example.com", "excludes": [{"extension": "KHR_materials_unlit", "because": "b"}],
  "requires": [{"extension": "KHR_materials_ior", "because": "b", "severity": "error"}],
  "overriddenBy": [{"extension": "KHR_materials_volume", "because": "b"}], "mustBeRequired": "without-fallback",
  "fallback": "name", "strength": "a", "standalone": true, "undrawn": true, "imageMimeTypes": ["image/x"],
  "vertexAttributes": {"_A": {"types": ["VEC3"], "components": ["FLOAT"]}}, "successor": "KHR_materials_volume",
  "enumAdditions": {"material/alphaMode": ["X"]},
  "generations": [{"name": "v1", "description": "1", "with": ["c"], "without": ["d"],
                   "slots": {"t": {"channels": "r", "colorSpace": "linear"}}}],
  "upgrade": {"to": "KHR_materials_diffuse_transmission",
    "steps": [{"step": "move", "from": "a", "to": "diffuseTransmissionFactor"},
              {"step": "move", "from": "t", "to": "diffuseTransmissionTexture", "swizzle": "r>a", "accept": "index"},
              {"step": "place", "to": "doubleSided", "otherwise": true}],
    "losses": [{"vertexAttribute": "COLOR_0", "because": "b"}], "stays": [{"generations": ["v1"], "because": "b"}]}}})";

const char* const kDocument =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_x"], "accessors": [{}], "nodes": [
{"extensions": {"ACME_x": {"p": 0}}}, {"extensions": {"ACME_x": []}}], "materials": [
{"name": "m", "alphaMode": "X", "extensions": {"ACME_x": {"a": 0.5, "b": [{"p": 0}, {"p": 7}], "c": 1, "d": "/a", "n": "m",
 "t": {"index": 0}, "y": 1, "z": 2, "extensions": {}}}},
{"extensions": {"ACME_x": {"old": 3, "b": [[1], [2, 3]], "c": "", "d": "d", "n": "o", "t": 0, "q": null}}},
{"extensions": {"ACME_x": {}}}, {"extensions": {"ACME_x": 1}}]})";

// With core and the extensions that kEverything names, which is an eighth of the time.
Compiled compile_user(std::string text) {
  std::vector<schema::SourceFile> files;
  for (const schema::SourceFile& file : schema::builtin_files()) {
    const std::string stem = std::filesystem::path(file.name).stem().stem();
    const bool core = file.name.starts_with("core/");
    const bool named = std::string_view(kEverything).find('"' + stem + '"') != std::string::npos;
    if (core || named) files.push_back(file);
  }
  files.push_back({"acme.json", std::move(text), true});
  return schema::compile(files);
}

// Any file is either refused with a place in it, or the walk can use the result.
void expect_safe(const std::string& text) {
  const Compiled compiled = compile_user(text);
  ASSERT_EQ(compiled.set == nullptr, !compiled.errors.empty()) << text;
  for (const schema::SchemaError& error : compiled.errors) {
    EXPECT_GT(error.line, 0U) << text;
    EXPECT_FALSE(error.message.empty()) << text;
  }
  if (compiled.set == nullptr) return;
  for (const auto& deviations : {schema::Deviations(), schema::kKhronosValidator}) {
    for (const Found& found : find(kDocument, deviations, *compiled.set)) {
      EXPECT_FALSE(found.message.empty()) << text;
    }
  }
}

std::vector<json::json_pointer> places_of(const json& value, const json::json_pointer& at) {
  std::vector<json::json_pointer> places{at};
  if (!value.is_structured()) return places;
  for (const auto& [key, inside] : value.items()) {
    const auto place = value.is_array() ? at / std::stoul(key) : at / key;
    const auto below = places_of(inside, place);
    places.insert(places.end(), below.begin(), below.end());
  }
  return places;
}

TEST(HostileSchema, IsWholeToBeginWith) {
  const Compiled compiled = compile_user(kEverything);
  EXPECT_TRUE(compiled.errors.empty()) << compiled.errors.front().text();
}

TEST(HostileSchema, AnyPartMayBeMissing) {
  const json whole = json::parse(kEverything);
  for (const auto& place : places_of(whole, json::json_pointer())) {
    if (place.empty()) continue;
    json cut = whole;
    json& around = cut[place.parent_pointer()];
    if (around.is_array()) {
      around.erase(std::stoul(place.back()));
    } else {
      around.erase(place.back());
    }
    SCOPED_TRACE(place.to_string());
    expect_safe(cut.dump());
  }
}

TEST(HostileSchema, AnyPartMayBeOfAnotherTypeOrEmpty) {
  const json whole = json::parse(kEverything);
  const std::array<const char*, 8> others{"null", "true", "0", "\"\"", "[]", "{}", "[0]", "[\"\"]"};
  constexpr std::size_t kStep = kSanitized ? 3 : 1;  // in turn, so that each is somewhere
  std::size_t first = 0;
  for (const auto& place : places_of(whole, json::json_pointer())) {
    for (std::size_t i = first++ % kStep; i < others.size(); i += kStep) {
      json changed = whole;
      changed[place] = json::parse(others.at(i));
      SCOPED_TRACE(place.to_string() + " = " + others.at(i));
      expect_safe(changed.dump());
    }
  }
}

TEST(HostileSchema, TypesOfCoreCannotBeReplaced) {
  for (const char* const name : {"glTF", "material", "textureInfo", "node", "accessor", "own"}) {
    SCOPED_TRACE(name);
    const auto errors =
        compile_user(
            R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:core/)" +
            std::string(name) + R"(", "title": "x", "description": "x"})")
            .errors;
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_THAT(errors[0].message, HasSubstr("cannot be replaced"));
    EXPECT_THAT(errors[0].message, HasSubstr("gltfx rules --new"));
  }
}

TEST(HostileSchema, AnExtensionThatSaysNotWhereItStandsIsRefused) {
  const auto errors =
      compile_user(
          R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_glow", "title": "ACME_glow", "description": "x", "type": "object"})")
          .errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].line, 1U);
  EXPECT_THAT(errors[0].message, HasSubstr("'x-gltfx' is missing"));
}

// The object of an extension may be one that core describes; core keeps its name.
TEST(HostileSchema, AnObjectOfCoreMayBeBorrowed) {
  const auto set = set_with(acme(R"("$ref": "gltfx:core/material")"));
  ASSERT_NE(set, nullptr);
  EXPECT_EQ(set->type(set->find_type("material")).name, "material");
  EXPECT_EQ(set->type(set->find_type("material.ACME_x")).name, "material.ACME_x");
}

TEST(DependentRequired, MayNameMembersThatAreNotDescribed) {
  const auto text = asset_using("ACME_x", R"("materials": [{"extensions": {"ACME_x": {"u": 1}}}])");
  for (const char* const properties :
       {R"("properties": {"a": {}}, "additionalProperties": true, )", ""}) {
    const auto set =
        set_with(acme(properties + std::string(R"("dependentRequired": {"u": ["v"]})")));
    ASSERT_NE(set, nullptr);
    const Found found = only(text, *set);
    EXPECT_EQ(found.code, "UNSATISFIED_DEPENDENCY");
    EXPECT_EQ(found.message, "'u' requires 'v'.");
  }
}

// `d0` is all of `d1` twice, which is all of `d2` twice, and so on.
std::string doubled(int levels, std::string_view combinator) {
  std::string defs = R"("$defs": {"d)" + std::to_string(levels) + R"(": {"type": "integer"})";
  for (int i = 0; i < levels; ++i) {
    const std::string next = R"({"$ref": "#/$defs/d)" + std::to_string(i + 1) + "\"}";
    defs += ",\n\"d" + std::to_string(i) + "\": {\"" + std::string(combinator) + "\": [" + next +
            "," + next + "]}";
  }
  return acme(defs + R"(}, "properties": {"a": {"$ref": "#/$defs/d0"}})");
}

TEST(Multiplied, BranchesAreRefusedWhereTheyGrowTooMany) {
  EXPECT_NE(set_with(doubled(8, "allOf")), nullptr);
  for (const char* const combinator : {"allOf", "anyOf", "oneOf"}) {
    const auto errors = compile_user(doubled(30, combinator)).errors;
    ASSERT_EQ(errors.size(), 1U) << combinator;
    EXPECT_EQ(errors[0].line, 24U);
    EXPECT_EQ(errors[0].pointer, "/$defs/d21");
    EXPECT_THAT(errors[0].message, HasSubstr("more than 1000 schemas"));
  }
}

// Each level of the array is walked for two branches that lead to one schema.
TEST(Multiplied, AValueIsHeldOnceAgainstASchemaHoweverManyWaysLeadThere) {
  const auto set = set_with(acme(
      R"("properties": {"a": {"$ref": "#/$defs/s"}}, "$defs": {"s": {"allOf": [{"items": {"$ref": "#/$defs/s"}}, {"items": {"$ref": "#/$defs/s"}}]}})"));
  ASSERT_NE(set, nullptr);
  const std::string deep = std::string(200, '[') + "{}" + std::string(200, ']');
  const auto text =
      asset_using("ACME_x", R"("materials": [{"extensions": {"ACME_x": {"a": )" + deep + "}}}]");
  EXPECT_THAT(verdict(text, {}, *set), testing::IsEmpty());
}

std::string chain(int links, std::string_view beside) {
  std::string defs = R"("$defs": {"d)" + std::to_string(links) + R"(": {"enum": ["a", "b"]})";
  for (int i = 0; i < links; ++i) {
    defs += ",\n\"d" + std::to_string(i) + "\": {\"$ref\": \"#/$defs/d" + std::to_string(i + 1) +
            "\"" + std::string(beside) + "}";
  }
  return acme(defs + R"(}, "properties": {"a": {"$ref": "#/$defs/d0"}})");
}

TEST(Multiplied, ChainsOfReferencesAreRefusedWhereTheyGrowTooLong) {
  EXPECT_NE(set_with(chain(30, "")), nullptr);
  const auto errors = compile_user(chain(6000, "")).errors;
  ASSERT_FALSE(errors.empty());
  EXPECT_LE(errors.size(), 200U);
  EXPECT_EQ(errors[0].pointer, "/$defs/d0/$ref");
  EXPECT_EQ(errors[0].line, 3U);
  EXPECT_THAT(errors[0].message, HasSubstr("more than 40 $refs"));
}

TEST(Multiplied, CopiesOfWhatIsReferredToAreLimitedTogether) {
  std::string text = R"("$defs": {"big": {"description": ")" + std::string(50'000, 'x') + R"("})";
  for (int i = 0; i < 2000; ++i) {
    text +=
        ",\n\"d" + std::to_string(i) +
        R"(": {"$ref": "#/$defs/big", "x-gltfx": {"slot": {"channels": "r", "colorSpace": "linear"}}})";
  }
  const auto errors = compile_user(acme(text + "}")).errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_GT(errors[0].line, 3U);
  EXPECT_THAT(errors[0].message, HasSubstr("too large in total"));
}

TEST(Multiplied, NamesAreLimitedTogether) {
  const auto errors = compile_user(acme(R"("properties": {")" + std::string(2000, 'x') +
                                        R"(": {"properties": {"a": {}}}})"))
                          .errors;
  ASSERT_FALSE(errors.empty());
  EXPECT_THAT(errors[0].message, HasSubstr("more than 1000 bytes"));
}

TEST(Multiplied, AFileThatIsTooLongIsNotRead) {
  const auto errors =
      compile_user(acme(R"("$comment": ")" + std::string(300'000, 'x') + "\"")).errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].line, 1U);
  EXPECT_THAT(errors[0].message, HasSubstr("a schema file has at most 262144"));
}

}  // namespace
}  // namespace gltfx::test
