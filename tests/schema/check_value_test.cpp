// SPDX-License-Identifier: Apache-2.0
// Single values and arrays: codes, places, words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/findings.hpp"
#include "schema/leaf.hpp"

namespace gltfx::test {
namespace {

using schema::kKhronosValidator;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Found pbr(const std::string& members) {
  return only(material("\"pbrMetallicRoughness\": {" + members + "}"));
}

std::vector<Found> leaf_findings(const schema::Set& set, const std::string& members) {
  return test::find(
      asset_using("ACME_x", R"("materials": [{"extensions": {"ACME_x": {)" + members + "}}}]"), {},
      set);
}

TEST(Vector, OfUnitLength) {
  const auto set = set_with(acme(R"("type": "object", "properties": {
    "up": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3, "x-gltfx": {"unitLength": "error"}},
    "pull": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3, "x-gltfx": {"unitLength": "warning"}}})"));
  ASSERT_NE(set, nullptr);
  const auto said = [&](const std::string& members) { return leaf_findings(*set, members); };
  EXPECT_THAT(said(R"("up": [0, 0.6, -0.8], "pull": [0.577, 0.577, 0.577])"), IsEmpty());
  const auto up = said(R"("up": [0, 3, 4])");
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up[0].code, "VECTOR_NON_UNIT");
  EXPECT_EQ(up[0].message, "'up' has length 5; it must be 1.");
  EXPECT_EQ(up[0].help, "divide the numbers by the length");
  EXPECT_TRUE(up[0].is_error);
  const auto pull = said(R"("pull": [0, 0, 0])");
  ASSERT_EQ(pull.size(), 1U);
  EXPECT_EQ(pull[0].message, "'pull' has length 0; it should be 1.");
  EXPECT_EQ(pull[0].help, "") << "no direction, no help";
  EXPECT_FALSE(pull[0].is_error);
  EXPECT_EQ(said(R"("up": [0, 3])")[0].code, "ARRAY_LENGTH_NOT_IN_LIST")
      << "one cause, one finding";
  EXPECT_THAT(said(R"("up": [1e308, 1e308, 1e308])"), testing::SizeIs(1));
}

TEST(Text, ThatShouldHaveAForm) {
  const auto set = set_with(acme(R"("type": "object", "properties": {
    "version": {"type": "string", "x-gltfx": {"shouldMatch": "^[0-9]+$"}}})"));
  ASSERT_NE(set, nullptr);
  EXPECT_THAT(leaf_findings(*set, R"("version": "12")"), IsEmpty());
  const auto found = leaf_findings(*set, R"("version": "one")");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, "PATTERN_MISMATCH");
  EXPECT_EQ(found[0].message, "'version' is the string 'one'; it should match ^[0-9]+$.");
  EXPECT_FALSE(found[0].is_error);
}

TEST(Number, OutOfRangeSaysWhatIsThereAndWhatIsExpected) {
  const Found found = pbr(R"("metallicFactor": 1.5)");
  EXPECT_EQ(found.code, "VALUE_NOT_IN_RANGE");
  EXPECT_EQ(found.pointer, "/materials/0/pbrMetallicRoughness/metallicFactor");
  EXPECT_EQ(found.message, "'metallicFactor' is 1.5; it must be between 0 and 1.");
  EXPECT_EQ(found.marked, "1.5");
}

TEST(Number, LimitsThemselvesAreFine) {
  EXPECT_THAT(
      verdict(material(R"("pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1.0})")),
      IsEmpty());
  EXPECT_THAT(verdict(material(
                  R"("pbrMetallicRoughness": {"metallicFactor": 1e0, "roughnessFactor": 10E-1})")),
              IsEmpty());
}

TEST(Number, ExclusiveLimitsAreNot) {
  const auto camera = [](const char* yfov) {
    return asset(
        std::string(R"("cameras": [{"type": "perspective", "perspective": {"znear": 1, "yfov": )") +
        yfov + "}}]");
  };
  EXPECT_THAT(verdict(camera("0")), ElementsAre("VALUE_NOT_IN_RANGE /cameras/0/perspective/yfov"));
  EXPECT_THAT(verdict(camera("5e-324")), IsEmpty());
  EXPECT_THAT(only(camera("0")).message, HasSubstr("above 0"));
}

TEST(Number, StringsThatHoldOneGetTheQuotesNamed) {
  const Found found = pbr(R"("metallicFactor": "0.5")");
  EXPECT_EQ(found.code, "TYPE_MISMATCH");
  EXPECT_EQ(found.message, "'metallicFactor' is the string '0.5'; it must be a number.");
  EXPECT_EQ(found.help, "remove the quotes: write 0.5");
}

