// SPDX-License-Identifier: Apache-2.0
// Edges of triangles: their coding, lines along them, and whether they close a surface.
#include <vector>

#include <gtest/gtest.h>

#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

std::string bytes_of(const std::vector<int>& numbers) {
  std::string bytes;
  for (const int number : numbers) bytes += static_cast<char>(number);
  return bytes;
}

// The values of edges, four per byte.
std::string coded(const std::vector<unsigned>& values) {
  std::string bytes((values.size() * 2 + 7) / 8, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i / 4]);
    bytes[i / 4] = static_cast<char>(byte | values[i] << (i % 4 * 2));
  }
  return bytes;
}

const std::string kQuad = floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
const std::string kPlace = " /meshes/0/primitives/0/extensions/EXT_mesh_primitive_edge_visibility";

struct Edges {
  std::vector<unsigned> values{};
  std::vector<std::vector<int>> lines{};
  std::string normals{};
  std::string mode = "4";
  std::vector<int> indices{0, 1, 2, 0, 2, 3};
  std::size_t corners = 4;

  Lines found() const {
    DataAsset asset;
    asset.accessor("VEC3", kFloat, corners, kQuad);
    asset.accessor("SCALAR", kUint8, indices.size(), bytes_of(indices));
    std::string members;
    const auto add = [&](const std::string& member) {
      members += (members.empty() ? "" : ", ") + member;
    };
    if (!values.empty()) {
      const std::string bytes = coded(values);
      add(R"("visibility": )" +
          std::to_string(asset.accessor("SCALAR", kUint8, bytes.size(), bytes)));
    }
    if (!normals.empty()) {
      add(R"("silhouetteNormals": )" +
          std::to_string(asset.accessor("VEC3", kFloat, normals.size() / 12, normals)));
    }
    std::string list;
    for (const std::vector<int>& line : lines) {
      list += (list.empty() ? "" : ", ") +
              (R"({"indices": )" +
               std::to_string(asset.accessor("SCALAR", kUint8, line.size(), bytes_of(line))) + "}");
    }
    if (!list.empty()) add(R"("lineStrings": [)" + list + "]");
    const std::string primitive =
        mesh(R"("POSITION": 0)", R"(, "indices": 1, "mode": )" + mode +
                                     R"(, "extensions": {"EXT_mesh_primitive_edge_visibility": {)" +
                                     members + "}}");
    return selected(
        asset.text(R"("extensionsUsed": ["EXT_mesh_primitive_edge_visibility"], )" + primitive),
        {"EDGE_LINE_STRING_INVALID", "EDGE_LINE_STRING_REPEATED",
         "EDGE_SILHOUETTE_NORMALS_MISMATCH", "EDGE_VISIBILITY_EMPTY",
         "EDGE_VISIBILITY_INVALID_MODE", "EDGE_VISIBILITY_PADDING", "EDGE_VISIBILITY_REPEATED",
         "ACCESSOR_VECTOR3_NON_UNIT"});
  }
};

TEST(EdgeVisibility, EachEdgeIsToldOnce) {
  const Lines wrong{"EDGE_VISIBILITY_REPEATED" + kPlace + "/visibility"};
  EXPECT_EQ((Edges{{2, 0, 2, 3, 2, 0}}).found(), Lines{});
  EXPECT_EQ((Edges{{2, 0, 3, 2, 2, 0}}).found(), Lines{}) << "whichever comes first";
  EXPECT_EQ((Edges{{2, 0, 2, 2, 2, 0}}).found(), wrong);
  EXPECT_EQ((Edges{{2, 0, 3, 3, 2, 0}}).found(), wrong);
  EXPECT_EQ((Edges{{2, 0, 2, 0, 2, 0}}).found(), wrong);
  EXPECT_EQ((Edges{{3, 0, 0, 0, 2, 0}}).found(), wrong) << "of one triangle";
  EXPECT_EQ((Edges{{2, 0, 1, 2, 2, 0}, {}, floats({0, 0, 1, 0, 0, 1})}).found(), wrong);
}

TEST(EdgeVisibility, StripsAndFansHaveEdgesToo) {
  // Triangles 0 1 3 and 1 2 3 of a strip; 1 2 0 and 2 3 0 of a fan.
  EXPECT_EQ((Edges{{0, 2, 0, 0, 0, 3}, {}, "", "5", {0, 1, 3, 2}}).found(), Lines{});
  EXPECT_EQ((Edges{{0, 2, 0, 0, 3, 0}, {}, "", "6", {0, 1, 2, 3}}).found(),
            Lines{"EDGE_VISIBILITY_REPEATED" + kPlace + "/visibility"});
  EXPECT_EQ((Edges{{0, 2, 0, 0, 0, 3}, {}, "", "6", {0, 1, 2, 3}}).found(), Lines{});
  EXPECT_EQ((Edges{{2, 0, 2}, {}, "", "3", {0, 1, 2}}).found(),
            Lines{"EDGE_VISIBILITY_INVALID_MODE" + kPlace});
}

