// SPDX-License-Identifier: Apache-2.0
// Members of objects: unknown, missing, renamed, in order, and what holds for several together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json/parse.hpp"
#include "schema/findings.hpp"
#include "schema/leaf.hpp"

namespace gltfx::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(UnknownMember, MarksTheKeyAndSuggestsTheNearest) {
  const Found found = only(material(R"("pbrMetallicRoughness": {"roughnesFactor": 0.5})"));
  EXPECT_EQ(found.code, "UNEXPECTED_PROPERTY");
  EXPECT_EQ(found.pointer, "/materials/0/pbrMetallicRoughness/roughnesFactor");
  EXPECT_EQ(found.marked, "\"roughnesFactor\"");
  EXPECT_EQ(found.message,
            "'roughnesFactor' is not a known member of 'material.pbrMetallicRoughness'.");
  EXPECT_EQ(found.help, "did you mean 'roughnessFactor'?");
}

TEST(UnknownMember, ExtensionOutsideItsObjectIsShownTheWay) {
  const Found found = only(material(R"("KHR_materials_unlit": {})"));
  EXPECT_EQ(found.code, "UNEXPECTED_PROPERTY");
  EXPECT_THAT(found.help, HasSubstr("\"extensions\""));
}

TEST(UnknownMember, ExtrasAreNotLookedInto) {
  EXPECT_THAT(verdict(material(R"("extras": {"anything": [1, {"extensions": 3}]})")), IsEmpty());
}

TEST(UnknownMember, EscapedNamesAreTheSameNames) {
  EXPECT_THAT(verdict(material("\"double\\u0053ided\": true")), IsEmpty());
}

TEST(MissingMember, MarksTheBraceOnlyAndSaysWhatToAdd) {
  const Found found = only(asset(R"("accessors": [{"componentType": 5126, "count": 1}])"));
  EXPECT_EQ(found.code, "UNDEFINED_PROPERTY");
  EXPECT_EQ(found.pointer, "/accessors/0");
  EXPECT_EQ(found.marked, "{");
  EXPECT_EQ(found.message, "'type' is required, but missing.");
  EXPECT_THAT(found.help, HasSubstr(R"("SCALAR")"));
}

TEST(MissingMember, OfTheRootShowsASnippet) {
  const Found found = only("{}");
  EXPECT_EQ(found.code, "UNDEFINED_PROPERTY");
  EXPECT_EQ(found.pointer, "");
  EXPECT_THAT(found.help, HasSubstr(R"("asset": { "version": "2.0" })"));
}

TEST(Order, UnknownMembersFirstThenPropertiesAsDescribed) {
  EXPECT_THAT(
      verdict(asset(
          R"("bufferViews": [{"y": 1, "buffer": "a", "byteStride": 3, "x": 1, "byteLength": 0}])")),
      ElementsAre("UNEXPECTED_PROPERTY /bufferViews/0/y", "UNEXPECTED_PROPERTY /bufferViews/0/x",
                  "VALUE_NOT_IN_RANGE /bufferViews/0/byteLength",
                  "VALUE_NOT_IN_RANGE /bufferViews/0/byteStride",
                  "TYPE_MISMATCH /bufferViews/0/buffer"));
}

TEST(Order, RequiredMembersAreMissedInTheirTurn) {
  EXPECT_THAT(
      verdict(asset(R"("accessors": [{"bufferView": -1, "type": 3}])")),
      ElementsAre("INVALID_INDEX /accessors/0/bufferView", "UNDEFINED_PROPERTY /accessors/0",
                  "UNDEFINED_PROPERTY /accessors/0", "TYPE_MISMATCH /accessors/0/type"));
}

TEST(Order, RootDeclaresBeforeItHolds) {
  EXPECT_THAT(
      verdict(
          R"({"nope": 1, "accessors": [], "asset": {"version": 2}, "extensionsRequired": ["A_b"], "extras": 3})"),
      ElementsAre("UNEXPECTED_PROPERTY /nope", "UNSATISFIED_DEPENDENCY /extensionsRequired",
                  "UNUSED_EXTENSION_REQUIRED /extensionsRequired/0", "TYPE_MISMATCH /asset/version",
                  "EMPTY_ENTITY /accessors", "NON_OBJECT_EXTRAS /extras"));
}

