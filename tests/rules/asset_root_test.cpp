// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

Lines of_asset(const std::string& members, Profile profile = Profile::standard) {
  return selected(R"({"asset": {)" + members + "}}",
                  {"ASSET_MIN_VERSION_GREATER_THAN_VERSION", "UNKNOWN_ASSET_MAJOR_VERSION",
                   "UNKNOWN_ASSET_MINOR_VERSION", "GLTF_VERSION_2_1_DRAFT"},
                  profile);
}

TEST(AssetRoot, MinVersionMustNotBeAboveVersion) {
  const Lines found{"ASSET_MIN_VERSION_GREATER_THAN_VERSION /asset/minVersion"};
  EXPECT_EQ(of_asset(R"("version": "2.0", "minVersion": "2.1")"), found);
  EXPECT_EQ(of_asset(R"("version": "2.0", "minVersion": "3.0")"), found);
  EXPECT_EQ(of_asset(R"("version": "2.0", "minVersion": "2.0")"), Lines{});
  EXPECT_EQ(of_asset(R"("version": "2.0", "minVersion": "1.9")"), Lines{});
  EXPECT_EQ(of_asset(R"("version": "2.0", "minVersion": "two")"), Lines{});
}

TEST(AssetRoot, OtherMajorVersionsAreErrors) {
  EXPECT_EQ(of_asset(R"("version": "3.0")"), Lines{"UNKNOWN_ASSET_MAJOR_VERSION /asset/version"});
  EXPECT_EQ(of_asset(R"("version": "0.9")"), Lines{"UNKNOWN_ASSET_MAJOR_VERSION /asset/version"});
  EXPECT_EQ(of_asset(R"("version": "2.0")"), Lines{});
}

TEST(AssetRoot, MinorVersionsAndTheDraftAreNamed) {
  EXPECT_EQ(of_asset(R"("version": "2.2")"), Lines{"UNKNOWN_ASSET_MINOR_VERSION /asset/version"});
  EXPECT_EQ(of_asset(R"("version": "2.1")"), Lines{"GLTF_VERSION_2_1_DRAFT /asset/version"});
  EXPECT_EQ(of_asset(R"("version": "2.1")", Profile::khronos),
            Lines{"UNKNOWN_ASSET_MINOR_VERSION /asset/version"});
}

TEST(AssetRoot, TheKhronosProfileStopsAtAnotherMajorVersion) {
  EXPECT_EQ(verdict(R"({"asset": {"version": "3.0"}, "nodes": [{}]})", Profile::khronos),
            Lines{"UNKNOWN_ASSET_MAJOR_VERSION /asset/version"});
}

}  // namespace
}  // namespace gltfx::test
