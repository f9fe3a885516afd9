// SPDX-License-Identifier: Apache-2.0
/// Bodies and surfaces with numbers drawn at random, of which it is known which way they face.
#pragma once

#include <cstddef>
#include <utility>

#include "rules/shows_assets.hpp"

namespace gltfx::test {

/// Triangles with a normal for each point; none: they are not written.
struct Body {
  Shape shape;
  std::vector<Point> normals;
};

/// A profile that is turned around z, with points on the axis at both ends: closed, and facing
/// outward because rings go around counter-clockwise, and from below to above.
inline Body lathe(const std::vector<std::array<double, 2>>& profile, int sides, bool seam) {
  Body made;
  const int columns = seam ? sides + 1 : sides;
  const auto add = [&](double radius, double height, double angle, double slope) {
    made.shape.points.push_back({static_cast<float>(radius * std::cos(angle)),
                                 static_cast<float>(radius * std::sin(angle)),
                                 static_cast<float>(height)});
    const double length = std::hypot(1, slope);
    made.normals.push_back({static_cast<float>(std::cos(angle) / length),
                            static_cast<float>(std::sin(angle) / length),
                            static_cast<float>(slope / length)});
  };
  for (std::size_t ring = 1; ring + 1 < profile.size(); ++ring) {
    const double rise = profile[ring + 1][1] - profile[ring - 1][1];
    const double slope = (profile[ring - 1][0] - profile[ring + 1][0]) / rise;
    for (int side = 0; side < columns; ++side) {
      add(profile[ring][0], profile[ring][1], (side % sides) * 6.28318530717959 / sides, slope);
    }
  }
  const int rings = static_cast<int>(profile.size()) - 2;
  const int bottom = static_cast<int>(made.shape.points.size());
  made.shape.points.push_back({0, 0, static_cast<float>(profile.front()[1])});
  made.normals.push_back({0, 0, -1});
  made.shape.points.push_back({0, 0, static_cast<float>(profile.back()[1])});
  made.normals.push_back({0, 0, 1});
  const auto triangle = [&](int a, int b, int c) {
    for (const int corner : {a, b, c}) {
      made.shape.corners.push_back(static_cast<std::uint16_t>(corner));
    }
  };
  for (int side = 0; side < sides; ++side) {
    const int next = seam ? side + 1 : (side + 1) % sides;
    triangle(bottom, next, side);
    for (int ring = 0; ring + 1 < rings; ++ring) {
      const int low = ring * columns, high = low + columns;
      triangle(low + side, low + next, high + side);
      triangle(high + side, low + next, high + next);
    }
    const int top = (rings - 1) * columns;
    triangle(top + side, top + next, bottom + 1);
  }
  return made;
}

/// A closed body: a lathe of any profile.
inline Body body(Drawn& d) {
  const double width = d.magnitude(0.05, 10);
  std::vector<std::array<double, 2>> profile{{0, 0}};
  const int rings = d.pick(2, 8);
  for (int ring = 0; ring < rings; ++ring) {
    profile.push_back(
        {width * d.number(0.25, 0.5), profile.back()[1] + width * d.number(0.2, 0.4)});
  }
  profile.push_back({0, profile.back()[1] + width * d.number(0.1, 0.3)});
  return lathe(profile, d.pick(3, 40), d.pick(0, 1) == 1);
}

/// A ball of radius 0.5 to 5 around 0.
inline Body ball(Drawn& d) {
  const double radius = d.number(0.5, 5);
  std::vector<std::array<double, 2>> profile;
  const int rings = d.pick(4, 12);
  for (int ring = 0; ring <= rings + 1; ++ring) {
    const double angle = 3.14159265358979 * ring / (rings + 1);
    profile.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
  }
  return lathe(profile, d.pick(5, 40), d.pick(0, 1) == 1);
}

/// An open surface of 10 by 10 whose front is towards +z.
inline Body hills(Drawn& d) {
  Body made;
  const int size = d.pick(3, 12);
  for (int row = 0; row <= size; ++row) {
    for (int column = 0; column <= size; ++column) {
      made.shape.points.push_back({static_cast<float>(10.0 * column / size - 5),
                                   static_cast<float>(10.0 * row / size - 5),
                                   static_cast<float>(d.number(0, 3.0 / size))});
      made.normals.push_back({0, 0, 1});
      if (row == size || column == size) continue;
      const int at = row * (size + 1) + column;
      for (const int corner : {at, at + 1, at + size + 1, at + size + 1, at + 1, at + size + 2}) {
        made.shape.corners.push_back(static_cast<std::uint16_t>(corner));
      }
    }
  }
  return made;
}

/// Cards that are turned any way, with normals that all point up.
inline Body leaves(Drawn& d) {
  Body made;
  const int cards = d.pick(20, 60);
  for (int card = 0; card < cards; ++card) {
    const Point center = d.point(5), u = d.point(0.5), v = d.point(0.5);
    const auto first = static_cast<std::uint16_t>(made.shape.points.size());
    for (const auto& [along, across] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {-1.0F, 1.0F}}) {
      Point point = center;
      for (std::size_t k = 0; k < 3; ++k) point[k] += along * u[k] + across * v[k];
      made.shape.points.push_back(point);
      made.normals.push_back({0, 1, 0});
    }
    // Every other one is behind its neighbour, with its front on the other side.
    for (const int corner : {0, 1, 2, 0, 2, 1}) {
      made.shape.corners.push_back(static_cast<std::uint16_t>(first + corner));
    }
  }
  return made;
}

