// SPDX-License-Identifier: Apache-2.0
// References by kind, and elements that lose their last user.
#include "graph/graph.hpp"

#include <gmock/gmock.h>

#include "graph/orphans.hpp"
#include "graph/pointers.hpp"
#include "graph/renumber.hpp"
#include "json/parse.hpp"
#include "schema/compile.hpp"

namespace gltfx::graph {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A document with its graph.
struct Read {
  explicit Read(const std::string& json)
      : text(json),
        parsed(json::parse(std::string_view(text))),
        graph(parsed.document, *schema::builtin_set()),
        tree(graph.tree()) {
    EXPECT_TRUE(parsed.ok()) << text;
  }
  json::NodeId node(const std::string& pointer) const { return tree.find(pointer).node; }
  std::vector<std::string> pointers(const std::vector<json::NodeId>& values) const {
    std::vector<std::string> all;
    for (const json::NodeId value : values) all.push_back(tree.pointer(value));
    return all;
  }
  /// "/place kind" of all that refers to a value.
  std::vector<std::string> users(const std::string& pointer) const {
    constexpr std::array<const char*, 4> kKinds{" index", " pointer", " name", " implied"};
    std::vector<std::string> all;
    for (const Use& use : graph.users(node(pointer))) {
      all.push_back(tree.pointer(use.at) + kKinds.at(static_cast<std::size_t>(use.kind)));
    }
    return all;
  }

  const std::string text;
  const json::Parsed parsed;
  const Graph graph;
  const Tree& tree;
};

TEST(Graph, IndicesArePlacesInObjectsAndInLists) {
  const Read read(
      R"({"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"children":[1]},{"mesh":7}]})");
  EXPECT_THAT(read.users("/scenes/0"), ElementsAre("/scene index"));
  EXPECT_THAT(read.users("/nodes/1"),
              ElementsAre("/nodes/0/children/0 index", "/scenes/0/nodes/1 index"));
  EXPECT_THAT(read.users("/nodes"), IsEmpty());
}

TEST(Graph, PointersReferToWhatTheyLeadTo) {
  const Read read(
      R"({"nodes":[{},{"scale":[1,1,1]}],"animations":[{"samplers":[],"channels":[{)"
      R"("sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{)"
      R"("pointer":"/nodes/1/scale"}}}}]}],"extras":{"pointer":"/nodes/0/scale"}})");
  EXPECT_THAT(read.users("/nodes/1/scale"),
              ElementsAre("/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer"
                          " pointer"));
  EXPECT_THAT(read.users("/nodes/0"), IsEmpty());
}

