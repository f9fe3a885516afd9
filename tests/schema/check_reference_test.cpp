// SPDX-License-Identifier: Apache-2.0
// Indices and names that refer to other objects, what they mark as used, and what the walk hands
// over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json/parse.hpp"
#include "schema/findings.hpp"
#include "schema/leaf.hpp"

namespace gltfx::test {
namespace {

using schema::kKhronosValidator;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Reference, BehindTheEndSaysHowManyThereAre) {
  const Found found =
      only(asset(R"("nodes": [{"mesh": 7}], "meshes": [{"primitives": [{"attributes": {"_A": 0}}]}],
    "accessors": [{"componentType": 5126, "count": 1, "type": "VEC3"}])"));
  EXPECT_EQ(found.code, "UNRESOLVED_REFERENCE");
  EXPECT_TRUE(found.is_reference) << "goes to the sink for references";
  EXPECT_EQ(found.pointer, "/nodes/0/mesh");
  EXPECT_EQ(found.message, "'mesh' refers to meshes[7], but the length of meshes is 1.");
  EXPECT_EQ(found.marked, "7");
}

TEST(Reference, ToAnArrayThatIsNotThereSaysSo) {
  const Found found = only(asset(
      R"("nodes": [{"skin": 0, "mesh": 0}], "meshes": [{"primitives": [{"attributes": {"_A": 0}}]}],
    "accessors": [{"componentType": 5126, "count": 1, "type": "VEC3"}])"));
  EXPECT_EQ(found.message, "'skin' refers to skins[0], but there are no skins.");
}

TEST(Reference, IntoTheObjectAround) {
  const auto animation = [](const char* sampler) {
    return asset(
        std::string(R"("accessors": [{"componentType": 5126, "count": 1, "type": "SCALAR"}],
      "animations": [{"channels": [{"target": {"path": "scale"}, "sampler": )") +
        sampler + R"(}], "samplers": [{"input": 0, "output": 0}]},
                     {"channels": [{"target": {"path": "scale"}, "sampler": 1}], "samplers": [{"input": 0, "output": 0}, {"input": 0, "output": 0}]}])");
  };
  EXPECT_THAT(verdict(animation("0")), IsEmpty());
  EXPECT_THAT(verdict(animation("1")),
              ElementsAre("UNRESOLVED_REFERENCE /animations/0/channels/0/sampler"));
  const auto result = result_of(animation("0"));
  ASSERT_EQ(result.local_targets.size(), 2U);
  EXPECT_EQ(result.local_targets[0].pointer, "/animations/0/samplers");
  EXPECT_TRUE(result.local_targets[0].used.contains(0));
  EXPECT_EQ(result.local_targets[1].pointer, "/animations/1/samplers");
  EXPECT_FALSE(result.local_targets[1].used.contains(0));
  EXPECT_TRUE(result.local_targets[1].used.contains(1));
}

TEST(Reference, IntoAnArrayOfAnExtension) {
  const auto lights = [](const char* light) {
    return asset_using(
        "KHR_lights_punctual",
        std::string(R"("nodes": [{"extensions": {"KHR_lights_punctual": {"light": )") + light +
            R"(}}}], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}, {"type": "point"}]}})");
  };
  EXPECT_THAT(verdict(lights("1")), IsEmpty());
  EXPECT_THAT(verdict(lights("2")),
              ElementsAre("UNRESOLVED_REFERENCE /nodes/0/extensions/KHR_lights_punctual/light"));
  const auto result = result_of(lights("1"));
  const auto* target = result.target("/extensions/KHR_lights_punctual/lights");
  ASSERT_NE(target, nullptr);
  EXPECT_EQ(target->used.size(), 2U);
  EXPECT_FALSE(target->used.contains(0));
  EXPECT_TRUE(target->used.contains(1));
}

TEST(Reference, WithAStarFitsTheLargestOfTheArrays) {
  const auto set = set_with(acme(R"("type": "object", "$defs": {
    "root": {"type": "object", "properties": {"groups": {"type": "array", "items": {"type": "object", "properties": {"things": {"type": "array", "items": {"type": "object"}}}}}}},
    "node": {"type": "object", "properties": {"thing": {"type": "integer", "minimum": 0, "x-gltfx": {"ref": "/extensions/ACME_x/groups/*/things"}}}}})",
                                 "", R"({"glTF": "#/$defs/root", "node": "#/$defs/node"})"));
  ASSERT_NE(set, nullptr);
  const auto said = [&](const char* thing) {
    return verdict(
        asset_using(
            "ACME_x",
            std::string(R"("nodes": [{"extensions": {"ACME_x": {"thing": )") + thing +
                R"(}}}], "extensions": {"ACME_x": {"groups": [{"things": [{}]}, {"things": [{}, {}, {}]}, {}]}})"),
        {}, *set);
  };
  EXPECT_THAT(said("2"), IsEmpty());
  EXPECT_THAT(said("3"), ElementsAre("UNRESOLVED_REFERENCE /nodes/0/extensions/ACME_x/thing"));
}

TEST(Reference, ByNameMustOccur) {
  const auto said = [](const char* name) {
    return find(asset_using(
        "AGI_articulations",
        std::string(
            R"("extensions": {"AGI_articulations": {"articulations": [{"name": "door", "stages": [
      {"name": "open", "type": "yRotate", "minimumValue": 0, "maximumValue": 90, "initialValue": 0}]}]}},
      "nodes": [{"extensions": {"AGI_articulations": {"articulationName": ")") +
            name + "\"}}}]"));
  };
  EXPECT_TRUE(said("door").empty());
  ASSERT_EQ(said("window").size(), 1U);
  EXPECT_EQ(said("window")[0].code, "UNRESOLVED_NAME");
  EXPECT_TRUE(said("window")[0].is_reference);
  EXPECT_THAT(said("window")[0].message, HasSubstr("'window'"));
}

TEST(Reference, TheMinimumMayStandForNone) {
  const auto set = set_with(acme(R"("type": "object", "properties": {
    "seat": {"type": "integer", "minimum": -1, "x-gltfx": {"ref": "nodes"}},
    "door": {"type": "integer", "minimum": 0, "x-gltfx": {"ref": "nodes"}}})"));
  ASSERT_NE(set, nullptr);
  const auto said = [&](const std::string& members) {
    return verdict(
        asset_using("ACME_x", R"("materials": [{"extensions": {"ACME_x": {)" + members + "}}}]"),
        {}, *set);
  };
  const std::string place = " /materials/0/extensions/ACME_x/";
  EXPECT_THAT(said(R"("seat": -1)"), IsEmpty());
  EXPECT_THAT(said(R"("seat": -2)"), ElementsAre("INVALID_INDEX" + place + "seat"));
  EXPECT_THAT(said(R"("seat": 0)"), ElementsAre("UNRESOLVED_REFERENCE" + place + "seat"));
  EXPECT_THAT(said(R"("door": -1)"), ElementsAre("INVALID_INDEX" + place + "door"));
}

TEST(Reference, ToWhatLacksTheMember) {
  const auto set = set_with(acme(R"("type": "object", "properties": {
    "seats": {"type": "array", "items": {"type": "integer", "minimum": 0, "x-gltfx": {"ref": "nodes", "refHas": "extras/seat"}}}})"));
  ASSERT_NE(set, nullptr);
  const auto said = [&](const std::string& seats) {
    return verdict(asset_using("ACME_x", R"("nodes": [{}, {"extras": {"seat": 1}}, {"extras": {}}],
    "materials": [{"extensions": {"ACME_x": {"seats": [)" +
                                             seats + "]}}}]"),
                   {}, *set);
  };
  const std::string place = " /materials/0/extensions/ACME_x/seats/";
  EXPECT_THAT(said("1, 1"), IsEmpty());
  EXPECT_THAT(said("1, 0, 2"), ElementsAre("REFERENCE_MEMBER_MISSING" + place + "1",
                                           "REFERENCE_MEMBER_MISSING" + place + "2"));
  EXPECT_THAT(said("3"), ElementsAre("UNRESOLVED_REFERENCE" + place + "0"));
}

TEST(Name, OfAMemberOfAnObject) {
  const auto set = set_with(R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_x", "title": "x",
    "description": "x", "x-gltfx": {"extension": "ACME_x", "on": {"glTF": "#/$defs/root",
    "material": "#/$defs/user"}, "status": "vendor"}, "$defs": {
    "root": {"type": "object", "properties": {"kinds": {"type": "object", "additionalProperties": true},
      "list": {"type": "object", "properties": {"kinds": {"type": "object", "additionalProperties": true}}}}},
    "user": {"type": "object", "properties": {
      "kind": {"type": "string", "x-gltfx": {"refName": "/extensions/ACME_x/kinds"}},
      "listed": {"type": "string", "x-gltfx": {"refName": "/extensions/ACME_x/list/kinds"}}}}}})");
  ASSERT_NE(set, nullptr);
  const auto said = [&](const std::string& root, const std::string& user) {
    return verdict(asset_using("ACME_x", R"("extensions": {"ACME_x": {)" + root +
                                             R"(}}, "materials": [{"extensions": {"ACME_x": {)" +
                                             user + "}}}]"),
                   {}, *set);
  };
  const std::string place = "UNRESOLVED_NAME /materials/0/extensions/ACME_x/";
  EXPECT_THAT(said(R"("kinds": {"oak": {}})", R"("kind": "oak")"), IsEmpty());
  EXPECT_THAT(said(R"("kinds": {"oak": {}})", R"("kind": "elm")"), ElementsAre(place + "kind"));
  EXPECT_THAT(said("", R"("kind": "elm")"), ElementsAre(place + "kind"));
  EXPECT_THAT(said(R"("list": {"kinds": {}})", R"("listed": "elm")"),
              ElementsAre(place + "listed"));
  EXPECT_THAT(said("", R"("listed": "elm")"), IsEmpty()) << "the list may be a file of its own";
}

TEST(Reference, ToAHoleIsBrokenForKhronosOnly) {
  const std::string json = asset(R"("scenes": [{"nodes": [1]}], "nodes": [{}, 3])");
  EXPECT_THAT(verdict(json), ElementsAre("TYPE_MISMATCH /nodes/1")) << "one cause, one finding";
  EXPECT_THAT(verdict(json, kKhronosValidator),
              testing::UnorderedElementsAre("TYPE_MISMATCH /nodes/1",
                                            "UNRESOLVED_REFERENCE /scenes/0/nodes/0"));
}

TEST(Used, MarksWhatIsReferredToAndNothingElse) {
  const auto result = result_of(
      asset(R"("scene": 0, "scenes": [{"nodes": [2]}], "nodes": [{}, {"children": [0]}, {}, {}])"));
  const auto* nodes = result.target("/nodes");
  ASSERT_NE(nodes, nullptr);
  EXPECT_TRUE(nodes->used.contains(0));
  EXPECT_FALSE(nodes->used.contains(1));
  EXPECT_TRUE(nodes->used.contains(2));
  EXPECT_FALSE(nodes->used.contains(3));
  EXPECT_EQ(result.target("/meshes"), nullptr) << "the document has none";
}

TEST(Used, TellsThoseOfExtensions) {
  const auto result = result_of(asset_using(
      "VRMC_node_constraint",
      R"("nodes": [{"children": [1]}, {}, {"extensions": {"VRMC_node_constraint": {"specVersion": "1.0",
      "constraint": {"rotation": {"source": 0}}}}}])"));
  const auto* nodes = result.target("/nodes");
  ASSERT_NE(nodes, nullptr);
  EXPECT_TRUE(nodes->used.contains(1));
  EXPECT_FALSE(nodes->used.is_used_by_extension(1));
  EXPECT_TRUE(nodes->used.is_used_by_extension(0));
}

TEST(Used, CountsReferencesOfExtensions) {
  const auto result = result_of(asset_using("KHR_materials_variants", R"("materials": [{}, {}],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "a"}]}}, "accessors": [{"componentType": 5126, "count": 1, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"_A": 0}, "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}}}]}])"));
  EXPECT_FALSE(result.target("/materials")->used.contains(0));
  EXPECT_TRUE(result.target("/materials")->used.contains(1));
}

