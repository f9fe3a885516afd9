// SPDX-License-Identifier: Apache-2.0
// What schema files become.

#include <functional>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/embedded.hpp"
#include "schema/leaf.hpp"
#include "schema/stored_set.hpp"

namespace gltfx::test {
namespace {

using schema::builtin_set;
using schema::kNone;
using schema::Set;
using schema::Shape;

const Shape& shape_of(const Set& set, std::string_view type, std::string_view property) {
  const schema::Property* found = set.find_property(set.find_type(type), property);
  EXPECT_NE(found, nullptr) << type << "/" << property;
  return set.shape(found->shape);
}

TEST(BuiltinSet, KnowsEveryCoreTypeByTheNameTheFieldUses) {
  for (const char* name : {"glTF",
                           "asset",
                           "accessor",
                           "accessor.sparse",
                           "accessor.sparse.indices",
                           "accessor.sparse.values",
                           "animation",
                           "animation.channel",
                           "animation.channel.target",
                           "animation.sampler",
                           "buffer",
                           "bufferView",
                           "camera",
                           "camera.orthographic",
                           "camera.perspective",
                           "image",
                           "material",
                           "material.normalTextureInfo",
                           "material.occlusionTextureInfo",
                           "material.pbrMetallicRoughness",
                           "mesh",
                           "mesh.primitive",
                           "node",
                           "sampler",
                           "scene",
                           "skin",
                           "texture",
                           "textureInfo"}) {
    const auto id = builtin_set()->find_type(name);
    ASSERT_NE(id, kNone) << name;
    EXPECT_EQ(builtin_set()->type(id).name, name);
    EXPECT_EQ(builtin_set()->type(id).extension, kNone) << name;
  }
  EXPECT_EQ(builtin_set()->find_type("materials"), kNone);
}

TEST(BuiltinSet, IsTheSameAsTheOneCompiledFromItsTexts) {
  const auto compiled = schema::compile_with({});
  ASSERT_NE(compiled.set, nullptr);
  EXPECT_TRUE(schema::write_set(*builtin_set()) == schema::write_set(*compiled.set));
}

TEST(BuiltinSet, IsMadeOnce) { EXPECT_EQ(builtin_set().get(), builtin_set().get()); }

TEST(Image, BrokenBytesAreRefused) {
  const std::string stored = schema::write_set(*builtin_set());
  ASSERT_NE(schema::read_set(stored), nullptr);
  EXPECT_EQ(schema::read_set(""), nullptr);
  EXPECT_EQ(schema::read_set("something else entirely"), nullptr);
  EXPECT_EQ(schema::read_set(stored + "x"), nullptr);
  for (const std::size_t size : {stored.size() / 7, stored.size() / 2, stored.size() - 1}) {
    EXPECT_EQ(schema::read_set(std::string_view(stored).substr(0, size)), nullptr) << size;
  }
}

TEST(Image, RefersToTextsInPlaceOfCopies) {
  const std::string whole = schema::write_set(*builtin_set());
  const std::string stored = schema::write_set(*builtin_set(), schema::embedded_texts());
  EXPECT_LT(stored.size(), whole.size() * 3 / 4);
  const auto set = schema::read_set(stored, schema::embedded_texts());
  ASSERT_NE(set, nullptr);
  EXPECT_TRUE(schema::write_set(*set) == whole);
  EXPECT_EQ(schema::read_set(stored), nullptr);
  EXPECT_EQ(schema::read_set(stored, schema::embedded_texts().first(10)), nullptr);
}

TEST(TextIndex, FindsStringsThatHaveNoEscapes) {
  const std::string_view texts[]{R"({"a":"short","name":"long enough to be found"})",
                                 R"(["with an \"escape\" inside","and another one behind"])",
                                 R"({"not closed": "until the end)"};
  const schema::TextIndex index(texts);
  const auto found = index.find("long enough to be found");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->text, 0U);
  EXPECT_EQ(texts[0].substr(found->begin, 4), "long");
  const auto behind = index.find("and another one behind");
  ASSERT_TRUE(behind.has_value());
  EXPECT_EQ(behind->text, 1U);
  EXPECT_EQ(texts[1].substr(behind->begin, 3), "and");
  for (const char* missing :
       {"short", "with an \"escape\" inside", "until the end", "nowhere at all"})
    EXPECT_FALSE(index.find(missing).has_value()) << missing;
}

