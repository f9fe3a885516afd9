// SPDX-License-Identifier: Apache-2.0
// Skinned meshes at rest, and morph targets.
#include "model/node.hpp"
#include "rules/shows_assets.hpp"

namespace gltfx::test {
namespace {

using model::Affine;

Affine moved_by(const std::array<double, 3>& by) {
  Affine affine;
  affine.columns[3] = by;
  return affine;
}

Matrix inverse_of(const Affine& rigid) {
  Matrix matrix{};
  matrix[15] = 1;
  for (std::size_t column = 0; column < 3; ++column) {
    double back = 0;
    for (std::size_t row = 0; row < 3; ++row) {
      matrix[row * 4 + column] = static_cast<float>(rigid.columns[column][row]);
      back -= rigid.columns[column][row] * rigid.columns[3][row];
    }
    matrix[12 + column] = static_cast<float>(back);
  }
  return matrix;
}

// A limb: a tube along +y over a chain of joints, bound in rows of vertices to the nearest two.
struct Limb {
  std::vector<std::array<double, 3>> offsets;  ///< of each joint from the one before
  std::vector<Matrix> bind;                    ///< inverse bind matrices
  double width = 0;                            ///< the height of the tube
};

Limb limb(Drawn& d, std::size_t joints) {
  Limb made;
  Affine world;
  for (std::size_t i = 0; i < joints; ++i) {
    const double bone = i == 0 ? 0 : d.number(0.8, 1.2);
    made.offsets.push_back({d.number(-0.05, 0.05), bone, d.number(-0.05, 0.05)});
    world = world * moved_by(made.offsets.back());
    made.bind.push_back(inverse_of(world));
    made.width += bone;
  }
  return made;
}

void build(Drawn& d, const Limb& limb, const std::vector<Json>& nodes, bool matrices = true,
           const Json& armature = Json::object()) {
  const std::size_t joints = limb.offsets.size();
  Shape tube;
  std::vector<Four> weights;
  std::vector<std::uint8_t> influences;
  const int around = 6;
  const int rows = static_cast<int>(joints) * 3;
  for (int row = 0; row <= rows; ++row) {
    const double at = static_cast<double>(row) / rows;
    const double joint = at * static_cast<double>(joints - 1);
    const auto lower = std::min(static_cast<std::size_t>(joint), joints - 2);
    const auto share = static_cast<float>(joint - static_cast<double>(lower));
    for (int side = 0; side < around; ++side) {
      const double angle = side * 6.28318530717959 / around;
      tube.points.push_back({static_cast<float>(std::cos(angle) * 0.3),
                             static_cast<float>(at * limb.width),
                             static_cast<float>(std::sin(angle) * 0.3)});
      const bool second = share > 0;
      const bool first = share < 1;
      weights.push_back({first ? 1 - share : 0, second ? share : 0, 0, 0});
      influences.push_back(static_cast<std::uint8_t>(first ? lower : 0));
      influences.push_back(static_cast<std::uint8_t>(second ? lower + 1 : 0));
      if (!first) {
        weights.back() = {1, 0, 0, 0};
        influences[influences.size() - 2] = static_cast<std::uint8_t>(lower + 1);
        influences.back() = 0;
      }
      influences.push_back(0);
      influences.push_back(0);
      if (row == rows) continue;
      const int next = (side + 1) % around;
      for (const int corner :
           {row * around + side, row * around + next, (row + 1) * around + side,
            (row + 1) * around + side, row * around + next, (row + 1) * around + next}) {
        tube.corners.push_back(static_cast<std::uint16_t>(corner));
      }
    }
  }
  Json primitive = d.primitive(tube);
  primitive["attributes"]["JOINTS_0"] = d.made.accessor(
      "VEC4", 5121, weights.size(), packed(influences), Json::object(), {{"target", 34962}});
  primitive["attributes"]["WEIGHTS_0"] = d.values("VEC4", weights, {{"target", 34962}});
  Json skin{{"joints", Json::array()}};
  if (matrices) skin["inverseBindMatrices"] = d.values("MAT4", limb.bind);
  d.root({{"mesh", d.mesh(std::move(primitive))}, {"skin", 0}});
  Json top = armature;
  top["children"] = {2};
  d.root(top);
  for (std::size_t i = 0; i < joints; ++i) {
    Json node = nodes[i];
    node["name"] = fmt::format("joint {}", i);
    if (i + 1 < joints) node["children"] = {i + 3};
    skin["joints"].push_back(d.made.add("nodes", std::move(node)));
  }
  d.made.add("skins", std::move(skin));
}

// The joints as they were bound.
std::vector<Json> as_bound(const Limb& limb) {
  std::vector<Json> nodes;
  for (const auto& offset : limb.offsets) nodes.push_back({{"translation", offset}});
  return nodes;
}

TEST(SkinStretchedAtRest, IsFound) {
  expect_found("SKIN_STRETCHED_AT_REST", "/skins/0",
               {
                   // Two matrices change places.
                   [](Drawn& d) {
                     Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 8)));
                     std::swap(made.bind.front(), made.bind.back());
                     build(d, made, as_bound(made));
                   },
                   // They are in the reverse order.
                   [](Drawn& d) {
                     Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 8)));
                     std::reverse(made.bind.begin(), made.bind.end());
                     build(d, made, as_bound(made));
                   },
                   // The bones are several times as long as those that were bound.
                   [](Drawn& d) {
                     const Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 5)));
                     std::vector<Json> nodes;
                     const double longer = d.number(6, 50);
                     for (auto offset : made.offsets) {
                       for (double& each : offset) each *= longer;
                       nodes.push_back({{"translation", offset}});
                     }
                     build(d, made, nodes);
                   },
               });
}

