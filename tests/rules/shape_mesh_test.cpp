// SPDX-License-Identifier: Apache-2.0
// glTF 2.1: meshes of shapes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/packed_bytes.hpp"
#include "rules/selected.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {
namespace {

const std::set<std::string, std::less<>> kShapeCodes{"SHAPE_MESH_INVALID", "SHAPE_NOT_CONVEX",
                                                     "SHAPE_INSIDE_OUT", "SHAPE_ORIGIN_OUTSIDE"};

/// Points and the triangles of a closed surface.
struct ShapeBody {
  std::vector<float> points;
  std::vector<std::uint32_t> corners;

  std::size_t size() const { return points.size() / 3; }
};

// A ball of so many rings, or a ring with a hole, which is not convex.
ShapeBody round_body(std::uint32_t rings, double hole) {
  ShapeBody body;
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < rings; ++k) {
      const double around = 2 * std::numbers::pi * k / rings;
      const double up = hole > 0 ? 2 * std::numbers::pi * i / rings
                                 : std::numbers::pi * i / (rings - 1) - std::numbers::pi / 2;
      const double radius = hole + std::cos(up);
      for (const double each :
           {radius * std::cos(around), radius * std::sin(around), std::sin(up)}) {
        body.points.push_back(static_cast<float>(each));
      }
      if (i + 1 == rings && !(hole > 0)) continue;
      const std::uint32_t next = (i + 1) % rings * rings;
      const std::uint32_t here = i * rings;
      const std::uint32_t beside = (k + 1) % rings;
      for (const std::uint32_t corner :
           {here + k, here + beside, next + k, next + k, here + beside, next + beside}) {
        body.corners.push_back(corner);
      }
    }
  }
  return body;
}

std::string shape_of(const ShapeBody& body, const std::string& type = "convexMesh",
                     const AssetBuilder::Json& primitive = AssetBuilder::Json::object()) {
  AssetBuilder made;
  made.json["asset"]["version"] = "2.1";
  std::vector<float> least(3, 1e30F), most(3, -1e30F);
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    least[i % 3] = std::min(least[i % 3], body.points[i]);
    most[i % 3] = std::max(most[i % 3], body.points[i]);
  }
  made.accessor("VEC3", 5126, body.size(), packed(body.points), {{"min", least}, {"max", most}});
  made.accessor("SCALAR", 5125, body.corners.size(), packed(body.corners));
  AssetBuilder::Json one{{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
  one.update(primitive);
  made.add("meshes", {{"primitives", AssetBuilder::Json::array({one})}});
  made.add("shapes", {{"type", type}, {type, {{"mesh", 0}}}});
  return made.text(buffer_uri(made.bytes));
}

Lines judged_shape(const ShapeBody& body) { return selected(shape_of(body), kShapeCodes); }

TEST(ShapeMesh, ABallIsConvex) {
  for (const std::uint32_t rings : {4U, 9U, 60U, 150U}) {
    EXPECT_EQ(judged_shape(round_body(rings, 0)), Lines{}) << rings;
  }
}

TEST(ShapeMesh, ATurnedCubeWithManyTrianglesIsConvex) {
  ShapeBody body;
  constexpr std::uint32_t kParts = 60;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(body.size());
      for (std::uint32_t i = 0; i <= kParts; ++i) {
        for (std::uint32_t k = 0; k <= kParts; ++k) {
          double p[3];
          p[axis] = side;
          p[(axis + 1) % 3] = 2.0 * i / kParts - 1;
          p[(axis + 2) % 3] = (2.0 * k / kParts - 1) * side;
          // A rotation by 1 around (1, 2, 3).
          const double q[3] = {0.573 * p[0] - 0.609 * p[1] + 0.548 * p[2],
                               0.740 * p[0] + 0.671 * p[1] - 0.028 * p[2],
                               -0.351 * p[0] + 0.422 * p[1] + 0.836 * p[2]};
          for (const double each : q) body.points.push_back(static_cast<float>(each));
          if (i == kParts || k == kParts) continue;
          const std::uint32_t at = first + i * (kParts + 1) + k;
          for (const std::uint32_t corner :
               {at, at + kParts + 1, at + 1, at + 1, at + kParts + 1, at + kParts + 2}) {
            body.corners.push_back(corner);
          }
        }
      }
    }
  }
  EXPECT_EQ(judged_shape(body), Lines{});
}

TEST(ShapeMesh, DentsBeyondATenThousandthAreFound) {
  const Lines dented{"SHAPE_NOT_CONVEX /shapes/0/convexMesh/mesh"};
  for (const std::uint32_t rings : {9U, 40U}) {
    const auto dented_by = [&](double part) {
      ShapeBody body = round_body(rings, 0);
      const std::size_t vertex = rings * (rings / 2) + 1;
      for (std::size_t k = 0; k < 3; ++k) body.points[3 * vertex + k] *= static_cast<float>(part);
      return judged_shape(body);
    };
    EXPECT_EQ(dented_by(0.5), dented);
    EXPECT_EQ(dented_by(1 - 1e-5), Lines{});
  }
  EXPECT_EQ(judged_shape(round_body(30, 2)), dented) << "a ring";
}

