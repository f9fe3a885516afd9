// SPDX-License-Identifier: Apache-2.0
// Objects are deleted, and each remaining reference leads to the same object as before.
#include "change/deletion.hpp"

#include <gmock/gmock.h>

#include "json/parse.hpp"
#include "schema/compile.hpp"

namespace gltfx::change {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Deleted {
  std::string text;  ///< empty: nothing was deleted
  std::string error;
  std::vector<std::string> values;     ///< "/pointer" or "/pointer < /cause"
  std::vector<std::string> obstacles;  ///< "/pointer > /target", "/pointer has /target"
  Deletion deletion;
};

Deleted deleted(const std::string& text, const std::vector<std::string>& pointers,
                bool cascade = false) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  EXPECT_TRUE(parsed.ok()) << text;
  DeletionOptions options;
  options.cascade = cascade;
  auto done = plan_deletion(parsed.document, *schema::builtin_set(), pointers, options);
  Deleted result;
  if (!done) {
    result.error = done.error().message;
    return result;
  }
  result.deletion = *std::move(done);
  for (const DeletedValue& value : result.deletion.deleted) {
    result.values.push_back(value.cause.empty() ? value.pointer
                                                : value.pointer + " < " + value.cause);
  }
  for (const DeletionObstacle& obstacle : result.deletion.obstacles) {
    result.obstacles.push_back(obstacle.pointer + (obstacle.must_have ? " has " : " > ") +
                               obstacle.target);
  }
  if (result.obstacles.empty()) result.text = json::apply_edits(text, result.deletion.change.edits);
  return result;
}

Deleted cascaded(const std::string& text, const std::vector<std::string>& pointers) {
  return deleted(text, pointers, true);
}

TEST(Deletion, IndicesBehindADeletedObjectMoveUp) {
  const std::string text =
      R"({"meshes":[{"name":"a"},{"name":"b"},{"name":"c"}],"nodes":[{"mesh":2},{"mesh":0}]})";
  const Deleted done = deleted(text, {"/meshes/1"});
  EXPECT_EQ(done.text, R"({"meshes":[{"name":"a"},{"name":"c"}],"nodes":[{"mesh":1},{"mesh":0}]})");
  EXPECT_EQ(done.deletion.renumbered, 1U);
  EXPECT_THAT(done.values, ElementsAre("/meshes/1"));
}

TEST(Deletion, ManyAtOnceAreCountedTogether) {
  const std::string text = R"({"nodes":[{},{},{},{},{}],"scenes":[{"nodes":[1, 4]}]})";
  EXPECT_EQ(deleted(text, {"/nodes/3", "/nodes/0", "/nodes/2", "/nodes/0"}).text,
            R"({"nodes":[{},{}],"scenes":[{"nodes":[0, 1]}]})");
}

TEST(Deletion, WhatRefersToIsListedAndNothingIsDone) {
  const std::string text = R"({"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{}]})";
  EXPECT_THAT(deleted(text, {"/nodes/1"}).obstacles, ElementsAre("/nodes/0/children/0 > /nodes/1"));
  EXPECT_THAT(deleted(text, {"/scenes/0"}).obstacles, ElementsAre("/scene > /scenes/0"));
  EXPECT_THAT(deleted(text, {"/scenes/0"}).deletion.change.edits, IsEmpty());
}

TEST(Deletion, WhoIsDeletedTooIsNotInTheWay) {
  const std::string text =
      R"({"nodes":[{"children":[1]},{"mesh":0}],"meshes":[{"name":"m"},{"name":"n"}]})";
  EXPECT_EQ(deleted(text, {"/meshes/0", "/nodes/1", "/nodes/0"}).text,
            R"({"meshes":[{"name":"n"}]})");
}

TEST(Deletion, CascadeTakesEntriesOutOfLists) {
  const std::string text =
      R"({"scenes":[{"nodes":[0,1,2]}],"nodes":[{"children":[2]},{},{"name":"x"}]})";
  const Deleted done = cascaded(text, {"/nodes/1"});
  EXPECT_EQ(done.text, R"({"scenes":[{"nodes":[0,1]}],"nodes":[{"children":[1]},{"name":"x"}]})");
  EXPECT_THAT(done.values, ElementsAre("/nodes/1", "/scenes/0/nodes/1 < /nodes/1"));
}