TEST(Order, TextureSlotsReadTheirExtensionsFirst) {
  EXPECT_THAT(verdict(material(
                  R"("normalTexture": {"index": "a", "extensions": {"A_b": 3}, "extras": 1})")),
              ElementsAre("TYPE_MISMATCH /materials/0/normalTexture/extensions/A_b",
                          "TYPE_MISMATCH /materials/0/normalTexture/index",
                          "NON_OBJECT_EXTRAS /materials/0/normalTexture/extras"));
}

TEST(Order, OtherObjectsReadThemLast) {
  EXPECT_THAT(
      verdict(asset(
          R"("accessors": [{"extras": 1, "extensions": {"A_b": 3}, "name": 4, "componentType": 5126,
            "type": "VEC3", "count": 0}])")),
      ElementsAre("VALUE_NOT_IN_RANGE /accessors/0/count", "TYPE_MISMATCH /accessors/0/name",
                  "TYPE_MISMATCH /accessors/0/extensions/A_b",
                  "NON_OBJECT_EXTRAS /accessors/0/extras"));
}

TEST(Order, MaterialsReadThemBeforeTheirName) {
  EXPECT_THAT(
      verdict(material(R"("extras": 1, "extensions": {"A_b": 3}, "name": 4, "alphaCutoff": -1)")),
      ElementsAre("VALUE_NOT_IN_RANGE /materials/0/alphaCutoff",
                  "TYPE_MISMATCH /materials/0/extensions/A_b", "TYPE_MISMATCH /materials/0/name",
                  "NON_OBJECT_EXTRAS /materials/0/extras"));
}

TEST(Dependency, IsToldAtTheMemberThatNeedsTheOther) {
  const Found found = only(asset(
      R"("accessors": [{"componentType": 5126, "count": 1, "type": "VEC3", "byteOffset": 4}])"));
  EXPECT_EQ(found.code, "UNSATISFIED_DEPENDENCY");
  EXPECT_EQ(found.pointer, "/accessors/0/byteOffset");
  EXPECT_EQ(found.message, "'byteOffset' requires 'bufferView'.");
}

TEST(OneOf, NoneAndBothAreToldAtTheObject) {
  const Found none = only(asset(R"("images": [{}])"));
  EXPECT_EQ(none.code, "ONE_OF_MISMATCH");
  EXPECT_EQ(none.pointer, "/images/0");
  EXPECT_EQ(none.marked, "{");
  EXPECT_THAT(none.message,
              testing::AllOf(HasSubstr("'bufferView' or 'uri'"), HasSubstr("neither")));
  const auto both = verdict(
      asset(R"("buffers": [{"byteLength": 9}], "bufferViews": [{"buffer": 0, "byteLength": 9}],
    "images": [{"uri": "a", "bufferView": 0, "mimeType": "image/png"}])"));
  EXPECT_THAT(both, ElementsAre("ONE_OF_MISMATCH /images/0"));
}

TEST(Condition, AsksForTheMemberThatTheKindNeeds) {
  EXPECT_THAT(verdict(asset(R"("cameras": [{"type": "orthographic"}])")),
              ElementsAre("UNDEFINED_PROPERTY /cameras/0"));
  EXPECT_THAT(
      verdict(asset(R"("cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1},
    "orthographic": {"xmag": 1, "ymag": 1, "zfar": 2, "znear": 1}}])")),
      ElementsAre("ONE_OF_MISMATCH /cameras/0"));
}

TEST(EmptyObject, WhereMembersAreNeededIsTold) {
  EXPECT_THAT(verdict(asset(R"("meshes": [{"primitives": [{"attributes": {}}]}])")),
              ElementsAre("EMPTY_ENTITY /meshes/0/primitives/0/attributes"));
}

TEST(Map, ValuesAreChecked) {
  EXPECT_THAT(
      verdict(asset(
          R"("meshes": [{"primitives": [{"attributes": {"POSITION": "0", "extras": {}, "_A": -1, "NORMAL": 0}}]}])")),
      ElementsAre("TYPE_MISMATCH /meshes/0/primitives/0/attributes/POSITION",
                  "TYPE_MISMATCH /meshes/0/primitives/0/attributes/extras",
                  "INVALID_INDEX /meshes/0/primitives/0/attributes/_A",
                  "UNRESOLVED_REFERENCE /meshes/0/primitives/0/attributes/NORMAL"));
}

TEST(Extras, ThatAreNoObjectAreAnInformation) {
  const Found found = only(material(R"("extras": [1])"));
  EXPECT_EQ(found.code, "NON_OBJECT_EXTRAS");
  EXPECT_EQ(found.marked, "[1]");
}

