// SPDX-License-Identifier: Apache-2.0
// Avatars, bodies and other ecosystems: their requirements on the whole graph, and malicious
// assets. Each rule's page has an example of its own.
#include <gtest/gtest.h>

#include "rules/part.hpp"
#include "rules/textured.hpp"
#include "sanitized.hpp"

namespace gltfx::test {
namespace {

std::string used(const std::string& name) { return R"("extensionsUsed": [")" + name + "\"], "; }

// --- Node constraints ---

std::string following(const std::string& source, const std::string& kind = "rotation") {
  return R"({"extensions": {"VRMC_node_constraint": {"specVersion": "1.0", "constraint": {")" +
         kind + R"(": {"source": )" + source + R"(, "rollAxis": "X", "aimAxis": "PositiveX"}}}}})";
}

Lines constraints(const std::string& nodes) {
  return findings(used("VRMC_node_constraint") + R"("nodes": [)" + nodes + "]",
                  {"NODE_CONSTRAINT_CYCLE"});
}
const std::string kConstraint = "/extensions/VRMC_node_constraint/constraint";

TEST(NodeConstraint, ACycleIsFoundWhateverTheKinds) {
  EXPECT_EQ(constraints(following("1") + "," + following("2") + ", {}"), Lines{});
  EXPECT_EQ(constraints(following("0")), Lines{"NODE_CONSTRAINT_CYCLE /nodes/0" + kConstraint});
  EXPECT_EQ(constraints(following("1", "roll") + "," + following("0", "aim")),
            Lines{"NODE_CONSTRAINT_CYCLE /nodes/0" + kConstraint + " x2"});
}

TEST(NodeConstraint, WhatLeadsIntoACycleIsNotPartOfIt) {
  EXPECT_EQ(constraints(following("1") + "," + following("1")),
            Lines{"NODE_CONSTRAINT_CYCLE /nodes/1" + kConstraint});
  EXPECT_EQ(constraints(following("7") + ", {}"), Lines{});
}

TEST(NodeConstraint, ACycleOfManyNodesTakesLinearTime) {
  constexpr int kCount = kSanitized ? 20'000 : 100'000;
  std::string nodes;
  for (int i = 0; i < kCount; ++i) {
    nodes.append(i == 0 ? "" : ",").append(following(std::to_string((i + 1) % kCount)));
  }
  EXPECT_EQ(constraints(nodes),
            Lines{"NODE_CONSTRAINT_CYCLE /nodes/0" + kConstraint + " x" + std::to_string(kCount)});
}

// --- Springs ---

Lines springs(const std::string& list, const std::string& nodes) {
  return findings(used("VRMC_springBone") +
                      R"("extensions": {"VRMC_springBone": {"specVersion": "1.0", "springs": [)" +
                      list + R"(]}}, "nodes": [)" + nodes + "]",
                  {"SPRING_CHAIN", "SPRING_JOINT", "SPRING_CENTER"});
}
const std::string kSprings = " /extensions/VRMC_springBone/springs/";
// 0 is the parent of 1, 1 of 2, 2 of 3, and 4 is a sibling of 1.
const std::string kTree = R"({"children": [1, 4]}, {"children": [2]}, {"children": [3]}, {}, {})";

TEST(Springs, JointsMaySkipNodes) {
  EXPECT_EQ(springs(R"({"joints": [{"node": 1}, {"node": 3}]})", kTree), Lines{});
  EXPECT_EQ(springs(R"({"joints": [{"node": 3}, {"node": 1}]})", kTree),
            Lines{"SPRING_CHAIN_BROKEN" + kSprings + "0/joints/1/node"});
  EXPECT_EQ(springs(R"({"joints": [{"node": 1}, {"node": 1}]})", kTree),
            Lines{"SPRING_CHAIN_BROKEN" + kSprings + "0/joints/1/node"});
}