TEST(Deletion, ListsThatMustNotBeEmptyGo) {
  const std::string text =
      R"({"scenes":[{"nodes":[1],"name":"s"}],"nodes":[{"children":[1],"name":"p"},{}]})";
  EXPECT_EQ(cascaded(text, {"/nodes/1"}).text,
            R"({"scenes":[{"name":"s"}],"nodes":[{"name":"p"}]})");
}

TEST(Deletion, CascadeTakesOptionalMembersAlone) {
  const std::string text =
      R"({"nodes":[{"mesh":0,"name":"n"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},)"
      R"({"name":"m"}]})";
  EXPECT_EQ(cascaded(text, {"/meshes/0"}).text,
            R"({"nodes":[{"name":"n"}],"meshes":[{"name":"m"}]})");
}

TEST(Deletion, CascadeTakesTheOwnerOfARequiredMember) {
  const std::string text =
      R"({"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0}}],)"
      R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"a"},{"uri":"b"}]})";
  const Deleted done = cascaded(text, {"/images/0"});
  EXPECT_EQ(done.text, R"({"materials":[{"pbrMetallicRoughness":{"metallicFactor":0}}],)"
                       R"("textures":[{"source":0}],"images":[{"uri":"b"}]})");
  EXPECT_THAT(done.values,
              ElementsAre("/images/0", "/textures/0 < /images/0",
                          "/materials/0/pbrMetallicRoughness/baseColorTexture < /textures/0"));
}

TEST(Deletion, TexturesWithAnotherSourceStand) {
  const std::string text =
      R"({"textures":[{"source":0,"extensions":{"EXT_texture_webp":{"source":1}}}],)"
      R"("images":[{"uri":"a.png"},{"uri":"b.webp"}],"extensionsUsed":["EXT_texture_webp"]})";
  EXPECT_EQ(cascaded(text, {"/images/0"}).text,
            R"({"textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}],)"
            R"("images":[{"uri":"b.webp"}],"extensionsUsed":["EXT_texture_webp"]})");
  EXPECT_EQ(cascaded(text, {"/images/1"}).text,
            R"({"textures":[{"source":0}],"images":[{"uri":"a.png"}]})");
  EXPECT_EQ(cascaded(text, {"/images/0", "/images/1"}).text, "{}");
}

TEST(Deletion, MembersThatNeedAnotherGoWithIt) {
  const std::string text =
      R"({"nodes":[{"mesh":0,"skin":0,"weights":[1],"name":"n"}],"meshes":[{},{}],"skins":[{}]})";
  EXPECT_EQ(cascaded(text, {"/meshes/0"}).text,
            R"({"nodes":[{"name":"n"}],"meshes":[{}],"skins":[{}]})");
  EXPECT_THAT(deleted(text, {"/nodes/0/mesh"}).obstacles,
              ElementsAre("/nodes/0/skin > /nodes/0/mesh", "/nodes/0/weights > /nodes/0/mesh"));
}

TEST(Deletion, AnimationsLoseChannelsAndGoWithTheLast) {
  const std::string channel = R"({"sampler":0,"target":{"node":0,"path":"scale"}})";
  const std::string other = R"({"sampler":1,"target":{"node":1,"path":"scale"}})";
  const auto text = [&](const std::string& channels) {
    return R"({"animations":[{"channels":[)" + channels +
           R"(],"samplers":[{"input":0,"output":1},{"input":0,"output":1}]}],"nodes":[{},{"name":"b"}]})";
  };
  EXPECT_EQ(cascaded(text(channel), {"/nodes/0"}).text, R"({"nodes":[{"name":"b"}]})");
  EXPECT_THAT(cascaded(text(channel + "," + other), {"/nodes/0"}).text,
              HasSubstr(R"("channels":[{"sampler":1,"target":{"node":0,"path":"scale"}}])"));
}

