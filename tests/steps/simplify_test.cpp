// SPDX-License-Identifier: Apache-2.0
// Surfaces stay within the bound, shut and closed when they lose triangles. Distances are measured
// here by a search through all triangles.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using Point = std::array<double, 3>;
using Face = std::array<Point, 3>;
using Faces = std::vector<Face>;

/// A sheet of points, as arrays of an asset.
struct Sheet {
  std::vector<float> positions, texcoords;
  std::vector<std::uint32_t> indices;

  // `place` takes two parts from 0 to 1.
  template <class Place>
  Sheet(unsigned columns, unsigned rows, const Place& place) {
    for (unsigned x = 0; x <= columns; ++x) {
      for (unsigned y = 0; y <= rows; ++y) {
        const double u = 1.0 * x / columns, v = 1.0 * y / rows;
        for (const double each : place(u, v)) positions.push_back(static_cast<float>(each));
        texcoords.push_back(static_cast<float>(u));
        texcoords.push_back(static_cast<float>(v));
        if (x == columns || y == rows) continue;
        const unsigned at = x * (rows + 1) + y;
        for (const unsigned corner :
             {at, at + 1, at + rows + 1, at + rows + 1, at + 1, at + rows + 2})
          indices.push_back(corner);
      }
    }
  }
};

Point hill(double u, double v) {
  return {2 * u, 0.2 * std::sin(5 * u + 1) * std::cos(4 * v) + 0.1 * u * v, 2 * v};
}

// Both ends of a turn, and all points of a pole, are at exactly one place.
Point ball(double u, double v) {
  const double turn = u == 1 ? 0 : 2 * std::numbers::pi * u;
  const double ring = v == 0 || v == 1 ? 0 : std::sin(std::numbers::pi * v);
  const double size = 1 + 0.1 * std::sin(3 * ring * std::cos(turn)) * ring;
  return {size * ring * std::cos(turn), -std::cos(std::numbers::pi * v),
          size * ring * std::sin(turn)};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = minus(b, a);
  const double part =
      std::clamp(dot(minus(p, a), along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
  const Point off =
      minus(p, {a[0] + part * along[0], a[1] + part * along[1], a[2] + part * along[2]});
  return std::sqrt(dot(off, off));
}

// To the edges, or to the plane if the point is above the inside.
double to_face(const Point& p, const Face& face) {
  const auto& [a, b, c] = face;
  double best = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
  const Point normal = cross(minus(b, a), minus(c, a));
  const auto is_left = [&](const Point& from, const Point& to) {
    return dot(cross(minus(to, from), minus(p, from)), normal) >= 0;
  };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a) && dot(normal, normal) > 0)
    best = std::min(best, std::abs(dot(minus(p, a), normal)) / std::sqrt(dot(normal, normal)));
  return best;
}

// From corners, midpoints and centers, one way.
double farthest(const Faces& from, const Faces& to) {
  double most = 0;
  for (const auto& [a, b, c] : from) {
    std::vector<Point> points{a, b, c};
    for (const auto& weights :
         {Point{.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}, {1 / 3., 1 / 3., 1 / 3.}}) {
      Point point{};
      for (std::size_t i = 0; i < 3; ++i)
        point[i] = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i];
      points.push_back(point);
    }
    for (const Point& point : points) {
      double least = INFINITY;
      for (const Face& face : to) least = std::min(least, to_face(point, face));
      most = std::max(most, least);
    }
  }
  return most;
}

double diagonal(const Faces& faces) {
  Point least{1e9, 1e9, 1e9}, most{-1e9, -1e9, -1e9};
  for (const Face& face : faces) {
    for (const Point& point : face) {
      for (std::size_t i = 0; i < 3; ++i) {
        least[i] = std::min(least[i], point[i]);
        most[i] = std::max(most[i], point[i]);
      }
    }
  }
  return std::sqrt(dot(minus(most, least), minus(most, least)));
}

// Edges without a face on the other side, by the places of their ends.
std::vector<std::pair<Point, Point>> open_edges(const Faces& faces) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const Face& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& from = face[i];
      const Point& to = face[(i + 1) % 3];
      if (from < to) ++edges[{from, to}];
      if (to < from) --edges[{to, from}];
    }
  }
  std::vector<std::pair<Point, Point>> open;
  for (const auto& [edge, times] : edges) {
    if (times != 0) open.push_back(edge);
  }
  return open;
}