TEST(Springs, ASkippedNodeBelongsToTheSpring) {
  EXPECT_EQ(springs(R"({"joints": [{"node": 1}, {"node": 3}]}, {"joints": [{"node": 2}]})", kTree),
            Lines{"SPRING_JOINT_SHARED" + kSprings + "1/joints/0/node"});
  EXPECT_EQ(springs(R"({"joints": [{"node": 1}]}, {"joints": [{"node": 2}, {"node": 3}]})", kTree),
            Lines{})
      << "a chain may go on from another one";
}

TEST(Springs, TheCenterIsAboveAndAtRest) {
  const auto center = [](const std::string& node) {
    return springs(R"({"joints": [{"node": 2}, {"node": 3}], "center": )" + node +
                       R"(}, {"joints": [{"node": 1}]})",
                   kTree);
  };
  const Lines wrong{"SPRING_CENTER_INVALID" + kSprings + "0/center"};
  EXPECT_EQ(center("0"), Lines{});
  EXPECT_EQ(center("1"), wrong) << "it swings";
  EXPECT_EQ(center("2"), wrong) << "it is below one that swings";
  EXPECT_EQ(center("4"), wrong) << "it is beside the chain";
}

TEST(Springs, ManyOverOneLongWayTakeLinearTime) {
  constexpr int kNodes = 20'000;
  std::string nodes;
  std::string list;
  for (int i = 0; i < kNodes; ++i) {
    nodes.append(i == 0 ? "" : ",");
    nodes += i + 1 < kNodes ? R"({"children": [)" + std::to_string(i + 1) + "]}" : "{}";
    list.append(i == 0 ? "" : ",")
        .append(R"({"center": 0, "joints": [{"node": 0}, {"node": )" + std::to_string(kNodes - 1) +
                "}]}");
  }
  const Lines lines = springs(list, nodes);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.front(), "SPRING_JOINT_SHARED" + kSprings + "1/joints/0/node x39998");
}

// --- Humanoids ---

const std::vector<std::string> kBones{
    "hips",         "spine",         "head",          "leftUpperLeg",  "leftLowerLeg",
    "leftFoot",     "rightUpperLeg", "rightLowerLeg", "rightFoot",     "leftUpperArm",
    "leftLowerArm", "leftHand",      "rightUpperArm", "rightLowerArm", "rightHand"};
const std::string kBody =
    R"({"children": [1, 3, 6]}, {"children": [2, 9, 12]}, {}, {"children": [4]}, {"children": [5]}, {},
       {"children": [7]}, {"children": [8]}, {}, {"children": [10]}, {"children": [11]}, {},
       {"children": [13]}, {"children": [14]}, {})";

Lines humanoid(const std::string& more, const std::string& nodes) {
  std::string bones;
  for (std::size_t i = 0; i < kBones.size(); ++i) {
    bones.append(i == 0 ? "" : ",");
    bones += "\"" + kBones[i] + R"(": {"node": )" + std::to_string(i) + "}";
  }
  return findings(used("VRMC_vrm") +
                      R"("extensions": {"VRMC_vrm": {"specVersion": "1.0", "meta": {"name": "A",
     "authors": ["B"], "licenseUrl": "https://vrm.dev/licenses/1.0/"}, "humanoid": {"humanBones": {)" +
                      bones + more + R"(}}}}, "nodes": [)" + nodes + "]",
                  {"HUMANOID_", "UNSATISFIED", "UNDEFINED"});
}
const std::string kHumanBones = " /extensions/VRMC_vrm/humanoid/humanBones";

TEST(Humanoid, ABoneHangsOnTheNearestOneThatIsThere) {
  EXPECT_EQ(humanoid("", kBody), Lines{});
  EXPECT_EQ(humanoid(R"(, "neck": {"node": 15})", kBody + R"(, {"children": [2]})"),
            Lines{"HUMANOID_HIERARCHY" + kHumanBones + "/neck/node"});
  EXPECT_EQ(humanoid(R"(, "leftShoulder": {"node": 15})", kBody + ", {}"),
            (Lines{"HUMANOID_HIERARCHY" + kHumanBones + "/leftUpperArm/node",
                   "HUMANOID_HIERARCHY" + kHumanBones + "/leftShoulder/node"}));
}