TEST(Deletion, SamplersOfAnAnimationAreCountedInItAlone) {
  const std::string text =
      R"({"animations":[{"channels":[{"sampler":1,"target":{"path":"scale"}}],)"
      R"("samplers":[{"input":0,"output":1},{"input":2,"output":3}]},)"
      R"({"channels":[{"sampler":1,"target":{"path":"scale"}}],)"
      R"("samplers":[{"input":0,"output":1},{"input":2,"output":3}]}]})";
  EXPECT_EQ(deleted(text, {"/animations/0/samplers/0"}).text,
            R"({"animations":[{"channels":[{"sampler":0,"target":{"path":"scale"}}],)"
            R"("samplers":[{"input":2,"output":3}]},)"
            R"({"channels":[{"sampler":1,"target":{"path":"scale"}}],)"
            R"("samplers":[{"input":0,"output":1},{"input":2,"output":3}]}]})");
  EXPECT_THAT(deleted(text, {"/animations/1/samplers/1"}).obstacles,
              ElementsAre("/animations/1/channels/0/sampler > /animations/1/samplers/1"));
}

TEST(Deletion, LightsAndVariantsOfExtensionsAreRenumbered) {
  const std::string lights =
      R"({"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":)"
      R"([{"type":"point"},{"type":"directional"}]}},)"
      R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":1}}},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":0}},"name":"n"}]})";
  const std::string light = "/extensions/KHR_lights_punctual/lights/0";
  EXPECT_THAT(deleted(lights, {light}).obstacles,
              ElementsAre("/nodes/1/extensions/KHR_lights_punctual/light > " + light));
  EXPECT_EQ(cascaded(lights, {light}).text,
            R"({"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":)"
            R"({"lights":[{"type":"directional"}]}},)"
            R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}},{"name":"n"}]})");
  const Deleted all = cascaded(lights, {"/extensions/KHR_lights_punctual"});
  EXPECT_EQ(all.text, R"({"nodes":[{},{"name":"n"}]})");
  EXPECT_THAT(all.deletion.names, ElementsAre("KHR_lights_punctual"));
}

TEST(Deletion, VariantsLeaveTheirMappings) {
  const std::string text =
      R"({"extensions":{"KHR_materials_variants":{"variants":[{"name":"a"},{"name":"b"}]}},)"
      R"("materials":[{},{}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":)"
      R"({"KHR_materials_variants":{"mappings":[{"variants":[0],"material":0},)"
      R"({"variants":[0,1],"material":1}]}}}]}]})";
  EXPECT_THAT(cascaded(text, {"/extensions/KHR_materials_variants/variants/0"}).text,
              HasSubstr(R"("mappings":[{"variants":[0],"material":1}])"));
}

TEST(Deletion, PointersAreRenumberedStepByStep) {
  const auto text = [](const std::string& pointer, const std::string& nodes) {
    return R"({"animations":[{"channels":[{"sampler":0,"target":{"path":"pointer","extensions":)"
           R"({"KHR_animation_pointer":{"pointer":")" +
           pointer + R"("}}}}],"samplers":[{"input":0,"output":0}]}],"nodes":[)" + nodes + "]}";
  };
  EXPECT_EQ(deleted(text("/nodes/2/translation", "{},{},{}"), {"/nodes/0"}).text,
            text("/nodes/1/translation", "{},{}"));
  EXPECT_THAT(deleted(text("/nodes/1/translation", "{},{}"), {"/nodes/1"}).obstacles,
              ElementsAre("/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer"
                          " > /nodes/1"));
  EXPECT_EQ(cascaded(text("/nodes/1/translation", "{},{}"), {"/nodes/1"}).text,
            R"({"nodes":[{}]})");
  EXPECT_EQ(deleted(text("/nodes/7/translation", "{},{}"), {"/nodes/1"}).text,
            text("/nodes/7/translation", "{}"));
}

TEST(Deletion, NamesThatLookLikePointersStay) {
  const std::string text = R"({"nodes":[{},{"name":"/nodes/1/scale"}]})";
  EXPECT_EQ(deleted(text, {"/nodes/0"}).text, R"({"nodes":[{"name":"/nodes/1/scale"}]})");
}

