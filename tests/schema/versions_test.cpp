// SPDX-License-Identifier: Apache-2.0
// What depends on the version of glTF that an asset states.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/findings.hpp"
#include "schema/leaf.hpp"
#include "schema/version.hpp"

namespace gltfx::test {
namespace {

using schema::parse_version;
using schema::Version;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string of_version(const std::string& version, const std::string& members) {
  return R"({"asset": {"version": ")" + version + R"("}, )" + members + "}";
}

TEST(Version, IsTwoNumbersThatCompareAsIntegers) {
  EXPECT_EQ(parse_version("2.1"), (Version{2, 1}));
  EXPECT_LT(*parse_version("2.1"), *parse_version("2.10"));
  EXPECT_LT(*parse_version("2.10"), *parse_version("3.0"));
  for (const char* const wrong : {"", "2", "2.", ".1", "2.1.0", "a.b", "2.-1", "+2.1"}) {
    EXPECT_FALSE(parse_version(wrong)) << wrong;
  }
  EXPECT_EQ(parse_version("2.99999999999"), (Version{2, UINT32_MAX}));
}

TEST(Version, OfTheBuiltInSchemasAreInOrder) {
  const auto& versions = schema::builtin_set()->versions();
  ASSERT_FALSE(versions.empty());
  EXPECT_EQ(versions.front().version, schema::kVersion2);
  for (std::size_t i = 1; i < versions.size(); ++i) {
    EXPECT_LT(versions[i - 1].version, versions[i].version);
    const bool draft = versions[i].status == schema::Status::draft;
    EXPECT_EQ(draft, !versions[i].revision.empty());
  }
}

const std::string kShapes = R"("shapes": [{"type": "box"}])";

TEST(Since, EarlierAssetsDoNotHaveTheMember) {
  EXPECT_THAT(verdict(of_version("2.1", kShapes)), IsEmpty());
  EXPECT_THAT(verdict(of_version("2.7", kShapes)), IsEmpty()) << "judged by the newest one";
  const Found found = only(of_version("2.0", kShapes));
  EXPECT_EQ(found.code, "UNEXPECTED_PROPERTY");
  EXPECT_EQ(found.pointer, "/shapes");
  EXPECT_THAT(found.help, HasSubstr("of glTF 2.1"));
}

TEST(Since, AnUnknownMemberIsNotLookedInto) {
  EXPECT_THAT(verdict(of_version("2.0", R"("shapes": [{"type": 3}], "files": 1)")),
              ElementsAre("UNEXPECTED_PROPERTY /shapes", "UNEXPECTED_PROPERTY /files"));
}

TEST(Since, LaterNamesAreNotSuggestedToEarlierAssets) {
  EXPECT_THAT(only(of_version("2.1", R"("shape": [])")).help, HasSubstr("'shapes'"));
  EXPECT_THAT(only(of_version("2.0", R"("shape": [])")).help, testing::Not(HasSubstr("'shapes'")));
  EXPECT_THAT(only(of_version("2.0", R"("mimeType": "a")")).message,
              testing::Not(HasSubstr("'files'")));
}

TEST(Since, TheKhronosValidatorKnowsNone) {
  const schema::Deviations khronos = schema::kKhronosValidator;
  EXPECT_THAT(verdict(of_version("2.1", kShapes), khronos),
              ElementsAre("UNEXPECTED_PROPERTY /shapes"));
  EXPECT_THAT(verdict(of_version("2.1", R"("scenes": [{}, {}])"), khronos), IsEmpty());
}

TEST(Since, AMemberOfADraftIsInForceFromItsVersionOn) {
  const std::string members = R"("thumbnail": 0}, "images": [{"uri": "a.png"}]})";
  EXPECT_THAT(verdict(R"({"asset": {"version": "2.0", )" + members),
              ElementsAre("PROPERTY_DRAFT /asset/thumbnail"));
  EXPECT_THAT(verdict(R"({"asset": {"version": "2.1", )" + members), IsEmpty());
}

TEST(Since, AMemberOfADraftIsAnyNameToAnEarlierVersionThatMeansSomethingElse) {
  for (const std::string value : {"1", "-1", "null", R"("a.png")", R"({"uri": "a.png"})"}) {
    const std::string members = R"("thumbnail": )" + value + R"(}, "images": [{"uri": "a.png"}]})";
    EXPECT_THAT(verdict(R"({"asset": {"version": "2.0", )" + members),
                ElementsAre("UNEXPECTED_PROPERTY /asset/thumbnail"))
        << value;
    EXPECT_THAT(verdict(R"({"asset": {"version": "2.1", )" + members),
                ElementsAre(testing::Not(testing::HasSubstr("UNEXPECTED_PROPERTY"))))
        << value;
  }
  EXPECT_THAT(verdict(R"({"asset": {"version": "2.0", "thumbnail": 0}})"),
              ElementsAre("UNEXPECTED_PROPERTY /asset/thumbnail"));
}

TEST(Explained, NamesAreInformation) {
  const Found found = only(of_version("2.1", R"("nodes": [{"uid": "a"}])"));
  EXPECT_EQ(found.code, "UNEXPECTED_PROPERTY");
  EXPECT_FALSE(found.is_error);
  EXPECT_THAT(found.help, HasSubstr("proposed for glTF 2.1"));
  EXPECT_THAT(only(of_version("2.0", R"("nodes": [{"uid": "a"}])")).help,
              testing::Not(HasSubstr("2.1")));
}

TEST(Should, AdviceBeginsWithAVersion) {
  const std::string two = R"("scene": 1, "scenes": [{}, {}])";
  EXPECT_THAT(verdict(of_version("2.0", two)), IsEmpty());
  EXPECT_THAT(verdict(of_version("2.1", two)),
              ElementsAre("NOT_RECOMMENDED /scenes", "NOT_RECOMMENDED /scene"));
  EXPECT_THAT(verdict(of_version("2.1", R"("scene": 0, "scenes": [{}])")), IsEmpty());
}

TEST(OpenSince, OtherValuesAreAllowedFromAVersionOn) {
  const std::string image = R"("images": [{"bufferView": 0, "mimeType": "image/x"}],
    "bufferViews": [{"buffer": 0, "byteLength": 1}], "buffers": [{"byteLength": 1}])";
  EXPECT_THAT(verdict(of_version("2.0", image)),
              ElementsAre("VALUE_NOT_IN_LIST /images/0/mimeType"));
  EXPECT_THAT(verdict(of_version("2.1", image)), IsEmpty());
}

TEST(Without, MembersExcludeEachOther) {
  const std::string files =
      R"("meshes": [{"primitives": [{"attributes": {"_A": 0}}]}], "accessors": [{"componentType": 5126, "count": 1,
      "type": "SCALAR"}], "externalAssets": [{"file": 0}], "files": [{"uri": "a.gltf", "mimeType": "model/gltf+json"}],)";
  EXPECT_THAT(verdict(of_version("2.1", files + R"("nodes": [{"externalAsset": 0}])")), IsEmpty());
  EXPECT_THAT(verdict(of_version("2.1", files + R"("nodes": [{"externalAsset": 0, "mesh": 0}])")),
              ElementsAre("ONE_OF_MISMATCH /nodes/0"));
}