TEST(Humanoid, FingersNeedTheOnesBeforeThem) {
  EXPECT_EQ(humanoid(R"(, "leftIndexDistal": {"node": 15})", kBody + R"(, {})"),
            (Lines{"UNSATISFIED_DEPENDENCY" + kHumanBones + "/leftIndexDistal",
                   "HUMANOID_HIERARCHY" + kHumanBones + "/leftIndexDistal/node"}));
}

TEST(Humanoid, NodesOnALoopAreNotBelowAnything) {
  std::string nodes;
  for (int i = 0; i < 15; ++i) {
    nodes.append(i == 0 ? "" : ",");
    nodes += R"({"children": [)" + std::to_string((i + 1) % 15) + "]}";
  }
  EXPECT_EQ(humanoid("", nodes).size(), 14U) << "all but the hips";
}

// --- Bodies ---

TEST(Humanoid, BonesAreScaledAlikeOnAllAxesAndNotMirrored) {
  const auto scaled = [](const std::string& transform) {
    return humanoid("", kBody.substr(0, kBody.size() - 1) + transform + "}");
  };
  const Lines wrong{"HUMANOID_SCALE" + kHumanBones + "/rightHand/node"};
  EXPECT_EQ(scaled(R"("scale": [2, 2, 2.0000002])"), Lines{});
  EXPECT_EQ(scaled(R"("scale": [1, 2, 1])"), wrong);
  EXPECT_EQ(scaled(R"("scale": [1, -1, 1])"), wrong);
  EXPECT_EQ(scaled(R"("matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1])"), Lines{});
  EXPECT_EQ(scaled(R"("matrix": [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])"), wrong);
}

TEST(Vehicle, PartsLieBelowIt) {
  const std::string wheel = R"({"extensions": {"OMI_vehicle_wheel": {"wheel": 0}}})";
  const auto parts = [&](const std::string& nodes) {
    return findings(
        R"("extensionsUsed": ["OMI_vehicle_wheel", "OMI_vehicle_body", "OMI_physics_body"],
      "extensions": {"OMI_vehicle_wheel": {"wheels": [{}]}}, "nodes": [)" +
            nodes + "]",
        {"BODY_", "REFERENCE_"});
  };
  const std::string car = R"("extensions": {"OMI_physics_body": {}, "OMI_vehicle_body": {}}})";
  EXPECT_EQ(parts(R"({"children": [1], )" + car + R"(, {"children": [2]}, )" + wheel), Lines{});
  EXPECT_EQ(parts("{" + car + "," + wheel),
            Lines{"BODY_PART_NOT_BELOW /nodes/1/extensions/OMI_vehicle_wheel"});
  EXPECT_EQ(
      parts(
          R"({"extensions": {"OMI_physics_body": {}, "OMI_vehicle_body": {"pilotSeat": 1}}}, {})"),
      Lines{"REFERENCE_MEMBER_MISSING /nodes/0/extensions/OMI_vehicle_body/pilotSeat"});
  EXPECT_EQ(
      parts(
          R"({"extensions": {"OMI_physics_body": {}, "OMI_vehicle_body": {"pilotSeat": -1}}}, {})"),
      Lines{});
}

TEST(Toon, UnlitBesideItServesOtherReaders) {
  const std::string material = R"("materials": [{"extensions": {"KHR_materials_unlit": {},
    "VRMC_materials_mtoon": {"specVersion": "1.0"}}}])";
  const std::string both = R"("extensionsUsed": ["KHR_materials_unlit", "VRMC_materials_mtoon"], )";
  EXPECT_EQ(findings(both + material, {"MULTIPLE"}), Lines{});
  EXPECT_EQ(findings(both + material, {"MULTIPLE"}, Profile::khronos),
            Lines{"MULTIPLE_EXTENSIONS /materials/0/extensions/KHR_materials_unlit"});
}

