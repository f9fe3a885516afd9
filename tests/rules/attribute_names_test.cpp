// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

const std::string kPrimitive = "/meshes/0/primitives/0";

std::string primitive(const std::string& members) {
  return asset_with(R"("meshes": [{"primitives": [{)" + members + "}]}]");
}

std::string attributes(const std::string& members) {
  return primitive(R"("attributes": {)" + members + "}");
}

const std::set<std::string, std::less<>> kSetCodes{"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY",
                                                   "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH"};

TEST(AttributeNames, AreThoseOfTheSpecificationOrBeginWithAnUnderscore) {
  EXPECT_EQ(
      places(attributes(R"("POSITION": 0, "NORMAL": 0, "TEXCOORD_0": 0, "COLOR_0": 0, "_MINE": 0,
              "JOINTS_0": 0, "WEIGHTS_0": 0, "TANGENT": 0)"),
             "MESH_PRIMITIVE_INVALID_ATTRIBUTE"),
      Lines{});
  EXPECT_EQ(
      places(attributes(
                 R"("POSITION": 0, "TEXCOORD": 0, "TEXCOORD_00": 0, "mine": 0, "~UNKNOWN/2": 0)"),
             "MESH_PRIMITIVE_INVALID_ATTRIBUTE", Profile::khronos),
      (Lines{kPrimitive + "/attributes/TEXCOORD", kPrimitive + "/attributes/TEXCOORD_00",
             kPrimitive + "/attributes/mine", kPrimitive + "/attributes/~0UNKNOWN~12"}));
}

TEST(AttributeNames, ANearMissIsNamed) {
  const auto help_for = [](const std::string& name) {
    return help(attributes("\"POSITION\": 0, \"" + name + "\": 0"),
                "MESH_PRIMITIVE_INVALID_ATTRIBUTE");
  };
  EXPECT_EQ(help_for("TEXCOORD"), "did you mean 'TEXCOORD_0'?");
  EXPECT_EQ(help_for("normal"), "did you mean 'NORMAL'?");
  EXPECT_EQ(help_for("temperature"),
            "start the name of a custom attribute with an underscore, such as _TEMPERATURE");
}

TEST(AttributeNames, SkinningCannotBeMorphed) {
  EXPECT_EQ(
      places(
          primitive(R"("attributes": {"POSITION": 0}, "targets": [{"POSITION": 0, "TEXCOORD_0": 0},
              {"JOINTS_0": 0, "_MINE": 0}])"),
          "MESH_PRIMITIVE_INVALID_ATTRIBUTE"),
      Lines{kPrimitive + "/targets/1/JOINTS_0"});
}

TEST(AttributeNames, ExtensionsBringNamesOfTheirOwn) {
  const std::string code = "MESH_PRIMITIVE_INVALID_ATTRIBUTE";
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "KHR_gaussian_splatting:ROTATION": 0)"), code),
            Lines{});
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "KHR_gaussian_splatting:ROTATIONS": 0)"), code),
            Lines{kPrimitive + "/attributes/KHR_gaussian_splatting:ROTATIONS"});
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "ACME_leaf:AGE": 0)"), code), Lines{})
      << "of an extension without a schema nothing is known";
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "leaf:AGE": 0)"), code),
            Lines{kPrimitive + "/attributes/leaf:AGE"});
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "KHR_gaussian_splatting:ROTATION": 0)"), code,
                   Profile::khronos),
            Lines{kPrimitive + "/attributes/KHR_gaussian_splatting:ROTATION"});
}

TEST(AttributeNames, PositionIsMissedUnlessAnExtensionMayBringIt) {
  const std::string code = "MESH_PRIMITIVE_NO_POSITION";
  const Lines found{kPrimitive + "/attributes"};
  const auto with = [](const std::string& extension) {
    return primitive(R"("attributes": {"COLOR_0": 0}, "extensions": {")" + extension + R"(": {}})");
  };
  EXPECT_EQ(places(attributes(R"("COLOR_0": 0)"), code), found);
  EXPECT_EQ(places(attributes(R"("POSITION": 0)"), code), Lines{});
  EXPECT_EQ(places(attributes(""), code), Lines{}) << "the empty object is reported";
  EXPECT_EQ(places(with("ACME_points"), code), Lines{});
  EXPECT_EQ(places(with("ACME_points"), code, Profile::khronos), found);
  EXPECT_EQ(places(with("KHR_materials_variants"), code), found) << "this one may be left out";
}

TEST(AttributeNames, TangentNeedsNormal) {
  const std::string code = "MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL";
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "TANGENT": 0)"), code),
            Lines{kPrimitive + "/attributes/TANGENT"});
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "TANGENT": 0, "NORMAL": 0)"), code), Lines{});
}