// Of a primitive, moved.
Faces faces_of(const StoredAsset& asset, std::size_t mesh, std::size_t primitive = 0,
               const Point& shift = {}) {
  const OrderedJson object = asset.json()["meshes"][mesh]["primitives"][primitive];
  const auto numbers = numbers_of(asset, object["attributes"]["POSITION"]);
  const auto indices = numbers_of(asset, object["indices"]);
  Faces faces(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      faces[i / 3][i % 3][k] = numbers[3 * static_cast<std::size_t>(indices[i]) + k] + shift[k];
  }
  return faces;
}

Faces joined(Faces a, const Faces& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

ConvertOptions simplified(double error, std::uint64_t triangles = 0) {
  ConvertOptions options;
  options.simplify = Simplification{error, triangles};
  return options;
}

class Simplify : public test::ConvertMade {
 protected:
  Simplify() : ConvertMade(simplified(0.01)) {}

  OrderedJson primitive(const Sheet& sheet, bool texcoords = false) {
    OrderedJson object;
    object["attributes"]["POSITION"] = made_.accessor(sheet.positions, "VEC3", true);
    if (texcoords) object["attributes"]["TEXCOORD_0"] = made_.accessor(sheet.texcoords, "VEC2");
    object["indices"] = made_.accessor(sheet.indices, "SCALAR");
    return object;
  }
  void add(const std::vector<OrderedJson>& primitives) {
    made_.json["meshes"].push_back({{"primitives", primitives}});
    made_.json["nodes"].push_back({{"mesh", made_.json["meshes"].size() - 1}});
  }
  // Keeps the row of the step in row_.
  StoredAsset result() {
    before_.emplace(made_.glb());
    const ConvertReport report = run(made_.glb());
    EXPECT_TRUE(report.written) << report.error;
    for (const ConvertStep& step : report.steps) {
      if (step.step == "simplify") row_ = step;
    }
    return StoredAsset::at(output());
  }
  double loss() const { return row_.losses.empty() ? -1 : row_.losses.front().measured / 100; }

  MadeAsset made_;
  std::optional<StoredAsset> before_;
};

TEST_F(Simplify, KeepsClosedSurfacesClosedAndWithinTheBound) {
  add({primitive(Sheet(18, 14, ball))});
  const StoredAsset after = result();
  const Faces old = faces_of(*before_, 0), now = faces_of(after, 0);
  EXPECT_LT(now.size(), old.size());
  ASSERT_THAT(open_edges(old), IsEmpty());
  EXPECT_THAT(open_edges(now), IsEmpty());
  const double measured = std::max(farthest(old, now), farthest(now, old)) / diagonal(old);
  EXPECT_LE(measured, 0.01);
  EXPECT_GE(loss(), 0.98 * measured);
  EXPECT_LE(loss(), 1.3 * measured);
  EXPECT_EQ(row_.losses.front().quantity, "surface");
  EXPECT_EQ(row_.losses.front().bound, 1);
}

TEST_F(Simplify, KeepsSeamsOfTexturesShut) {
  add({primitive(Sheet(32, 24, ball), true)});
  const StoredAsset after = result();
  const Faces old = faces_of(*before_, 0), now = faces_of(after, 0);
  EXPECT_LT(now.size(), old.size());
  EXPECT_THAT(open_edges(now), IsEmpty()) << "both sides of the seam are at equal places";
  for (const ConvertLoss& loss : row_.losses) EXPECT_LE(loss.measured, loss.bound) << loss.quantity;
  ASSERT_THAT(row_.losses, SizeIs(2));
  EXPECT_EQ(row_.losses[1].quantity, "textures");
}

TEST_F(Simplify, StaysWithinTheBoundWhenRepeated) {
  add({primitive(Sheet(18, 14, ball))});
  const StoredAsset first = result();
  const std::string once = container::test::content_of(output());
  ASSERT_TRUE(run(once).written);
  const StoredAsset second = StoredAsset::at(output());
  const Faces old = faces_of(first, 0), now = faces_of(second, 0);
  EXPECT_LE(std::max(farthest(old, now), farthest(now, old)), 0.01 * diagonal(old));
}

TEST_F(Simplify, KeepsBordersOfMaterialsShut) {
  const Sheet sheet(24, 24, hill);
  OrderedJson left = primitive(sheet), right = left;
  const std::size_t half = sheet.indices.size() / 2;
  const auto from = sheet.indices.begin();
  const auto middle = from + static_cast<std::ptrdiff_t>(half);
  left["indices"] = made_.accessor(std::vector<std::uint32_t>(from, middle), "SCALAR");
  right["indices"] =
      made_.accessor(std::vector<std::uint32_t>(middle, sheet.indices.end()), "SCALAR");
  add({left, right});
  const StoredAsset after = result();
  const Faces old = joined(faces_of(*before_, 0), faces_of(*before_, 0, 1));
  const Faces now = joined(faces_of(after, 0), faces_of(after, 0, 1));
  EXPECT_LT(now.size(), old.size() / 2);
  EXPECT_EQ(open_edges(now), open_edges(old)) << "only the outline is open";
}

TEST_F(Simplify, KeepsBordersOfMeshesThatTouchShut) {
  add({primitive(Sheet(16, 16, hill))});
  add({primitive(Sheet(16, 16, [](double u, double v) {
    Point point = hill(u + 1, v);
    point[0] -= 2;
    return point;
  }))});
  made_.json["nodes"][1]["translation"] = {2, 0, 0};
  const StoredAsset after = result();
  const auto both = [](const StoredAsset& asset) {
    return joined(faces_of(asset, 0), faces_of(asset, 1, 0, {2, 0, 0}));
  };
  const Faces now = both(after);
  EXPECT_LT(now.size(), both(*before_).size() / 2);
  const auto before = open_edges(both(*before_));
  EXPECT_EQ(open_edges(now), before);
}

TEST_F(Simplify, MeasuresTheErrorInTheScene) {
  add({primitive(Sheet(16, 16, hill))});
  made_.json["nodes"][0]["scale"] = {50, 50, 50};
  made_.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 0}}});
  const StoredAsset after = result();
  const Faces old = faces_of(*before_, 0), now = faces_of(after, 0);
  EXPECT_LT(now.size(), old.size());
  EXPECT_LE(std::max(farthest(old, now), farthest(now, old)), 0.01 * diagonal(old) * 1.0001);
}