TEST(UnusedNodes, WhatAnExtensionRefersToIsNotEmpty) {
  const std::string body =
      R"("extensions": {"OMI_physics_joint": {"physicsJoints": [{}]}}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
    "nodes": [{"extensions": {"OMI_physics_joint": {"connectedNode": 1, "joint": 0}}}, {}, {}])";
  EXPECT_EQ(findings(used("OMI_physics_joint") + body, {"NODE_EMPTY"}),
            Lines{"NODE_EMPTY /nodes/2"});
}

// --- Malicious assets ---

std::string repeated(const std::string& text, int count) {
  std::string list = text;
  for (int i = 1; i < count; ++i) list.append(",").append(text);
  return list;
}

std::string on_root(const std::string& name, const std::string& object,
                    const std::string& more = {}) {
  return R"({"asset": {"version": "2.0"}, )" + used(name) + R"("extensions": {")" + name +
         "\": " + object + "}" + more + "}";
}
std::string on_node(const std::string& name, const std::string& object,
                    const std::string& more = {}) {
  return R"({"asset": {"version": "2.0"}, )" + used(name) + R"("nodes": [{"extensions": {")" +
         name + "\": " + object + "}}]" + more + "}";
}
std::string on_material(const std::string& name, const std::string& object) {
  return R"({"asset": {"version": "2.0"}, )" + used(name) + R"("materials": [{"extensions": {")" +
         name + "\": " + object + "}}]}";
}