TEST(RepeatedMember, TheLastCounts) {
  const auto parsed = json::parse(
      R"({"asset": {"version": "2.0"}, "materials": [{"alphaCutoff": -1, "alphaCutoff": 1}], "materials": [{}]})");
  ASSERT_FALSE(parsed.document.empty()) << "the parser tells the repeat and reads on";
  class Count : public Sink {
   public:
    void report(const Path&, Finding) override { ++count; }
    int count = 0;
  } sink;
  schema::check(parsed.document, *schema::builtin_set(), {}, sink, sink);
  EXPECT_EQ(sink.count, 0);
}

class Words : public testing::Test {
 protected:
  std::vector<std::string> said(const std::string& members, const std::string& object,
                                const schema::Deviations& deviations = {}) {
    set_ = set_with(acme(members));
    EXPECT_NE(set_, nullptr) << members;
    if (set_ == nullptr) return {};
    std::vector<std::string> lines;
    const std::string prefix = "/materials/0/extensions/ACME_x";
    for (const Found& found :
         find(asset_using("ACME_x", R"("nodes": [{}], "materials": [{"extensions": {"ACME_x": )" +
                                        object + "}}]"),
              deviations, *set_)) {
      EXPECT_EQ(found.pointer.rfind(prefix, 0), 0U) << found.pointer;
      lines.push_back(found.code + " " +
                      found.pointer.substr(std::min(prefix.size(), found.pointer.size())));
      last_ = found;
    }
    return lines;
  }
  std::shared_ptr<const schema::Set> set_;
  Found last_;
};

TEST_F(Words, AliasesAreInformationAndCheckedAsTheProperty) {
  const std::string members =
      R"("required": ["age"], "properties": {"age": {"type": "integer", "maximum": 5, "x-gltfx": {"aliases": ["years"]}}})";
  EXPECT_THAT(said(members, R"({"years": 3})"), ElementsAre("PROPERTY_RENAMED /years"));
  EXPECT_THAT(last_.help, HasSubstr("'age'"));
  EXPECT_THAT(said(members, R"({"years": 7})"),
              ElementsAre("PROPERTY_RENAMED /years", "VALUE_NOT_IN_RANGE /years"));
  EXPECT_THAT(said(members, R"({"years": 7, "age": 3})"), ElementsAre("PROPERTY_RENAMED /years"));
}

TEST_F(Words, DeprecatedPropertiesAreInformation) {
  const std::string members =
      R"("properties": {"old": {"x-gltfx": {"deprecated": "use 'fresh'"}}, "older": {"deprecated": true}})";
  EXPECT_THAT(said(members, R"({"old": 3})"), ElementsAre("PROPERTY_DEPRECATED /old"));
  EXPECT_THAT(last_.message, HasSubstr("use 'fresh'"));
  EXPECT_THAT(said(members, R"({"older": 3})"), ElementsAre("PROPERTY_DEPRECATED /older"));
}

TEST_F(Words, PropertiesOfADraftAreInformation) {
  const std::string members = R"("properties": {"next": {"x-gltfx": {"draft": "ACME 2"}}})";
  EXPECT_THAT(said(members, R"({"next": 3})"), ElementsAre("PROPERTY_DRAFT /next"));
  EXPECT_THAT(last_.message, HasSubstr("the draft of ACME 2"));
}

TEST_F(Words, AdditionalPropertiesOpenAndCloseAnObject) {
  EXPECT_THAT(said(R"("properties": {"a": {}})", R"({"b": 1})"),
              ElementsAre("UNEXPECTED_PROPERTY /b"));
  EXPECT_THAT(said(R"("properties": {"a": {}}, "additionalProperties": true)", R"({"b": 1})"),
              IsEmpty());
  EXPECT_THAT(said(R"("properties": {"a": {}}, "additionalProperties": {"type": "string"})",
                   R"({"b": 1, "c": "x"})"),
              ElementsAre("TYPE_MISMATCH /b"));
  EXPECT_THAT(said(R"("additionalProperties": false)", R"({"b": 1})"),
              ElementsAre("UNEXPECTED_PROPERTY /b"));
  EXPECT_THAT(said(R"("type": "object")", R"({"b": 1})"), IsEmpty());
}