TEST_F(Simplify, NeedsTwoTrianglesForASquare) {
  add({primitive(Sheet(20, 20, [](double u, double v) { return Point{u, 0, v}; }), true)});
  const StoredAsset after = result();
  EXPECT_LE(faces_of(after, 0).size(), 4U);
  EXPECT_NEAR(loss(), 0, 1e-9);
  const OrderedJson json = after.json();
  const OrderedJson& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_LE(json["accessors"][attributes["POSITION"].get<std::size_t>()]["count"], 6);
  EXPECT_LE(json["accessors"][attributes["TEXCOORD_0"].get<std::size_t>()]["count"], 6);
}

TEST_F(Simplify, WeldsTrianglesFirst) {
  const Sheet sheet(20, 20, hill);
  std::vector<float> soup;
  for (const std::uint32_t index : sheet.indices) {
    for (std::size_t k = 0; k < 3; ++k) soup.push_back(sheet.positions[3 * index + k]);
  }
  OrderedJson object;
  object["attributes"]["POSITION"] = made_.accessor(soup, "VEC3", true);
  add({object});
  EXPECT_LT(faces_of(result(), 0).size(), sheet.indices.size() / 6);
}

TEST_F(Simplify, SaysWhatANumberOfTrianglesTakes) {
  options_ = simplified(0, 300);
  add({primitive(Sheet(16, 16, hill))});
  add({primitive(Sheet(16, 16, ball))});
  made_.json["nodes"][1]["translation"] = {5, 0, 0};
  const StoredAsset after = result();
  std::size_t triangles = 0;
  double farthest_of_all = 0;
  Faces all;
  for (std::size_t mesh = 0; mesh < 2; ++mesh) {
    const Point shift{5.0 * static_cast<double>(mesh), 0, 0};
    const Faces old = faces_of(*before_, mesh, 0, shift), now = faces_of(after, mesh, 0, shift);
    triangles += now.size();
    all = joined(std::move(all), old);
    farthest_of_all = std::max({farthest_of_all, farthest(old, now), farthest(now, old)});
  }
  EXPECT_LE(triangles, 300U);
  EXPECT_GT(triangles, 200U);
  EXPECT_GE(loss(), 0.98 * farthest_of_all / diagonal(all));
  EXPECT_LE(loss(), 1.3 * farthest_of_all / diagonal(all));
  EXPECT_EQ(row_.losses.front().bound, row_.losses.front().measured);
}

