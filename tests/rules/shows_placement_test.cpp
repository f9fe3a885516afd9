// SPDX-License-Identifier: Apache-2.0
// Units, places, and surfaces in one place.
#include "rules/shows_bodies.hpp"

namespace gltfx::test {
namespace {

Json of_body(Drawn& d, const Body& made) { return {{"mesh", d.mesh(primitive_of(d, made))}}; }
Body sized(Drawn& d, double width) {
  Body made = ball(d);
  float reach = 0;
  for (const Point& each : made.shape.points) reach = std::max({reach, each[0], each[2]});
  return grown(made, width / 2 / static_cast<double>(reach));
}

// A skeleton with names of a usual rig, so tall; the mesh is bound to the hips.
void human(Drawn& d, double height, const std::string& prefix) {
  struct Bone {
    const char* name;
    int parent;
    double x, y;
  };
  const std::array<Bone, 11> bones{{{"Hips", -1, 0, 0.5},
                                    {"Spine", 0, 0, 0.15},
                                    {"Neck", 1, 0, 0.25},
                                    {"Head", 2, 0, 0.1},
                                    {"LeftArm", 1, 0.1, 0.2},
                                    {"LeftHand", 4, 0.3, 0},
                                    {"RightArm", 1, -0.1, 0.2},
                                    {"RightHand", 6, -0.3, 0},
                                    {"LeftUpLeg", 0, 0.1, 0},
                                    {"LeftFoot", 8, 0, -0.5},
                                    {"RightFoot", 0, -0.1, -0.5}}};
  Body made = sized(d, height);
  Json primitive = primitive_of(d, made);
  const std::size_t count = made.shape.points.size();
  primitive["attributes"]["JOINTS_0"] =
      d.made.accessor("VEC4", 5121, count, packed(std::vector<std::uint8_t>(4 * count, 0)),
                      Json::object(), {{"target", 34962}});
  primitive["attributes"]["WEIGHTS_0"] =
      d.values("VEC4", std::vector<Four>(count, Four{1, 0, 0, 0}), {{"target", 34962}});
  d.root({{"mesh", d.mesh(std::move(primitive))}, {"skin", 0}});
  Json joints = Json::array();
  for (std::size_t i = 0; i < bones.size(); ++i) {
    Json node{{"name", prefix + bones[i].name},
              {"translation", {bones[i].x * height, bones[i].y * height, 0}}};
    for (std::size_t k = 0; k < bones.size(); ++k) {
      if (bones[k].parent == static_cast<int>(i)) node["children"].push_back(k + 1);
    }
    joints.push_back(i == 0 ? d.root(node) : d.made.add("nodes", node));
  }
  d.made.add("skins", {{"joints", joints}});
}

TEST(UnitsNotMeters, IsFound) {
  expect_found(
      "UNITS_NOT_METERS", "",
      {
          // A tiny scene.
          [](Drawn& d) { d.root(of_body(d, sized(d, d.magnitude(1.1e-4, 4.9e-3)))); },
          // One large thing.
          [](Drawn& d) { d.root(of_body(d, sized(d, d.magnitude(81, 9e7)))); },
          // A human that is far too tall, or far too small.
          [](Drawn& d) { human(d, d.number(0.5, 2.5) * 100 * d.pick(1, 10), "mixamorig:"); },
          [](Drawn& d) { human(d, d.number(0.5, 2.5) / 100 * d.number(0.1, 1), "J_"); },
      });
}

TEST(UnitsNotMeters, IsNotGuessedAtWithoutEvidence) {
  expect_silent({
      [](Drawn& d) { d.root(of_body(d, sized(d, d.magnitude(6e-3, 79)))); },
      [](Drawn& d) { human(d, d.number(0.3, 4), "mixamorig:"); },
      // A large thing with the name of one.
      [](Drawn& d) {
        Json node = of_body(d, sized(d, d.magnitude(100, 1e4)));
        node["name"] = d.pick(0, 1) == 0 ? "Tower_02" : "old building";
        d.root(node);
      },
      // A landscape.
      [](Drawn& d) { d.root(of_body(d, grown(hills(d), d.magnitude(10, 1e4)))); },
      // Several things.
      [](Drawn& d) {
        d.root(of_body(d, sized(d, 100)));
        Json node = of_body(d, sized(d, 1));
        node["translation"] = {120, 0, 0};
        d.root(node);
      },
  });
}

TEST(PartFarAway, IsFound) {
  expect_found(
      "PART_FAR_AWAY", "/nodes/",
      {
          // One of two.
          [](Drawn& d) {
            d.root(of_body(d, sized(d, 1)));
            Json node = of_body(d, sized(d, d.number(0.2, 1)));
            node["translation"] = {0, d.sign() * d.magnitude(1100, 1e5), 0};
            d.root(node);
          },
          // One of many.
          [](Drawn& d) {
            const int count = d.pick(3, 20);
            for (int i = 0; i < count; ++i) {
              Json node = of_body(d, sized(d, d.number(0.2, 1)));
              node["translation"] = {d.number(-2, 2), d.number(-2, 2), d.number(-2, 2)};
              if (i == count / 2) node["translation"][2] = d.magnitude(2e4, 1e6);
              d.root(node);
            }
          },
          // By the translation of a parent.
          [](Drawn& d) {
            d.root(of_body(d, sized(d, 1)));
            const std::size_t child = d.made.add("nodes", of_body(d, sized(d, 1)));
            d.root({{"children", {child}}, {"translation", {d.magnitude(1100, 1e5), 0, 0}}});
          },
      });
}

TEST(PartFarAway, IsNoWideScene) {
  expect_silent({
      // Things all over.
      [](Drawn& d) {
        for (int i = d.pick(2, 12); i > 0; --i) {
          Json node = of_body(d, sized(d, d.number(0.5, 1)));
          if (!d.roots.empty()) {
            node["translation"] = {d.number(-200, 200), 0, d.number(-5, 5) + i};
          }
          d.root(node);
        }
      },
      // It comes from far away.
      [](Drawn& d) {
        d.root(of_body(d, sized(d, 1)));
        Json node = of_body(d, sized(d, 1));
        node["translation"] = {d.magnitude(1100, 1e5), 0, 0};
        d.root(node);
        d.made.add(
            "animations",
            {{"samplers",
              {{{"input", d.made.accessor("SCALAR", 5126, 2, packed(std::vector<float>{0, 1}),
                                          {{"min", {0}}, {"max", {1}}})},
                {"output", d.values<3>("VEC3", {{5000, 0, 0}, {0, 0, 0}})}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
      },
      // A large thing around a small one.
      [](Drawn& d) {
        d.root(of_body(d, sized(d, 1)));
        Json node = of_body(d, sized(d, d.magnitude(10, 500)));
        node["translation"] = {0, 0, d.number(-900, 900)};
        d.root(node);
      },
  });
}

TEST(PivotFarOutside, IsFound) {
  expect_found("PIVOT_FAR_OUTSIDE", "/scenes/0",
               {
                   [](Drawn& d) {
                     Json node = of_body(d, sized(d, 1));
                     node["translation"] = {d.sign() * d.magnitude(12, 1e4), 0, 0};
                     d.root(node);
                   },
                   [](Drawn& d) {
                     d.root_with(moved(sized(d, 1).shape, {0, d.sign() * d.magnitude(12, 1e3), 0}));
                   },
                   [](Drawn& d) {
                     for (int i = 0; i < 3; ++i) {
                       Json node = of_body(d, sized(d, 1));
                       node["translation"] = {d.number(0, 3), d.magnitude(60, 1e3) * 0 + 70, 0};
                       d.root(node);
                     }
                   },
               });
}

TEST(PivotFarOutside, IsNotBesideTheOrigin) {
  expect_silent({
      [](Drawn& d) {
        Json node = of_body(d, sized(d, 1));
        node["translation"] = {d.number(-9, 9), 0, 0};
        d.root(node);
      },
      [](Drawn& d) {
        d.root_with(moved(sized(d, 1).shape, {0, d.number(-9, 9), 0}));
      },
      [](Drawn& d) {
        d.root(of_body(d, sized(d, 1)));
        Json node = of_body(d, sized(d, 1));
        node["translation"] = {d.number(10, 90), 0, 0};
        d.root(node);
      },
  });
}

Json two_materials(Drawn& d, Json mesh) {
  mesh["primitives"][1]["material"] = d.made.add("materials", {{"name", "red"}});
  return mesh;
}

TEST(TrianglesCoincide, IsFound) {
  expect_found(
      "TRIANGLES_COINCIDE", "/",
      {
          // Two primitives with one set of numbers.
          [](Drawn& d) {
            const Json primitive = primitive_of(d, body(d));
            d.root(placed(
                d, {{"mesh", d.made.add("meshes", two_materials(d, {{"primitives",
                                                                     {primitive, primitive}}}))}}));
          },
          // A copy in another place of the file, drawn where it was moved to.
          [](Drawn& d) {
            const Body made = body(d);
            d.root(of_body(d, made));
            const std::array<double, 3> by{d.number(-3, 3), d.number(-3, 3), d.number(-3, 3)};
            Body copy = made;
            copy.shape = moved(made.shape, by);
            Json node = of_body(d, copy);
            node["translation"] = {-by[0], -by[1], -by[2]};
            d.root(node);
          },
          // A node that was copied in place.
          [](Drawn& d) {
            const Json node = placed(d, of_body(d, body(d)));
            d.root(node);
            d.root(node);
          },
          // Most of the triangles, in another order.
          [](Drawn& d) {
            const Body made = sized(d, 1);
            d.root(of_body(d, made));
            Body copy = made;
            auto& corners = copy.shape.corners;
            std::rotate(corners.begin(), corners.begin() + 3 * d.pick(1, 5), corners.end());
            corners.resize(corners.size() / 3 * 2 / 3 * 3 + 3);
            copy.normals.clear();
            d.root(of_body(d, copy));
          },
          // Twice in one primitive.
          [](Drawn& d) {
            Body made = sized(d, 1);
            auto& corners = made.shape.corners;
            const std::vector<std::uint16_t> again(corners.begin(), corners.end());
            corners.insert(corners.end(), again.begin(), again.end());
            d.root(of_body(d, made));
          },
      });
}

TEST(TrianglesCoincide, IsNoOtherSideLayerOrPlace) {
  expect_silent({
      // Next to each other.
      [](Drawn& d) {
        const std::size_t mesh = d.mesh(primitive_of(d, sized(d, 1)));
        d.root({{"mesh", mesh}});
        d.root({{"mesh", mesh}, {"translation", {d.number(0.02, 2), 0, 0}}});
      },
      // The two sides of a surface.
      [](Drawn& d) {
        Body made = hills(d);
        d.root(of_body(d, made));
        d.root(of_body(d, inside_out(made)));
      },
      // A layer that is blended or cut out.
      [](Drawn& d) {
        Json primitive = primitive_of(d, hills(d));
        const Json below = primitive;
        primitive["material"] =
            d.made.add("materials", {{"alphaMode", d.pick(0, 1) == 0 ? "BLEND" : "MASK"}});
        d.root({{"mesh", d.made.add("meshes", {{"primitives", {below, primitive}}})}});
      },
      // Two shapes with the same bounds.
      [](Drawn& d) {
        const std::vector<std::array<double, 2>> thin{{0, 0}, {1, 0.5}, {1, 1}, {0, 2}};
        const std::vector<std::array<double, 2>> thick{{0, 0}, {0.5, 0.5}, {1, 1.5}, {0, 2}};
        d.root(of_body(d, lathe(thin, 4 * d.pick(1, 8), false)));
        d.root(of_body(d, lathe(thick, 4 * d.pick(1, 8), false)));
      },
  });
}

// A rectangle with its front up.
Json plate(Drawn& d, double x, double y, double z, double width, double depth) {
  Shape shape;
  for (const int corner : {0, 1, 2, 3}) {
    shape.points.push_back({static_cast<float>(x + (corner % 2 == 0 ? 0 : width)),
                            static_cast<float>(y),
                            static_cast<float>(z + (corner < 2 ? 0 : depth))});
  }
  shape.corners = {0, 2, 1, 1, 2, 3};
  return {{"mesh", d.mesh(shape)}};
}

TEST(PlanesOverlap, IsFound) {
  expect_found("PLANES_OVERLAP", "/nodes/",
               {
                   [](Drawn& d) {
                     d.root(plate(d, -5, 0, -5, 10, 10));
                     d.root(plate(d, -1, 0, d.number(-4, 0), d.number(1, 3), 3));
                   },
                   [](Drawn& d) {
                     const double height = d.number(-1, 1);
                     d.root(plate(d, 0, height, 0, 2, 2));
                     d.root(plate(d, d.number(0.1, 1.3), height, 0, 2, 2));
                   },
                   [](Drawn& d) {
                     d.root(plate(d, -5, 0, -5, 10, 10));
                     Json node = plate(d, -1, 1, -1, 2, 2);
                     node["translation"] = {d.number(-3, 3), -1, 0};
                     d.root(node);
                   },
               });
}

TEST(PlanesOverlap, IsNoOtherHeightSideOrPlace) {
  expect_silent({
      [](Drawn& d) {
        d.root(plate(d, -5, 0, -5, 10, 10));
        d.root(plate(d, -1, d.sign() * d.magnitude(0.001, 1), -1, 2, 2));
      },
      [](Drawn& d) {
        d.root(plate(d, 0, 0, 0, 2, 2));
        d.root(plate(d, d.number(1.6, 3), 0, 0, 2, 2));
      },
      [](Drawn& d) {
        d.root(plate(d, -5, 0, -5, 10, 10));
        Json node = plate(d, -1, 0, -1, 2, d.number(1, 3));
        node["scale"] = {1, 1, -1};
        node["rotation"] = {0, 0, 1, 0};
        d.root(node);
      },
  });
}

}  // namespace
}  // namespace gltfx::test
