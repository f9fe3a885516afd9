// SPDX-License-Identifier: Apache-2.0
// Random materials with all legacy extensions together: plans are always valid, and one run is
// enough.
#include <algorithm>
#include <array>
#include <random>

#include <gmock/gmock.h>

#include "sanitized.hpp"
#include "steps/upgrade/choice.hpp"
#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

// Valid and invalid materials, in every layout.
class RandomFactory {
 public:
  explicit RandomFactory(std::uint32_t seed) : random_(seed) {}

  std::string document() {
    Json root = Json::object();
    if (one_in(2)) root["extensionsUsed"] = Json::array({"A_a", "KHR_materials_sss", "KHR_xmp"});
    if (one_in(4))
      root["extensionsRequired"] = Json::array({"KHR_materials_pbrSpecularGlossiness"});
    root["textures"] = Json::array({Json::object()});
    for (int i = 0; i < 4; ++i) root["materials"].push_back(material());
    if (one_in(2)) root["animations"] = animations();
    if (one_in(2)) root["extensions"]["KHR_xmp"] = metadata();
    if (one_in(4)) root["extensions"]["KHR_xmp_json_ld"] = {{"packets", {{{"@context", {}}}}}};
    if (one_in(8)) root["asset"]["extensions"]["KHR_xmp"]["packet"] = one_in(2) ? 1 : 0;
    if (one_in(16)) root["asset"]["extensions"]["KHR_xmp_json_ld"]["packet"] = one_in(3) ? 1 : 0;
    return root.dump(static_cast<int>(random_() % 4) - 1);
  }

 private:
  bool one_in(std::uint32_t count) { return random_() % count == 0; }
  double share() { return static_cast<double>(random_() % 5) / 4; }
  Json color() { return {share(), share(), share()}; }
  void maybe(Json& object, const char* name, Json value) {
    if (one_in(2)) object[name] = std::move(value);
  }

  Json material() {
    Json material = Json::object();
    if (one_in(2)) {
      Json& base = material["pbrMetallicRoughness"] = Json::object();
      maybe(base, "baseColorFactor", {share(), share(), share(), 1});
      maybe(base, "roughnessFactor", share());
    }
    Json extensions = Json::object();
    if (one_in(2)) extensions["KHR_materials_pbrSpecularGlossiness"] = glossy();
    if (one_in(2)) extensions[std::string(kOld)] = translucent();
    if (one_in(4)) extensions["3DS_materials_translucency"] = translucent();
    if (one_in(3)) extensions["KHR_materials_sss"] = scattering();
    if (one_in(4)) extensions["KHR_materials_subsurface"] = scattering();
    if (one_in(3)) extensions["KHR_materials_volume"]["thicknessFactor"] = share();
    if (one_in(4)) extensions["ADOBE_materials_thin_transparency"] = Json::object();
    if (one_in(8)) extensions["KHR_materials_transmission"] = Json::object();
    for (const char* name : {"KHR_materials_unlit", "KHR_materials_ior", "KHR_materials_clearcoat",
                             "KHR_materials_diffuse_transmission"}) {
      if (one_in(16)) extensions[name] = Json::object();
    }
    if (!extensions.empty()) material["extensions"] = std::move(extensions);
    return material;
  }

  Json glossy() {
    Json object = Json::object();
    maybe(object, "diffuseFactor", {share(), share(), share(), 1});
    maybe(object, "specularFactor", color());
    maybe(object, "glossinessFactor", share() * (one_in(9) ? 2 : 1));
    if (one_in(3)) object["diffuseTexture"] = {{"index", one_in(5)}};
    if (one_in(3)) object["specularGlossinessTexture"] = {{"index", 0}};
    return object;
  }

  Json translucent() {
    Json object = Json::object();
    maybe(object, "translucencyFactor", share());
    if (one_in(4)) object["translucencyColorFactor"] = color();
    if (one_in(8)) object["extras"]["by"] = "me";
    return object;
  }

  Json scattering() {
    Json object = Json::object();
    maybe(object, "scatterDistance", share());
    maybe(object, "scatterColor", color());
    if (one_in(8)) object["power"] = 2;
    if (one_in(8)) object["extensions"]["A_a"] = Json::object();
    return object;
  }

  Json animations() {
    constexpr std::array<const char*, 6> kPaths{
        "pbrMetallicRoughness/roughnessFactor",
        "extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor",
        "extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor",
        "extensions/KHR_materials_translucency/translucencyFactor",
        "extensions/KHR_materials_sss/scatterColor",
        "extensions/KHR_materials_volume/attenuationColor"};
    const std::string path = kPaths[random_() % kPaths.size()];
    const std::string material = one_in(4) ? "{i}" : std::to_string(random_() % 4);
    const std::string pointer = "/materials/" + material + "/" + path;
    return Json::parse("{" + animated(pointer) + R"("end":0})")["animations"];
  }

  Json metadata() {
    Json object = Json::object();
    maybe(object, "@context", {{"dc", one_in(9) ? Json(1) : Json("urn:dc")}});
    object["packets"] = {
        {{"dc:a", {1, 2}}, {"dc:b", {{"en", "x"}}}, {"dc:c", {{{"dc:d", {"y"}}}}}}};
    return object;
  }

  std::mt19937 random_;
};

void expect_settled(const std::string& text, const UpgradeOptions& options) {
  const Upgraded once = upgraded(text, options);
  ASSERT_TRUE(Json::accept(once.text)) << text << '\n' << once.text;
  const Json root = once.json();
  for (const UpgradeAction& action : once.plan.actions) {
    // The next name in a list may be at the place of a removed one.
    const Json::json_pointer at(action.pointer);
    const bool left = root.contains(at) && (!root.at(at).is_string() || root.at(at) == action.from);
    ASSERT_EQ(left, !action.done) << text << '\n' << action.pointer;
  }
  const Upgraded twice = upgraded(once.text, options);
  ASSERT_TRUE(twice.plan.change.edits.empty()) << text << '\n' << once.text << '\n' << twice.text;
  ASSERT_EQ(twice.plan.actions.size(), static_cast<std::size_t>(std::count_if(
                                           once.plan.actions.begin(), once.plan.actions.end(),
                                           [](const auto& action) { return !action.done; })))
      << text << '\n'
      << once.text;
}

TEST(Random, OneRunIsEnough) {
  UpgradeOptions plain, unsafe, all = only(legacy_names(*schema::builtin_set()));
  unsafe.unsafe = true;
  UpgradeOptions all_unsafe = all;
  all_unsafe.unsafe = true;
  UpgradeOptions scatter = all_unsafe;
  scatter.only.clear();
  scatter.to = {"KHR_materials_scatter"};
  constexpr std::uint32_t kSeeds = kSanitized ? 250 : 1000;
  for (std::uint32_t seed = 0; seed < kSeeds && !testing::Test::HasFatalFailure(); ++seed) {
    const std::string text = RandomFactory(seed).document();
    for (const UpgradeOptions& options : {plain, unsafe, all, all_unsafe, scatter}) {
      expect_settled(text, options);
    }
  }
}

}  // namespace
}  // namespace gltfx::upgrade::test
