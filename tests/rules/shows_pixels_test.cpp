// SPDX-License-Identifier: Apache-2.0
// What the pixels of textures make of a surface.
#include "rules/shows_textured.hpp"

namespace gltfx::test {
namespace {

// --- Occlusion ---

std::string packed_map(Drawn& d, int least, int most) {
  return painted(d.pick(4, 40), d.pick(4, 40), PngColor::rgb, [&](int, int) {
    return Texel{d.pick(least, most), d.pick(0, 255), d.pick(0, 255), 255};
  });
}
Json with_occlusion(Json texture, double strength, const Json& more = Json::object()) {
  texture["strength"] = strength;
  Json material{{"occlusionTexture", texture}};
  material.update(more);
  return material;
}

TEST(BlackOcclusion, IsFound) {
  expect_found_in_pictures(
      "OCCLUSION_BLACK", "/materials/0/occlusionTexture",
      {
          [](Drawn& d) {
            const Json map = texture_of(d, packed_map(d, 0, 0));
            show(d, with_occlusion(
                        map, 1, {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", map}}}}));
          },
          [](Drawn& d) {
            const std::string black = painted(d.pick(2, 30), d.pick(2, 30), PngColor::grey,
                                              [](int, int) { return Texel{}; });
            show(d, with_occlusion(texture_of(d, black), d.number(0.91, 1)));
          },
          [](Drawn& d) { show(d, with_occlusion(texture_of(d, packed_map(d, 0, 5)), 1)); },
      });
}

TEST(BlackOcclusion, ShadesAndWeakMapsAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) { show(d, with_occlusion(texture_of(d, packed_map(d, 0, 255)), 1)); },
      [](Drawn& d) {
        show(d, with_occlusion(texture_of(d, packed_map(d, 0, 0)), d.number(0, 0.8)));
      },
      [](Drawn& d) {
        d.made.json["extensionsUsed"] = Json::array({"KHR_materials_unlit"});
        show(d, with_occlusion(texture_of(d, packed_map(d, 0, 0)), 1,
                               {{"extensions", {{"KHR_materials_unlit", Json::object()}}}}));
      },
      [](Drawn& d) { show(d, with_occlusion(texture_of(d, packed_map(d, 20, 60)), 1)); },
  });
}

// --- Relief ---

// A height and its slopes to the right and down, in texels.
struct Relief {
  std::vector<std::array<double, 5>> bumps;  // x, y, width, height, and how sharp

  static Relief round(Drawn& d, int size) {
    Relief relief;
    for (int i = 0; i < size * size / 60; ++i) {
      const double width = d.number(4, 12);
      relief.bumps.push_back(
          {d.number(0, size), d.number(0, size), width, d.number(0.2, 0.5) * width * d.sign(), 1});
    }
    return relief;
  }
  // Bumps in rows, all alike.
  static Relief studs(Drawn& d, int size) {
    Relief relief;
    const double apart = d.number(9, 16);
    const double width = apart * d.number(0.3, 0.45);
    const double height = width * d.number(0.3, 0.8) * d.sign();
    for (double y = apart / 2; y < size; y += apart) {
      for (double x = apart / 2; x < size; x += apart) {
        relief.bumps.push_back({x, y, width, height, 1});
      }
    }
    return relief;
  }
  std::array<double, 2> slopes(double x, double y) const {
    std::array<double, 2> sum{};
    for (const auto& [cx, cy, width, height, sharp] : bumps) {
      const double dx = (x - cx) / width;
      const double dy = (y - cy) / width;
      const double value = height * std::exp(-sharp * (dx * dx + dy * dy));
      sum[0] -= 2 * sharp * dx / width * value;
      sum[1] -= 2 * sharp * dy / width * value;
    }
    return sum;
  }
};

enum class Green { up, down };

Painter normals_of(Drawn& d, const Relief& relief, Green green, int noise) {
  return [&d, relief, green, noise](int x, int y) {
    const auto [right, down] = relief.slopes(x + 0.5, y + 0.5);
    const double length = std::sqrt(right * right + down * down + 1);
    const double g = green == Green::up ? down : -down;
    const auto code = [&](double value) {
      return static_cast<int>(std::lround((value / length + 1) * 127.5)) +
             (noise > 0 ? d.pick(-noise, noise) : 0);
    };
    return Texel{code(-right), code(g), code(1), 255};
  };
}

std::string normal_png(Drawn& d, Relief (*make)(Drawn&, int), Green green, int noise) {
  const int size = d.pick(56, 120);
  return painted(size, size, PngColor::rgb, normals_of(d, make(d, size), green, noise));
}

// With normals, and with tangents whose w is that of glTF (1) or the other one.
void show_relief(Drawn& d, const std::string& png, double w) {
  const UvSheet sheet = whole_sheet(d);
  const std::vector<Point> normals(sheet.points.size(), Point{0, 0, 1});
  const std::vector<Four> tangents(sheet.points.size(), Four{1, 0, 0, static_cast<float>(w)});
  Json attributes{{"NORMAL", d.values("VEC3", normals)}};
  if (w != 0) attributes["TANGENT"] = d.values("VEC4", tangents);
  show(d, sheet, {{"normalTexture", texture_of(d, png)}}, attributes);
}

TEST(DirectXNormalMap, IsFound) {
  expect_found_in_pictures(
      "NORMAL_MAP_DIRECTX", "/materials/0/normalTexture",
      {
          [](Drawn& d) { show_relief(d, normal_png(d, Relief::round, Green::down, 0), 0); },
          [](Drawn& d) { show_relief(d, normal_png(d, Relief::studs, Green::down, 0), 1); },
          [](Drawn& d) { show_relief(d, normal_png(d, Relief::round, Green::down, 2), 1); },
      });
}

TEST(DirectXNormalMap, OtherMapsAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) { show_relief(d, normal_png(d, Relief::round, Green::up, 0), 0); },
      [](Drawn& d) { show_relief(d, normal_png(d, Relief::studs, Green::up, 2), 1); },
      // Tangents that were made for such a map.
      [](Drawn& d) { show_relief(d, normal_png(d, Relief::round, Green::down, 1), -1); },
      // Directions that no surface has.
      [](Drawn& d) {
        show_relief(d,
                    painted(64, 64, PngColor::rgb,
                            [&](int, int) {
                              return Texel{128 + d.pick(-40, 40), 128 + d.pick(-40, 40), 245, 255};
                            }),
                    0);
      },
      // Grooves along the edges of the image look alike in both conventions.
      [](Drawn& d) {
        const int apart = d.pick(8, 20);
        show_relief(d,
                    painted(96, 96, PngColor::rgb,
                            [&](int x, int y) {
                              return Texel{x % apart == 0   ? 90
                                           : x % apart == 2 ? 165
                                                            : 128,
                                           y % apart == 0   ? 90
                                           : y % apart == 2 ? 165
                                                            : 128,
                                           245, 255};
                            }),
                    0);
      },
  });
}