TEST(EdgeVisibility, SomethingIsVisibleAndNothingBehindTheEnd) {
  EXPECT_EQ((Edges{{0, 0, 0, 0, 0, 0}}).found(),
            Lines{"EDGE_VISIBILITY_EMPTY" + kPlace + "/visibility"});
  EXPECT_EQ((Edges{{2, 0, 0, 0, 0, 0, 0, 1}}).found(),
            Lines{"EDGE_VISIBILITY_PADDING" + kPlace + "/visibility"});
}

TEST(EdgeVisibility, SilhouettesHaveTwoNormals) {
  const Lines wrong{"EDGE_SILHOUETTE_NORMALS_MISMATCH" + kPlace + "/silhouetteNormals"};
  const std::vector<unsigned> silhouette{2, 0, 1, 0, 2, 0};
  EXPECT_EQ((Edges{silhouette, {}, floats({0, 0, 1, 1, 0, 0})}).found(), Lines{});
  EXPECT_EQ((Edges{silhouette}).found(), wrong);
  EXPECT_EQ((Edges{silhouette, {}, floats({0, 0, 1})}).found(), wrong);
  EXPECT_EQ((Edges{{2, 0, 0, 0, 2, 0}, {}, floats({0, 0, 1, 1, 0, 0})}).found(), wrong);
  EXPECT_EQ((Edges{silhouette, {}, floats({0, 0, 1, 1, 0, 1})}).found(),
            Lines{"ACCESSOR_VECTOR3_NON_UNIT" + kPlace + "/silhouetteNormals"});
}

TEST(EdgeVisibility, LinesFollowEdges) {
  const Lines wrong{"EDGE_LINE_STRING_INVALID" + kPlace + "/lineStrings/0/indices"};
  const auto lines = [](const std::vector<int>& numbers) { return (Edges{{}, {numbers}}).found(); };
  EXPECT_EQ(lines({0, 1, 2}), Lines{});
  EXPECT_EQ(lines({0, 1, 255, 2, 3}), Lines{});
  EXPECT_EQ(lines({1, 3}), wrong) << "no edge";
  EXPECT_EQ(lines({1, 1}), wrong);
  EXPECT_EQ(lines({0, 9}), wrong);
  EXPECT_EQ(lines({0}), wrong);
  EXPECT_EQ(lines({255, 0, 1}), wrong);
  EXPECT_EQ(lines({0, 1, 255}), wrong);
  EXPECT_EQ(lines({0, 1, 255, 255, 2, 3}), wrong);
  EXPECT_EQ(lines({0, 1, 255, 2, 255, 2, 3}), wrong);
}

TEST(EdgeVisibility, LinesDoNotRepeatWhatIsDrawn) {
  const auto line = [](int index) {
    return Lines{"EDGE_LINE_STRING_REPEATED" + kPlace + "/lineStrings/" + std::to_string(index) +
                 "/indices"};
  };
  EXPECT_EQ((Edges{{}, {{0, 1, 255, 1, 0}}}).found(), line(0));
  EXPECT_EQ((Edges{{}, {{0, 1}, {1, 0}}}).found(), line(1));
  EXPECT_EQ((Edges{{2, 0, 0, 0, 0, 0}, {{0, 1}}}).found(), line(0));
  EXPECT_EQ((Edges{{2, 0, 0, 0, 0, 0}, {{1, 2}}}).found(), Lines{});
}

TEST(Outlines, RunAlongEdges) {
  const auto outline = [](const std::vector<int>& pairs, const std::string& more) {
    DataAsset asset;
    asset.accessor("VEC3", kFloat, 4, kQuad);
    asset.accessor("SCALAR", kUint16, 3, packed<std::uint16_t>({0, 1, 2}));
    std::string bytes;
    for (const int each : pairs) bytes += packed<std::uint16_t>({static_cast<std::uint16_t>(each)});
    asset.accessor("SCALAR", kUint16, pairs.size(), bytes);
    return selected(
        asset.text(R"("extensionsUsed": ["CESIUM_primitive_outline"], )" +
                   mesh(R"("POSITION": 0)",
                        more + R"(, "extensions": {"CESIUM_primitive_outline": {"indices": 2}})")),
        {"OUTLINE_NOT_AN_EDGE", "OUTLINE_NOT_TRIANGLES"});
  };
  const std::string at = " /meshes/0/primitives/0/extensions/CESIUM_primitive_outline";
  EXPECT_EQ(outline({0, 1, 2, 1}, R"(, "indices": 1)"), Lines{});
  EXPECT_EQ(outline({0, 1, 2, 3}, R"(, "indices": 1)"),
            Lines{"OUTLINE_NOT_AN_EDGE" + at + "/indices"});
  EXPECT_EQ(outline({0, 0}, R"(, "indices": 1)"), Lines{"OUTLINE_NOT_AN_EDGE" + at + "/indices"});
  EXPECT_EQ(outline({0, 1}, ""), Lines{"OUTLINE_NOT_TRIANGLES" + at});
  EXPECT_EQ(outline({0, 1}, R"(, "indices": 1, "mode": 5)"), Lines{"OUTLINE_NOT_TRIANGLES" + at});
}

