// SPDX-License-Identifier: Apache-2.0
// Which parts of textures the triangles show.
#include <map>

#include "rules/shows_textured.hpp"

namespace gltfx::test {
namespace {

Json with_base(const Json& texture) { return {{"pbrMetallicRoughness", textured_base(texture)}}; }

UvSheet moved_to(UvSheet sheet, const std::function<Pair(std::size_t)>& place) {
  for (std::size_t i = 0; i < sheet.uvs.size(); ++i) sheet.uvs[i] = place(i);
  return sheet;
}
UvSheet at_place(Drawn& d, Pair place) {
  return moved_to(whole_sheet(d), [=](std::size_t) { return place; });
}
Pair any_place(Drawn& d) {
  return {static_cast<float>(d.number(-2, 2)), static_cast<float>(d.number(-2, 2))};
}

// Another mesh with the material of index 0.
void show_again(Drawn& d, const UvSheet& sheet) {
  Json primitive = d.primitive({sheet.points, sheet.corners});
  primitive["attributes"]["TEXCOORD_0"] = d.values("VEC2", sheet.uvs, {{"target", 34962}});
  primitive["material"] = 0;
  d.root({{"mesh", d.mesh(std::move(primitive))}});
}

TEST(CollapsedCoordinates, AreFound) {
  const std::string code = "UV_COLLAPSED";
  expect_found_in_pictures(
      code, "/meshes/0/primitives/0/attributes/TEXCOORD_0",
      {
          [](Drawn& d) {
            show(d, at_place(d, {0, 0}), with_base(colors(d)));
          },
          [](Drawn& d) { show(d, at_place(d, any_place(d)), with_base(colors(d))); },
          [](Drawn& d) {
            const Pair place = any_place(d);
            show(d, at_place(d, place), with_base(colors(d)));
            show_again(d, at_place(d, place));
          },
          // A normal map on lines.
          [](Drawn& d) {
            const double slope = d.number(-2, 2);
            UvSheet sheet = whole_sheet(d);
            sheet = moved_to(sheet, [&](std::size_t i) {
              const auto u = static_cast<float>(static_cast<double>(i % 7) / 8);
              return Pair{u, static_cast<float>(i % 2 == 0 ? 0 : slope * 0)};
            });
            show(d, sheet, {{"normalTexture", colors(d)}});
          },
      });
  // One of several meshes.
  expect_found_in_pictures(code, "/meshes/1/primitives/0/attributes/TEXCOORD_0", {[](Drawn& d) {
                             show(d, with_base(colors(d)));
                             show_again(d, at_place(d, {0, static_cast<float>(d.pick(0, 1))}));
                           }});
}

TEST(CollapsedCoordinates, MapsAndPalettesAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) { show(d, with_base(colors(d))); },
      // A color for each mesh.
      [](Drawn& d) {
        show(d, at_place(d, {0.1F, 0.1F}), with_base(colors(d)));
        for (int i = d.pick(1, 4); i > 0; --i) show_again(d, at_place(d, any_place(d)));
      },
      [](Drawn& d) {
        show(d, with_base(colors(d)));
        show_again(d, at_place(d, {0.3F, static_cast<float>(d.number(0.1, 0.9))}));
      },
      // A color for each part of a mesh.
      [](Drawn& d) {
        UvSheet sheet = whole_sheet(d);
        show(d,
             moved_to(sheet,
                      [&](std::size_t i) {
                        return Pair{i < 4 ? 0.2F : 0.8F, 0.5F};
                      }),
             with_base(colors(d)));
      },
      // An image of one color.
      [](Drawn& d) {
        const int size = d.pick(20, 60);
        const Json plain = texture_of(d, painted(size, size, PngColor::rgb, [](int, int) {
                                        return Texel{90, 120, 30, 255};
                                      }));
        show(d, at_place(d, {0, 0}), with_base(plain));
      },
      // Coordinates for no texture.
      [](Drawn& d) {
        show(d, at_place(d, {0, 0}), Json::object());
      },
  });
}

Json clamping() { return {{"wrapS", 33071}, {"wrapT", 33071}}; }