TEST(NormalMapAsColor, IsFound) {
  expect_found_in_pictures(
      "NORMAL_MAP_AS_COLOR", "/materials/0/",
      {
          [](Drawn& d) {
            const Json map = texture_of(d, normal_png(d, Relief::round, Green::up, 0));
            show(d, {{"pbrMetallicRoughness", textured_base(map)}});
          },
          [](Drawn& d) {
            const Json map = texture_of(d, normal_png(d, Relief::studs, Green::down, 1));
            show(d, {{"pbrMetallicRoughness", textured_base(map)}});
          },
          [](Drawn& d) {
            const Json map = texture_of(d, normal_png(d, Relief::round, Green::up, 2));
            show(d, {{"emissiveTexture", map}, {"emissiveFactor", {0.5, d.number(0.1, 0.6), 0.5}}});
          },
      });
}

TEST(NormalMapAsColor, PicturesAreNotReported) {
  const auto base = [](Drawn& d, const Painter& paint) {
    const std::string png = painted(d.pick(40, 90), d.pick(40, 90), PngColor::rgb, paint);
    show(d, {{"pbrMetallicRoughness", textured_base(texture_of(d, png))}});
  };
  expect_silent_in_pictures({
      // The sky has colors of about unit length.
      [&](Drawn& d) {
        const int top = d.pick(100, 140);
        base(d, [&](int x, int y) {
          return Texel{top + y / 2, top + 60 + y / 2, 235 + x % 3, 255};
        });
      },
      // Clouds of light violet.
      [&](Drawn& d) {
        base(d, [&](int, int) {
          return Texel{128 + d.pick(-30, 30), 128 + d.pick(-30, 30), 250, 255};
        });
      },
      // Bricks.
      [&](Drawn& d) {
        const int width = d.pick(6, 20);
        base(d, [&](int x, int y) {
          return x % width == 0 || y % 8 == 0 ? Texel{200, 200, 190, 255}
                                              : Texel{150 + d.pick(-9, 9), 60, 40, 255};
        });
      },
      [](Drawn& d) { show_relief(d, normal_png(d, Relief::round, Green::up, 0), 0); },
  });
}

// --- Alpha ---

// Opaque up to a column; the alpha beyond is drawn by `rest`.
Json partly_opaque(Drawn& d, int size, int column, const std::function<int(int, int)>& rest) {
  return texture_of(
      d, painted(size, size, PngColor::rgba, [&](int x, int y) {
        return Texel{d.pick(0, 200), d.pick(0, 200), d.pick(0, 200), x < column ? 255 : rest(x, y)};
      }));
}