TEST(SkinStretchedAtRest, IsNoOtherPoseSizeOrPlace) {
  expect_silent({
      [](Drawn& d) {
        const Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 8)));
        build(d, made, as_bound(made));
      },
      // Each joint is turned.
      [](Drawn& d) {
        const Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 8)));
        std::vector<Json> nodes = as_bound(made);
        for (Json& node : nodes) node["rotation"] = d.turn(d.number(-100, 100));
        build(d, made, nodes);
      },
      // The armature is in centimeters, turned and elsewhere.
      [](Drawn& d) {
        const Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 8)));
        const double scale = d.magnitude(0.01, 100);
        build(d, made, as_bound(made), true,
              {{"scale", {scale, scale, scale}},
               {"rotation", d.turn(90)},
               {"translation", {d.number(-50, 50), 0, d.number(-50, 50)}}});
      },
      // The hip sits somewhere else, and bones are a little longer.
      [](Drawn& d) {
        const Limb made = limb(d, static_cast<std::size_t>(d.pick(3, 8)));
        std::vector<Json> nodes;
        for (auto offset : made.offsets) {
          offset[1] *= d.number(0.9, 1.1);
          nodes.push_back({{"translation", offset}});
        }
        nodes.front()["translation"] = {d.number(-9, 9), d.number(-9, 9), 0};
        build(d, made, nodes);
      },
  });
}

// A mesh with a target that moves one vertex, or all, by a number of widths.
void morph(Drawn& d, double widths, bool all) {
  const double width = d.magnitude(0.1, 10);
  const Shape shape = d.shape(width);
  std::vector<Point> moves(shape.points.size(), Point{});
  const auto axis = static_cast<std::size_t>(d.pick(0, 2));
  for (Point& move : moves) {
    move[axis] = static_cast<float>(d.sign() * widths * width * d.number(0.99, 1));
    if (!all) break;
  }
  Json primitive = d.primitive(shape);
  primitive["targets"] = Json::array({{{"POSITION", d.positions(moves)}}});
  d.root({{"mesh", d.mesh(std::move(primitive), {{"weights", {0}}})}});
}

TEST(MorphTargetFar, IsFound) {
  expect_found("MORPH_TARGET_FAR", "/meshes/0/primitives/0/targets/0/POSITION",
               {
                   [](Drawn& d) { morph(d, d.magnitude(11, 1e4), false); },
                   [](Drawn& d) { morph(d, d.magnitude(11, 1e4), true); },
                   [](Drawn& d) { morph(d, 100, d.pick(0, 1) == 0); },
               });
}

TEST(MorphTargetFar, IsNotAnUsualTarget) {
  expect_silent({
      [](Drawn& d) { morph(d, d.magnitude(0.001, 1), false); },
      [](Drawn& d) { morph(d, d.magnitude(0.001, 5), true); },
      [](Drawn& d) { morph(d, 0, true); },
  });
}

}  // namespace
}  // namespace gltfx::test