TEST(Image, ThreadsThatAskForTheSamePartsGetTheSame) {
  const std::string stored = schema::write_set(*builtin_set());
  const auto set = schema::read_set(stored);
  ASSERT_NE(set, nullptr);
  std::vector<const void*> seen[2];
  const auto ask_for_all = [&](std::vector<const void*>& parts) {
    for (schema::ShapeId id = 0; id < set->shapes().size(); ++id) parts.push_back(&set->shape(id));
    for (schema::TypeId id = 0; id < set->types().size(); ++id) parts.push_back(&set->type(id));
  };
  std::thread other(ask_for_all, std::ref(seen[1]));
  ask_for_all(seen[0]);
  other.join();
  EXPECT_GT(seen[0].size(), 1000U);
  EXPECT_EQ(seen[0], seen[1]);
}

TEST(Compile, PropertiesKeepTheirOrderAndFacts) {
  const Set& set = *builtin_set();
  const auto& type = set.type(set.find_type("material.pbrMetallicRoughness"));
  ASSERT_GE(type.properties.size(), 5U);
  EXPECT_EQ(type.properties[0].name, "baseColorFactor");
  EXPECT_EQ(type.properties[0].mutable_type, "float4");
  EXPECT_EQ(type.properties[0].default_json, "[1,1,1,1]");
  EXPECT_FALSE(type.properties[0].required);
  EXPECT_FALSE(type.properties[0].description.empty());
  const Shape& factor = set.shape(type.properties[0].shape);
  EXPECT_EQ(factor.types, schema::kArray);
  EXPECT_EQ(factor.min_items, 4U);
  EXPECT_EQ(factor.max_items, 4U);
  EXPECT_EQ(set.shape(factor.items).maximum, 1);
}

TEST(Compile, SlotsShareTheirTypeButHaveShapesOfTheirOwn) {
  const Set& set = *builtin_set();
  const Shape& base = shape_of(set, "material.pbrMetallicRoughness", "baseColorTexture");
  const Shape& metal = shape_of(set, "material.pbrMetallicRoughness", "metallicRoughnessTexture");
  EXPECT_EQ(base.type, set.find_type("textureInfo"));
  EXPECT_EQ(metal.type, base.type);
  ASSERT_TRUE(base.slot && metal.slot);
  EXPECT_EQ(base.slot->channels, "rgba");
  EXPECT_TRUE(base.slot->srgb);
  EXPECT_EQ(base.slot->scaled_by, "baseColorFactor");
  EXPECT_EQ(metal.slot->channels, "gb");
  EXPECT_EQ(base.label, "material.pbrMetallicRoughness/baseColorTexture");
  EXPECT_FALSE(set.shape(set.type(base.type).shape).slot) << "the type itself is no slot";
}

TEST(Compile, TargetsAreOfThreeKinds) {
  const Set& set = *builtin_set();
  const auto& mesh = shape_of(set, "node", "mesh").ref;
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->base, schema::Target::Base::root_array);
  EXPECT_THAT(mesh->steps, testing::ElementsAre("meshes"));
  const auto& sampler = shape_of(set, "animation.channel", "sampler").ref;
  ASSERT_TRUE(sampler);
  EXPECT_EQ(sampler->base, schema::Target::Base::enclosing);
  EXPECT_EQ(sampler->enclosing, set.find_type("animation"));
  const auto& light = shape_of(set, "node.KHR_lights_punctual", "light").ref;
  ASSERT_TRUE(light);
  EXPECT_EQ(light->base, schema::Target::Base::root_path);
  EXPECT_THAT(light->steps, testing::ElementsAre("extensions", "KHR_lights_punctual", "lights"));
}

TEST(Compile, ExtensionsHaveAnObjectTypeForEachHome) {
  const Set& set = *builtin_set();
  const auto& transform = set.extensions()[set.find_extension("KHR_texture_transform")];
  ASSERT_EQ(transform.attachment_points.size(), 6U);  // those of other extensions, too
  const auto plain = set.find_type("textureInfo.KHR_texture_transform");
  const auto normal = set.find_type("material.normalTextureInfo.KHR_texture_transform");
  ASSERT_NE(plain, kNone);
  ASSERT_NE(normal, kNone);
  EXPECT_EQ(set.shape(transform.shape_on(set.find_type("textureInfo"))).type, plain);
  EXPECT_EQ(set.shape(transform.shape_on(set.find_type("material.normalTextureInfo"))).type,
            normal);
  EXPECT_EQ(transform.shape_on(set.find_type("node")), kNone);
  EXPECT_EQ(set.type(normal).origin, plain) << "both come from one definition";
  EXPECT_EQ(set.type(normal).extension, set.find_extension("KHR_texture_transform"));
}