TEST_F(Words, PatternPropertiesDescribeMembersByName) {
  const std::string members =
      R"("properties": {"a": {}}, "patternProperties": {"^_": {"type": "integer"}})";
  EXPECT_THAT(said(members, R"({"_x": 1, "a": 2})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"_x": "1", "x": 2})"),
              ElementsAre("UNEXPECTED_PROPERTY /x", "TYPE_MISMATCH /_x"));
}

TEST_F(Words, PropertyNamesAreChecked) {
  const std::string map =
      R"("properties": {"m": {"type": "object", "additionalProperties": true, "propertyNames": {"pattern": "^[a-z]+$", "maxLength": 3}}})";
  EXPECT_THAT(said(map, R"({"m": {"ab": 1}})"), IsEmpty());
  EXPECT_THAT(said(map, R"({"m": {"A": 1}})"), ElementsAre("PATTERN_MISMATCH /m/A"));
  EXPECT_THAT(said(map, R"({"m": {"abcd": 1}})"),
              ElementsAre("STRING_LENGTH_NOT_IN_RANGE /m/abcd"));
}

TEST_F(Words, PropertyNamesThatAreTakenAreRefused) {
  const std::string map =
      R"("properties": {"m": {"type": "object", "additionalProperties": true, "propertyNames": {"not": {"enum": ["a", "b"]}}}})";
  EXPECT_THAT(said(map, R"({"m": {"ab": 1, "c": 1}})"), IsEmpty());
  EXPECT_THAT(said(map, R"({"m": {"b": 1}})"), ElementsAre("CONDITION_MISMATCH /m/b"));
}

TEST_F(Words, MemberCountsAreChecked) {
  const std::string map =
      R"("properties": {"m": {"type": "object", "minProperties": 2, "maxProperties": 3}})";
  EXPECT_THAT(said(map, R"({"m": {"a": 1, "b": 1}})"), IsEmpty());
  EXPECT_THAT(said(map, R"({"m": {}})"), ElementsAre("EMPTY_ENTITY /m"));
  EXPECT_THAT(said(map, R"({"m": {"a": 1}})"), ElementsAre("PROPERTY_COUNT_NOT_IN_RANGE /m"));
  EXPECT_THAT(said(map, R"({"m": {"a": 1, "b": 1, "c": 1, "d": 1}})"),
              ElementsAre("PROPERTY_COUNT_NOT_IN_RANGE /m"));
}

TEST_F(Words, AnyOfNamesWereOneIsNeeded) {
  const std::string members =
      R"("properties": {"a": {}, "b": {}}, "anyOf": [{"required": ["a"]}, {"required": ["b"]}])";
  EXPECT_THAT(said(members, "{}"), ElementsAre("UNDEFINED_PROPERTY "));
  EXPECT_THAT(said(members, R"({"a": 1, "b": 1})"), IsEmpty());
}

TEST_F(Words, AlternativesOfNumbersAreRangesOrLists) {
  const std::string number =
      R"("properties": {"n": {"type": "number", "oneOf": [{"const": 0}, {"minimum": 1}]}})";
  EXPECT_THAT(said(number, R"({"n": 0})"), IsEmpty());
  EXPECT_THAT(said(number, R"({"n": 1.5})"), IsEmpty());
  EXPECT_THAT(said(number, R"({"n": 0.5})"), ElementsAre("VALUE_NOT_IN_RANGE /n"));
  EXPECT_THAT(last_.message, HasSubstr("0 or at least 1"));
  const std::string list = R"("properties": {"n": {"anyOf": [{"enum": ["a"]}, {"const": 3}]}})";
  EXPECT_THAT(said(list, R"({"n": "b"})"), ElementsAre("VALUE_NOT_IN_LIST /n"));
}

TEST_F(Words, AlternativesOfTypesAreACondition) {
  const std::string members =
      R"("properties": {"n": {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "integer"}}]}})";
  EXPECT_THAT(said(members, R"({"n": "b"})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"n": [1, 2]})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"n": [1, 2.5]})"), ElementsAre("CONDITION_MISMATCH /n"));
  EXPECT_THAT(said(members, R"({"n": {}})"), ElementsAre("CONDITION_MISMATCH /n"));
  EXPECT_THAT(last_.message, HasSubstr("a string or an array"));
}

