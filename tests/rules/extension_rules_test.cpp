// SPDX-License-Identifier: Apache-2.0
// Requirements of extensions on the whole graph, in addition to the examples of every rule.
#include <gtest/gtest.h>

#include "rules/part.hpp"

namespace gltfx::test {
namespace {

Lines levels(const std::string& nodes) {
  return findings(R"("extensionsUsed": ["MSFT_lod"], "nodes": [)" + nodes + "]", {"LOD_"});
}
std::string level(const std::string& ids) {
  return R"({"extensions": {"MSFT_lod": {"ids": [)" + ids + "]}}}";
}

TEST(Lod, OnlyCirclesAreReported) {
  EXPECT_EQ(levels(level("1, 2") + "," + level("2") + ", {}"), Lines{});
  EXPECT_EQ(levels(level("0")), Lines{"LOD_CYCLE /nodes/0/extensions/MSFT_lod/ids"});
  EXPECT_EQ(levels(level("1") + "," + level("2") + "," + level("1")),
            Lines{"LOD_CYCLE /nodes/1/extensions/MSFT_lod/ids x2"});
}

TEST(Lod, LongChainsAreNoProblem) {
  std::string nodes = "{}";
  for (int i = 0; i < 50000; ++i) nodes.append(",").append(level(std::to_string(i)));
  EXPECT_EQ(levels(nodes), Lines{});
}

TEST(Lod, CoveragesFallFromLevelToLevel) {
  const auto coverage = [](const std::string& numbers) {
    return levels(R"({"extensions": {"MSFT_lod": {"ids": [1, 2]}},
        "extras": {"MSFT_screencoverage": [)" +
                  numbers + "]}}, {}, {}");
  };
  const Lines wrong{"LOD_COVERAGE_MISMATCH /nodes/0/extras/MSFT_screencoverage"};
  EXPECT_EQ(coverage("0.5, 0.2, 0.1"), Lines{});
  EXPECT_EQ(coverage("0.5, 0.2"), wrong);
  EXPECT_EQ(coverage("0.5, 0.2, 0.1, 0"), wrong);
  EXPECT_EQ(coverage("0.5, 0.5, 0.1"), wrong);
}

Lines single(const std::string& members) {
  return findings(R"("extensionsUsed": ["GODOT_single_root"], )" + members, {"SINGLE_ROOT"});
}

TEST(SingleRoot, IsNodeZeroOfTheOnlyScene) {
  EXPECT_EQ(single(R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{}])"), Lines{});
  EXPECT_EQ(single(R"("scenes": [{"nodes": [0]}], "nodes": [{}])"),
            Lines{"SINGLE_ROOT_MISSING /scene"});
  EXPECT_EQ(single(R"("scene": 0, "scenes": [{"nodes": [1]}], "nodes": [{}, {}])"),
            Lines{"SINGLE_ROOT_MISSING /scenes/0/nodes"});
  EXPECT_EQ(single(R"("scene": 0, "scenes": [{"nodes": [0]}, {"nodes": [0]}], "nodes": [{}])"),
            Lines{"SINGLE_ROOT_MISSING /scenes"});
  EXPECT_EQ(single(R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"scale": [2, 1, 1]}])"),
            Lines{"SINGLE_ROOT_TRANSFORM /nodes/0"});
}

Lines interactive(const std::string& graph) {
  return findings(R"("extensionsUsed": ["KHR_interactivity"],
    "extensions": {"KHR_interactivity": {"graphs": [{)" +
                      graph + "}]}}",
                  {"INTERACTIVITY"});
}
const std::string kGraph = " /extensions/KHR_interactivity/graphs/0";

// All findings on a graph, of any code.
Lines in_graph(const std::string& graph, Profile profile = Profile::standard) {
  return findings(R"("extensionsUsed": ["KHR_interactivity"],
    "extensions": {"KHR_interactivity": )" +
                      graph + "}",
                  {""}, profile);
}

TEST(Interactivity, AnEarlierDraftIsToldOnceAndNotChecked) {
  const Lines once{"INTERACTIVITY_EARLIER_DRAFT /extensions/KHR_interactivity"};
  const std::vector<std::string> drafts{
      R"({"graphs": [{"types": [{"signature": "float"}], "variables": [{"id": "v", "type": 0}], "events": []}]})",
      R"({"graph": 0, "graphs": [{"types": [{"signature": "float"}], "declarations": [{"op": "a/b",
          "inputValueSockets": {}}], "nodes": [{"declaration": 0, "configuration": {}, "flows": {}},
          {"declaration": 0, "flows": {"out": {"node": 0}}, "values": {"a": {"node": 9}}}]}]})",
      R"({"graphs": [{"customEvents": [{"id": "e"}]}]})",
      R"({"graphs": [{"nodes": [{"type": "event/onStart", "flows": {"out": {"node": 1}}}]}]})",
      R"({"graphs": [{"declarations": [{"op": "a/b"}], "nodes": [{"declaration": 0, "values": [{"id": "a", "value": 1}]}]}]})",
      R"({"nodes": [{"id": "0", "type": "event/onStart"}], "variables": [], "types": []})",
  };
  for (const std::string& draft : drafts) {
    EXPECT_EQ(in_graph(draft), once) << draft;
    EXPECT_EQ(in_graph(draft, Profile::strict), once) << draft;
  }
}

