// SPDX-License-Identifier: Apache-2.0
// Other changes of the document because of an upgrade: lists of names, pointers.
#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kConverted =
    R"({"extensions":{"KHR_materials_translucency":{"translucencyFactor":1}}})";
const std::string kLeft =
    R"({"extensions":{"KHR_materials_translucency":{"translucencyFactor":2}}})";

std::string names_after(const std::string& lists, const std::string& materials) {
  const Json root = upgraded("{" + lists + R"("materials":[)" + materials + "]}").json();
  std::string names;
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    names += root.value(list, Json()).dump() + " ";
  }
  return names;
}

TEST(Names, TheNewNameTakesThePlaceOfTheOld) {
  EXPECT_EQ(
      names_after(R"("extensionsUsed":["A_a","KHR_materials_translucency","B_b"],)", kConverted),
      R"(["A_a","KHR_materials_diffuse_transmission","B_b"] null )");
}

TEST(Names, ARequiredExtensionStaysRequired) {
  EXPECT_EQ(names_after(R"("extensionsUsed":["KHR_materials_translucency"],)"
                        R"("extensionsRequired":["KHR_materials_translucency"],)",
                        kConverted),
            R"(["KHR_materials_diffuse_transmission"] ["KHR_materials_diffuse_transmission"] )");
}

TEST(Names, ANameThatIsThereIsNotRepeated) {
  EXPECT_EQ(names_after(R"("extensionsUsed":["KHR_materials_translucency",)"
                        R"("KHR_materials_diffuse_transmission"],)",
                        kConverted),
            R"(["KHR_materials_diffuse_transmission"] null )");
}

TEST(Names, AMissingListOrNameIsAdded) {
  EXPECT_EQ(names_after("", kConverted), R"(["KHR_materials_diffuse_transmission"] null )");
  EXPECT_EQ(names_after(R"("extensionsUsed":["A_a"],)", kConverted),
            R"(["A_a","KHR_materials_diffuse_transmission"] null )");
}

TEST(Names, TheOldNameStaysWhileSomethingUsesIt) {
  EXPECT_EQ(
      names_after(R"("extensionsUsed":["KHR_materials_translucency"],)", kConverted + "," + kLeft),
      R"(["KHR_materials_translucency","KHR_materials_diffuse_transmission"] null )");
  EXPECT_EQ(names_after(R"("extensionsUsed":["KHR_materials_translucency"],)", kLeft),
            R"(["KHR_materials_translucency"] null )");
}

TEST(Names, ListsThatLoseTheirLastNameGo) {
  EXPECT_EQ(names_after(R"("extensionsUsed":["KHR_materials_translucency"],)"
                        R"("extensionsRequired":["KHR_materials_translucency"],)",
                        R"({"extensions":{"KHR_materials_translucency":{}}})"),
            "null null ");
}

TEST(Names, AListOfSomethingElseIsLeftAlone) {
  EXPECT_EQ(names_after(R"("extensionsUsed":[1,2],)", kConverted), "[1,2] null ");
  EXPECT_EQ(names_after(R"("extensionsUsed":{},)", kConverted), "{} null ");
  EXPECT_EQ(names_after(R"("extensionsUsed":["A_a",null],"extensionsRequired":[],)", kConverted),
            R"(["A_a",null,"KHR_materials_diffuse_transmission"] [] )");
  EXPECT_EQ(names_after(R"("extensionsUsed":["KHR_materials_translucency",null],)",
                        R"({"extensions":{"KHR_materials_translucency":{}}})"),
            "[null] null ");
}

std::string pointer_after(const std::string& pointer, const std::string& legacy) {
  return pointer_of(upgraded(document_with("", legacy, animated(pointer))).json());
}

TEST(Pointers, FollowTheNames) {
  const std::string at = "/materials/0/extensions/";
  EXPECT_EQ(pointer_after(at + "KHR_materials_translucency/translucencyFactor",
                          R"("translucencyFactor":1)"),
            at + "KHR_materials_diffuse_transmission/diffuseTransmissionFactor");
  EXPECT_EQ(pointer_after(at + "KHR_materials_translucency/translucencyColorTexture/extensions/"
                               "KHR_texture_transform/offset",
                          R"("translucencyFactor":1,"translucencyColorTexture":{"index":0})"),
            at + "KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture/extensions/"
                 "KHR_texture_transform/offset");
}

TEST(Pointers, ToObjectsThatAreLeftStay) {
  const std::string pointer =
      "/materials/0/extensions/KHR_materials_translucency/translucencyFactor";
  EXPECT_EQ(pointer_after(pointer, R"("translucencyFactor":2)"), pointer);
}

TEST(Pointers, AnAnimatedFactorOfZeroIsNoReasonToGo) {
  const std::string pointer =
      "/materials/0/extensions/KHR_materials_translucency/translucencyFactor";
  const Upgraded result =
      upgraded(document_with("", R"("translucencyFactor":0)", animated(pointer)));
  EXPECT_FALSE(result.only().removed);
  EXPECT_EQ(extension_of(result)["diffuseTransmissionFactor"], 0);
}

TEST(Pointers, IntoAnObjectThatWouldGoKeepIt) {
  const Upgraded result = upgraded(document_with(
      "", R"("translucencyTexture":{"index":0})",
      animated("/materials/0/extensions/KHR_materials_translucency/translucencyTexture/extensions/"
               "KHR_texture_transform/scale")));
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
}