TEST(Slots, AreListedWithOwnerAndPointer) {
  const std::string json = asset(R"("images": [{"uri": "a"}], "textures": [{"source": 0}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "occlusionTexture": {"index": 0}, "normalTexture": 3}])");
  const auto result = result_of(json);
  ASSERT_EQ(result.slots.size(), 2U) << "a slot that is no object is not filled";
  EXPECT_EQ(result.slots[0].pointer, "/materials/0/pbrMetallicRoughness/baseColorTexture");
  EXPECT_EQ(result.slots[0].slot->channels, "rgba");
  EXPECT_EQ(result.slots[1].pointer, "/materials/0/occlusionTexture");
  const auto parsed = json::parse(json);
  EXPECT_EQ(parsed.document.pointer_of(result.slots[0].texture_info), result.slots[0].pointer);
  EXPECT_EQ(parsed.document.pointer_of(result.slots[0].owner), "/materials/0/pbrMetallicRoughness");
}

class Quiet : public Sink {
 public:
  void report(const Path&, Finding) override {}
};

TEST(Visitor, SeesEachTypedObjectBehindItsMembers) {
  const auto parsed = json::parse(asset_using(
      "KHR_materials_ior",
      R"("materials": [{"pbrMetallicRoughness": {}, "extensions": {"KHR_materials_ior": {}}, "extras": {}}])"));
  std::vector<std::string> seen;
  Quiet sink;
  schema::check(parsed.document, *schema::builtin_set(), {}, sink, sink,
                [&](const schema::ObjectType& type, json::NodeId node, const Path& path) {
                  EXPECT_EQ(parsed.document.pointer_of(node), path.pointer());
                  seen.push_back(type.name + " " + path.pointer());
                });
  EXPECT_THAT(
      seen,
      ElementsAre("asset /asset", "material.pbrMetallicRoughness /materials/0/pbrMetallicRoughness",
                  "material.KHR_materials_ior /materials/0/extensions/KHR_materials_ior",
                  "material /materials/0", "glTF "));
}