TEST(Interactivity, AnEarlierDraftIsToldToBeUndeclaredToo) {
  const Lines found = test::verdict(
      R"({"asset": {"version": "2.0"}, "extensions": {"KHR_interactivity": {"graphs": [{"customEvents": []}]}}})");
  EXPECT_EQ(found, (Lines{"UNDECLARED_EXTENSION /extensions/KHR_interactivity",
                          "INTERACTIVITY_EARLIER_DRAFT /extensions/KHR_interactivity"}));
}

TEST(Interactivity, ASingleSlipIsNoEarlierDraft) {
  const std::string graph =
      R"({"graph": 0, "graphs": [{"declarations": [{"op": "math/add"}], "nodes": [{"declaration": 0, "flows": {}}]}]})";
  EXPECT_EQ(in_graph(graph),
            Lines{"EMPTY_ENTITY /extensions/KHR_interactivity/graphs/0/nodes/0/flows"});
  EXPECT_EQ(in_graph("{}"), Lines{"UNDEFINED_PROPERTY /extensions/KHR_interactivity"});
}

TEST(ExtensionName, ASlipIsAWarningWithTheRightName) {
  const std::vector<std::pair<std::string, std::string>> slips{
      {"KHR_material_unlit", "KHR_materials_unlit"},
      {"khr_materials_unlit", "KHR_materials_unlit"},
      {"KHR_MATERIALS_UNLIT", "KHR_materials_unlit"},
      {"KHR_materials_transmision", "KHR_materials_transmission"},
      {"KHR_texture_transfrom", "KHR_texture_transform"},
      {"EXT_mesh_feature", "EXT_mesh_features"},
      {"vrm", "VRM"},
      {"VRMC_springbone", "VRMC_springBone"},
      {"OMI_physic_body", "OMI_physics_body"}};
  for (const auto& [name, meant] : slips) {
    for (const bool required : {false, true}) {
      const std::string list = "[\"" + name + "\"]";
      const std::string members =
          "\"extensionsUsed\": " + list + (required ? ", \"extensionsRequired\": " + list : "");
      EXPECT_EQ(findings(members, {""}), Lines{"EXTENSION_NAME_MISSPELT /extensionsUsed/0"})
          << name;
      ValidateOptions options;
      const FileReport report = validate_bytes(asset(members), "test", options);
      ASSERT_EQ(report.diagnostics.size(), 1U);
      EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
      EXPECT_EQ(report.diagnostics[0].help, "did you mean '" + meant + "'?");
    }
  }
}

TEST(ExtensionName, OfAnUndeclaredObjectIsGuessedToo) {
  const FileReport report = validate_bytes(
      asset(R"("materials": [{"extensions": {"KHR_material_unlit": {}}}])"), "test", {});
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_EQ(report.diagnostics[0].code, "UNDECLARED_EXTENSION");
  EXPECT_EQ(report.diagnostics[0].help, "did you mean 'KHR_materials_unlit'?");
}

TEST(ExtensionName, ThatIsInUseIsNeverToBeRenamed) {
  for (const char* const name : {"EXT_texture_video", "KHR_accessor_float16", "KHR_environment_map",
                                 "OMI_link", "MOZ_hubs_components", "ACME_sparkle"}) {
    EXPECT_EQ(findings("\"extensionsUsed\": [\"" + std::string(name) + "\"]", {""}),
              Lines{"UNSUPPORTED_EXTENSION /extensionsUsed/0"})
        << name;
  }
  EXPECT_EQ(findings(R"("extensionsUsed": ["VRM"])", {""}),
            Lines{"EXTENSION_UNUSED /extensionsUsed/0"})
      << "whose name is a prefix alone";
  EXPECT_EQ(findings(R"("extensionsUsed": ["sparkle"])", {"INVALID_EXT", "EXTENSION_NAME"}),
            Lines{"INVALID_EXTENSION_NAME_FORMAT /extensionsUsed/0"});
}