TEST_F(Simplify, LeavesWhatItCannotKeep) {
  const Sheet sheet(20, 20, hill);
  const auto reason_of = [&](const OrderedJson& object) {
    MadeAsset made = made_;
    made.json["meshes"].push_back({{"primitives", {object}}});
    made.json["nodes"].push_back({{"mesh", 0}});
    const ConvertReport report = run(made.glb());
    EXPECT_TRUE(report.written) << report.error;
    EXPECT_FALSE(report.steps[1].changes);
    return report.steps[1].left.empty() ? std::string() : report.steps[1].left[0].reason;
  };
  OrderedJson morphed = primitive(sheet), skinned = morphed, strip = morphed, fine = morphed;
  morphed["targets"] = {{{"POSITION", morphed["attributes"]["POSITION"]}}};
  EXPECT_EQ(reason_of(morphed), "has morph targets");
  const std::size_t vertices = sheet.positions.size() / 3;
  skinned["attributes"]["JOINTS_0"] =
      made_.accessor(std::vector<std::uint8_t>(4 * vertices, 0), "VEC4");
  std::vector<float> weights(4 * vertices, 0);
  for (std::size_t i = 0; i < vertices; ++i) weights[4 * i] = 1;
  skinned["attributes"]["WEIGHTS_0"] = made_.accessor(weights, "VEC4");
  EXPECT_EQ(reason_of(skinned), "is skinned");
  strip["mode"] = 5;
  EXPECT_EQ(reason_of(strip), "has primitives that are not triangles");
  options_ = simplified(1e-8);
  EXPECT_EQ(reason_of(fine), "has no triangle that may go within the bound");
}

TEST_F(Simplify, LeavesTexturesThatWouldSlide) {
  Sheet sheet(20, 20, [](double u, double v) { return Point{u, 0, v}; });
  for (float& each : sheet.texcoords) each = std::sin(12 * each);
  add({primitive(sheet, true)});
  const StoredAsset after = result();
  EXPECT_EQ(faces_of(after, 0), faces_of(*before_, 0));
  ASSERT_THAT(row_.left, SizeIs(1));
  EXPECT_EQ(row_.left[0].reason, "has normals or textures that would move too far");
}

TEST_F(Simplify, LeavesTanglesInBoundedTime) {
  std::mt19937 random(1);
  Sheet tangle(1, 1, hill);
  tangle.positions.clear();
  tangle.indices.clear();
  for (std::uint32_t i = 0; i < 6000; ++i) {
    for (int k = 0; k < 3; ++k) tangle.positions.push_back(static_cast<float>(random() % 4096));
  }
  for (int i = 0; i < 60000; ++i)
    tangle.indices.push_back(static_cast<std::uint32_t>(random() % 6000));
  add({primitive(tangle)});
  result();
  ASSERT_THAT(row_.left, SizeIs(1));
  EXPECT_EQ(row_.left[0].pointer, "/meshes/0/primitives/0");
}

TEST_F(Simplify, IsRefusedWhereAnUnknownExtensionMayKnowVertices) {
  OrderedJson object = primitive(Sheet(20, 20, hill));
  object["extensions"]["ACME_outline"]["first"] = 3;
  made_.json["extensionsUsed"] = {"ACME_outline"};
  add({object});
  const ConvertReport report = run(made_.glb());
  EXPECT_FALSE(report.written);
  EXPECT_THAT(report.error, HasSubstr("ACME_outline may hold indices of its vertices"));
}

}  // namespace
}  // namespace gltfx
