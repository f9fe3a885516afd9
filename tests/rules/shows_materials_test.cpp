// SPDX-License-Identifier: Apache-2.0
// Materials, vertex colors and lights that hide what they are meant to show.
#include "rules/shows_textured.hpp"

namespace gltfx::test {
namespace {

void use(Drawn& d, const char* extension) { d.made.json["extensionsUsed"].push_back(extension); }

Json shade(double least) { return Json::array({1, least, least}); }

// --- Emission ---

Json emitting(const Json& factor, const Json& base, const Json& more = Json::object()) {
  Json material{{"emissiveFactor", factor}, {"pbrMetallicRoughness", base}};
  material.update(more);
  return material;
}

Json emission_of(Drawn& d, int least) {
  const int size = d.pick(2, 40);
  return {{"emissiveTexture", texture_of(d, painted(size, size, PngColor::rgb, [&](int x, int y) {
                                           const int value = x + y == 0 ? least : 255;
                                           return Texel{value, 255, value, 255};
                                         }))}};
}

TEST(WhiteEmission, IsFound) {
  expect_found_in_pictures(
      "EMISSION_HIDES_COLOR", "/materials/0/emissive",
      {
          [](Drawn& d) { show(d, emitting(shade(d.number(0.96, 1)), textured_base(colors(d)))); },
          [](Drawn& d) {
            use(d, "KHR_materials_emissive_strength");
            const double factor = d.number(0.1, 1);
            const Json strength{{"emissiveStrength", d.number(1, 20) / factor}};
            show(d, emitting({factor, factor, factor}, textured_base(colors(d)),
                             {{"extensions", {{"KHR_materials_emissive_strength", strength}}}}));
          },
          [](Drawn& d) {
            show(d, emitting({1, 1, 1}, textured_base(colors(d)), emission_of(d, 255)));
          },
      });
}

TEST(WhiteEmission, GlowsAndLampsAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) { show(d, emitting(shade(d.number(0, 0.9)), textured_base(colors(d)))); },
      [](Drawn& d) {
        show(d, emitting({1, 1, 1}, Json::object()));
      },
      [](Drawn& d) {
        show(d, emitting({1, 1, 1}, textured_base(colors(d)), emission_of(d, d.pick(0, 200))));
      },
      [](Drawn& d) {
        use(d, "KHR_materials_unlit");
        show(d, emitting({1, 1, 1}, textured_base(colors(d)),
                         {{"extensions", {{"KHR_materials_unlit", Json::object()}}}}));
      },
  });
}

// --- Metals ---

std::string one_of(Drawn& d, const std::vector<std::string>& names) {
  return names[static_cast<std::size_t>(d.pick(0, static_cast<int>(names.size()) - 1))];
}
std::string dielectric(Drawn& d) {
  return one_of(d, {"Oak Wood", "leather_02", "M_Skin", "bodyHair", "brick.wall", "Fabric-03",
                    "GreenGrass", "concrete", "Red_Plastic_001", "SM_Paper"}) +
         std::to_string(d.pick(0, 99));
}

TEST(MetalByDefault, IsFound) {
  expect_found_in_pictures(
      "METAL_BY_DEFAULT", "/materials/0/pbrMetallicRoughness/metallicFactor",
      {
          [](Drawn& d) {
            show(d, {{"name", dielectric(d)},
                     {"pbrMetallicRoughness", {{"roughnessFactor", d.number(0, 1)}}}});
          },
          [](Drawn& d) {
            show(d, {{"name", dielectric(d)}, {"pbrMetallicRoughness", {{"metallicFactor", 1}}}});
          },
          [](Drawn& d) {
            const Json map = texture_of(d,
                                        painted(8, 8, PngColor::rgb,
                                                [&](int, int) {
                                                  return Texel{d.pick(0, 255), 9, 9, 0};
                                                }),
                                        dielectric(d) + "_diffuse.png");
            show(d, {{"name", "Material"}, {"pbrMetallicRoughness", {{"baseColorTexture", map}}}});
          },
      });
}