TEST(RefHolds, TheElementFitsASchema) {
  const auto said = [](const std::string& type) {
    return verdict(of_version("2.1", R"("shapes": [{"type": "plane"}, {"type": ")" + type +
                                         R"("}], "nodes": [{"boundingVolume": {"shape": 1}}])"));
  };
  EXPECT_THAT(said("box"), IsEmpty());
  EXPECT_THAT(said("sphere"), IsEmpty());
  EXPECT_THAT(said("VENDOR_torus"), IsEmpty()) << "an extension may allow it";
  EXPECT_THAT(said("cylinder"), ElementsAre("REFERENCE_MISMATCH /nodes/0/boundingVolume/shape"));
}

TEST(RefHolds, ManyReferencesToOneElementAreJudgedOnce) {
  std::string nodes = R"({"boundingVolume": {"shape": 0}})";
  for (int i = 0; i < 10; ++i) nodes += "," + nodes;
  std::string shape = R"({"type": "cylinder", "extras": {)";
  for (int i = 0; i < 1000; ++i) shape += "\"a" + std::to_string(i) + "\":0,";
  shape += R"("b":0}})";
  EXPECT_EQ(
      verdict(of_version("2.1", "\"shapes\": [" + shape + "], \"nodes\": [" + nodes + "]")).size(),
      1024U);
}

}  // namespace
}  // namespace gltfx::test