TEST(Deletion, NamesThatReferToTheObjectStandInItsWay) {
  const std::string text =
      R"({"materials":[{"name":"a"},{"name":"b"}],"extensions":{"VRM":{"blendShapeMaster":{)"
      R"("blendShapeGroups":[{"name":"g","materialValues":[{"materialName":"a"}]}]}}}})";
  EXPECT_THAT(deleted(text, {"/materials/0"}).obstacles,
              ElementsAre("/extensions/VRM/blendShapeMaster/blendShapeGroups/0/materialValues/0/"
                          "materialName > /materials/0"));
  EXPECT_THAT(deleted(text, {"/materials/1"}).obstacles, IsEmpty());
}

TEST(Deletion, GraphsRefuseTargetsOfRunTimeAndFollowTheRest) {
  const auto text = [](const std::string& pointer, const std::string& materials) {
    return R"({"materials":[)" + materials +
           R"(],"nodes":[{},{}],"extensions":{"KHR_interactivity":{"graphs":[{"types":[{"signature":)"
           R"("float"},{"signature":"ref"}],"declarations":[{"op":"pointer/get"}],"nodes":[{)"
           R"("declaration":0,"configuration":{"pointer":{"value":[")" +
           pointer + R"("]},"type":{"value":[1]}}}]}]}}})";
  };
  EXPECT_THAT(deleted(text("/materials/{m}/alphaCutoff", "{},{}"), {"/materials/0"}).error,
              HasSubstr("is set at run time"));
  EXPECT_EQ(deleted(text("/materials/{m}/alphaCutoff", "{},{}"), {"/nodes/1"}).error, "");
  EXPECT_EQ(deleted(text("/materials/1/alphaCutoff", "{},{}"), {"/materials/0"}).text,
            text("/materials/0/alphaCutoff", "{}"));
  const std::string types = "/extensions/KHR_interactivity/graphs/0/types/";
  EXPECT_THAT(deleted(text("/nodes/0/scale", "{}"), {types + "0"}).text,
              HasSubstr(R"("type":{"value":[0]})"));
  EXPECT_THAT(
      deleted(text("/nodes/0/scale", "{}"), {types + "1"}).obstacles,
      ElementsAre("/extensions/KHR_interactivity/graphs/0/nodes/0/configuration/type/value/0"
                  " > " +
                  types + "1"));
}

TEST(Deletion, ADefaultThatRefersToTheObjectKeepsIt) {
  const std::string graphs =
      R"({"extensions":{"KHR_interactivity":{"graphs":[{"name":"a"},{"name":"b"}]}}})";
  EXPECT_THAT(deleted(graphs, {"/extensions/KHR_interactivity/graphs/0"}).error,
              HasSubstr("by its default"));
  EXPECT_EQ(deleted(graphs, {"/extensions/KHR_interactivity/graphs/1"}).text,
            R"({"extensions":{"KHR_interactivity":{"graphs":[{"name":"a"}]}}})");
}

TEST(Deletion, PositionsThatVerticesCountStay) {
  const std::string text =
      R"({"skins":[{"joints":[0,1]}],"nodes":[{},{}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0},"targets":[{"POSITION":0}]}],"weights":[1]}]})";
  for (const bool cascade : {false, true}) {
    EXPECT_THAT(deleted(text, {"/skins/0/joints/0"}, cascade).error, HasSubstr("must stay where"));
    EXPECT_THAT(deleted(text, {"/meshes/0/primitives/0/targets/0"}, cascade).error,
                HasSubstr("must stay where"));
    EXPECT_THAT(deleted(text, {"/meshes/0/weights/0"}, cascade).error,
                HasSubstr("is a number and no reference"));
  }
  EXPECT_THAT(cascaded(text, {"/nodes/0"}).error, HasSubstr("/skins/0/joints/0 must stay"));
  EXPECT_THAT(deleted(text, {"/nodes/0"}).obstacles, ElementsAre("/skins/0/joints/0 > /nodes/0"));
}