TEST(MetalByDefault, MetalsAndOtherNamesAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        show(d, {{"name", dielectric(d)},
                 {"pbrMetallicRoughness", {{"metallicFactor", d.number(0, 0.9)}}}});
      },
      [](Drawn& d) {
        show(d, {{"name", one_of(d, {"Steel", "Gold leaf", "Car skin", "Iron wall", "Chrome"})}});
      },
      [](Drawn& d) {
        show(d,
             {{"name", one_of(d, {"Material.001", "lambert1", "Woodward", "Skinny", "default"})}});
      },
      [](Drawn& d) {
        show(d, {{"name", dielectric(d)},
                 {"pbrMetallicRoughness", {{"metallicRoughnessTexture", colors(d)}}}});
      },
  });
}

// --- Vertex colors ---

template <std::size_t N>
Json colored(Drawn& d, const UvSheet& sheet, std::array<float, N> color, bool one_differs) {
  std::vector<std::array<float, N>> all(sheet.points.size(), color);
  if (one_differs) {
    all[static_cast<std::size_t>(d.pick(0, static_cast<int>(all.size()) - 1))][1] = 0.2F;
  }
  return {{"COLOR_0", d.values(N == 3 ? "VEC3" : "VEC4", all)}};
}

TEST(BlackVertexColors, AreFound) {
  const std::string pointer = "/meshes/0/primitives/0/attributes/COLOR_0";
  expect_found_in_pictures(
      "VERTEX_COLORS_BLACK", pointer,
      {
          [](Drawn& d) {
            const UvSheet sheet = whole_sheet(d);
            show(d, sheet, {{"pbrMetallicRoughness", textured_base(colors(d))}},
                 colored(d, sheet, Point{0, 0, 0}, false));
          },
          [](Drawn& d) {
            const UvSheet sheet = whole_sheet(d);
            show(d, sheet, {{"pbrMetallicRoughness", textured_base(colors(d))}},
                 colored(d, sheet, Four{0, 0, 0, static_cast<float>(d.number(0, 1))}, false));
          },
          [](Drawn& d) {
            const UvSheet sheet = whole_sheet(d);
            const std::string bytes(sheet.points.size() * 4, '\0');
            const std::size_t black = d.made.accessor("VEC4", 5121, sheet.points.size(), bytes,
                                                      {{"normalized", true}}, {{"target", 34962}});
            show(d, sheet, {{"pbrMetallicRoughness", textured_base(colors(d))}},
                 {{"COLOR_0", black}});
          },
      });
}

TEST(BlackVertexColors, ColorsAndBlackPaintAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        const UvSheet sheet = whole_sheet(d);
        show(d, sheet, {{"pbrMetallicRoughness", textured_base(colors(d))}},
             colored(d, sheet, Point{0, 0, 0}, true));
      },
      [](Drawn& d) {
        const UvSheet sheet = whole_sheet(d);
        show(d, sheet, Json::object(), colored(d, sheet, Four{0, 0, 0, 1}, false));
      },
      [](Drawn& d) {
        const UvSheet sheet = whole_sheet(d);
        show(d, sheet, {{"pbrMetallicRoughness", textured_base(colors(d))}},
             colored(d, sheet, Point{static_cast<float>(d.number(0.01, 1)), 0, 0}, false));
      },
  });
}

// --- Lights ---