// A tetrahedron whose vertex 4 has the position of vertex 0.
const std::string kCorners = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
const std::vector<int> kSolid{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

Lines manifold(const std::vector<int>& drawn, const std::vector<int>& whole,
               const std::vector<int>& places = {}, const std::vector<int>& values = {}) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, 5, kCorners);
  asset.accessor("SCALAR", kUint8, drawn.size(), bytes_of(drawn));
  asset.accessor("SCALAR", kUint8, whole.size(), bytes_of(whole));
  std::string merges;
  if (!places.empty()) {
    merges = R"(, "mergeIndices": )" +
             std::to_string(asset.accessor("SCALAR", kUint8, places.size(), bytes_of(places))) +
             R"(, "mergeValues": )" +
             std::to_string(asset.accessor("SCALAR", kUint8, values.size(), bytes_of(values)));
  }
  return selected(asset.text(R"("extensionsUsed": ["EXT_mesh_manifold"], "meshes": [{"primitives":
      [{"attributes": {"POSITION": 0}, "indices": 1}], "extensions": {"EXT_mesh_manifold":
      {"manifoldPrimitive": {"attributes": {"POSITION": 0}, "indices": 2})" +
                             merges + "}}}]"),
                  {"MANIFOLD_NOT_CLOSED", "MANIFOLD_MERGE_INVALID"});
}

TEST(Manifolds, AreClosedAndTurnedOneWay) {
  const Lines open{"MANIFOLD_NOT_CLOSED /meshes/0/extensions/EXT_mesh_manifold/manifoldPrimitive"};
  EXPECT_EQ(manifold(kSolid, kSolid), Lines{});
  std::vector<int> hole(kSolid.begin(), kSolid.begin() + 9);
  EXPECT_EQ(manifold(hole, hole), open);
  std::vector<int> turned = kSolid;
  std::swap(turned[0], turned[1]);
  EXPECT_EQ(manifold(turned, turned), open);
  std::vector<int> doubled = kSolid;
  doubled.insert(doubled.end(), kSolid.begin(), kSolid.begin() + 3);
  EXPECT_EQ(manifold(doubled, doubled), open);
}

TEST(Manifolds, MergeWhatLiesAtOnePlace) {
  const std::string at = "MANIFOLD_MERGE_INVALID /meshes/0/extensions/EXT_mesh_manifold/";
  std::vector<int> drawn = kSolid;
  drawn[3] = 4;  // a seam
  EXPECT_EQ(manifold(drawn, kSolid, {3}, {0}), Lines{});
  EXPECT_EQ(manifold(drawn, kSolid), Lines{at + "mergeIndices"}) << "nothing is listed";
  EXPECT_EQ(manifold(drawn, kSolid, {2}, {0}), Lines{at + "mergeIndices"});
  EXPECT_EQ(manifold(drawn, kSolid, {3}, {1}), Lines{at + "mergeIndices"});
  EXPECT_EQ(manifold(kSolid, kSolid, {0}, {1}), Lines{at + "mergeIndices"}) << "not so merged";
  EXPECT_EQ(manifold(drawn, kSolid, {3}, {0, 0}), Lines{at + "mergeIndices"});
  drawn[3] = 1;
  EXPECT_EQ(manifold(drawn, kSolid, {3}, {0}), Lines{at + "mergeValues"}) << "which lies elsewhere";
}

Lines volume(const std::vector<int>& indices, const std::string& thickness = "1") {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, 5, kCorners);
  asset.accessor("SCALAR", kUint8, indices.size(), bytes_of(indices));
  return selected(asset.text(R"("extensionsUsed": ["KHR_materials_volume"], "materials":
      [{"extensions": {"KHR_materials_volume": {"thicknessFactor": )" +
                             thickness + "}}}], " +
                             mesh(R"("POSITION": 0)", R"(, "indices": 1, "material": 0)")),
                  {"KHR_MATERIALS_VOLUME_NOT_CLOSED"}, Profile::strict);
}

TEST(Volumes, HaveNoHoles) {
  std::vector<int> seam = kSolid;
  seam[3] = 4;
  EXPECT_EQ(volume(kSolid), Lines{});
  EXPECT_EQ(volume(seam), Lines{}) << "two vertices at one place are one";
  const std::vector<int> hole(kSolid.begin(), kSolid.begin() + 9);
  EXPECT_EQ(volume(hole), Lines{"KHR_MATERIALS_VOLUME_NOT_CLOSED /meshes/0"});
  EXPECT_EQ(volume(hole, "0"), Lines{}) << "a thin wall";
  EXPECT_EQ(volume({0, 2, 9}), Lines{}) << "which is told elsewhere";
}

}  // namespace
}  // namespace gltfx::test