TEST(Integer, WholeNumbersCountHoweverTheyAreWritten) {
  const auto count = [](const char* number) {
    return verdict(asset(std::string(R"("buffers": [{"byteLength": )") + number + "}]"));
  };
  EXPECT_THAT(count("1.0"), IsEmpty());
  EXPECT_THAT(count("1e3"), IsEmpty());
  EXPECT_THAT(count("1.5"), ElementsAre("TYPE_MISMATCH /buffers/0/byteLength"));
  EXPECT_THAT(count("0"), ElementsAre("VALUE_NOT_IN_RANGE /buffers/0/byteLength"));
  EXPECT_THAT(count("9007199254740992"), IsEmpty());
}

TEST(Integer, MultiplesAreChecked) {
  const Found found = only(asset(
      R"("buffers": [{"byteLength": 64}], "bufferViews": [{"buffer": 0, "byteLength": 64, "byteStride": 6}])"));
  EXPECT_EQ(found.code, "VALUE_MULTIPLE_OF");
  EXPECT_THAT(found.message, HasSubstr("a multiple of 4"));
}

TEST(Boolean, NumbersForFlagsAreNamed) {
  const Found found = only(material(R"("doubleSided": 1)"));
  EXPECT_EQ(found.message, "'doubleSided' is 1; it must be true or false.");
  EXPECT_EQ(found.help, "write true");
}

TEST(Enum, UnlistedValuesSuggestTheNearest) {
  const Found found = only(material(R"("alphaMode": "BLENDED")"));
  EXPECT_EQ(found.code, "VALUE_NOT_IN_LIST");
  EXPECT_EQ(found.message,
            "'alphaMode' is the string 'BLENDED'; it must be 'OPAQUE', 'MASK' or 'BLEND'.");
  EXPECT_EQ(found.help, "did you mean 'BLEND'?");
}

TEST(Enum, NumbersAreListedWithTheirNames) {
  const Found found = only(asset(R"("samplers": [{"magFilter": 9730}])"));
  EXPECT_EQ(found.code, "VALUE_NOT_IN_LIST");
  EXPECT_THAT(found.message, HasSubstr("9728 (NEAREST) or 9729 (LINEAR)"));
}

TEST(Enum, EscapedStringsAreReadAsWhatTheyMean) {
  EXPECT_THAT(verdict(material("\"alphaMode\": \"M\\u0041SK\"")), IsEmpty());
  EXPECT_THAT(verdict(material("\"alphaMode\": \"M\\u0042SK\"")),
              ElementsAre("VALUE_NOT_IN_LIST /materials/0/alphaMode"));
}

TEST(Enum, ExtensionsAddValuesOnceTheyAreDeclared) {
  const std::string images = R"("images": [{"uri": "a", "mimeType": "image/webp"}])";
  EXPECT_THAT(verdict(asset(images)), ElementsAre("VALUE_NOT_IN_LIST /images/0/mimeType"));
  EXPECT_THAT(verdict(asset_using("EXT_texture_webp", images)), IsEmpty());
  EXPECT_THAT(verdict(asset_using("KHR_texture_basisu", images)),
              ElementsAre("VALUE_NOT_IN_LIST /images/0/mimeType"));
  EXPECT_THAT(verdict(asset_using("EXT_texture_webp", images), kKhronosValidator), IsEmpty());
  const std::string astc = R"("images": [{"uri": "a", "mimeType": "image/ktx2"}])";
  EXPECT_THAT(verdict(asset_using("EXT_texture_astc", astc)), IsEmpty());
  EXPECT_THAT(verdict(asset_using("EXT_texture_astc", astc), kKhronosValidator),
              testing::Contains("VALUE_NOT_IN_LIST /images/0/mimeType"))
      << "that validator does not know the extension";
}

TEST(Text, PatternsAreShown) {
  const Found found = only(R"({"asset": {"version": "two"}})");
  EXPECT_EQ(found.code, "PATTERN_MISMATCH");
  EXPECT_EQ(found.pointer, "/asset/version");
}

TEST(Text, LengthsCountCharactersNotBytes) {
  const auto set =
      set_with(acme(R"("properties": {"s": {"type": "string", "minLength": 2, "maxLength": 3}})"));
  ASSERT_NE(set, nullptr);
  const auto said = [&](const std::string& text) {
    return verdict(asset_using("ACME_x", R"("materials": [{"extensions": {"ACME_x": {"s": ")" +
                                             text + "\"}}}]"),
                   {}, *set);
  };
  const std::string code = "STRING_LENGTH_NOT_IN_RANGE /materials/0/extensions/ACME_x/s";
  EXPECT_THAT(said("a"), ElementsAre(code));
  EXPECT_THAT(said("\xc3\xa4"), ElementsAre(code));
  EXPECT_THAT(said("\xc3\xa4\xc3\xa4\xc3\xa4"), IsEmpty());
  EXPECT_THAT(said("abcd"), ElementsAre(code));
}

