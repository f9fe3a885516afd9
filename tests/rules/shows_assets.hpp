// SPDX-License-Identifier: Apache-2.0
/// Assets with numbers drawn at random, for rules about what an asset shows.
#pragma once

#include <gltfx/validate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/packed_bytes.hpp"
#include "rules/selected.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

using Json = AssetBuilder::Json;
using Point = std::array<float, 3>;
using Four = std::array<float, 4>;
using Matrix = std::array<float, 16>;

/// Corners of triangles.
struct Shape {
  std::vector<Point> points;
  std::vector<std::uint16_t> corners;
};

/// Draws numbers, and builds an asset with one scene of them.
class Drawn {
 public:
  explicit Drawn(unsigned seed) : engine_(seed) {}

  double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  /// Each order of magnitude is as likely.
  double magnitude(double least, double most) {
    return std::exp(number(std::log(least), std::log(most)));
  }
  int pick(int least, int most) { return std::uniform_int_distribution<int>(least, most)(engine_); }
  double sign() { return pick(0, 1) == 0 ? -1 : 1; }
  Point point(double reach) {
    return {static_cast<float>(number(-reach, reach)), static_cast<float>(number(-reach, reach)),
            static_cast<float>(number(-reach, reach))};
  }
  /// A rotation by an angle in degrees around any axis.
  Four turn(double degrees) {
    std::array<double, 3> axis{number(-1, 1), number(-1, 1), number(0.1, 1)};
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    const double half = degrees * 3.14159265358979 / 360;
    Four turn{};
    for (std::size_t k = 0; k < 3; ++k) {
      turn[k] = static_cast<float>(axis[k] / length * std::sin(half));
    }
    turn[3] = static_cast<float>(std::cos(half));
    return turn;
  }

  /// A box with separate faces, a grid with hills, or a ball, of a width of about `width`.
  Shape shape(double width) {
    const int kind = pick(0, 2);
    if (kind == 0) return box(width);
    return kind == 1 ? sheet(width, false) : sheet(width, true);
  }

  std::size_t positions(const std::vector<Point>& points) {
    std::vector<float> numbers;
    Point least = points.front();
    Point most = points.front();
    for (const Point& each : points) {
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], each[k]);
        most[k] = std::max(most[k], each[k]);
      }
      numbers.insert(numbers.end(), each.begin(), each.end());
    }
    return made.accessor("VEC3", 5126, points.size(), packed(numbers),
                         {{"min", least}, {"max", most}}, {{"target", 34962}});
  }
  template <std::size_t N>
  std::size_t values(const std::string& type, const std::vector<std::array<float, N>>& all,
                     const Json& of_view = Json::object()) {
    std::vector<float> numbers;
    for (const auto& each : all) numbers.insert(numbers.end(), each.begin(), each.end());
    return made.accessor(type, 5126, all.size(), packed(numbers), Json::object(), of_view);
  }
  Json primitive(const Shape& shape) {
    return {{"attributes", {{"POSITION", positions(shape.points)}}},
            {"indices", made.accessor("SCALAR", 5123, shape.corners.size(), packed(shape.corners),
                                      Json::object(), {{"target", 34963}})}};
  }
  std::size_t mesh(Json primitive, const Json& more = Json::object()) {
    Json object{{"primitives", Json::array({std::move(primitive)})}};
    object.update(more);
    return made.add("meshes", std::move(object));
  }
  std::size_t mesh(const Shape& shape) { return mesh(primitive(shape)); }
  /// A node, and a root of the scene.
  std::size_t root(Json node) {
    roots.push_back(made.add("nodes", std::move(node)));
    return roots.back();
  }
  std::size_t root_with(const Shape& shape) { return root({{"mesh", mesh(shape)}}); }

  std::string text() {
    if (has_scene) {
      made.json["scene"] = 0;
      made.json["scenes"] = Json::array({Json::object()});
      if (!roots.empty()) made.json["scenes"][0]["nodes"] = roots;
    }
    return made.text(buffer_uri(made.bytes));
  }

  AssetBuilder made;
  std::vector<std::size_t> roots;
  bool has_scene = true;

 private:
  Shape box(double width) {
    Shape shape;
    const std::array<double, 3> half{width / 2, width / 2 * number(0.2, 1),
                                     width / 2 * number(0.2, 1)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const auto first = static_cast<std::uint16_t>(shape.points.size());
        for (int corner = 0; corner < 4; ++corner) {
          Point point{};
          point[axis] = static_cast<float>(side * half[axis]);
          const std::size_t u = (axis + 1) % 3;
          const std::size_t v = (axis + 2) % 3;
          point[u] = static_cast<float>((corner % 2 == 0 ? -side : side) * half[u]);
          point[v] = static_cast<float>((corner < 2 ? -1 : 1) * half[v]);
          shape.points.push_back(point);
        }
        for (const int corner : {0, 1, 2, 2, 1, 3}) {
          shape.corners.push_back(static_cast<std::uint16_t>(first + corner));
        }
      }
    }
    return shape;
  }
  // A grid, which may be rolled up to a ball.
  Shape sheet(double width, bool ball) {
    Shape shape;
    const int columns = pick(4, 12);
    const int rows = pick(4, 12);
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column <= columns; ++column) {
        const double u = static_cast<double>(column) / columns;
        const double v = static_cast<double>(row) / rows;
        const double around = u * 6.28318530717959;
        const double up = (v - 0.5) * 3.1;
        shape.points.push_back(
            ball ? Point{static_cast<float>(std::cos(around) * std::cos(up) * width / 2),
                         static_cast<float>(std::sin(around) * std::cos(up) * width / 2),
                         static_cast<float>(std::sin(up) * width / 2)}
                 : Point{static_cast<float>((u - 0.5) * width),
                         static_cast<float>((v - 0.5) * width),
                         static_cast<float>(number(0, 0.1) * width)});
        if (row == rows || column == columns) continue;
        const int at = row * (columns + 1) + column;
        for (const int corner :
             {at, at + 1, at + columns + 1, at + columns + 1, at + 1, at + columns + 2}) {
          shape.corners.push_back(static_cast<std::uint16_t>(corner));
        }
      }
    }
    return shape;
  }

  std::mt19937 engine_;
};

