// SPDX-License-Identifier: Apache-2.0
// Surfaces on the wrong side.
#include "rules/shows_bodies.hpp"

namespace gltfx::test {
namespace {

TEST(NormalsAgainstWinding, IsFound) {
  expect_found("NORMALS_AGAINST_WINDING", "/meshes/0/primitives/",
               {
                   // Normals that point inward.
                   [](Drawn& d) {
                     Body made = body(d);
                     turn_normals(made);
                     d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, made))}}));
                   },
                   // Triangles that face inward.
                   [](Drawn& d) {
                     Body made = body(d);
                     turn_triangles(made);
                     d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, made))}}));
                   },
                   // An open surface, of which either may be wrong.
                   [](Drawn& d) {
                     Body made = hills(d);
                     if (d.pick(0, 1) == 0) {
                       turn_normals(made);
                     } else {
                       turn_triangles(made);
                     }
                     d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, made))}}));
                   },
                   // One of several primitives, drawn by a plain and a mirrored node.
                   [](Drawn& d) {
                     Body good = body(d);
                     Body bad = body(d);
                     turn_normals(bad);
                     const std::size_t mesh = d.made.add(
                         "meshes", {{"primitives", {primitive_of(d, good), primitive_of(d, bad)}}});
                     d.root({{"mesh", mesh}});
                     d.root({{"mesh", mesh}, {"scale", {-1, 1, 1}}, {"translation", {9, 9, 9}}});
                   },
               });
}

TEST(NormalsAgainstWinding, IsNoMirrorImageNorAnOutline) {
  expect_silent({
      [](Drawn& d) {
        d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, body(d)))}}));
      },
      [](Drawn& d) {
        d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, hills(d)))}}));
      },
      // A plain and a mirrored node with one mesh.
      [](Drawn& d) {
        const std::size_t mesh = d.mesh(primitive_of(d, body(d)));
        d.root({{"mesh", mesh}});
        d.root({{"mesh", mesh}, {"scale", {1, -1, 1}}, {"translation", {0, 0, 5}}});
      },
      // Leaves whose normals point up, and cards with two sides.
      [](Drawn& d) {
        d.root({{"mesh", d.mesh(primitive_of(d, leaves(d)))}});
      },
      // A hull that faces inward and draws the outline.
      [](Drawn& d) {
        const Body inner = body(d);
        Body hull = grown(inner, d.number(1.01, 1.1));
        turn_triangles(hull);
        d.root({{"mesh", d.mesh(primitive_of(d, inner))}});
        d.root({{"mesh", d.mesh(primitive_of(d, hull))}});
      },
  });
}

TEST(SurfaceInsideOut, IsFound) {
  expect_found(
      "SURFACE_INSIDE_OUT", "/meshes/0",
      {
          // Normals agree.
          [](Drawn& d) {
            d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, inside_out(body(d))))}}));
          },
          // There are no normals.
          [](Drawn& d) {
            Body made = inside_out(body(d));
            made.normals.clear();
            d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, made))}}));
          },
          // Two halves with their own vertices and materials.
          [](Drawn& d) {
            const Body made = inside_out(body(d));
            d.root(placed(d, {{"mesh", d.made.add("meshes", {{"primitives", halves(d, made)}})}}));
          },
          // Several that are in each other.
          [](Drawn& d) {
            const Body made = inside_out(body(d));
            d.root({{"mesh", d.mesh(primitive_of(d, made))}});
            d.root({{"mesh", d.mesh(primitive_of(d, grown(made, d.number(0.3, 0.5))))}});
          },
      });
}

TEST(SurfaceInsideOut, IsNoRoomSkyOrOpenSurface) {
  expect_silent({
      // A room with a thing in it.
      [](Drawn& d) {
        const Body thing = body(d);
        d.root({{"mesh", d.mesh(primitive_of(d, inside_out(grown(thing, d.number(2, 9)))))},
                {"translation", {0, 0, -0.01}}});
        d.root({{"mesh", d.mesh(primitive_of(d, thing))}});
      },
      // A sky.
      [](Drawn& d) {
        const Body sky = inside_out(body(d));
        d.root({{"name", "SkyDome"}, {"mesh", d.mesh(primitive_of(d, sky))}});
      },
      // A surface with a hole.
      [](Drawn& d) {
        Body made = inside_out(body(d));
        made.shape.corners.resize(made.shape.corners.size() -
                                  3 * static_cast<std::size_t>(d.pick(1, 3)));
        d.root(placed(d, {{"mesh", d.mesh(primitive_of(d, made))}}));
      },
      // A body of two halves.
      [](Drawn& d) {
        d.root(placed(d, {{"mesh", d.made.add("meshes", {{"primitives", halves(d, body(d))}})}}));
      },
  });
}

// What a double-sided material hides is an info.
TEST(SurfaceInsideOut, IsAnInfoIfHidden) {
  Drawn d(1);
  Json primitive = primitive_of(d, inside_out(body(d)));
  primitive["material"] = d.made.add("materials", {{"doubleSided", true}});
  d.root({{"mesh", d.mesh(std::move(primitive))}});
  const FileReport report = shown(d.text());
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics.front().code, "SURFACE_INSIDE_OUT");
  EXPECT_EQ(report.diagnostics.front().severity, Severity::info);
}

TEST(CameraSeesBacks, IsFound) {
  expect_found("CAMERA_SEES_BACKS", "/nodes/0",
               {
                   // Inside of a body.
                   [](Drawn& d) {
                     look(d, {d.number(-0.01, 0.01), 0, d.number(-0.01, 0.01)});
                     Body made = ball(d);
                     d.root({{"mesh", d.mesh(primitive_of(d, made))}});
                   },
                   // Below a surface.
                   [](Drawn& d) {
                     look(d, {d.number(-5, 5), d.number(-5, 5), -d.number(20, 60)});
                     d.root({{"mesh", d.mesh(primitive_of(d, hills(d)))}});
                   },
                   // The same, mirrored, from two places.
                   [](Drawn& d) {
                     look(d, {d.number(-5, 5), d.number(-5, 5), -d.number(20, 60)});
                     look(d, {d.number(-5, 5), d.number(-5, 5), -d.number(20, 60)});
                     d.root({{"mesh", d.mesh(primitive_of(d, hills(d)))},
                             {"scale", {d.number(-1, -0.5), 1, 1}}});
                   },
               });
}

TEST(CameraSeesBacks, IsNoCameraWithAFrontBeforeIt) {
  expect_silent({
      [](Drawn& d) {
        look(d, {d.number(20, 50), d.number(-5, 5), 0});
        d.root({{"mesh", d.mesh(primitive_of(d, ball(d)))}});
      },
      // One of two.
      [](Drawn& d) {
        look(d, {0, 0, -d.number(20, 60)});
        look(d, {0, 0, d.number(20, 60)});
        d.root({{"mesh", d.mesh(primitive_of(d, hills(d)))}});
      },
      // Both sides are drawn.
      [](Drawn& d) {
        look(d, {0, 0, -d.number(20, 60)});
        Json primitive = primitive_of(d, hills(d));
        primitive["material"] = d.made.add("materials", {{"doubleSided", true}});
        d.root({{"mesh", d.mesh(std::move(primitive))}});
      },
  });
}

}  // namespace
}  // namespace gltfx::test
