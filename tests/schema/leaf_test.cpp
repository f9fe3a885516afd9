// SPDX-License-Identifier: Apache-2.0
// A user's own extension has the same powers as a built-in one.
#include "schema/leaf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/findings.hpp"

namespace gltfx::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Leaf : public testing::Test {
 protected:
  Leaf() : set_(set_with(kLeaf)) {}
  void SetUp() override { ASSERT_NE(set_, nullptr); }

  std::string asset_with(const std::string& extensions, const std::string& names = "ACME_leaf") {
    return asset_using(
        names,
        R"("images": [{"uri": "a.png"}], "textures": [{"source": 0}], "materials": [{"extensions": {)" +
            extensions + "}}]");
  }
  std::vector<std::string> verdict_of(const std::string& leaf) {
    return verdict(asset_with("\"ACME_leaf\": " + leaf), {}, *set_);
  }
  const std::string at_ = "/materials/0/extensions/ACME_leaf";
  std::shared_ptr<const schema::Set> set_;
};

TEST_F(Leaf, ValidObjectsRaiseNothing) {
  EXPECT_THAT(verdict_of(R"({"age": 1})"), IsEmpty());
  EXPECT_THAT(verdict_of(R"({"age": 9, "veins": {"index": 0}, "extensions": {}, "extras": {}})"),
              IsEmpty());
}

TEST_F(Leaf, ErrorsAreToldAtTheMember) {
  EXPECT_THAT(verdict_of("{}"), ElementsAre("UNDEFINED_PROPERTY " + at_));
  EXPECT_THAT(verdict_of(R"({"age": 0})"), ElementsAre("VALUE_NOT_IN_RANGE " + at_ + "/age"));
  EXPECT_THAT(verdict_of(R"({"age": 10})"), ElementsAre("VALUE_NOT_IN_RANGE " + at_ + "/age"));
  EXPECT_THAT(verdict_of(R"({"age": 2.5})"), ElementsAre("TYPE_MISMATCH " + at_ + "/age"));
  EXPECT_THAT(verdict_of(R"({"age": 2.0})"), IsEmpty());
  EXPECT_THAT(verdict_of(R"({"agee": 2})"),
              ElementsAre("UNEXPECTED_PROPERTY " + at_ + "/agee", "UNDEFINED_PROPERTY " + at_));
  EXPECT_THAT(verdict_of(R"({"age": 2, "veins": 0})"),
              ElementsAre("TYPE_MISMATCH " + at_ + "/veins"));
  EXPECT_THAT(verdict_of(R"({"age": 2, "veins": {"index": 1}})"),
              ElementsAre("UNRESOLVED_REFERENCE " + at_ + "/veins/index"));
  EXPECT_THAT(verdict_of(R"({"age": 2, "extensions": 3})"),
              ElementsAre("TYPE_MISMATCH " + at_ + "/extensions"));
  EXPECT_THAT(verdict_of("3"), ElementsAre("TYPE_MISMATCH " + at_));
}

TEST_F(Leaf, ExclusionNamesBothAndTheReason) {
  const Found found = only(asset_with(R"("ACME_leaf": {"age": 1}, "KHR_materials_unlit": {})",
                                      "ACME_leaf,KHR_materials_unlit"),
                           *set_);
  EXPECT_EQ(found.code, "EXTENSION_EXCLUDED");
  EXPECT_EQ(found.pointer, at_);
  EXPECT_EQ(found.marked, "\"ACME_leaf\"");
  EXPECT_THAT(found.message,
              testing::AllOf(HasSubstr("'ACME_leaf'"), HasSubstr("'KHR_materials_unlit'"),
                             HasSubstr("a leaf is lit.")));
}

TEST_F(Leaf, SlotIsRecordedWithItsChannels) {
  const auto result =
      result_of(asset_with(R"("ACME_leaf": {"age": 1, "veins": {"index": 0}})"), {}, *set_);
  ASSERT_EQ(result.slots.size(), 1U);
  EXPECT_EQ(result.slots[0].pointer, at_ + "/veins");
  ASSERT_NE(result.slots[0].slot, nullptr);
  EXPECT_EQ(result.slots[0].slot->channels, "a");
  EXPECT_FALSE(result.slots[0].slot->srgb);
}

TEST_F(Leaf, OtherHomesAreRefused) {
  const std::string text =
      asset_using("ACME_leaf", R"("nodes": [{"extensions": {"ACME_leaf": {"age": 1}}}])");
  const Found found = only(text, *set_);
  EXPECT_EQ(found.code, "UNEXPECTED_EXTENSION_OBJECT");
  EXPECT_THAT(found.help, HasSubstr("material"));
}

TEST_F(Leaf, WithoutItsFileTheExtensionIsNotJudged) {
  EXPECT_THAT(verdict(asset_with(R"("ACME_leaf": {"age": 77, "what": []})")), IsEmpty());
}

TEST_F(Leaf, IsKnownAsGivenByTheUser) {
  const auto id = set_->find_extension("ACME_leaf");
  ASSERT_NE(id, schema::kNone);
  EXPECT_TRUE(set_->extensions()[id].from_user);
  EXPECT_EQ(set_->extensions()[id].status, schema::Status::vendor);
  EXPECT_FALSE(set_->extensions()[set_->find_extension("KHR_materials_ior")].from_user);
}

TEST(UserSchema, ReplacesABuiltInExtension) {
  std::string text = kLeaf;
  for (std::size_t at = text.find("ACME_leaf"); at != std::string::npos;
       at = text.find("ACME_leaf")) {
    text.replace(at, 9, "KHR_materials_ior");
  }
  const auto set = set_with(text);
  ASSERT_NE(set, nullptr);
  const auto asset_of = [](const char* object) {
    return asset_using(
        "KHR_materials_ior",
        std::string(R"("materials": [{"extensions": {"KHR_materials_ior": )") + object + "}}]");
  };
  EXPECT_THAT(verdict(asset_of(R"({"age": 1})"), {}, *set), IsEmpty());
  EXPECT_THAT(verdict(asset_of(R"({"ior": 1.5})"), {}, *set),
              ElementsAre("UNEXPECTED_PROPERTY /materials/0/extensions/KHR_materials_ior/ior",
                          "UNDEFINED_PROPERTY /materials/0/extensions/KHR_materials_ior"));
  EXPECT_THAT(verdict(asset_of(R"({"ior": 1.5})")), IsEmpty()) << "the built-in set stays as it is";
  EXPECT_EQ(set->extensions().size(), schema::builtin_set()->extensions().size());
}

TEST(UserSchema, TheLaterOfTwoFilesCounts) {
  std::string second = kLeaf;
  second.replace(second.find("\"maximum\":9"), 11, "\"maximum\":5");
  const auto compiled = schema::compile_with({{"a.json", kLeaf, false}, {"b.json", second, false}});
  ASSERT_NE(compiled.set, nullptr);
  EXPECT_THAT(verdict(asset_using("ACME_leaf",
                                  R"("materials": [{"extensions": {"ACME_leaf": {"age": 7}}}])"),
                      {}, *compiled.set),
              ElementsAre("VALUE_NOT_IN_RANGE /materials/0/extensions/ACME_leaf/age"));
}

}  // namespace
}  // namespace gltfx::test