inline Shape moved(Shape shape, const std::array<double, 3>& by) {
  for (Point& point : shape.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = static_cast<float>(static_cast<double>(point[k]) + by[k]);
    }
  }
  return shape;
}

using Generator = std::function<void(Drawn&)>;

inline std::set<std::string, std::less<>> codes_of_group(std::string_view group) {
  std::set<std::string, std::less<>> codes;
  for (const RuleDescription& rule : rules()) {
    if (rule.group == group) codes.emplace(rule.code);
  }
  return codes;
}

/// Of each generator; the environment variable GLTFX_DRAWS asks for more.
inline unsigned draws() {
  constexpr unsigned kUsual = 50;
  const char* wanted = std::getenv("GLTFX_DRAWS");
  return wanted == nullptr ? kUsual : static_cast<unsigned>(std::stoul(wanted));
}

/// What `--select` of the group reports on an asset, with pixels; without a severity of its own for
/// hints.
inline FileReport shown(const std::string& asset) {
  ValidateOptions options;
  options.pixels = PixelLevel::needed;
  options.select = codes_of_group("shows");
  return validate_bytes(asset, "test", options);
}

/// Each asset drawn from the generators is found, at a pointer that begins so.
inline void expect_found(const std::string& code, const std::string& pointer,
                         const std::vector<Generator>& generators, unsigned count = draws()) {
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (unsigned seed = 0; seed < count; ++seed) {
      Drawn drawn(seed);
      generators[i](drawn);
      const std::string asset = drawn.text();
      const FileReport report = shown(asset);
      const bool found = std::any_of(
          report.diagnostics.begin(), report.diagnostics.end(), [&](const Diagnostic& each) {
            return each.code == code && each.pointer.substr(0, pointer.size()) == pointer;
          });
      ASSERT_TRUE(found) << code << ": generator " << i << ", seed " << seed << "\n"
                         << asset.substr(0, 3000);
    }
  }
}

/// None of them has a finding of the group, but those that `besides` names: shapes that are drawn
/// one by one have the same corners at times.
inline void expect_silent(const std::vector<Generator>& generators,
                          const std::set<std::string_view>& besides = {"DUPLICATE_ACCESSORS"},
                          unsigned count = draws()) {
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (unsigned seed = 0; seed < count; ++seed) {
      Drawn drawn(seed);
      generators[i](drawn);
      const std::string asset = drawn.text();
      for (const Diagnostic& each : shown(asset).diagnostics) {
        ASSERT_TRUE(besides.count(each.code) > 0)
            << each.code << " " << each.message << ": generator " << i << ", seed " << seed << "\n"
            << asset.substr(0, 3000);
      }
    }
  }
}

}  // namespace gltfx::test
