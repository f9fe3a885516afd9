// SPDX-License-Identifier: Apache-2.0
// glTF 2.1: rules that are relaxed or new, for assets that state this version only.
#include <string>

#include <gtest/gtest.h>

#include "container/glb3_builder.hpp"
#include "rules/selected.hpp"

namespace gltfx::test {
namespace {

using container::kChunkBin;
using container::kChunkJson;
using container::test::Chunk3;
using container::test::glb3;

const std::string kDraft = "GLTF_VERSION_2_1_DRAFT /asset/version";

std::string of_2_1(const std::string& members) {
  return R"({"asset": {"version": "2.1"}, )" + members + "}";
}

// The findings but for that on the draft.
Lines judged(const std::string& asset, Profile profile = Profile::standard) {
  Lines lines = verdict(asset, profile);
  std::erase(lines, kDraft);
  return lines;
}

TEST(Draft21, IsNamedWithItsRevision) {
  const FileReport report = validate_bytes(of_2_1(R"("scenes": [{}])"), "test", {});
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("revision 20"), std::string::npos);
}

TEST(Draft21, TheKhronosProfileHasNothingOfIt) {
  EXPECT_EQ(verdict(of_2_1(R"("shapes": [{"type": 3}])"), Profile::khronos),
            (Lines{"UNEXPECTED_PROPERTY /shapes", "UNKNOWN_ASSET_MINOR_VERSION /asset/version"}));
  EXPECT_EQ(verdict(glb3({{kChunkJson, of_2_1(R"("scenes": [{}])")}}), Profile::khronos),
            Lines{"GLB_INVALID_VERSION @4"});
}

const std::string kMesh =
    R"("buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 12, "target": 34962}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]},
      {"bufferView": 0, "componentType": 5125, "count": 3, "type": "SCALAR"}],
    "meshes": [{"primitives": [)";

Lines of_mesh(const std::string& version, const std::string& primitives) {
  const Lines all = selected(
      R"({"asset": {"version": ")" + version + R"("}, )" + kMesh + primitives + "]}]}",
      {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT",
       "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT"});
  return all;
}

std::size_t errors_of_mesh(const std::string& version, const std::string& primitives) {
  return validate_bytes(
             R"({"asset": {"version": ")" + version + R"("}, )" + kMesh + primitives + "]}]}",
             "test", {})
      .counts.errors;
}

TEST(Draft21, NamesOfAttributesAreFree) {
  const std::string named = R"({"attributes": {"POSITION": 0, "TEMPERATURE": 0}})";
  const Lines found{
      "MESH_PRIMITIVE_INVALID_ATTRIBUTE /meshes/0/primitives/0/attributes/TEMPERATURE"};
  EXPECT_EQ(of_mesh("2.0", named), found);
  EXPECT_EQ(of_mesh("2.1", named), found);
  EXPECT_EQ(errors_of_mesh("2.0", named), 1U);
  EXPECT_EQ(errors_of_mesh("2.1", named), 0U);
  EXPECT_EQ(errors_of_mesh("2.1", R"({"attributes": {"POSITION": 0, "TEXCOORD_01": 0}})"), 1U);
}

TEST(Draft21, NamesWithoutAnUnderscoreAreNotIndexed) {
  for (const std::string name : {"TEXCOORD", "COLOR", "JOINTSET"}) {
    const std::string primitive = R"({"attributes": {"POSITION": 0, ")" + name + R"(": 0}})";
    EXPECT_EQ(errors_of_mesh("2.0", primitive), 1U) << name;
    EXPECT_EQ(errors_of_mesh("2.1", primitive), 0U) << name;
    EXPECT_EQ(of_mesh("2.1", primitive).size(), 1U) << name;
  }
}

TEST(Draft21, AttributesOfExtensionsAreThoseOfListedOnes) {
  const std::string primitive =
      R"({"attributes": {"POSITION": 0, "ACME_heat:T": 0}, "targets": [{"ACME_heat:T": 0}]})";
  EXPECT_EQ(of_mesh("2.0", primitive), Lines{});
  EXPECT_EQ(of_mesh("2.1", primitive),
            (Lines{"MESH_PRIMITIVE_INVALID_ATTRIBUTE /meshes/0/primitives/0/attributes/ACME_heat:T",
                   "MESH_PRIMITIVE_INVALID_ATTRIBUTE "
                   "/meshes/0/primitives/0/targets/0/ACME_heat:T"}));
  EXPECT_EQ(errors_of_mesh("2.1", primitive), 0U);
  EXPECT_EQ(of_mesh(R"(2.1"}, "extensionsUsed": ["ACME_heat"], "extras": {"a": ")", primitive),
            Lines{});
}

TEST(Draft21, IntegersOf32BitsAreAdvisedAgainst) {
  const std::string integers = R"({"attributes": {"POSITION": 0, "_ID": 1}})";
  EXPECT_EQ(of_mesh("2.0", integers), of_mesh("2.1", integers));
  EXPECT_EQ(errors_of_mesh("2.0", integers), 1U);
  EXPECT_EQ(errors_of_mesh("2.1", integers), 0U);
}

TEST(Draft21, PrimitivesMayLackTargets) {
  const std::string plain = R"({"attributes": {"POSITION": 0}})";
  const std::string one = R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]})";
  const std::string two =
      R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}, {"POSITION": 0}]})";
  for (const std::string& mixed : {one + "," + plain, plain + "," + one}) {
    EXPECT_EQ(of_mesh("2.0", mixed).size(), 1U) << mixed;
    EXPECT_EQ(of_mesh("2.1", mixed), Lines{}) << mixed;
  }
  EXPECT_EQ(of_mesh("2.1", plain + "," + one + "," + two),
            Lines{"MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT /meshes/0/primitives/2/targets"});
}