std::vector<std::string> hostile_assets() {
  const std::string deep = [] {
    std::string text;
    for (int i = 0; i < 400; ++i) text += R"({"a":)";
    return text + "1" + std::string(400, '}');
  }();
  std::vector<std::string> all;
  // Every object as something else: a number, a text, a list, a deep one, one that contains itself.
  const std::vector<std::string> wrong{
      "7", "\"x\"", "[]", "[[[]]]", "null", deep, R"({"a": 1, "a": 2})"};
  for (const std::string& value : wrong) {
    all.push_back(
        on_root("VRMC_vrm", R"({"humanoid": )" + value + R"(, "expressions": )" + value + "}"));
    all.push_back(on_root("VRM", R"({"humanoid": )" + value + R"(, "blendShapeMaster": )" + value +
                                     R"(, "materialProperties": )" + value + "}"));
    all.push_back(
        on_root("VRMC_springBone", R"({"springs": )" + value + R"(, "colliders": )" + value + "}"));
    all.push_back(on_node("VRMC_node_constraint", R"({"constraint": )" + value + "}"));
    all.push_back(on_material(
        "VRMC_materials_mtoon",
        R"({"renderQueueOffsetNumber": )" + value + R"(, "shadeColorFactor": )" + value + "}"));
    all.push_back(on_root("KHR_physics_rigid_bodies", R"({"physicsJoints": )" + value + "}"));
    all.push_back(on_root("KHR_texture_procedurals", R"({"procedurals": [{"nodes": )" + value +
                                                         R"(, "outputs": )" + value + "}]}"));
  }
  // Numbers that are not indices, and long lists.
  for (const std::string index :
       {"-1", "1e308", "0.5", "4294967296", "18446744073709551616", "-9e99"}) {
    all.push_back(on_root("VRMC_springBone", R"({"springs": [{"center": )" + index +
                                                 R"(, "joints": [{"node": )" + index +
                                                 R"(}], "colliderGroups": [)" + index + "]}]}"));
    all.push_back(on_node("OMI_physics_body", R"({"collider": {"shape": )" + index +
                                                  R"(}, "trigger": {"nodes": [)" + index + "]}}"));
    all.push_back(on_root("VRMC_vrm",
                          R"({"humanoid": {"humanBones": {"hips": {"node": )" + index +
                              R"(}}}, "expressions": {"custom": {"a": {"morphTargetBinds":
      [{"node": 0, "index": )" +
                              index + R"(, "weight": )" + index + "}]}}}}",
                          R"(, "nodes": [{}])"));
  }
  constexpr int kMany = kSanitized ? 10'000 : 50'000;
  all.push_back(
      on_node("OMI_physics_body", R"({"trigger": {"nodes": [)" + repeated("0", 4 * kMany) + "]}}"));
  all.push_back(on_root("VRMC_springBone",
                        R"({"springs": [{"joints": [)" + repeated(R"({"node": 0})", kMany) + "]}]}",
                        R"(, "nodes": [{}])"));
  all.push_back(on_root("VRM",
                        R"({"humanoid": {"humanBones": [)" +
                            repeated(R"({"bone": "hips", "node": 0})", kMany) + "]}}",
                        R"(, "nodes": [{}])"));
  all.push_back(on_root(
      "VRM",
      R"({"blendShapeMaster": {"blendShapeGroups": [)" +
          repeated(R"({"presetName": "joy", "binds": [{"mesh": 0, "index": 9}]})", kMany / 2) +
          "]}}",
      R"(, "meshes": [{"primitives": [{}]}])"));
  all.push_back(on_root("KHR_audio_emitter", R"({"emitters": [{"type": "positional"}]})",
                        R"(, "scenes": [{"extensions": {"KHR_audio_emitter": {"emitters": [)" +
                            repeated("0", 2 * kMany) + "]}}}]"));
  all.push_back(
      on_root("NGA_gpm_local", R"({"storageType": "Direct", "covarianceDirectUpperTriangle": [)" +
                                   repeated("1", 99'999) + "]}"));
  return all;
}

TEST(HostileEcosystems, EndWithFindings) {
  const std::vector<std::string> all = hostile_assets();
  ASSERT_GE(all.size(), 60U);
  for (const std::string& asset : all) {
    EXPECT_FALSE(verdict(asset).empty()) << asset.substr(0, 300);
  }
}

// --- Poses ---

struct PoseOf {
  double side = 1;                     ///< side of the left half, along X
  std::string hand = "[0.3, 0, 0]";    ///< offset from the lower arm, on the left
  std::string leg = "[0.1, -0.1, 0]";  ///< offset from the hips, on the left
  std::string more = {};               ///< members of the head
};

std::string mirrored(const std::string& place, double side) {
  return place.starts_with("[0") && side < 0 ? "[-" + place.substr(1) : place;
}

Lines pose(const std::string& extension, const PoseOf& of) {
  const auto at = [](const std::string& place, const std::string& more = {}) {
    return R"({"translation": )" + place + more + "}";
  };
  const auto below = [](const std::string& list) { return R"(, "children": [)" + list + "]"; };
  const auto half = [&](double side, const std::string& a, const std::string& b) {
    return std::pair{at(mirrored(of.leg, side), below(a)), at("[0, -0.4, 0]", below(b))};
  };
  std::string nodes = at("[0, 1, 0]", below("1, 3, 6")) + "," +
                      at("[0, 0.2, 0]", below("2, 9, 12")) + "," + at("[0, 0.4, 0]", of.more);
  for (const double side : {of.side, -of.side}) {
    const int first = side == of.side ? 3 : 6;
    const auto [upper, lower] = half(side, std::to_string(first + 1), std::to_string(first + 2));
    nodes.append(",").append(upper).append(",").append(lower).append(",") += at("[0, -0.4, 0]");
  }
  for (const double side : {of.side, -of.side}) {
    const int first = side == of.side ? 9 : 12;
    nodes += "," + at(mirrored("[0.1, 0.3, 0]", side), below(std::to_string(first + 1))) + "," +
             at(mirrored("[0.3, 0, 0]", side), below(std::to_string(first + 2))) + "," +
             at(mirrored(side == of.side ? of.hand : "[0.3, 0, 0]", side));
  }
  std::string bones;
  for (std::size_t i = 0; i < kBones.size(); ++i) {
    bones.append(i == 0 ? "" : ",");
    const std::string node = R"("node": )" + std::to_string(i) + "}";
    bones += extension == "VRM" ? R"({"bone": ")" + kBones[i] + "\", " + node
                                : "\"" + kBones[i] + "\": {" + node;
  }
  bones = extension == "VRM" ? "[" + bones + "]" : "{" + bones + "}";
  return findings(used(extension) + R"("extensions": {")" + extension +
                      R"(": {"specVersion": "1.0", "humanoid": {"humanBones": )" + bones +
                      R"(}}}, "nodes": [)" + nodes + "]",
                  {"HUMANOID_POSE"});
}

TEST(Pose, AnAvatarFacesItsDirection) {
  const auto wrong = [](const std::string& extension) {
    return Lines{"HUMANOID_POSE /extensions/" + extension + "/humanoid/humanBones"};
  };
  EXPECT_EQ(pose("VRMC_vrm", {}), Lines{});
  EXPECT_EQ(pose("VRMC_vrm", {.side = -1}), wrong("VRMC_vrm"));
  EXPECT_EQ(pose("VRMC_vrm_animation", {.side = -1}), wrong("VRMC_vrm_animation"));
  EXPECT_EQ(pose("VRM", {}), wrong("VRM"));
  EXPECT_EQ(pose("VRM", {.side = -1}), Lines{});
}

TEST(Pose, TheArmsAreStretchedOut) {
  const Lines wrong{"HUMANOID_POSE /extensions/VRMC_vrm/humanoid/humanBones"};
  EXPECT_EQ(pose("VRMC_vrm", {.hand = "[0.3, -0.1, 0]"}), Lines{}) << "about straight";
  EXPECT_EQ(pose("VRMC_vrm", {.hand = "[0.01, -0.6, 0]"}), wrong);
  EXPECT_EQ(pose("VRMC_vrm", {.hand = "[0.01, -0.6, 0]", .leg = "[0, 0, 0]"}), Lines{})
      << "what has no legs beside each other is not judged";
}

TEST(Pose, BonesOfVrm0HaveNoTransformOfTheirOwn) {
  const Lines wrong{"HUMANOID_POSE /extensions/VRM/humanoid/humanBones/2/node"};
  EXPECT_EQ(pose("VRM", {.side = -1, .more = R"(, "rotation": [0, 0, 0, 1], "scale": [1, 1, 1])"}),
            Lines{});
  EXPECT_EQ(pose("VRM", {.side = -1, .more = R"(, "rotation": [0, 1, 0, 0])"}), wrong);
  EXPECT_EQ(pose("VRM", {.side = -1, .more = R"(, "scale": [2, 2, 2])"}), wrong);
  EXPECT_EQ(pose("VRMC_vrm", {.more = R"(, "rotation": [0, 1, 0, 0])"}), Lines{});
}

TEST(Thumbnail, IsPngOrJpeg) {
  const auto shown = [](const std::string& type, const std::string& image) {
    return findings(
        R"("extensionsUsed": ["VRMC_vrm", "EXT_texture_webp"], "images": [{"uri": "data:)" + type +
            ";base64," + base64(image) + R"("}], "extensions": {"VRMC_vrm":
                        {"specVersion": "1.0", "meta": {"thumbnailImage": 0}}})",
        {"THUMBNAIL"});
  };
  EXPECT_EQ(shown("image/png", grey_png()), Lines{});
  EXPECT_EQ(shown("image/webp", webp_header(false)),
            Lines{"THUMBNAIL_NOT_SQUARE /extensions/VRMC_vrm/meta/thumbnailImage"});
}

}  // namespace
}  // namespace gltfx::test
