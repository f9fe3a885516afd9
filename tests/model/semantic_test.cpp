// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "model/mesh.hpp"

namespace gltfx::model {
namespace {

TEST(Semantic, KnowsTheNamesOfTheSpecification) {
  EXPECT_EQ(parse_semantic("POSITION").kind, SemanticKind::position);
  EXPECT_EQ(parse_semantic("NORMAL").kind, SemanticKind::normal);
  EXPECT_EQ(parse_semantic("TANGENT").kind, SemanticKind::tangent);
  EXPECT_EQ(parse_semantic("TEXCOORD_0").kind, SemanticKind::texcoord);
  EXPECT_EQ(parse_semantic("COLOR_3").kind, SemanticKind::color);
  EXPECT_EQ(parse_semantic("JOINTS_12").set, 12U);
  EXPECT_EQ(parse_semantic("WEIGHTS_1").kind, SemanticKind::weights);
}

TEST(Semantic, TakesNoNumberWhereNoneBelongsAndNoLeadingZeros) {
  for (const char* name :
       {"POSITION_0", "NORMAL_0", "TEXCOORD", "TEXCOORD_", "TEXCOORD_01", "TEXCOORD_-1",
        "TEXCOORD__0", "TEXCOORD_1_1", "TEXCOORD_1a", "texcoord_0", "", "COLOR0"}) {
    EXPECT_EQ(parse_semantic(name).kind, SemanticKind::invalid) << name;
  }
}

TEST(Semantic, ANumberBeyondAllRangesSaturates) {
  const Semantic semantic = parse_semantic("TEXCOORD_99999999999999999999999");
  EXPECT_EQ(semantic.kind, SemanticKind::texcoord);
  EXPECT_EQ(semantic.set, UINT64_MAX);
}

TEST(Semantic, TellsApplicationsFromExtensions) {
  EXPECT_EQ(parse_semantic("_").kind, SemanticKind::application);
  EXPECT_EQ(parse_semantic("_TEXCOORD_0").kind, SemanticKind::application);
  EXPECT_EQ(parse_semantic("ACME_leaf:AGE").kind, SemanticKind::extension);
  EXPECT_EQ(semantic_extension("ACME_leaf:AGE"), "ACME_leaf");
  for (const char* name : {"leaf:AGE", ":AGE", "ACME_leaf:", "_leaf:AGE", "ACME_:AGE"}) {
    EXPECT_EQ(semantic_extension(name), "") << name;
  }
}

TEST(Semantic, PatternsOfTablesStandForAllSets) {
  EXPECT_TRUE(matches_semantic("TEXCOORD_n", "TEXCOORD_7"));
  EXPECT_FALSE(matches_semantic("TEXCOORD_n", "TEXCOORD_n"));
  EXPECT_FALSE(matches_semantic("TEXCOORD_n", "TEXCOORD_07"));
  EXPECT_TRUE(matches_semantic("ACME_leaf:AGE", "ACME_leaf:AGE"));
  EXPECT_FALSE(matches_semantic("ACME_leaf:AGE", "ACME_leaf:AGE_0"));
}

}  // namespace
}  // namespace gltfx::model