TEST(Robustness, DeepDocumentsAreWalkedWithoutRecursion) {
  const auto set = set_with(acme(R"("properties": {"tree": {"$ref": "#/$defs/tree"}},
    "$defs": {"tree": {"type": "object", "properties": {"next": {"$ref": "#/$defs/tree"}, "n": {"type": "integer"}}}})"));
  ASSERT_NE(set, nullptr);
  constexpr int kDeep = 100000;
  std::string json =
      R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_x"], "materials": [{"extensions": {"ACME_x": {"tree": )";
  for (int i = 0; i < kDeep; ++i) json += "{\"next\":";
  json += "{\"n\":\"x\"}";
  json.append(kDeep, '}');
  json += "}}}]}";
  json::Limits limits;
  limits.depth = 2 * kDeep;
  const auto parsed = json::parse(share_text(json), limits);
  ASSERT_TRUE(parsed.ok());
  class Count : public Sink {
   public:
    void report(const Path&, Finding finding) override {
      codes.emplace_back(code_name(finding.code));
    }
    std::vector<std::string> codes;
  } sink;
  schema::check(parsed.document, *set, {}, sink, sink);
  EXPECT_THAT(sink.codes, ElementsAre("TYPE_MISMATCH"));
}

TEST(Robustness, NestedAlternativesDoNotExplode) {
  const auto set = set_with(acme(
      R"("properties": {"tree": {"$ref": "#/$defs/tree"}}, "$defs": {"tree": {"type": "object", "oneOf": [
      {"properties": {"next": {"$ref": "#/$defs/tree"}}, "required": ["a"]}, {"properties": {"next": {"$ref": "#/$defs/tree"}}, "required": ["b"]}]}})"));
  ASSERT_NE(set, nullptr);
  std::string json = R"("materials": [{"extensions": {"ACME_x": {"tree": )";
  for (int i = 0; i < 500; ++i) json += R"({"a": 1, "next": )";
  json += R"({"b": 1})" + std::string(500, '}');
  EXPECT_THAT(verdict(asset_using("ACME_x", json + "}}}]"), {}, *set), IsEmpty())
      << "two ways at each of 500 levels";
}

TEST(Robustness, AnEmptyDocumentIsNothing) {
  Quiet sink;
  EXPECT_TRUE(schema::check({}, *schema::builtin_set(), {}, sink, sink).targets.empty());
}

}  // namespace
}  // namespace gltfx::test