TEST(Compile, DefinitionsOfExtensionsAreTypesToo) {
  const Set& set = *builtin_set();
  const auto light = set.find_type("KHR_lights_punctual.light");
  ASSERT_NE(light, kNone);
  EXPECT_NE(set.find_property(light, "color"), nullptr);
  EXPECT_EQ(set.find_type("KHR_lights_punctual.root"), set.find_type("glTF.KHR_lights_punctual"));
}

TEST(Compile, EnumNamesBelongToTheirValues) {
  const Shape& shape = shape_of(*builtin_set(), "accessor", "componentType");
  ASSERT_EQ(shape.literals.size(), 6U);
  EXPECT_EQ(shape.literals[1].number, 5121);
  EXPECT_EQ(shape.literals[1].name, "UNSIGNED_BYTE");
}

TEST(Compile, StatusNamesAreThoseOfTheFiles) {
  EXPECT_EQ(schema::status_name(schema::Status::release_candidate), "release-candidate");
  const Set& set = *builtin_set();
  EXPECT_EQ(set.extensions()[set.find_extension("KHR_materials_translucency")].status,
            schema::Status::legacy);
  EXPECT_EQ(set.extensions()[set.find_extension("KHR_materials_unlit")].status,
            schema::Status::ratified);
}

TEST(Compile, WordsBesideAReferenceAreKept) {
  const auto set = set_with(
      acme(R"("properties": {"p": {"$ref": "#/$defs/base", "description": "mine", "maximum": 3}},
    "$defs": {"base": {"description": "base", "type": "integer", "minimum": 1}})"));
  ASSERT_NE(set, nullptr);
  const Shape& shape = shape_of(*set, "material.ACME_x", "p");
  EXPECT_EQ(shape.minimum, 1);
  EXPECT_EQ(shape.description, "mine");
  ASSERT_EQ(shape.all_of.size(), 1U) << "what stands beside it has to hold as well";
  EXPECT_EQ(set->shape(shape.all_of[0]).maximum, 3);
}

TEST(Compile, GraphsOfTypesMayHaveCycles) {
  const auto set = set_with(acme(R"("properties": {"tree": {"$ref": "#/$defs/tree"}},
    "$defs": {"tree": {"type": "object", "properties": {"left": {"$ref": "#/$defs/tree"}, "right": {"$ref": "#/$defs/tree"}}}})"));
  ASSERT_NE(set, nullptr);
  const auto tree = set->find_type("ACME_x.tree");
  EXPECT_EQ(set->shape(set->find_property(tree, "left")->shape).type, tree);
}

TEST(Compile, NameOnlyExtensionsHaveNoHome) {
  const auto set = set_with(acme(R"("type": "object")", "", "[]"));
  ASSERT_NE(set, nullptr);
  EXPECT_TRUE(set->extensions()[set->find_extension("ACME_x")].attachment_points.empty());
}

TEST(Compile, TighterOfTwoLimitsCounts) {
  const auto set = set_with(acme(
      R"("properties": {"a": {"type": "number", "exclusiveMinimum": 1, "minimum": 2, "maximum": 9, "exclusiveMaximum": 5}})"));
  ASSERT_NE(set, nullptr);
  const Shape& shape = shape_of(*set, "material.ACME_x", "a");
  EXPECT_EQ(shape.minimum, 2);
  EXPECT_FALSE(shape.exclusive_minimum);
  EXPECT_EQ(shape.maximum, 5);
  EXPECT_TRUE(shape.exclusive_maximum);
}

TEST(Compile, ErrorTextNamesFileLineColumnAndKey) {
  const schema::SchemaError error{"a.json", 3, 7, "/type", "must be"};
  EXPECT_EQ(error.text(), "a.json:3:7: /type: must be");
}

}  // namespace
}  // namespace gltfx::test