TEST(AttributeNames, SetsAreNumberedFromZeroWithoutGaps) {
  const std::string code = "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY";
  const Lines once{kPrimitive + "/attributes"};
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "TEXCOORD_1": 0, "TEXCOORD_0": 0)"), code),
            Lines{});
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "TEXCOORD_1": 0)"), code), once);
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "COLOR_0": 0, "COLOR_2": 0)"), code), once);
  EXPECT_EQ(places(attributes(R"("POSITION": 0, "COLOR_99999999999999999999": 0)"), code), once);
  EXPECT_EQ(places(attributes(R"("JOINTS_1": 0, "WEIGHTS_1": 0, "COLOR_1": 0, "TEXCOORD_1": 0)"),
                   code, Profile::khronos),
            (Lines{once[0], once[0], once[0], once[0]}));
}

TEST(AttributeNames, JointsAndWeightsComeInPairs) {
  const std::string mismatch =
      "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH " + kPrimitive + "/attributes";
  const std::string gap =
      "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY " + kPrimitive + "/attributes";
  EXPECT_EQ(selected(attributes(R"("JOINTS_0": 0, "WEIGHTS_0": 0)"), kSetCodes), Lines{});
  EXPECT_EQ(selected(attributes(R"("JOINTS_0": 0)"), kSetCodes), Lines{mismatch});
  EXPECT_EQ(selected(attributes(R"("JOINTS_0": 0, "JOINTS_1": 0, "WEIGHTS_0": 0)"), kSetCodes),
            Lines{mismatch});
  EXPECT_EQ(selected(attributes(R"("JOINTS_1": 0, "WEIGHTS_0": 0)"), kSetCodes), Lines{gap});
  EXPECT_EQ(selected(attributes(R"("JOINTS_1": 0, "WEIGHTS_0": 0)"), kSetCodes, Profile::khronos),
            (Lines{gap, mismatch}));
}

// --- Meshes ---

Lines of_mesh(const std::string& first, const std::string& second, const std::string& weights) {
  return selected(
      asset_with(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0})" + first +
                 R"(}, {"attributes": {"POSITION": 0})" + second + "}]" + weights + "}]"),
      {"MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT", "MESH_INVALID_WEIGHTS_COUNT"});
}

TEST(Mesh, AllPrimitivesHaveAsManyTargetsAsTheFirst) {
  const std::string one = R"(, "targets": [{"POSITION": 0}])";
  const std::string two = R"(, "targets": [{"POSITION": 0}, {"POSITION": 0}])";
  const std::string code = "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT /meshes/0/primitives/1";
  EXPECT_EQ(of_mesh("", "", ""), Lines{});
  EXPECT_EQ(of_mesh(one, one, ""), Lines{});
  EXPECT_EQ(of_mesh(one, "", ""), Lines{code});
  EXPECT_EQ(of_mesh(one, two, ""), Lines{code + "/targets"});
  EXPECT_EQ(of_mesh("", one, ""), Lines{code + "/targets"});
}

TEST(Mesh, HasOneWeightForEachTarget) {
  const std::string two = R"(, "targets": [{"POSITION": 0}, {"POSITION": 0}])";
  const Lines found{"MESH_INVALID_WEIGHTS_COUNT /meshes/0/weights"};
  EXPECT_EQ(of_mesh(two, two, R"(, "weights": [0, 1])"), Lines{});
  EXPECT_EQ(of_mesh(two, two, R"(, "weights": [0])"), found);
  EXPECT_EQ(of_mesh(two, two, R"(, "weights": [0, 1, 1])"), found);
  EXPECT_EQ(of_mesh("", "", R"(, "weights": [1])"), found);
  EXPECT_EQ(of_mesh(two, two, ""), Lines{});
  EXPECT_EQ(of_mesh(two, two, R"(, "weights": ["a"])"), Lines{});
}

// The number of targets is unknown: the broken one is the only finding.
TEST(Mesh, MorphTargetsOfWhichOneIsBrokenAreNotCounted) {
  const std::string broken = R"(, "targets": [{"POSITION": 0}, {}])";
  const std::string one = R"(, "targets": [{"POSITION": 0}])";
  const std::string weights = R"(, "weights": [0, 1])";
  EXPECT_EQ(of_mesh(broken, broken, weights), Lines{});
  EXPECT_EQ(of_mesh(broken, one, ""), Lines{});
  EXPECT_EQ(of_mesh(one, broken, ""), Lines{});
  EXPECT_EQ(of_mesh(R"(, "targets": [])", "", weights),
            Lines{"MESH_INVALID_WEIGHTS_COUNT /meshes/0/weights"});
  const auto animated = [](const std::string& targets) {
    return selected(asset_with(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0})" +
                               targets + R"(}]}], "nodes": [{"mesh": 0, "weights": [1, 1]}],
"animations": [{"samplers": [{"input": 0, "output": 1}], "channels": [{"sampler": 0,
"target": {"node": 0, "path": "weights"}}]}], "accessors": [
{"componentType": 5126, "type": "SCALAR", "count": 1, "min": [0], "max": [0]},
{"componentType": 5126, "type": "SCALAR", "count": 2}])"),
                    {"NODE_WEIGHTS_INVALID", "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS",
                     "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT"});
  };
  EXPECT_EQ(animated(broken), Lines{});
  EXPECT_EQ(animated(one).size(), 2U);
  EXPECT_EQ(animated("").size(), 2U);
}

}  // namespace
}  // namespace gltfx::test