TEST(ShapeMesh, ShallowBowlsOfManyTrianglesAreFound) {
  // Each edge is bent by less than a ten-thousandth; the whole is not.
  ShapeBody body = round_body(100, 0);
  for (std::size_t i = 0; i < body.size(); ++i) {
    float* const p = &body.points[3 * i];
    if (p[2] > 0) p[2] *= -0.5F;
  }
  EXPECT_EQ(judged_shape(body).size(), 1U);
  EXPECT_EQ(judged_shape(body).front().substr(0, 16), "SHAPE_NOT_CONVEX");
}

TEST(ShapeMesh, ABodyHasAVolume) {
  ShapeBody body = round_body(12, 0);
  for (std::size_t i = 2; i < body.points.size(); i += 3) body.points[i] *= 1e-7F;
  EXPECT_EQ(judged_shape(body), Lines{"SHAPE_NOT_CONVEX /shapes/0/convexMesh/mesh"});
  for (std::size_t i = 2; i < body.points.size(); i += 3) body.points[i] *= 1e5F;
  EXPECT_EQ(judged_shape(body), Lines{}) << "a thin one";
}

TEST(ShapeMesh, TrianglesFaceOutwards) {
  ShapeBody body = round_body(9, 0);
  for (std::size_t i = 0; i < body.corners.size(); i += 3) {
    std::swap(body.corners[i], body.corners[i + 1]);
  }
  const Lines inside_out{"SHAPE_INSIDE_OUT /shapes/0/convexMesh/mesh"};
  EXPECT_EQ(judged_shape(body), inside_out);
  ShapeBody other = round_body(9, 0);
  std::swap(other.corners[216], other.corners[217]);
  EXPECT_EQ(judged_shape(other), inside_out) << "one triangle";
}

TEST(ShapeMesh, TheOriginIsInside) {
  const auto moved = [](float by) {
    ShapeBody body = round_body(9, 0);
    for (std::size_t i = 0; i < body.points.size(); i += 3) body.points[i] += by;
    return judged_shape(body);
  };
  EXPECT_EQ(moved(0.9F), Lines{});
  EXPECT_EQ(moved(1.5F), Lines{"SHAPE_ORIGIN_OUTSIDE /shapes/0/convexMesh/mesh"});
}

TEST(ShapeMesh, HasOnePrimitiveOfTriangles) {
  const ShapeBody body = round_body(9, 0);
  const Lines invalid{"SHAPE_MESH_INVALID /shapes/0/mesh/mesh"};
  const auto of_mode = [&](int mode) {
    return selected(shape_of(body, "mesh", {{"mode", mode}}), kShapeCodes);
  };
  for (const int mode : {0, 1, 2, 3}) EXPECT_EQ(of_mode(mode), invalid) << mode;
  for (const int mode : {4, 5, 6}) EXPECT_EQ(of_mode(mode), Lines{}) << mode;
  EXPECT_EQ(selected(shape_of(body, "mesh", {{"attributes", {{"_A", 0}}}}), kShapeCodes), invalid);
  EXPECT_EQ(selected(shape_of(body, "box"), kShapeCodes), Lines{}) << "not a mesh";
}

TEST(ShapeMesh, IsMorphedByItsOwnWeights) {
  ShapeBody body = round_body(9, 0);
  AssetBuilder made;
  made.json = AssetBuilder::Json::parse(shape_of(body));
  made.json.erase("buffers");
  made.bytes = packed(body.points);
  made.bytes += packed(body.corners);
  std::vector<float> moves(body.points.size());
  moves[3 * 40] = -1.5F * body.points[3 * 40];
  moves[3 * 40 + 1] = -1.5F * body.points[3 * 40 + 1];
  const std::size_t target = made.accessor("VEC3", 5126, body.size(), packed(moves));
  made.json["accessors"][target]["min"] = {-2, -2, 0};
  made.json["accessors"][target]["max"] = {2, 2, 0};
  made.json["meshes"][0]["primitives"][0]["targets"] =
      AssetBuilder::Json::array({{{"POSITION", target}}});
  EXPECT_EQ(selected(made.text(buffer_uri(made.bytes)), kShapeCodes), Lines{});
  made.json["meshes"][0]["weights"] = {1};
  EXPECT_EQ(selected(made.text(buffer_uri(made.bytes)), kShapeCodes),
            Lines{"SHAPE_NOT_CONVEX /shapes/0/convexMesh/mesh"});
}

TEST(ShapeMesh, HolesAreAHint) {
  ShapeBody body = round_body(9, 0);
  body.corners.resize(body.corners.size() - 3 * 9);
  EXPECT_EQ(places(shape_of(body, "mesh"), "SHAPE_NOT_CLOSED", Profile::strict),
            Lines{"/shapes/0/mesh/mesh"});
  EXPECT_EQ(judged_shape(body), Lines{}) << "an open surface may be convex";
}

TEST(ShapeMesh, OnlyGltf21HasShapes) {
  AssetBuilder::Json asset = AssetBuilder::Json::parse(shape_of(round_body(30, 2)));
  asset["asset"]["version"] = "2.0";
  EXPECT_EQ(selected(asset.dump(), kShapeCodes), Lines{});
}

}  // namespace
}  // namespace gltfx::test