TEST(Draft21, TargetsOfViewsAreNotMissed) {
  const std::string view =
      R"("buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
      "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})";
  EXPECT_EQ(selected(R"({"asset": {"version": "2.0"}, )" + view, {"BUFFER_VIEW_TARGET_MISSING"},
                     Profile::strict)
                .size(),
            1U);
  EXPECT_EQ(selected(R"({"asset": {"version": "2.1"}, )" + view, {"BUFFER_VIEW_TARGET_MISSING"},
                     Profile::strict),
            Lines{});
}

TEST(Draft21, NodesWithExternalAssetsOrVolumesAreNotEmpty) {
  EXPECT_EQ(
      selected(
          of_2_1(R"("shapes": [{"type": "box"}], "nodes": [{"boundingVolume": {"shape": 0}}, {}])"),
          {"NODE_EMPTY"}),
      Lines{"NODE_EMPTY /nodes/1"});
}

// --- Shapes ---

Lines of_shape(const std::string& shape) { return judged(of_2_1("\"shapes\": [" + shape + "]")); }

TEST(ShapeOf21, HasOnlyTheMemberOfItsType) {
  EXPECT_EQ(of_shape(R"({"type": "box"})"), Lines{});
  EXPECT_EQ(of_shape(R"({"type": "box", "box": {"size": [1, 2, 3]}})"), Lines{});
  EXPECT_EQ(of_shape(R"({"type": "box", "sphere": {}})"), Lines{"CONDITION_MISMATCH /shapes/0"});
  EXPECT_EQ(of_shape(R"({"type": "ACME_x", "sphere": {}})"), Lines{}) << "a fallback";
  EXPECT_EQ(of_shape(R"({"type": "mesh"})"), Lines{"UNDEFINED_PROPERTY /shapes/0"});
}

TEST(ShapeOf21, HasARadius) {
  for (const std::string type : {"capsule", "cylinder"}) {
    const auto round = [&](const std::string& members) {
      return of_shape(R"({"type": ")" + type + R"(", ")" + type + R"(": {)" + members + "}}");
    };
    EXPECT_EQ(round(R"("radiusTop": 0)"), Lines{});
    EXPECT_EQ(round(R"("radiusTop": 0, "radiusBottom": 0.0)"),
              Lines{"CONDITION_MISMATCH /shapes/0/" + type});
    EXPECT_EQ(round(R"("height": 0)"), Lines{"VALUE_NOT_IN_RANGE /shapes/0/" + type + "/height"});
    EXPECT_EQ(round(R"("radiusTop": -1)"),
              Lines{"VALUE_NOT_IN_RANGE /shapes/0/" + type + "/radiusTop"});
  }
}

// --- Chunks ---