Json with_alpha(const char* mode, const Json& texture, const Json& more = Json::object()) {
  return {{"alphaMode", mode}, {"pbrMetallicRoughness", textured_base(texture, more)}};
}

TEST(BlendShowsOpaque, IsFoundWhereOnlyTheRestIsTransparent) {
  expect_found_in_pictures(
      "BLEND_SHOWS_OPAQUE", "/materials/0/pbrMetallicRoughness/baseColorTexture",
      {
          [](Drawn& d) {
            const int column = d.pick(10, 30);
            const Json map = partly_opaque(d, 40, column, [](int, int) { return 0; });
            show(d, sheet_over(d, 0, 0, (column - 0.6) / 40, d.number(0.2, 1)),
                 with_alpha("BLEND", map));
          },
          [](Drawn& d) {
            const int column = d.pick(10, 30);
            const Json map = partly_opaque(d, 40, column, [&](int, int) { return d.pick(0, 200); });
            show(d, sheet_over(d, 0.05, 0.9, (column - 1.2) / 40, d.number(0, 0.6)),
                 with_alpha("BLEND", map));
          },
          // Two parts with one material, in another tile.
          [](Drawn& d) {
            const Json map = partly_opaque(d, 32, 24, [](int x, int) { return 8 * x - 192; });
            Json first = primitive_of(d, sheet_over(d, 1, 2, 1.3, 2.5), with_alpha("BLEND", map));
            Json second = primitive_of(d, sheet_over(d, 0.2, 0.2, 0.7, 0.9), Json::object());
            second["material"] = first["material"];
            d.made.json["materials"].erase(1);
            d.root({{"mesh", d.mesh(std::move(first))}});
            d.root({{"mesh", d.mesh(std::move(second))}});
          },
      });
}

TEST(BlendShowsOpaque, TransparentSurfacesAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        const int column = d.pick(10, 30);
        const Json map = partly_opaque(d, 40, column, [](int, int) { return 0; });
        show(d, sheet_over(d, 0, 0, (column + 2.0) / 40, 1), with_alpha("BLEND", map));
      },
      [](Drawn& d) {
        const Json map = partly_opaque(d, 40, 20, [](int, int) { return 0; });
        show(d, sheet_over(d, 0, 0, 0.4, 1),
             with_alpha("BLEND", map, {{"baseColorFactor", {1, 1, 1, d.number(0.1, 0.9)}}}));
      },
      [](Drawn& d) {
        const UvSheet sheet = sheet_over(d, 0, 0, 0.4, 1);
        const std::vector<Four> faded(sheet.points.size(), Four{1, 1, 1, 0.5F});
        const Json map = partly_opaque(d, 40, 20, [](int, int) { return 0; });
        show(d, sheet, with_alpha("BLEND", map), {{"COLOR_0", d.values("VEC4", faded)}});
      },
  });
}

TEST(MaskAlphaGradient, IsFound) {
  const std::string pointer = "/materials/0/pbrMetallicRoughness/baseColorTexture";
  expect_found_in_pictures(
      "MASK_ALPHA_GRADIENT", pointer,
      {
          [](Drawn& d) {
            const Json map =
                partly_opaque(d, 40, d.pick(0, 6), [&](int x, int) { return 20 + 5 * x; });
            show(d, with_alpha("MASK", map));
          },
          [](Drawn& d) {
            const Json map = partly_opaque(d, 40, 0, [&](int, int) { return d.pick(30, 220); });
            show(d, sheet_over(d, 0, 0, d.number(0.3, 3), 1), with_alpha("MASK", map));
          },
          [](Drawn& d) {
            const Json map = partly_opaque(d, 32, 20, [](int, int) { return 120; });
            show(d, sheet_over(d, 0.65, 0.1, 0.95, 0.9), with_alpha("MASK", map));
          },
      });
}

TEST(MaskAlphaGradient, CutoutsAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        const Json map = partly_opaque(d, 40, 10, [&](int, int) { return 255 * d.pick(0, 1); });
        show(d, with_alpha("MASK", map));
      },
      // Soft edges.
      [](Drawn& d) {
        const Json map = partly_opaque(d, 40, 10, [](int x, int) { return x < 14 ? 128 : 0; });
        show(d, with_alpha("MASK", map));
      },
      [](Drawn& d) {
        const Json map = partly_opaque(d, 40, 20, [](int, int) { return 100; });
        show(d, sheet_over(d, 0, 0, 0.48, 1), with_alpha("MASK", map));
      },
      [](Drawn& d) {
        const Json map = partly_opaque(d, 40, 2, [&](int, int) { return d.pick(30, 220); });
        show(d, with_alpha("BLEND", map));
      },
  });
}

}  // namespace
}  // namespace gltfx::test
