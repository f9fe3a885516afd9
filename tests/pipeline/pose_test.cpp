// SPDX-License-Identifier: Apache-2.0
// The pose of characters that nobody asked to move.
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A square on one joint, which each animation puts elsewhere: at -2 (the bind pose is 0), 2, ...
class Poses : public Baking {
 protected:
  Poses() {
    options.sizes = {{30, 30}};
    options.samples = 4;
    options.background = {BakeBackground::Kind::transparent};
  }

  AssetText character(const std::vector<std::pair<std::string, float>>& animations) const {
    AssetText asset;
    const int mesh = asset.mesh(render::quad(0.8F), asset.material(plastic()));
    Json& attributes = asset.json()["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = asset.accessor("VEC4", 5121, 4, std::string(16, '\0'));
    const std::vector<Float4> weights(4, Float4{1, 0, 0, 0});
    attributes["WEIGHTS_0"] = asset.accessor("VEC4", 5126, 4, packed(weights));
    const int joint = asset.node({{"name", "hip"}});
    asset.add("skins", {{"joints", Json::array({joint})}});
    asset.node({{"mesh", mesh}, {"skin", 0}});
    for (const auto& [name, x] : animations) move(asset, name, joint, x);
    asset.orthographic(3, 5);
    return asset;
  }
  static void move(AssetText& asset, const std::string& name, int node, float x) {
    const std::vector<float> times{0, 1};
    const std::vector<Float3> places{{x, 0, 0}, {0, 0, 0}};
    const int input =
        asset.accessor("SCALAR", 5126, 2, packed(times), {{"min", {0}}, {"max", {1}}});
    const int output = asset.accessor("VEC3", 5126, 2, packed(places));
    const Json channel{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}};
    const Json sampler{{"input", input}, {"output", output}};
    asset.add("animations", {{"name", name},
                             {"channels", Json::array({channel})},
                             {"samplers", Json::array({sampler})}});
  }
  // -2, 0 or 2: where the square is seen; 9: nowhere.
  int place_of(AssetText asset) {
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    notes = done.notes;
    for (const int x : {-2, 0, 2}) {
      const auto column = static_cast<std::size_t>(15 + x * 5);
      if (done.pixels.bytes[(std::size_t{15} * 30 + column) * 4 + 3] > 128) return x;
    }
    return 9;
  }

  std::vector<std::string> notes;
};

TEST_F(Poses, ACharacterStandsAsItsIdleAnimationBegins) {
  EXPECT_EQ(place_of(character({})), 0) << "the bind pose";
  EXPECT_EQ(place_of(character({{"Walk", -2}})), -2);
  EXPECT_EQ(place_of(character({{"Walk", -2}, {"Armature|Idle_Loop", 2}})), 2);
  EXPECT_EQ(place_of(character({{"Walk", -2}, {"Run", 2}})), -2) << "the first";
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(Poses, AnAnimationThatIsNamedCounts) {
  const AssetText asset = character({{"Walk", -2}, {"Idle", 2}});
  options.animation = "Walk";
  EXPECT_EQ(place_of(asset), -2);
  options.animation = "none";
  EXPECT_EQ(place_of(asset), 0);
  EXPECT_EQ(place_of(character({{"none", 2}})), 2) << "an animation of that name";
  options.animation = "Jump";
  options.if_present = true;
  EXPECT_EQ(place_of(asset), 2);
  EXPECT_THAT(notes, ElementsAre("it has no animation 'Jump'; there is 'Walk', 'Idle'"));
}

TEST_F(Poses, WhatMovesNoJointIsNotPosed) {
  AssetText rigid;
  const int node = rigid.draw(render::quad(0.8F), plastic());
  move(rigid, "Idle", node, 2);
  rigid.orthographic(3, 5);
  EXPECT_EQ(place_of(rigid), 0) << "no character";
  AssetText both = character({});
  move(both, "Idle", 1, -2);  // the node of the mesh, which a skin places
  EXPECT_EQ(place_of(both), 0);
}

}  // namespace
}  // namespace gltfx::test