TEST(Interactivity, ValuesAreOfTheirType) {
  const auto value = [](const std::string& signature, const std::string& elements) {
    return interactive(R"("types": [{"signature": ")" + signature +
                       R"("}], "variables": [{"type": 0, "value": [)" + elements + "]}]");
  };
  const Lines kind{"INTERACTIVITY_VALUE_KIND" + kGraph + "/variables/0/value"};
  EXPECT_EQ(value("bool", "false"), Lines{});
  EXPECT_EQ(value("bool", "0"), kind);
  EXPECT_EQ(value("int", "2147483647"), Lines{});
  EXPECT_EQ(value("int", "2147483648"), kind);
  EXPECT_EQ(value("int", "0.5"), kind);
  EXPECT_EQ(value("float", "true"), kind);
  EXPECT_EQ(value("ref", "\"/animations/1\""), Lines{});
  EXPECT_EQ(value("ref", "\"animations\""), kind);
  EXPECT_EQ(value("float4x4", "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0"), Lines{});
  EXPECT_EQ(value("float3", "0, 0"),
            Lines{"INTERACTIVITY_VALUE_LENGTH" + kGraph + "/variables/0/value"});
}

TEST(Interactivity, ValuesComeFromBeforeAndFlowsGoBehind) {
  const auto nodes = [](const std::string& list) {
    return interactive(R"("declarations": [{"op": "a/b"}], "nodes": [)" + list + "]");
  };
  EXPECT_EQ(nodes(R"({"declaration": 0, "flows": {"out": {"node": 1}}},
    {"declaration": 0, "values": {"a": {"node": 0}}})"),
            Lines{});
  EXPECT_EQ(nodes(R"({"declaration": 0, "flows": {"out": {"node": 0}}})"),
            Lines{"INTERACTIVITY_NODE_ORDER" + kGraph + "/nodes/0/flows/out/node"});
  EXPECT_EQ(nodes(R"({"declaration": 0, "values": {"a": {"node": 1}}}, {"declaration": 0})"),
            Lines{"INTERACTIVITY_NODE_ORDER" + kGraph + "/nodes/0/values/a/node"});
}

TEST(Names, AreUniqueInTheirListOnly) {
  const auto stage = [](const std::string& name) {
    return R"({"name": ")" + name +
           R"(", "type": "xScale", "minimumValue": 0, "maximumValue": 1, "initialValue": 1})";
  };
  const auto articulations = [&](const std::string& a, const std::string& b) {
    return findings(R"("extensionsUsed": ["AGI_articulations"], "extensions": {"AGI_articulations":
      {"articulations": [{"name": ")" +
                        a + R"(", "stages": [)" + stage("x") + R"(]}, {"name": ")" + b +
                        R"(", "stages": [)" + stage("x") + "]}]}}",
                    {"NAME_", "ARTICULATION"});
  };
  EXPECT_EQ(articulations("a", "b"), Lines{});
  EXPECT_EQ(articulations("a", "a"),
            Lines{"NAME_REPEATED /extensions/AGI_articulations/articulations/1/name"});
}

TEST(Formats, ThatNothingHasLeaveTheirExtensionUnused) {
  const auto used = [](const std::string& position, const std::string& morph) {
    return findings(R"("extensionsUsed": ["KHR_mesh_quantization"],
      "extensionsRequired": ["KHR_mesh_quantization"],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]}]}],
      "accessors": [{"type": "VEC3", "count": 3, )" +
                        position + R"(}, {"type": "VEC3", "count": 3, )" + morph + "}]",
                    {"EXTENSION_UNUSED"});
  };
  const std::string floats = R"("componentType": 5126)", shorts = R"("componentType": 5122)";
  EXPECT_EQ(used(floats, floats), Lines{"EXTENSION_UNUSED /extensionsUsed/0"});
  EXPECT_EQ(used(shorts, floats), Lines{});
  EXPECT_EQ(used(floats, shorts), Lines{});
}

TEST(ExtensionRules, StaySilentInTheKhronosProfile) {
  EXPECT_EQ(findings(R"("extensionsUsed": ["MSFT_lod"], "nodes": [)" + level("0") + "]", {"LOD_"},
                     Profile::khronos),
            Lines{});
}

TEST(Extensions, AllThatAreRequiredAndUnknownAreOneFinding) {
  EXPECT_EQ(findings(R"("extensionsUsed": ["ACME_a", "KHR_lights_punctual", "ACME_b", "ACME_c"],
                        "extensionsRequired": ["ACME_b", "ACME_a"])",
                     {"UNSUPPORTED_EXTENSION"}),
            (Lines{"UNSUPPORTED_EXTENSION_REQUIRED /extensionsUsed/0",
                   "UNSUPPORTED_EXTENSION /extensionsUsed/3"}));
}

TEST(Extensions, RepeatsAreSeenInTheirCompanyOnce) {
  std::string members = R"("KHR_materials_ior": {})";
  for (int i = 0; i < 20000; ++i) members += R"(, "KHR_materials_unlit": {})";
  EXPECT_EQ(
      verdict(R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_materials_ior", "KHR_materials_unlit"],
    "materials": [{"extensions": {)" +
                  members + "}}]}",
              Profile::khronos),
      (std::vector<std::string>{"MULTIPLE_EXTENSIONS /materials/0/extensions/KHR_materials_unlit",
                                "UNUSED_OBJECT /materials/0"}))
      << "and many take linear time";
}

}  // namespace
}  // namespace gltfx::test