TEST(Graph, NamesReferToTheOnlyOneThatHasThem) {
  const auto text = [](const std::string& second) {
    return R"({"materials":[{"name":"a"},{"name":")" + second +
           R"("}],"extensions":{"VRM":{"blendShapeMaster":{"blendShapeGroups":[{"materialValues":[)"
           R"({"materialName":"a","propertyName":"_Color","targetValue":[1,1,1,1]}]}]}}}})";
  };
  const std::string place =
      "/extensions/VRM/blendShapeMaster/blendShapeGroups/0/materialValues/0/materialName name";
  EXPECT_THAT(Read(text("b")).users("/materials/0"), ElementsAre(place));
  EXPECT_THAT(Read(text("a")).users("/materials/0"), IsEmpty());
}

TEST(Graph, MembersOfAnObjectAreReferredToByTheirNames) {
  const Read read(
      R"({"extensions":{"EXT_feature_metadata":{"schema":{"classes":{"tree":{}}},"featureTables":{)"
      R"("trees":{"class":"tree","count":1}}}}})");
  EXPECT_THAT(read.users("/extensions/EXT_feature_metadata/schema/classes/tree"),
              ElementsAre("/extensions/EXT_feature_metadata/featureTables/trees/class name"));
}

TEST(Graph, ADefaultRefersWhereItsMemberIsAbsent) {
  const Read read(R"({"extensions":{"KHR_interactivity":{"graphs":[{},{}]}}})");
  EXPECT_THAT(read.users("/extensions/KHR_interactivity/graphs/0"),
              ElementsAre("/extensions/KHR_interactivity implied"));
}

TEST(Graph, ExtensionsWithoutASchemaAreListedWhereTheyAre) {
  const Read read(
      R"({"nodes":[{"extensions":{"ACME_x":{},"KHR_materials_unlit":{}}}],"materials":[)"
      R"({"extensions":{"KHR_materials_unlit":{}},"extras":{"extensions":{"B_c":{}}}}]})");
  EXPECT_THAT(read.pointers(read.graph.unknown_extensions()),
              ElementsAre("/nodes/0/extensions/ACME_x", "/nodes/0/extensions/KHR_materials_unlit"));
}

TEST(Graph, TheClosureIsAllThatIsReached) {
  const Read read(R"({"scenes":[{"nodes":[0]},{"nodes":[2]}],"nodes":[{"children":[1]},)"
                  R"({"mesh":0},{}],"meshes":[{},{}]})");
  EXPECT_THAT(read.pointers(read.graph.closure({read.node("/scenes/0")})),
              ElementsAre("/scenes/0", "/nodes/0", "/nodes/1", "/meshes/0"));
}

const char* const kTextures =
    R"({"textures":[{"source":0},{"source":1}],"images":[{"bufferView":0},{"bufferView":1},{}],)"
    R"("bufferViews":[{},{}],"materials":[{"normalTexture":{"index":1}}]})";

TEST(Orphans, WhatOnlyAnOrphanRefersToIsOneToo) {
  const Read read(kTextures);
  Orphans orphans(read.graph);
  EXPECT_FALSE(orphans.is_used(read.node("/textures/0")));
  EXPECT_TRUE(orphans.is_used(read.node("/textures/1")));
  EXPECT_THAT(read.pointers(orphans.take(read.node("/textures/0"))),
              ElementsAre("/textures/0", "/images/0", "/bufferViews/0"));
  EXPECT_THAT(read.pointers(orphans.take(read.node("/materials/0"))),
              ElementsAre("/materials/0", "/textures/1", "/images/1", "/bufferViews/1"));
}

TEST(Orphans, OnlyCandidatesAreFound) {
  const Read read(kTextures);
  std::vector<json::NodeId> candidates{read.node("/textures/0"), read.node("/textures/1"),
                                       read.node("/images/0"), read.node("/images/1")};
  std::sort(candidates.begin(), candidates.end());
  EXPECT_THAT(read.pointers(find_orphans(read.graph, candidates)),
              ElementsAre("/textures/0", "/images/0"));
}

TEST(Orphans, ReferencesOfAnElementToItselfDoNotCount) {
  const Read read(R"({"nodes":[{"children":[0]},{"children":[0]}]})");
  Orphans orphans(read.graph);
  EXPECT_THAT(read.pointers(orphans.take(read.node("/nodes/1"))),
              ElementsAre("/nodes/1", "/nodes/0"));
}

TEST(Renumber, NumbersAndStepsFollowTheirElement) {
  const Read read(R"({"nodes":[{},{"scale":[1,1,1]}],"scenes":[{"nodes":[0,1,5]}],"animations":[{)"
                  R"("samplers":[],"channels":[{"sampler":0,"target":{"path":"pointer",)"
                  R"("extensions":{"KHR_animation_pointer":{"pointer":"/nodes/1/scale"}}}}]}]})");
  const auto swapped = [&](json::NodeId list, std::uint64_t position) {
    return list == read.node("/nodes") ? 1 - position : position;
  };
  std::vector<std::string> texts;
  for (const json::Edit& edit : renumber(read.graph, swapped, [](Place) { return false; })) {
    texts.push_back(std::string(edit.span.in(read.text)) + " > " + edit.text);
  }
  EXPECT_THAT(texts, ElementsAre("0 > 1", "1 > 0", R"("/nodes/1/scale" > "/nodes/0/scale")"));
  EXPECT_THAT(renumber(read.graph, swapped, [](Place) { return true; }), IsEmpty());
}

TEST(Pointers, AreFoundByTheElementAndBelow) {
  const auto channel = [](const std::string& pointer) {
    return R"({"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{)"
           R"("pointer":")" +
           pointer + R"("}}}})";
  };
  const Read read(R"({"animations":[{"samplers":[],"channels":[)" +
                  channel("/materials/1/pbrMetallicRoughness/baseColorFactor") + "," +
                  channel("/materials/{i}/alphaCutoff") + R"(]}],"x":"/materials/1/doubleSided"})");
  const Pointers pointers(read.parsed.document, *schema::builtin_set());
  EXPECT_EQ(pointers.all().size(), 2U);
  const std::vector<std::string> path{"pbrMetallicRoughness"}, cutoff{"alphaCutoff"};
  EXPECT_TRUE(pointers.lead_below("materials", "1", path));
  EXPECT_FALSE(pointers.lead_below("materials", "0", path));
  EXPECT_TRUE(pointers.lead_below("materials", "0", cutoff));
}

}  // namespace
}  // namespace gltfx::graph
