// SPDX-License-Identifier: Apache-2.0
// Mistakes in schema files: file, line, column, key and message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/compile.hpp"

namespace gltfx::schema {
namespace {

// A file for ACME_x: lines 3 and on are the test's.
std::string file_with(std::string_view members, std::string_view words = "") {
  std::string text =
      R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_x", "title": "x", "description": "x",
"x-gltfx": {"extension": "ACME_x", "on": ["material"], "status": "vendor")";
  text.append(words).append("},\n").append(members);
  return text + "}";
}

std::vector<SchemaError> errors_of(const std::string& text) {
  const Compiled compiled = compile_with({{"acme.json", text, false}});
  EXPECT_EQ(compiled.set == nullptr, !compiled.errors.empty());
  return compiled.errors;
}

struct Mistake {
  const char* name;
  const char* members;  ///< line 3 of the file, with '@' before the place of the error
  const char* pointer;
  const char* says;
};

class MembersWith : public testing::TestWithParam<Mistake> {};

TEST_P(MembersWith, OneMistakeAreRefusedAtItsPlace) {
  std::string members = GetParam().members;
  const std::size_t place = members.find('@');
  members.erase(place, 1);
  const auto errors = errors_of(file_with(members));
  ASSERT_EQ(errors.size(), 1U) << (errors.empty() ? "" : errors[1].text());
  EXPECT_EQ(errors[0].file, "acme.json");
  EXPECT_EQ(errors[0].line, 3U);
  EXPECT_EQ(errors[0].column, place + 1);
  EXPECT_EQ(errors[0].pointer, GetParam().pointer);
  EXPECT_THAT(errors[0].message, testing::HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    ChannelFactors, MembersWith,
    testing::Values(
        Mistake{
            "channel_scaled_by_nothing",
            R"("properties": {"leafFactor": {}, "t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": {"channels": "ga", "colorSpace": "linear", "factors": {"g": "leafFactor", "a": @"leafFacto"}}}}})",
            "/properties/t/x-gltfx/slot/factors/a", "did you mean 'leafFactor'?"},
        Mistake{
            "factor_of_no_channel",
            R"("properties": {"leafFactor": {}, "t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": {"channels": "ga", "colorSpace": "linear", "factors": {@"x": "leafFactor"}}}}})",
            "/properties/t/x-gltfx/slot/factors/x", "letters of rgba"}));

INSTANTIATE_TEST_SUITE_P(
    Compile, MembersWith,
    testing::Values(
        Mistake{"unknown_keyword", R"(@"propertees": {})", "/propertees",
                "did you mean 'properties'?"},
        Mistake{"keyword_of_the_standard_not_understood", R"(@"prefixItems": [])", "/prefixItems",
                "not a member of"},
        Mistake{"unknown_keyword_inside", R"("properties": {"a": {@"minimun": 1}})",
                "/properties/a/minimun", "'minimum'"},
        Mistake{"misspelt_word", R"("properties": {"a": {"x-gltfx": {@"sloot": {}}}})",
                "/properties/a/x-gltfx/sloot", "'slot'"},
        Mistake{"extension_word_on_a_property", R"("properties": {"a": {"x-gltfx": {@"on": []}}})",
                "/properties/a/x-gltfx/on", "not a member of x-gltfx"},
        Mistake{"type", R"("type": @"objekt")", "/type", "did you mean 'object'?"},
        Mistake{"type_list", R"("type": ["object", @"none"])", "/type/1", "must be"},
        Mistake{"empty_enum", R"("enum": @[])", "/enum", "at least one"},
        Mistake{"enum_of_lists", R"("enum": [@[1]])", "/enum/0", "must be a number, a string"},
        Mistake{"minimum_text", R"("minimum": @"0")", "/minimum", "must be a number"},
        Mistake{"zero_multiple", R"("multipleOf": @0)", "/multipleOf", "above 0"},
        Mistake{"negative_count", R"("minItems": @-1)", "/minItems", "at least 0"},
        Mistake{"min_above_max", R"("minimum": 2, @"maximum": 1)", "/maximum", "contradicts"},
        Mistake{"equal_limits_one_open", R"("minimum": 1, @"exclusiveMaximum": 1)",
                "/exclusiveMaximum", "contradicts"},
        Mistake{"items_above_max", R"("minItems": 3, @"maxItems": 2)", "/maxItems", "contradicts"},
        Mistake{"length_above_max", R"("minLength": 3, @"maxLength": 2)", "/maxLength",
                "contradicts"},
        Mistake{"bad_pattern", R"("pattern": @"a(")", "/pattern", "regular expression"},
        Mistake{"bad_pattern_key", R"("patternProperties": {@"[": true})", "/patternProperties/[",
                "regular expression"},
        Mistake{"schema_is_a_number", R"("properties": {"a": @1})", "/properties/a",
                "must be an object, true or false"},
        Mistake{"combinator_without_list", R"("anyOf": @{})", "/anyOf", "must be a list"},
        Mistake{"required_twice", R"("required": ["a", @"a"], "properties": {"a": {}})",
                "/required/1", "duplicate"},
        Mistake{"required_unknown", R"("required": [@"agee"], "properties": {"age": {}})",
                "/required/0", "did you mean 'age'?"},
        Mistake{"ref_of_wrong_form", R"("properties": {"a": {"$ref": @"textureInfo"}})",
                "/properties/a/$ref", "must be the $id"},
        Mistake{"ref_unresolved", R"("properties": {"a": {"$ref": @"gltfx:core/textureInf"}})",
                "/properties/a/$ref", "'gltfx:core/textureInfo'"},
        Mistake{"defs_unresolved",
                R"("$defs": {"leaf": {}}, "properties": {"a": {"$ref": @"#/$defs/leav"}})",
                "/properties/a/$ref", "did you mean 'leaf'?"},
        Mistake{"schema_in_itself", R"("$defs": {"a": @{"allOf": [{"$ref": "#/$defs/a"}]}})",
                "/$defs/a", "contains itself"},
        Mistake{
            "slot_channels_order",
            R"("properties": {"t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": {"channels": @"bg", "colorSpace": "linear"}}}})",
            "/properties/t/x-gltfx/slot/channels", "letters of"},
        Mistake{
            "slot_color_space",
            R"("properties": {"t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": {"channels": "rgb", "colorSpace": @"sRGB"}}}})",
            "/properties/t/x-gltfx/slot/colorSpace", "'srgb'"},
        Mistake{
            "slot_without_color_space",
            R"("properties": {"t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": @{"channels": "rgb"}}}})",
            "/properties/t/x-gltfx/slot", "'colorSpace' is missing"},
        Mistake{
            "scaled_by_nothing",
            R"("properties": {"leafFactor": {}, "t": {"$ref": "gltfx:core/textureInfo", "x-gltfx": {"slot": {"channels": "a", "colorSpace": "linear", "scaledBy": @"leafFacto"}}}})",
            "/properties/t/x-gltfx/slot/scaledBy", "did you mean 'leafFactor'?"},
        Mistake{"target_unknown",
                R"("properties": {"i": {"type": "integer", "x-gltfx": {"ref": @"accesors"}}})",
                "/properties/i/x-gltfx/ref", "did you mean 'accessors'?"},
        Mistake{"target_no_array",
                R"("properties": {"i": {"type": "integer", "x-gltfx": {"ref": @"asset"}}})",
                "/properties/i/x-gltfx/ref", "not an array"},
        Mistake{
            "target_type_unknown",
            R"("properties": {"i": {"type": "integer", "x-gltfx": {"ref": @"animatoin/samplers"}}})",
            "/properties/i/x-gltfx/ref", "did you mean 'animation'?"},
        Mistake{
            "target_extension_unknown",
            R"("properties": {"i": {"type": "integer", "x-gltfx": {"ref": @"/extensions/KHR_light/lights"}}})",
            "/properties/i/x-gltfx/ref", "not a known extension"},
        Mistake{
            "target_extension_not_there",
            R"("properties": {"i": {"type": "integer", "x-gltfx": {"ref": @"/extensions/KHR_materials_ior/ior"}}})",
            "/properties/i/x-gltfx/ref", "no object at this place"},
        Mistake{"target_star_on_object",
                R"("properties": {"i": {"type": "integer", "x-gltfx": {"ref": @"/asset/*/a"}}})",
                "/properties/i/x-gltfx/ref", "'*'"},
        Mistake{"name_target_relative",
                R"("properties": {"i": {"type": "string", "x-gltfx": {"refName": @"materials"}}})",
                "/properties/i/x-gltfx/refName", "from the root"},
        Mistake{"mutable", R"("properties": {"f": {"x-gltfx": {"mutable": @"float5"}}})",
                "/properties/f/x-gltfx/mutable", "must be"},
        Mistake{"enum_names_key",
                R"("properties": {"f": {"enum": [1], "x-gltfx": {"enumNames": {@"one": "ONE"}}}})",
                "/properties/f/x-gltfx/enumNames/one", "integers"},
        Mistake{"json_fault", R"("type": "object",@,)", "", ""}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

struct WordMistake {
  const char* name;
  const char* words;  ///< after the x-gltfx of line 2
  const char* pointer;
  const char* says;
};

class ExtensionWordsWith : public testing::TestWithParam<WordMistake> {};

TEST_P(ExtensionWordsWith, OneMistakeAreRefused) {
  const auto errors = errors_of(
      file_with(R"("properties": {"t": {"$ref": "gltfx:core/textureInfo"}})", GetParam().words));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].line, 2U);
  EXPECT_EQ(errors[0].pointer, GetParam().pointer);
  EXPECT_THAT(errors[0].message, testing::HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    Compile, ExtensionWordsWith,
    testing::Values(
        WordMistake{"misspelt", R"(, "exclude": [])", "/x-gltfx/exclude",
                    "did you mean 'excludes'?"},
        WordMistake{"spec_url", R"(, "spec": "www.acme.example")", "/x-gltfx/spec", "https://"},
        WordMistake{"relation_without_reason", R"(, "excludes": [{"extension": "KHR_a"}])",
                    "/x-gltfx/excludes/0", "'because' is missing"},
        WordMistake{"relation_name", R"(, "excludes": [{"extension": "unlit", "because": "x"}])",
                    "/x-gltfx/excludes/0/extension", "extension name"},
        WordMistake{"requirement", R"(, "mustBeRequired": "allways")", "/x-gltfx/mustBeRequired",
                    "did you mean 'always'?"},
        WordMistake{"media_type", R"(, "imageMimeTypes": ["png"])", "/x-gltfx/imageMimeTypes/0",
                    "media types"},
        WordMistake{"attribute_type",
                    R"(, "vertexAttributes": {"A": {"types": ["VEC5"], "components": ["FLOAT"]}})",
                    "/x-gltfx/vertexAttributes/A/types/0", "must be"},
        WordMistake{"generation_of_nothing",
                    R"(, "generations": [{"name": "1", "description": "1", "with": ["u"]}])",
                    "/x-gltfx/generations/0/with", "not a property"},
        WordMistake{
            "generation_slot",
            R"(, "generations": [{"name": "1", "description": "1", "slots": {"u": {"channels": "r", "colorSpace": "linear"}}}])",
            "/x-gltfx/generations/0/slots/u", "not a property"},
        WordMistake{
            "upgrade_to_nothing",
            R"(, "upgrade": {"to": "ACME_z", "steps": [{"step": "move", "from": "t", "to": "t"}]})",
            "/x-gltfx/upgrade/to", "not a known extension"},
        WordMistake{"upgrade_to_where", R"(, "upgrade": {"together": true})", "/x-gltfx/upgrade",
                    "'to' is missing"},
        WordMistake{"upgrade_alternative",
                    R"(, "upgrade": {"to": "ACME_x", "alternatives": ["ACME_z"]})",
                    "/x-gltfx/upgrade/alternatives", "not a known extension"},
        WordMistake{"upgrade_conversion", R"(, "upgrade": {"to": "ACME_x", "convert": "xmpp"})",
                    "/x-gltfx/upgrade/convert", "did you mean 'xmp'?"},
        WordMistake{"upgrade_step_from_nowhere",
                    R"(, "upgrade": {"to": "ACME_x", "steps": [{"step": "move", "to": "t"}]})",
                    "/x-gltfx/upgrade/steps/0", "'from' is missing"},
        WordMistake{
            "upgrade_place",
            R"(, "upgrade": {"to": "ACME_x", "steps": [{"step": "place", "from": "t", "to": "extensions/ACME_x/u"}]})",
            "/x-gltfx/upgrade/steps/0/to", "not a member there"},
        WordMistake{"upgrade_stay",
                    R"(, "upgrade": {"stays": [{"generations": ["v9"], "because": "b"}]})",
                    "/x-gltfx/upgrade/stays", "not a generation"},
        WordMistake{
            "upgrade_step_kind",
            R"(, "upgrade": {"to": "ACME_x", "steps": [{"step": "moves", "from": "t", "to": "t"}]})",
            "/x-gltfx/upgrade/steps/0/step", "did you mean 'move'?"},
        WordMistake{
            "upgrade_swizzle",
            R"(, "upgrade": {"to": "ACME_x", "steps": [{"step": "move", "from": "t", "to": "t", "swizzle": "x>a"}]})",
            "/x-gltfx/upgrade/steps/0/swizzle", "two channels"},
        WordMistake{
            "upgrade_loss_without_reason",
            R"(, "upgrade": {"to": "ACME_x", "steps": [{"step": "move", "from": "t", "to": "t"}], "losses": [{"vertexAttribute": "COLOR_0"}]})",
            "/x-gltfx/upgrade/losses/0", "'because' is missing"},
        WordMistake{"standalone_text", R"(, "standalone": "yes")", "/x-gltfx/standalone",
                    "true or false"},
        WordMistake{"duplicate", R"(, "status": "draft")", "", ""}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

std::string minimal(std::string_view id, std::string_view words) {
  return R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": ")" +
         std::string(id) +
         R"(", "title": "x", "description": "x", "type": "object", "x-gltfx": {)" +
         std::string(words) + "}}";
}

TEST(CompileError, UnknownHomeNamesTheNearestType) {
  const auto errors = errors_of(minimal(
      "gltfx:ext/ACME_x", R"("extension": "ACME_x", "on": ["materials"], "status": "vendor")"));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].text(), testing::HasSubstr("acme.json:1:"));
  EXPECT_THAT(errors[0].message, testing::HasSubstr("did you mean 'material'?"));
}

TEST(CompileError, UnknownStatusNamesTheNearest) {
  const auto errors = errors_of(
      minimal("gltfx:ext/ACME_x", R"("extension": "ACME_x", "on": [], "status": "ratifed")"));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].message, testing::HasSubstr("'ratified'"));
}

TEST(CompileError, ADraftSaysWhichTextItFollows) {
  const auto draft = [](const std::string& revision) {
    return errors_of(minimal("gltfx:ext/ACME_x",
                             R"("extension": "ACME_x", "on": [], "status": "draft")" + revision));
  };
  ASSERT_EQ(draft("").size(), 1U);
  EXPECT_THAT(draft("")[0].message, testing::HasSubstr("'revision'"));
  for (const std::string good : {"2025", "2025-09", "2025-09-15", "2025-09-15 b102d2d"}) {
    EXPECT_TRUE(draft(R"(, "revision": ")" + good + "\"").empty()) << good;
  }
  for (const std::string bad : {"", "25", "2025-9", "2025-09-15 x", "2025-09-15 b102", "b102d2d"}) {
    EXPECT_EQ(draft(R"(, "revision": ")" + bad + "\"").size(), 1U) << bad;
  }
}

TEST(CompileError, NameAndIdOfAnExtensionMustAgree) {
  const auto errors = errors_of(
      minimal("gltfx:ext/ACME_x", R"("extension": "ACME_y", "on": [], "status": "vendor")"));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].pointer, "/x-gltfx/extension");
}

TEST(CompileError, SameIdTwiceAmongBuiltInFilesIsOne) {
  std::vector<SourceFile> files = builtin_files();
  files.push_back({"again.json",
                   minimal("gltfx:ext/KHR_materials_ior",
                           R"("extension": "KHR_materials_ior", "on": [], "status": "vendor")"),
                   false});
  const Compiled compiled = compile(files);
  ASSERT_EQ(compiled.errors.size(), 1U);
  EXPECT_EQ(compiled.errors[0].file, "again.json");
  EXPECT_EQ(compiled.errors[0].pointer, "/$id");
  EXPECT_THAT(compiled.errors[0].message, testing::HasSubstr("KHR_materials_ior.schema.json"));
}

TEST(CompileError, HomeMustBeADefinitionOfTheFile) {
  const auto errors = errors_of(
      minimal("gltfx:ext/ACME_x",
              R"("extension": "ACME_x", "on": {"node": "#/$defs/no"}, "status": "vendor")"));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].message, testing::HasSubstr("$defs"));
}

TEST(CompileError, MissingIdAndTitleAreTold) {
  const auto errors = errors_of("{}");
  ASSERT_EQ(errors.size(), 4U);
  EXPECT_THAT(errors[0].message, testing::HasSubstr("'$schema' is missing"));
}

TEST(CompileError, ReferencesThatLeadToReferencesOnlyAreTold) {
  const auto errors =
      errors_of(file_with(R"("$defs": {"a": {"$ref": "#/$defs/b"}, "b": {"$ref": "#/$defs/a"}})"));
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors[0].pointer, "/$defs/a/$ref");
  EXPECT_THAT(errors[0].message, testing::HasSubstr("more than 40 $refs"));
}

TEST(CompileError, ReferencesInACircleWithWordsBesideThemAreTold) {
  const auto errors = errors_of(file_with(
      R"("$defs": {"a": {"$ref": "#/$defs/b", "x-gltfx": {"ref": "nodes"}}, "b": {"$ref": "#/$defs/a", "x-gltfx": {"ref": "nodes"}}})"));
  ASSERT_FALSE(errors.empty());
  EXPECT_THAT(errors[0].message, testing::HasSubstr("is circular"));
}

TEST(CompileError, NoObjectIsOne) { EXPECT_EQ(errors_of("[]").size(), 1U); }

TEST(CompileError, ColumnsCountCodePoints) {
  const auto errors = errors_of(file_with("\"title\": \"\xc3\xa4\xc3\xb6\", \"tipe\": 1"));
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors.back().column, 16U);
}

TEST(CompileError, ManyErrorsAreSortedByPlace) {
  const auto errors = errors_of(file_with("\"a\": 1,\n\"b\": 2,\n\"c\": 3"));
  ASSERT_EQ(errors.size(), 3U);
  EXPECT_EQ(errors[0].line, 3U);
  EXPECT_EQ(errors[2].line, 5U);
}

TEST(CompileError, DeepNestingOfCombinatorsIsRefused) {
  std::string schema = "{}";
  for (int i = 0; i < 100; ++i) schema = R"({"allOf": [)" + schema + "]}";
  const auto errors = errors_of(file_with(R"("properties": {"a": )" + schema + "}"));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].message, testing::HasSubstr("nested too deeply"));
}

}  // namespace
}  // namespace gltfx::schema