TEST(Null, IsAWrongTypeOnceOrTwice) {
  const std::string json = asset(R"("buffers": [{"byteLength": null}])");
  EXPECT_THAT(verdict(json), ElementsAre("TYPE_MISMATCH /buffers/0/byteLength"));
  EXPECT_THAT(verdict(json, kKhronosValidator),
              testing::UnorderedElementsAre("TYPE_MISMATCH /buffers/0/byteLength",
                                            "UNDEFINED_PROPERTY /buffers/0"));
}

TEST(NumberArray, LengthAndElementsAreTold) {
  const auto base = [](const char* array) {
    return verdict(material(std::string(R"("emissiveFactor": )") + array));
  };
  const std::string at = "/materials/0/emissiveFactor";
  EXPECT_THAT(base("[0, 0.5, 1]"), IsEmpty());
  EXPECT_THAT(base("[0,0]"), ElementsAre("ARRAY_LENGTH_NOT_IN_LIST " + at));
  EXPECT_THAT(base("[0,0,0,0]"), ElementsAre("ARRAY_LENGTH_NOT_IN_LIST " + at));
  EXPECT_THAT(base("[]"), ElementsAre("EMPTY_ENTITY " + at));
  // An array of the wrong length has another meaning, and the range of its numbers is unknown.
  EXPECT_THAT(base("[255, -1, 0, 1]"), ElementsAre("ARRAY_LENGTH_NOT_IN_LIST " + at));
  EXPECT_THAT(base("[0, 1.0000001, -0.5]"),
              ElementsAre("VALUE_NOT_IN_RANGE " + at + "/1", "VALUE_NOT_IN_RANGE " + at + "/2"));
  EXPECT_THAT(base("[0, 1e-1, 1E1]"), ElementsAre("VALUE_NOT_IN_RANGE " + at + "/2"));
  EXPECT_THAT(base("[0, 0.5e1, 0]"), ElementsAre("VALUE_NOT_IN_RANGE " + at + "/1"));
  EXPECT_THAT(base("[0, 1.00, 10]"), ElementsAre("VALUE_NOT_IN_RANGE " + at + "/2"));
  EXPECT_THAT(base("[0, \"1\", 1]"), ElementsAre("ARRAY_TYPE_MISMATCH " + at));
  EXPECT_THAT(base("[null, null, null]"), ElementsAre("ARRAY_TYPE_MISMATCH " + at))
      << "one cause, one finding";
  EXPECT_THAT(base("7"), ElementsAre("TYPE_MISMATCH " + at));
}

TEST(NumberArray, NegativeFractionsFitWhereTheyMay) {
  const auto node = [](const char* rotation) {
    return verdict(asset(std::string(R"("nodes": [{"rotation": )") + rotation + "}]"));
  };
  EXPECT_THAT(node("[-1, -0.5, 0.0, 1.000]"), IsEmpty());
  EXPECT_THAT(node("[-1.01, 0, 0, 1]"), ElementsAre("VALUE_NOT_IN_RANGE /nodes/0/rotation/0"));
  EXPECT_THAT(node("[0, 0, 0, 1.5]"), ElementsAre("VALUE_NOT_IN_RANGE /nodes/0/rotation/3"));
}

TEST(NumberArray, KhronosTellsEveryBadElement) {
  const std::string json = material(R"("emissiveFactor": [null, 0, null])");
  EXPECT_EQ(verdict(json, kKhronosValidator).size(), 2U);
}