TEST(Deletion, PointersThatLeadToNothingAreRefused) {
  const std::string text = R"({"asset":{"version":"2.0"},"meshes":[{"weights":[1,2]}]})";
  for (const char* pointer :
       {"/meshes/1", "/meshes/99999999999", "/meshes/18446744073709551616", "/meshes/-",
        "/meshes/00", "/meshes/-1", "/meshes/0/", "/meshes/0/weights/2", "meshes/0", "/meshes/~2",
        "/meshes/0/weights/0/1", "/x", "/meshes/\xff", "//", "/asset/version/0"}) {
    EXPECT_THAT(deleted(text, {pointer}).error, HasSubstr("leads nowhere")) << pointer;
  }
  EXPECT_THAT(deleted(text, {""}).error, HasSubstr("the document itself must stay"));
  EXPECT_THAT(cascaded(text, {"/asset"}).error, HasSubstr("the document needs it"));
  EXPECT_THAT(cascaded(text, {"/asset/version"}).error, HasSubstr("the document needs it"));
  EXPECT_THAT(deleted(text, {"/asset/version"}).obstacles,
              ElementsAre("/asset has /asset/version"));
}

TEST(Deletion, UnknownExtensionsMayHoldIndices) {
  const auto text = [](const std::string& node, const std::string& rest = "") {
    return R"({"nodes":[{},{"extensions":{)" + node + "}}]" + rest + "}";
  };
  EXPECT_THAT(deleted(text(R"("ACME_x":{})"), {"/nodes/0"}).error,
              HasSubstr("'ACME_x' is unknown there and may contain indices"));
  EXPECT_THAT(deleted(text(R"("KHR_materials_unlit":{})"), {"/nodes/0"}).error,
              HasSubstr("'KHR_materials_unlit' is unknown there"));
  EXPECT_THAT(deleted(R"({"nodes":[{},{}],"extensionsUsed":["ACME_x"]})", {"/nodes/0"}).error,
              HasSubstr("'ACME_x' is unknown there"));
  const Deleted gone =
      deleted(text(R"("ACME_x":{})", R"(,"extensionsUsed":["ACME_x"])"), {"/nodes/1"});
  EXPECT_EQ(gone.text, R"({"nodes":[{}]})");
}

TEST(Deletion, WhatExtrasSayIsNoted) {
  const std::string text =
      R"({"nodes":[{},{"extras":{"meshIndex":1,"age":3,"jointIds":[1,2]}}],"extras":{"node":0}})";
  const Deleted done = deleted(text, {"/nodes/0"});
  EXPECT_EQ(
      done.text,
      R"({"nodes":[{"extras":{"meshIndex":1,"age":3,"jointIds":[1,2]}}],"extras":{"node":0}})");
  EXPECT_THAT(done.deletion.doubtful,
              ElementsAre("/nodes/1/extras/meshIndex", "/nodes/1/extras/jointIds", "/extras/node"));
}

TEST(Deletion, BrokenReferencesCanBeDeleted) {
  const std::string text =
      R"({"scenes":[{"nodes":[0,7]}],"nodes":[{"mesh":3,"name":"n"}],"materials":[)"
      R"({"normalTexture":{"index":5},"name":"m"}]})";
  EXPECT_EQ(
      cascaded(text, {"/scenes/0/nodes/1", "/nodes/0/mesh", "/materials/0/normalTexture/index"})
          .text,
      R"({"scenes":[{"nodes":[0]}],"nodes":[{"name":"n"}],"materials":[{"name":"m"}]})");
}

TEST(Deletion, ManyDeletionsTakeOnePass) {
  constexpr int kCount = 20'000;
  std::string nodes, list;
  std::vector<std::string> pointers;
  for (int i = 0; i < kCount; ++i) {
    nodes += i == 0 ? "{}" : ",{}";
    list += (i == 0 ? "" : ",") + std::to_string(i);
    if (i % 2 == 0) pointers.push_back("/nodes/" + std::to_string(i));
  }
  const Deleted done =
      cascaded(R"({"nodes":[)" + nodes + R"(],"scenes":[{"nodes":[)" + list + "]}]}", pointers);
  EXPECT_EQ(done.values.size(), std::size_t{kCount});
  EXPECT_THAT(done.text, HasSubstr(",9998,9999]}]}"));
}

}  // namespace
}  // namespace gltfx::change