void light(Drawn& d, const Json& light, bool used = true) {
  use(d, "KHR_lights_punctual");
  d.made.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
  d.root_with(d.shape(1));
  if (used) d.root({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

TEST(UnusualLight, IsFound) {
  expect_found_in_pictures(
      "LIGHT_INTENSITY_UNUSUAL", "/extensions/KHR_lights_punctual/lights/0/",
      {
          [](Drawn& d) {
            light(d, {{"type", "point"}, {"intensity", d.magnitude(1e6, 1e12)}});
          },
          [](Drawn& d) {
            light(d, {{"type", "directional"}, {"intensity", d.magnitude(1.1e6, 1e9)}});
          },
          [](Drawn& d) {
            light(d, {{"type", "spot"},
                      {"spot", Json::object()},
                      {"intensity", d.pick(0, 1) == 0 ? 0 : 2e6}});
          },
          [](Drawn& d) {
            light(d, {{"type", "point"}, {"color", {0, 0, 0}}, {"intensity", 5}});
          },
      });
}

TEST(UnusualLight, LampsAndTheSunAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        light(d, {{"type", "point"}, {"intensity", d.magnitude(1e-2, 9e5)}});
      },
      [](Drawn& d) {
        light(d, {{"type", "directional"}, {"intensity", d.magnitude(0.1, 2e5)}});
      },
      [](Drawn& d) {
        light(d, {{"type", "spot"}, {"spot", Json::object()}});
      },
      [](Drawn& d) {
        light(d, {{"type", "point"}, {"intensity", 0}}, false);
      },
  });
}

// --- Characters ---

// A skinned mesh with a material for each mode.
void character(Drawn& d, const std::vector<const char*>& modes, double alpha) {
  Json primitives = Json::array();
  for (const char* mode : modes) {
    const UvSheet sheet = whole_sheet(d);
    const std::size_t count = sheet.points.size();
    const Json map = texture_of(d, painted(16, 16, PngColor::rgba, [&](int x, int) {
                                  return Texel{d.pick(0, 255), 80, 80, x < 4 ? 0 : 255};
                                }));
    Json material{
        {"pbrMetallicRoughness", textured_base(map, {{"baseColorFactor", {1, 1, 1, alpha}}})},
        {"alphaMode", mode}};
    primitives.push_back(primitive_of(
        d, sheet, material,
        {{"JOINTS_0", d.made.accessor("VEC4", 5121, count, std::string(count * 4, '\0'),
                                      Json::object(), {{"target", 34962}})},
         {"WEIGHTS_0",
          d.values("VEC4", std::vector<Four>(count, Four{1, 0, 0, 0}), {{"target", 34962}})}}));
  }
  const std::size_t mesh = d.made.add("meshes", {{"primitives", primitives}});
  const std::size_t joint = d.root({{"name", "hip"}});
  d.made.add("skins", {{"joints", {joint}}});
  d.root({{"mesh", mesh}, {"skin", 0}});
}

TEST(BlendedBody, IsFound) {
  expect_found_in_pictures(
      "BODY_BLENDED", "/materials/0/alphaMode",
      {
          [](Drawn& d) { character(d, {"BLEND"}, 1); },
          [](Drawn& d) {
            character(d, {"BLEND", "BLEND"}, 1);
          },
          [](Drawn& d) {
            character(d, std::vector<const char*>(static_cast<std::size_t>(d.pick(1, 4)), "BLEND"),
                      1);
            d.root_with(d.shape(1));
          },
      });
}

TEST(BlendedBody, MixedAndTranslucentOnesAreNotReported) {
  expect_silent_in_pictures({
      [](Drawn& d) {
        character(d, {"BLEND", d.pick(0, 1) == 0 ? "MASK" : "OPAQUE"}, 1);
      },
      [](Drawn& d) {
        character(d, {"BLEND", "BLEND"}, d.number(0.1, 0.9));
      },
      // Leaves and windows.
      [](Drawn& d) {
        const Json map = texture_of(d, painted(16, 16, PngColor::rgba, [&](int x, int) {
                                      return Texel{d.pick(0, 255), 80, 80, x < 4 ? 0 : 255};
                                    }));
        show(d, {{"pbrMetallicRoughness", textured_base(map)}, {"alphaMode", "BLEND"}});
      },
  });
}

}  // namespace
}  // namespace gltfx::test