TEST(IndexArray, ErrorsAreToldAtTheElement) {
  const auto scene = [](const char* nodes) {
    return verdict(
        asset(std::string(R"("nodes": [{}, {}, {}], "scenes": [{"nodes": )") + nodes + "}]"));
  };
  const std::string at = "/scenes/0/nodes";
  EXPECT_THAT(scene("[0, 1, 2]"), IsEmpty());
  EXPECT_THAT(scene("[]"), ElementsAre("EMPTY_ENTITY " + at));
  EXPECT_THAT(scene("[0, 0]"), ElementsAre("DUPLICATE_ELEMENTS " + at + "/1"));
  EXPECT_THAT(scene("[0, -1]"), ElementsAre("INVALID_INDEX " + at + "/1"));
  EXPECT_THAT(scene("[0, 1.5]"), ElementsAre("INVALID_INDEX " + at + "/1"));
  EXPECT_THAT(scene("[0, \"1\", null]"),
              ElementsAre("INVALID_INDEX " + at + "/1", "INVALID_INDEX " + at + "/2"));
  EXPECT_THAT(scene("[2, 3]"), ElementsAre("UNRESOLVED_REFERENCE " + at + "/1"));
  EXPECT_THAT(scene("[1.0, 1e0]"), ElementsAre("DUPLICATE_ELEMENTS " + at + "/1"));
}

TEST(IndexArray, LongOnesAreCheckedForRepeatsToo) {
  std::string nodes, list;
  for (int i = 0; i < 100; ++i) {
    nodes += i == 0 ? "{}" : ",{}";
    list += i == 0 ? "" : ",";
    list += std::to_string(i);
  }
  EXPECT_THAT(
      verdict(asset("\"nodes\": [" + nodes + "], \"scenes\": [{\"nodes\": [" + list + "]}]")),
      IsEmpty());
  EXPECT_THAT(
      verdict(asset("\"nodes\": [" + nodes + "], \"scenes\": [{\"nodes\": [" + list + ",50]}]")),
      ElementsAre("DUPLICATE_ELEMENTS /scenes/0/nodes/100"));
}

TEST(StringArray, ErrorsAreToldAtTheElement) {
  const auto used = [](const char* list) {
    return verdict(asset(std::string(R"("extensionsUsed": )") + list));
  };
  EXPECT_THAT(used(R"(["A_b", "A_b"])"), ElementsAre("DUPLICATE_ELEMENTS /extensionsUsed/1"));
  EXPECT_THAT(used(R"(["A_b", "A_\u0062"])"), ElementsAre("DUPLICATE_ELEMENTS /extensionsUsed/1"));
  EXPECT_THAT(used(R"(["A_b", 3])"), ElementsAre("ARRAY_TYPE_MISMATCH /extensionsUsed/1"));
  EXPECT_THAT(used("[]"), ElementsAre("EMPTY_ENTITY /extensionsUsed"));
  EXPECT_THAT(used("\"A_b\""), ElementsAre("TYPE_MISMATCH /extensionsUsed"));
}

TEST(ObjectArray, ErrorsAreToldAtTheArrayButAtTheItemInRootArrays) {
  EXPECT_THAT(verdict(asset(R"("meshes": [{"primitives": [3]}])")),
              ElementsAre("ARRAY_TYPE_MISMATCH /meshes/0/primitives"));
  EXPECT_THAT(verdict(asset(R"("meshes": [{"primitives": []}])")),
              ElementsAre("EMPTY_ENTITY /meshes/0/primitives"));
  EXPECT_THAT(verdict(asset(R"("meshes": [{}])")), ElementsAre("UNDEFINED_PROPERTY /meshes/0"));
  EXPECT_THAT(verdict(asset(R"("materials": [3, {}, "x"])")),
              ElementsAre("TYPE_MISMATCH /materials/0", "TYPE_MISMATCH /materials/2"));
  EXPECT_THAT(verdict(asset(R"("materials": [])")), ElementsAre("EMPTY_ENTITY /materials"));
}

TEST(ObjectArray, ABareObjectIsShownTheArray) {
  const Found found = only(asset(R"("materials": {"name": "a"})"));
  EXPECT_EQ(found.code, "TYPE_MISMATCH");
  EXPECT_THAT(found.help, HasSubstr("[ {"));
}

TEST(TextureSlot, ABareIndexIsShownTheObject) {
  const Found found = pbr(R"("baseColorTexture": 3)");
  EXPECT_EQ(found.code, "TYPE_MISMATCH");
  EXPECT_EQ(found.message, "'baseColorTexture' is 3; it must be an object.");
  EXPECT_EQ(found.help, "write { \"index\": 3 }");
}

TEST(Document, ThatIsNoObjectIsToldAtTheRoot) {
  EXPECT_THAT(verdict("[1]"), ElementsAre("TYPE_MISMATCH "));
  EXPECT_THAT(verdict("null"), ElementsAre("TYPE_MISMATCH "));
}

TEST(Names, HostileTextInMessagesIsNeutralised) {
  const Found found = only(material("\"alphaMode\": \"\\u001b[31m\\n::error\""));
  EXPECT_EQ(found.message.find('\x1b'), std::string::npos);
  EXPECT_EQ(found.message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace gltfx::test