TEST_F(Words, ReferencesInsideAnAlternativeAreFollowed) {
  const std::string members = R"("properties": {"n": {"anyOf": [{"type": "string"},
    {"type": "object", "required": ["node"], "properties": {"node": {"type": "integer", "minimum": 0, "x-gltfx": {"ref": "nodes"}}}}]}})";
  EXPECT_THAT(said(members, R"({"n": {"node": 0}})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"n": {"node": 1}})"), ElementsAre("UNRESOLVED_REFERENCE /n/node"));
}

TEST_F(Words, NotOneMemberForbidsIt) {
  const std::string members =
      R"("properties": {"a": {"type": "string"}, "b": {}}, "if": {"properties": {"a": {"const": "x"}}, "required": ["a"]},
    "then": {"not": {"required": ["b"]}}, "else": {"required": ["b"]})";
  EXPECT_THAT(said(members, R"({"a": "x"})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"a": "x", "b": 1})"), ElementsAre("CONDITION_MISMATCH /b"));
  EXPECT_THAT(said(members, R"({"a": "y"})"), ElementsAre("UNDEFINED_PROPERTY "));
}

TEST_F(Words, ThenTellsExactlyWhatIsWrong) {
  const std::string members =
      R"("properties": {"mode": {"type": "string"}, "n": {"type": "integer"}, "list": {"type": "array", "items": {"type": "number"}}},
    "if": {"properties": {"mode": {"enum": ["even", "both"]}}, "required": ["mode"]},
    "then": {"properties": {"n": {"multipleOf": 2}, "list": {"items": {"maximum": 1}}, "never": false}})";
  EXPECT_THAT(said(members, R"({"mode": "odd", "n": 3, "list": [5]})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"mode": "even", "n": 3})"), ElementsAre("VALUE_MULTIPLE_OF /n"));
  EXPECT_THAT(said(members, R"({"mode": "both", "n": 2, "list": [1, 5]})"),
              ElementsAre("VALUE_NOT_IN_RANGE /list/1"));
}

TEST_F(Words, ExtrasWithASchemaOfTheirOwnAreChecked) {
  const std::string members =
      R"("properties": {"extras": {"type": "object", "properties": {"id": {"type": "string"}}}})";
  EXPECT_THAT(said(members, R"({"extras": {"id": "a"}})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"extras": {"id": 3}})"), ElementsAre("TYPE_MISMATCH /extras/id"));
}

TEST_F(Words, JsonPointersOfAUserAreChecked) {
  const std::string members =
      R"("properties": {"p": {"type": "string", "format": "json-pointer"}})";
  EXPECT_THAT(said(members, R"({"p": "/a/~0b"})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"p": "a/b"})"), ElementsAre("PATTERN_MISMATCH /p"));
  EXPECT_THAT(said(members, R"({"p": "/a~2"})"), ElementsAre("PATTERN_MISMATCH /p"));
}

TEST_F(Words, NullAndListsOfTypesAreUnderstood) {
  const std::string members = R"("properties": {"p": {"type": ["null", "integer", "boolean"]}})";
  EXPECT_THAT(said(members, R"({"p": null})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"p": 3})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"p": 3.5})"), ElementsAre("TYPE_MISMATCH /p"));
  EXPECT_THAT(last_.message, HasSubstr("an integer, true or false or null"));
}

TEST_F(Words, ArraysOfArraysAreWalked) {
  const std::string members =
      R"("properties": {"m": {"type": "array", "items": {"type": "array", "items": {"type": "number"}, "minItems": 2}}})";
  EXPECT_THAT(said(members, R"({"m": [[1, 2], [3, 4]]})"), IsEmpty());
  EXPECT_THAT(said(members, R"({"m": [[1, 2], [3], 4, ["x", 1]]})"),
              ElementsAre("ARRAY_LENGTH_NOT_IN_LIST /m/1", "ARRAY_TYPE_MISMATCH /m/2",
                          "ARRAY_TYPE_MISMATCH /m/3"));
}

TEST_F(Words, UniqueNumbersAndObjectsAreCompared) {
  const std::string members =
      R"("properties": {"n": {"type": "array", "uniqueItems": true, "items": {"type": "number"}},
    "o": {"type": "array", "uniqueItems": true}})";
  EXPECT_THAT(said(members, R"({"n": [1, 2, 1.0]})"), ElementsAre("DUPLICATE_ELEMENTS /n/2"));
  EXPECT_THAT(said(members, R"({"o": [{"a": 1}, {"a": 2}, {"a": 1}]})"),
              ElementsAre("DUPLICATE_ELEMENTS /o/2"));
}

}  // namespace
}  // namespace gltfx::test