TEST(Pointers, AnAnimatedBaseColourIsALossWhereItCannotBeFollowed) {
  for (const char* pointer : {"/materials/0/pbrMetallicRoughness/baseColorFactor",
                              "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/"
                              "KHR_texture_transform/offset"}) {
    const Upgraded result =
        upgraded(document_with(R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],)"
                               R"("baseColorTexture":{"index":0}},)",
                               R"("translucencyFactor":1)", animated(pointer)));
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::unsafe) << pointer;
  }
  EXPECT_EQ(upgraded(document_with("", R"("translucencyFactor":1)",
                                   animated("/materials/1/pbrMetallicRoughness/baseColorFactor")))
                .only()
                .outcome,
            UpgradeOutcome::safe);
}

std::string graph(const std::string& materials) {
  return R"({"extensions":{"KHR_interactivity":{"graphs":[{"nodes":[{"configuration":{"pointer":)"
         R"({"value":["/materials/{i}/extensions/KHR_materials_translucency/translucencyFactor"]}}}]}]}},)"
         R"("materials":[)" +
         materials + "]}";
}

TEST(Pointers, TemplatesFollowWhenEveryObjectDoes) {
  EXPECT_THAT(upgraded(graph(kConverted + "," + kConverted)).text,
              HasSubstr("/materials/{i}/extensions/KHR_materials_diffuse_transmission/"
                        "diffuseTransmissionFactor"));
  EXPECT_THAT(upgraded(graph(kConverted + "," + kLeft)).text,
              HasSubstr("/materials/{i}/extensions/KHR_materials_translucency/"));
}

TEST(Pointers, OfAllObjectsKeepThemTogether) {
  const std::string text = graph(kConverted + "," + kLeft);
  const Upgraded result = upgraded(text);
  EXPECT_EQ(result.text, text);
  for (const UpgradeAction& action : result.plan.actions) {
    EXPECT_EQ(action.outcome, UpgradeOutcome::impossible);
  }
}

TEST(Pointers, InExtrasAreNobodysBusiness) {
  const std::string text = document_with(
      "", R"("translucencyFactor":1)",
      R"("extras":{"p":"/materials/0/extensions/KHR_materials_translucency/translucencyFactor"},)");
  EXPECT_THAT(upgraded(text).text,
              HasSubstr("/extensions/KHR_materials_translucency/translucencyFactor"));
}

// Random materials of all generations, valid and invalid, in every layout.
class Factory {
 public:
  explicit Factory(std::uint32_t seed) : random_(seed) {}

  std::string document() {
    Json root = Json::object();
    if (one_in(2)) root["extensionsUsed"] = Json::array({"A_a", kOld, "B_b"});
    if (one_in(4)) root["extensionsRequired"] = Json::array({kOld});
    root["textures"] = Json::array({Json::object(), Json::object()});
    for (int i = 0; i < 6; ++i) root["materials"].push_back(material());
    return root.dump(static_cast<int>(random_() % 4) - 1);
  }

 private:
  bool one_in(std::uint32_t count) { return random_() % count == 0; }
  double share() { return static_cast<double>(random_() % 5) / 4; }

  Json material() {
    Json material = Json::object();
    if (one_in(2)) material["name"] = "m";
    if (one_in(2)) {
      Json& base = material["pbrMetallicRoughness"];
      base["baseColorFactor"] = {share(), share(), share(), 1};
      if (one_in(2)) base["baseColorTexture"] = {{"index", 1}};
    }
    if (one_in(4)) return material;
    Json& extensions = material["extensions"];
    if (one_in(4)) extensions["KHR_materials_ior"] = {{"ior", 1.4}};
    if (one_in(8)) extensions["KHR_materials_unlit"] = Json::object();
    Json legacy = Json::object();
    if (!one_in(5)) legacy["translucencyFactor"] = share() * (one_in(9) ? 2 : 1);
    if (one_in(4)) legacy["translucencyTexture"] = one_in(2) ? Json(0) : Json{{"index", 0}};
    if (one_in(3)) legacy["translucencyColorFactor"] = {share(), 1, 0.5};
    if (one_in(8)) extensions[std::string(kNew)] = Json::object();
    extensions[std::string(kOld)] = std::move(legacy);
    return material;
  }

  std::mt19937 random_;
};

TEST(Plan, OfRandomMaterialsIsSoundAndSettledAfterOneRun) {
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    const std::string text = Factory(seed).document();
    const Upgraded once = upgraded(text);
    ASSERT_TRUE(Json::accept(once.text)) << text;
    const Json root = once.json();
    for (const UpgradeAction& action : once.plan.actions) {
      const auto at = Json::json_pointer(action.pointer);
      const bool left =
          root.contains(at) && (!root.at(at).is_string() || root.at(at) == action.from);
      ASSERT_EQ(left, !action.done) << text << '\n' << action.pointer;
    }
    const Upgraded twice = upgraded(once.text);
    ASSERT_THAT(twice.plan.change.edits, IsEmpty()) << text << '\n' << once.text;
    ASSERT_THAT(twice.plan.actions, testing::SizeIs(static_cast<std::size_t>(std::count_if(
                                        once.plan.actions.begin(), once.plan.actions.end(),
                                        [](const auto& a) { return !a.done; }))));
  }
}

}  // namespace
}  // namespace gltfx::upgrade::test
