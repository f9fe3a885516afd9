// SPDX-License-Identifier: Apache-2.0
/// Legacy objects in documents with errors: those that are edited, and those that are not.
#include "steps/upgrade/ambiguity.hpp"

#include <gmock/gmock.h>

#include "steps/upgrade/support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  std::string text;     // empty: refused
  std::string problem;  // reason
};

Outcome upgrade_of(const std::string& text) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  EXPECT_FALSE(parsed.document.empty()) << text;
  EXPECT_FALSE(parsed.ok()) << text;
  const Plan plan = make_plan(parsed.document, *schema::builtin_set(), {});
  EXPECT_FALSE(plan.change.edits.empty()) << text;
  if (auto problem = find_ambiguity(parsed, plan)) return {{}, *std::move(problem)};
  return {json::apply_edits(text, plan.change.edits), {}};
}

// As in tests/steps/upgrade/support.hpp, on a separate line.
const std::string kHead = R"({"extensionsUsed":["KHR_materials_translucency"],)";
const std::string kMaterial =
    R"({"extensions":{"KHR_materials_translucency":{"translucencyFactor":0.5}}})";
const std::string kFresh =
    R"({"extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.5}}})";
const std::string kFreshHead = R"({"extensionsUsed":["KHR_materials_diffuse_transmission"],)";

TEST(Ambiguity, ErrorsThatLieApartStay) {
  for (const std::string& error :
       {std::string(R"("asset":{"version":"2.0"},"asset":{"version":"2.0"})"),
        std::string(R"("nodes":[{"mesh":1,"mesh":2}])"), std::string(R"("nodes":[{},])"),
        std::string(R"("nodes":[{} {}])"), std::string(R"("extras":{"a":1 "a":2,})"),
        std::string(R"("cameras":[{"name":"\ud800"}])"),
        std::string(R"("meshes":[{"weights":[1e999]}])")}) {
    const Outcome outcome = upgrade_of(kHead + R"("materials":[)" + kMaterial + "]," + error + "}");
    EXPECT_EQ(outcome.text, kFreshHead + R"("materials":[)" + kFresh + "]," + error + "}")
        << outcome.problem;
  }
}

TEST(Ambiguity, AByteOrderMarkStays) {
  const std::string rest = R"("materials":[)";
  EXPECT_EQ(upgrade_of("\xEF\xBB\xBF" + kHead + rest + kMaterial + "]}").text,
            "\xEF\xBB\xBF" + kFreshHead + rest + kFresh + "]}");
}

TEST(Ambiguity, CommasBehindLastItemsStayAndAreNotCopied) {
  const Outcome outcome = upgrade_of(
      R"({"extensionsUsed":["KHR_materials_translucency",],"textures":[{},],"materials":[{)"
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extras":[1,],},},)"
      R"("extensions":{"KHR_materials_translucency":{"translucencyFactor":1,},},},]})");
  EXPECT_EQ(
      outcome.text,
      R"({"extensionsUsed":["KHR_materials_diffuse_transmission",],"textures":[{},],"materials":[{)"
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extras":[1,],},},)"
      R"("extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":1,)"
      R"("diffuseTransmissionColorTexture":{"index":0,"extras":[1]},},},},]})")
      << outcome.problem;
}

TEST(Ambiguity, OtherMaterialsMayHaveTheirErrors) {
  const std::string faulty = R"({"name":"a","name":"b" "doubleSided":true})";
  EXPECT_EQ(upgrade_of(kHead + R"("materials":[)" + faulty + "," + kMaterial + "]}").text,
            kFreshHead + R"("materials":[)" + faulty + "," + kFresh + "]}");
}

TEST(Ambiguity, NamesThatAreThereTwiceWhereThePlanReadsAreRefused) {
  for (const std::string& text : {
           kHead + R"("materials":[{"name":"a","name":"b",)" + kMaterial.substr(1) + "]}",
           kHead + R"("materials":[],"materials":[)" + kMaterial + "]}",
           kHead + R"("materials":[)" + kMaterial + R"(],"extensionsUsed":[]})",
           kHead + R"("textures":[],"textures":[],"materials":[)" + kMaterial + "]}",
           kHead +
               R"("meshes":[{"primitives":[{"attributes":{},"attributes":{}}]}],"materials":[)" +
               kMaterial + "]}",
       }) {
    const Outcome outcome = upgrade_of(text);
    EXPECT_EQ(outcome.text, "") << text;
    EXPECT_THAT(outcome.problem, StartsWith("its JSON is ambiguous at line 1, column ")) << text;
  }
}

TEST(Ambiguity, AMissingCommaInTheMaterialIsRefused) {
  const Outcome outcome =
      upgrade_of(kHead + "\n\"materials\":[{\"name\":\"a\" " + kMaterial.substr(1) + "]}");
  EXPECT_THAT(outcome.problem, StartsWith("its JSON is ambiguous at line 2, column 26"));
  EXPECT_THAT(outcome.problem, HasSubstr("missing ','"));
}

TEST(Ambiguity, AnEditedPlaceInsideARepeatedMemberIsRefused) {
  const Outcome outcome = upgrade_of(
      kHead + R"("animations":[],)" +
      test::animated("/materials/0/extensions/KHR_materials_translucency/translucencyFactor") +
      R"("materials":[)" + kMaterial + "]}");
  EXPECT_EQ(outcome.text, "");
}

TEST(Ambiguity, MoreErrorsThanAreRecordedAreTooMany) {
  std::string text = kHead + R"("materials":[)" + kMaterial + R"(],"extras":[)";
  for (int i = 0; i < 100; ++i) text += "[{},],";
  EXPECT_THAT(upgrade_of(text + "0]}").problem, HasSubstr("100 errors"));
}

}  // namespace
}  // namespace gltfx::upgrade::test
