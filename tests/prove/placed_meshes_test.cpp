// SPDX-License-Identifier: Apache-2.0
/// MeaningRequest::in_world: a mesh is compared where its nodes place it, if nothing else shows it.
#include <gtest/gtest.h>

#include "model/packed_bytes.hpp"
#include "prove/edited_asset.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;

using Points = std::vector<float>;
const Points kWhole{0, 0, 0, 2, 0, 0, 0, 2, 4};
const Points kHalf{0, 0, 0, 1, 0, 0, 0, 1, 2};

// `members` are those of the root, with nodes. Mesh 0 has these points, mesh 1 one point.
EditedAsset asset(const Points& points, const std::string& members) {
  test::AssetBuilder made;
  for (const Points& each : {points, Points{0, 0, 0}}) {
    const auto positions =
        made.accessor("VEC3", 5126, each.size() / 3, test::packed(each), Json::object());
    Json primitive;
    primitive["attributes"]["POSITION"] = positions;
    primitive["mode"] = 0;
    Json mesh;
    mesh["primitives"].push_back(primitive);
    made.add("meshes", mesh);
  }
  made.json.update(Json::parse("{" + members + "}"));
  const Json& nodes = made.json["nodes"];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool is_child = i == 0 && nodes.back().contains("children");
    if (!is_child) made.json["scenes"][0]["nodes"].push_back(i);
  }
  return EditedAsset::made(made.json.dump(), made.bytes);
}

// Whether the points may be halved where the first node doubles what it shows.
bool may_be_scaled(const std::string& node, const std::string& others,
                   MeaningRequest request = {}) {
  request.in_world = true;
  const auto with = [&](const Points& points, const std::string& scale) {
    return asset(points, R"("nodes": [{"mesh": 0)" + scale + node + "}" + others);
  };
  return test::compare(with(kWhole, ""), with(kHalf, R"(, "scale": [2, 2, 2])"), request).same();
}

TEST(PlacedMeshes, AreThoseOfNodesWithoutSkin) {
  EXPECT_TRUE(may_be_scaled("", "]"));
  EXPECT_FALSE(may_be_scaled("", R"(, {"mesh": 0}])"));
  const char* const skins = R"(], "skins": [{"joints": [2]}])";
  EXPECT_TRUE(may_be_scaled("", std::string(R"(, {"mesh": 1, "skin": 0}, {})") + skins));
  EXPECT_FALSE(may_be_scaled("", std::string(R"(, {"mesh": 0, "skin": 0}, {})") + skins));
  EXPECT_FALSE(may_be_scaled(R"(, "skin": 0)", std::string(R"(, {}, {})") + skins));
}

TEST(PlacedMeshes, AreNotThoseThatAnExtensionUses) {
  const auto with_shape = [](int mesh) {
    return may_be_scaled("", R"(], "extensionsUsed": ["OMI_physics_shape"], "extensions":
        {"OMI_physics_shape": {"shapes": [{"type": "convex", "convex": {"mesh": )" +
                                 std::to_string(mesh) + "}}]}}");
  };
  EXPECT_TRUE(with_shape(1));
  EXPECT_FALSE(with_shape(0));
}

TEST(PlacedMeshes, HaveNodesThatNothingElseRefersTo) {
  const char* const skin = R"(, {"mesh": 1, "skin": 0}, {}], "skins": [{"joints": [)";
  EXPECT_TRUE(may_be_scaled("", std::string(skin) + "2]}]"));
  EXPECT_FALSE(may_be_scaled("", std::string(skin) + "2, 0]}]"));
}

std::string animated(const std::string& target) {
  return R"(], "extensionsUsed": ["KHR_animation_pointer"], "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5126, "count": 1, "type": "VEC3"},
      {"componentType": 5126, "count": 1, "type": "SCALAR"},
      {"componentType": 5126, "count": 1, "type": "VEC3"}],
      "animations": [{"samplers": [{"input": 2, "output": 3}],
                      "channels": [{"sampler": 0, "target": {)" +
         target + "}}]}]";
}

std::string pointer_to(const std::string& pointer) {
  return R"("path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": ")" + pointer +
         "\"}}";
}

TEST(PlacedMeshes, HaveNodesThatDoNotMove) {
  for (const std::string& moved :
       {std::string(R"("node": 1, "path": "translation")"), pointer_to("/nodes/1/translation"),
        pointer_to("/nodes/1/scale")}) {
    EXPECT_TRUE(may_be_scaled("", ", {}" + animated(moved))) << moved;
  }
  for (const std::string& moved :
       {std::string(R"("node": 0, "path": "translation")"), pointer_to("/nodes/0/translation"),
        pointer_to("/nodes/0/scale")}) {
    EXPECT_FALSE(may_be_scaled("", ", {}" + animated(moved))) << moved;
  }
  const std::string written = R"(, "translation": [1, 0, 0])";
  EXPECT_TRUE(may_be_scaled(written, ", {}" + animated(pointer_to("/nodes/1/translation"))));
  EXPECT_FALSE(may_be_scaled(written, ", {}" + animated(pointer_to("/nodes/0/translation"))));
}

TEST(PlacedMeshes, AreComparedInTheirOrderOnly) {
  MeaningRequest request;
  request.order = VertexOrder::free;
  request.in_world = true;
  const EditedAsset before = asset(kWhole, R"("nodes": [{"mesh": 0}])");
  const EditedAsset after = asset(kWhole, R"("nodes": [{"mesh": 0, "scale": [2, 2, 2]}])");
  EXPECT_FALSE(test::compare(before, after, request).same());
}

// Points that differ by 2 where one unit is a thousandth of the scene's.
bool tells_points_apart(const std::string& members) {
  MeaningRequest request;
  request.in_world = true;
  request.tolerance.position = 0.01;
  return !test::compare(asset(kWhole, members), asset(kHalf, members), request).same();
}

TEST(PlacedMeshes, AreShownInTheirShape) {
  const std::string child = R"("nodes": [{"mesh": 0}, {"children": [0], "scale": )";
  EXPECT_TRUE(tells_points_apart(child + "[1, 1, 1]}]"));
  EXPECT_FALSE(tells_points_apart(child + "[0.001, 0.001, 0.001]}]"));
  for (const char* const scale : {"[0, 0, 0]", "[0.001, 0, 0.001]", "[0.001, 0.001, 1e-12]"}) {
    EXPECT_TRUE(tells_points_apart(child + scale + "}]")) << scale;
  }
  const std::string small = child + "[0.001, 0.001, 0.001]}";
  for (const std::string& scaled :
       {std::string(R"("node": 1, "path": "scale")"), pointer_to("/nodes/1/scale"),
        std::string(R"("node": 0, "path": "scale")")}) {
    EXPECT_TRUE(tells_points_apart(small + animated(scaled))) << scaled;
  }
  EXPECT_FALSE(tells_points_apart(small + animated(R"("node": 1, "path": "rotation")")));
}

}  // namespace
}  // namespace gltfx::prove
