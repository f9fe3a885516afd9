// SPDX-License-Identifier: Apache-2.0
#include "model/object_model.hpp"

#include <gtest/gtest.h>

#include "asset_text.hpp"
#include "schema/compile.hpp"

namespace gltfx::model {
namespace {

using Status = PropertyTarget::Status;

class ObjectModelTest : public ::testing::Test {
 protected:
  test::AssetText text_{R"({"nodes": [{"mesh": 0}, {"matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
      "targets": [{"POSITION": 0}, {"POSITION": 0}]}]}],
    "materials": [{"normalTexture": {"index": 0}, "emissiveFactor": [1, 0, 0],
      "extensions": {"KHR_materials_ior": {}, "X_unknown": {"glow": [1, {"a": 2}]}}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})"};
  std::shared_ptr<const schema::Set> set_ = schema::builtin_set();
  ObjectModel model_{text_.asset, *set_};
};

TEST_F(ObjectModelTest, MutablePropertiesHaveTheirTypes) {
  const std::pair<const char*, PropertyType> table[] = {
      {"/nodes/0/translation", PropertyType::float3},
      {"/nodes/0/rotation", PropertyType::float4},
      {"/nodes/0/weights", PropertyType::number_array},
      {"/nodes/0/weights/1", PropertyType::number},
      {"/nodes/1/translation", PropertyType::float3},
      {"/materials/0/emissiveFactor", PropertyType::float3},
      {"/materials/0/normalTexture/scale", PropertyType::number},
      {"/materials/0/extensions/KHR_materials_ior/ior", PropertyType::number},
      {"/extensions/KHR_lights_punctual/lights/0/color", PropertyType::float3},
  };
  for (const auto& [pointer, type] : table) {
    const PropertyTarget target = model_.resolve(pointer);
    EXPECT_EQ(target.status, Status::mutable_property) << pointer << ": " << target.reason;
    EXPECT_EQ(target.type, type) << pointer;
  }
}

TEST_F(ObjectModelTest, WrittenValueIsThereAndDefaultIsNot) {
  const PropertyTarget written = model_.resolve("/materials/0/emissiveFactor");
  ASSERT_NE(written.value, json::kNoNode);
  EXPECT_EQ(text_.document.raw(written.value), "[1, 0, 0]");
  EXPECT_EQ(model_.resolve("/materials/0/alphaCutoff").value, json::kNoNode);
}

TEST_F(ObjectModelTest, ElementsOfWeightsBelongToTheirArray) {
  const PropertyTarget element = model_.resolve("/nodes/0/weights/1");
  EXPECT_EQ(element.property, "/nodes/0/weights");
  EXPECT_EQ(element.element, 1U);
  EXPECT_EQ(model_.resolve("/nodes/0/weights").length, 2U);
  EXPECT_EQ(model_.resolve("/nodes/0/weights/2").status, Status::unresolved);
}

TEST_F(ObjectModelTest, MatrixHidesRotationAndScale) {
  EXPECT_EQ(model_.resolve("/nodes/1/rotation").status, Status::unresolved);
  EXPECT_EQ(model_.resolve("/nodes/1/scale").status, Status::unresolved);
}

TEST_F(ObjectModelTest, PropertyWithoutDefaultMustBeWritten) {
  EXPECT_EQ(model_.resolve("/extensions/KHR_lights_punctual/lights/0/range").status,
            Status::unresolved);
  EXPECT_EQ(model_.resolve("/materials/0/occlusionTexture/strength").status, Status::unresolved);
}

TEST_F(ObjectModelTest, RuntimeStateAndIndicesAreImmutable) {
  for (const char* pointer :
       {"/nodes/0/parent", "/nodes/0/globalMatrix", "/nodes.length", "/nodes/0/weights.length",
        "/nodes/0/mesh", "/materials/0/doubleSided"}) {
    EXPECT_EQ(model_.resolve(pointer).status, Status::immutable) << pointer;
  }
}

TEST_F(ObjectModelTest, UnknownExtensionsAreAnybodysBusiness) {
  EXPECT_EQ(model_.resolve("/materials/0/extensions/X_unknown/glow/1/a").status, Status::outside);
  EXPECT_EQ(model_.resolve("/materials/0/extensions/X_unknown/glow/0").status, Status::outside);
  EXPECT_EQ(model_.resolve("/materials/0/extensions/X_unknown/glow/2").status, Status::unresolved);
}

TEST_F(ObjectModelTest, WrongStepIsMended) {
  EXPECT_EQ(model_.resolve("/materials/0/emisiveFactor").nearest, "/materials/0/emissiveFactor");
  EXPECT_EQ(model_.resolve("/material/0/alphaCutoff").nearest, "/materials/0/alphaCutoff");
  EXPECT_EQ(model_.resolve("/materials/0/extensions/KHR_material_ior/ior").nearest,
            "/materials/0/extensions/KHR_materials_ior/ior");
}

TEST_F(ObjectModelTest, TextThatIsNoPointerIsMalformed) {
  for (const char* pointer : {"nodes", "#/nodes", "/nodes~", "/a~2"}) {
    EXPECT_EQ(model_.resolve(pointer).status, Status::malformed) << pointer;
  }
}

}  // namespace
}  // namespace gltfx::model