inline void turn_normals(Body& made) {
  for (Point& normal : made.normals) {
    for (float& each : normal) each = 0 - each;
  }
}
inline void turn_triangles(Body& made) {
  for (std::size_t i = 0; i < made.shape.corners.size(); i += 3) {
    std::swap(made.shape.corners[i], made.shape.corners[i + 2]);
  }
}
inline Body inside_out(Body made) {
  turn_normals(made);
  turn_triangles(made);
  return made;
}
inline Body grown(Body made, double by) {
  for (Point& point : made.shape.points) {
    for (float& each : point) each *= static_cast<float>(by);
  }
  return made;
}

inline Json primitive_of(Drawn& d, const Body& made) {
  Json primitive = d.primitive(made.shape);
  if (made.normals.empty()) return primitive;
  primitive["attributes"]["NORMAL"] = d.values("VEC3", made.normals, {{"target", 34962}});
  return primitive;
}

/// Two primitives with the first and the last triangles of a body.
inline Json halves(Drawn& d, const Body& made) {
  Json both = Json::array();
  const std::size_t half = made.shape.corners.size() / 6 * 3;
  for (const bool first : {true, false}) {
    Body part = made;
    auto& corners = part.shape.corners;
    if (first) {
      corners.resize(half);
    } else {
      corners.erase(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(half));
    }
    // Only the points that are used.
    std::vector<int> place(made.shape.points.size(), -1);
    part.shape.points.clear();
    part.normals.clear();
    for (std::uint16_t& corner : corners) {
      if (place[corner] < 0) {
        place[corner] = static_cast<int>(part.shape.points.size());
        part.shape.points.push_back(made.shape.points[corner]);
        if (!made.normals.empty()) part.normals.push_back(made.normals[corner]);
      }
      corner = static_cast<std::uint16_t>(place[corner]);
    }
    both.push_back(primitive_of(d, part));
    both.back()["material"] = d.made.add("materials", {{"name", first ? "one" : "other"}});
  }
  return both;
}

/// A node turned and scaled, mirrored half of the time, near the origin.
inline Json placed(Drawn& d, Json node) {
  const double scale = d.number(0.5, 2);
  node["rotation"] = d.turn(d.number(-180, 180));
  node["scale"] = {d.sign() * scale, scale, scale};
  return node;
}

/// A camera at a place.
inline void look(Drawn& d, const std::array<double, 3>& place) {
  const std::size_t camera = d.made.add(
      "cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  d.root({{"camera", camera}, {"translation", place}, {"rotation", d.turn(d.number(-180, 180))}});
}

}  // namespace gltfx::test