TEST(OutsideOfAClampedTexture, IsFound) {
  const std::string pointer = "/meshes/0/primitives/0/attributes/TEXCOORD_0";
  expect_found_in_pictures(
      "UV_OUTSIDE_CLAMPED", pointer,
      {
          [](Drawn& d) {
            const double by = d.number(1.01, 9) * d.sign();
            show(d, sheet_over(d, by, 0, by + d.number(0.2, 1) * (by > 0 ? 1 : -0.01), 1),
                 with_base(colors(d, 32, clamping())));
          },
          // One tile of many, along one axis.
          [](Drawn& d) {
            show(d, sheet_over(d, 0, 0, 1, d.number(6, 20)),
                 with_base(colors(d, 32, {{"wrapT", 33071}})));
          },
          [](Drawn& d) {
            const double u = d.pick(1, 9);
            show(d, sheet_over(d, u + 0.01, 0.02, u + 0.95, 0.98),
                 with_base(colors(d, 32, clamping())));
          },
      });
}

TEST(OutsideOfAClampedTexture, BordersRepeatsAndDecalsAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        const double over = d.number(0, 0.05);
        show(d, sheet_over(d, -over, -over, 1 + over, 1 + over),
             with_base(colors(d, 32, clamping())));
      },
      [](Drawn& d) {
        show(d, sheet_over(d, 3, 3, 5, 6), with_base(colors(d, 32, {{"wrapS", 10497}})));
      },
      // The other axis is clamped.
      [](Drawn& d) {
        show(d, sheet_over(d, 4, 0, 9, 1), with_base(colors(d, 32, {{"wrapT", 33071}})));
      },
      [](Drawn& d) {
        Json material =
            with_base(texture_of(d,
                                 painted(32, 32, PngColor::rgba,
                                         [&](int x, int) {
                                           return Texel{d.pick(0, 255), 9, 9, x < 9 ? 0 : 255};
                                         }),
                                 {}, clamping()));
        material["alphaMode"] = d.pick(0, 1) == 0 ? "BLEND" : "MASK";
        show(d, sheet_over(d, -4, -4, 5, 5), material);
      },
  });
}

constexpr int kLarge = 1024;

// Stripes in one bit, made once for a size.
const std::string& striped(int size) {
  static std::map<int, std::string> made;
  std::string& png = made[size];
  if (png.empty()) {
    const auto side = static_cast<std::size_t>(size);
    png = encode_png({static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size),
                      PngColor::grey, 1, std::string(side * side / 8, '\x3c')});
  }
  return png;
}

TEST(BarelyUsedTexture, IsFound) {
  expect_found_in_pictures("TEXTURE_BARELY_USED", "/meshes/0/primitives/0/attributes/TEXCOORD_0",
                           {
                               [](Drawn& d) {
                                 const double size = d.number(0.0005, 0.004);
                                 const double at = d.number(-1, 1);
                                 show(d, sheet_over(d, at, at, at + size, at + size),
                                      with_base(texture_of(d, striped(kLarge))));
                               },
                               // A line across the image.
                               [](Drawn& d) {
                                 const double at = d.number(0, 1);
                                 show(d, sheet_over(d, at, 0, at, d.number(0.01, 0.02)),
                                      with_base(texture_of(d, striped(2 * kLarge))));
                               },
                               [](Drawn& d) {
                                 show(d, sheet_over(d, 0, 0, 0.003, d.number(0.001, 0.004)),
                                      with_base(texture_of(d, striped(2 * kLarge))));
                                 show_again(d, sheet_over(d, 0.5, 0.5, 0.502, 0.503));
                               },
                           });
}

TEST(BarelyUsedTexture, OtherTexturesAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) { show(d, with_base(texture_of(d, striped(kLarge)))); },
      [](Drawn& d) {
        show(d, sheet_over(d, 0.2, 0.2, d.number(0.3, 9), d.number(0.3, 9)),
             with_base(texture_of(d, striped(kLarge))));
      },
      [](Drawn& d) {
        show(d, sheet_over(d, 0, 0, 0.002, 0.002), with_base(texture_of(d, striped(kLarge / 2))));
      },
      [](Drawn& d) {
        show(d, sheet_over(d, 0, 0, 0.002, 0.002), with_base(texture_of(d, striped(kLarge))));
        show_again(d, whole_sheet(d));
      },
  });
}

}  // namespace
}  // namespace gltfx::test