Lines of_chunks(const std::string& buffers, const std::vector<Chunk3>& more) {
  std::vector<Chunk3> chunks{{kChunkJson, of_2_1("\"buffers\": [" + buffers + "]")}};
  chunks.insert(chunks.end(), more.begin(), more.end());
  Lines lines = judged(glb3(chunks));
  std::erase_if(lines, [](const std::string& line) { return line.starts_with("UNUSED_OBJECT"); });
  return lines;
}

TEST(ChunkOfBuffer, OfABufferIsCountedOverAllChunks) {
  const Chunk3 bin{kChunkBin, "abcd"};
  const Chunk3 other{container::test::kChunkOther, "x"};
  const std::string first = R"({"byteLength": 4, "chunk": 1})";
  EXPECT_EQ(of_chunks(first, {bin}), Lines{});
  EXPECT_EQ(of_chunks(R"({"byteLength": 4})", {bin}), Lines{}) << "buffer 0 is chunk 1";
  EXPECT_EQ(of_chunks(first + R"(,{"byteLength": 4, "chunk": 3})", {bin, other, bin}), Lines{});
  EXPECT_EQ(of_chunks(first, {other, bin}), Lines{"BUFFER_CHUNK_INVALID /buffers/0/chunk"});
  EXPECT_EQ(of_chunks(R"({"byteLength": 4})", {other, bin}),
            Lines{"BUFFER_MISSING_GLB_DATA /buffers/0"});
  EXPECT_EQ(of_chunks(R"({"byteLength": 4, "chunk": 0})", {bin}),
            Lines{"BUFFER_CHUNK_INVALID /buffers/0/chunk"});
  EXPECT_EQ(of_chunks(R"({"byteLength": 4, "chunk": 2})", {bin}),
            Lines{"BUFFER_CHUNK_INVALID /buffers/0/chunk"});
  EXPECT_EQ(of_chunks(R"({"byteLength": 5, "chunk": 1})", {bin}),
            Lines{"BUFFER_BYTE_LENGTH_MISMATCH /buffers/0"});
}

TEST(ChunkOfBuffer, MayBeLongerThanTheBuffer) {
  EXPECT_EQ(of_chunks(R"({"byteLength": 4, "chunk": 1})", {{kChunkBin, std::string(100, '\0')}}),
            Lines{});
}

TEST(ChunkOfBuffer, EndsWhereItsLongestBufferEnds) {
  const Chunk3 bin{kChunkBin, "abcdefgh"};
  const std::string six = R"({"byteLength": 6, "chunk": 1})";
  EXPECT_EQ(of_chunks(six, {bin}), Lines{"GLB_BIN_PADDING /buffers/0"});
  EXPECT_EQ(of_chunks(six + R"(, {"byteLength": 8, "chunk": 1})", {bin}), Lines{});
  EXPECT_EQ(of_chunks(R"({"byteLength": 8}, )" + six, {bin}), Lines{});
}

TEST(ChunkOfBuffer, IsNotEncoded) {
  const Chunk3 encoded{kChunkBin, "abcd", 7};
  const std::string text = of_2_1(R"("buffers": [{"byteLength": 4, "chunk": 1}])");
  const Lines error{"GLB_CHUNK_ENCODING_UNKNOWN @" +
                    std::to_string(16 + (16 + text.size() + 7) / 8 * 8 + 4)};
  EXPECT_EQ(of_chunks(R"({"byteLength": 4, "chunk": 1})", {encoded}), error);
  const Lines implicit = of_chunks(R"({"byteLength": 4})", {encoded});
  ASSERT_EQ(implicit.size(), 1U);
  EXPECT_TRUE(implicit[0].starts_with("GLB_CHUNK_ENCODING_UNKNOWN @"));
  EXPECT_EQ(of_chunks(R"({"byteLength": 4, "chunk": 2})", {encoded, {kChunkBin, "abcd"}}), Lines{})
      << "of no buffer";
  EXPECT_EQ(
      of_chunks(R"({"byteLength": 4, "chunk": 1})", {{kChunkBin, "abcd"}, {kChunkJson, "?", 7}}),
      Lines{});
}

TEST(ChunkOfBuffer, IsOfAGlb) {
  EXPECT_EQ(judged(of_2_1(R"("buffers": [{"byteLength": 4, "chunk": 1}])")),
            (Lines{"UNUSED_OBJECT /buffers/0", "BUFFER_CHUNK_INVALID /buffers/0/chunk"}));
}

}  // namespace
}  // namespace gltfx::test
