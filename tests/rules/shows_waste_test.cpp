// SPDX-License-Identifier: Apache-2.0
// What is stored and has no effect.
#include "codec/support/png_encoder.hpp"
#include "container/base64.hpp"
#include "rules/shows_assets.hpp"

namespace gltfx::test {
namespace {

std::size_t drawn_count(Drawn& d, int least, int most) {
  return static_cast<std::size_t>(d.pick(least, most));
}

// A picture with texels of its own.
std::string picture(Drawn& d, std::uint32_t width) {
  std::string texels(std::size_t{width} * width, '\0');
  for (char& texel : texels) texel = static_cast<char>(d.pick(0, 255));
  return encode_png({width, width, PngColor::grey, 8, texels, {}});
}

// A mesh whose base color is the image.
void show_image(Drawn& d, std::size_t image) {
  Json shown{{"baseColorTexture", {{"index", d.made.add("textures", {{"source", image}})}}}};
  const Shape shape = d.shape(1);
  Json primitive = d.primitive(shape);
  std::vector<std::array<float, 2>> places;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    places.push_back({static_cast<float>(d.number(0, 1)), static_cast<float>(d.number(0, 1))});
  }
  primitive["attributes"]["TEXCOORD_0"] = d.values("VEC2", places, {{"target", 34962}});
  // Factors of their own, so that materials are not equal.
  primitive["material"] = d.made.add("materials", {{"pbrMetallicRoughness", std::move(shown)},
                                                   {"alphaCutoff", d.number(0, 1)},
                                                   {"alphaMode", "MASK"}});
  d.root({{"mesh", d.mesh(std::move(primitive))}});
}

void images(Drawn& d, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    Json image{{"mimeType", "image/png"}};
    image["bufferView"] = d.made.view(file);
    show_image(d, d.made.add("images", std::move(image)));
  }
}

TEST(DuplicateImages, AreFoundByTheirBytes) {
  expect_found(
      "DUPLICATE_IMAGES", "/images/",
      {
          [](Drawn& d) {
            const std::string file = picture(d, 40);
            images(d, {file, file});
          },
          [](Drawn& d) {
            std::vector<std::string> files(drawn_count(d, 2, 4), picture(d, 33));
            files.insert(files.begin() + d.pick(0, 1), picture(d, 34));
            images(d, files);
          },
          // Data URIs; few bytes, and many texels.
          [](Drawn& d) {
            const char texel = static_cast<char>(d.pick(0, 255));
            const std::string file =
                encode_png({160, 160, PngColor::grey, 8, std::string(160 * 160, texel), {}});
            for (int i = 0; i < 2; ++i) {
              show_image(d,
                         d.made.add("images", {{"uri", container::data_uri("image/png", file)}}));
            }
          },
      });
  expect_silent({
      [](Drawn& d) {
        images(d, {picture(d, 40), picture(d, 40), picture(d, 41)});
      },
      // One image for two textures.
      [](Drawn& d) {
        images(d, {picture(d, 40)});
        show_image(d, 0);
      },
      // Too few bytes to matter.
      [](Drawn& d) {
        const std::string file = picture(d, 4);
        images(d, {file, file});
      },
  });
}

// Points along a curve of their own.
std::vector<Point> points(Drawn& d, std::size_t count) {
  std::vector<Point> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(d.point(1));
  return all;
}

void show_points(Drawn& d, std::size_t positions) {
  Json primitive{{"attributes", {{"POSITION", positions}}}, {"mode", 0}};
  d.root({{"mesh", d.mesh(std::move(primitive))}});
}

TEST(DuplicateAccessors, AreFoundByTheirElements) {
  expect_found("DUPLICATE_ACCESSORS", "/accessors/",
               {
                   [](Drawn& d) {
                     const auto same = points(d, drawn_count(d, 90, 300));
                     show_points(d, d.positions(same));
                     show_points(d, d.positions(same));
                   },
                   // Many small ones.
                   [](Drawn& d) {
                     const auto same = points(d, 12);
                     for (std::size_t i = drawn_count(d, 9, 20); i > 0; --i) {
                       show_points(d, d.positions(same));
                     }
                   },
                   // Among others, with equal ends.
                   [](Drawn& d) {
                     auto same = points(d, 200);
                     show_points(d, d.positions(same));
                     std::swap(same[drawn_count(d, 5, 80)], same[drawn_count(d, 120, 190)]);
                     show_points(d, d.positions(same));
                     show_points(d, d.positions(same));
                   },
               });
  expect_silent({
                    [](Drawn& d) {
                      const std::size_t count = drawn_count(d, 90, 300);
                      show_points(d, d.positions(points(d, count)));
                      show_points(d, d.positions(points(d, count)));
                    },
                    // One element differs.
                    [](Drawn& d) {
                      auto same = points(d, 200);
                      show_points(d, d.positions(same));
                      same[drawn_count(d, 0, 199)] = d.point(1);
                      show_points(d, d.positions(same));
                    },
                    // Shared bytes.
                    [](Drawn& d) {
                      const auto same = points(d, 200);
                      const std::size_t first = d.positions(same);
                      show_points(d, first);
                      show_points(d, d.made.add("accessors", d.made.json["accessors"][first]));
                    },
                    // Few bytes of many.
                    [](Drawn& d) {
                      const auto same = points(d, 20);
                      show_points(d, d.positions(same));
                      show_points(d, d.positions(same));
                      show_points(d, d.positions(points(d, 4000)));
                    },
                },
                {});
}

void materials(Drawn& d, const std::vector<double>& roughness, bool named) {
  std::size_t number = 0;
  for (const double each : roughness) {
    Json material{{"pbrMetallicRoughness", {{"roughnessFactor", each}}}, {"doubleSided", true}};
    if (named) material["name"] = fmt::format("part {}", number++);
    Json primitive = d.primitive(d.shape(1));
    primitive["material"] = d.made.add("materials", std::move(material));
    d.root({{"mesh", d.mesh(std::move(primitive))}});
  }
}

TEST(DuplicateObjects, AreMaterialsAndMeshes) {
  expect_found("DUPLICATE_OBJECTS", "/materials/",
               {
                   [](Drawn& d) {
                     materials(d, std::vector<double>(drawn_count(d, 5, 9), d.number(0, 1)), false);
                   },
                   [](Drawn& d) {
                     materials(d, std::vector<double>(drawn_count(d, 5, 9), d.number(0, 1)), true);
                   },
                   [](Drawn& d) {
                     std::vector<double> all(8, d.number(0, 0.4));
                     all[drawn_count(d, 0, 7)] = d.number(0.5, 1);
                     materials(d, all, true);
                   },
               });
  expect_found("DUPLICATE_OBJECTS", "/meshes/", {[](Drawn& d) {
                 const Json primitive = d.primitive(d.shape(1));
                 for (std::size_t i = drawn_count(d, 5, 9); i > 0; --i) {
                   d.root({{"mesh", d.mesh(primitive, {{"name", fmt::format("leaf {}", i)}})}});
                 }
               }});
  expect_silent(
      {
          [](Drawn& d) {
            std::vector<double> all;
            for (std::size_t i = drawn_count(d, 5, 9); i > 0; --i) all.push_back(d.number(0, 1));
            materials(d, all, true);
          },
          [](Drawn& d) { materials(d, std::vector<double>(drawn_count(d, 1, 4), 0.5), true); },
          // Instances.
          [](Drawn& d) {
            const std::size_t mesh = d.mesh(d.shape(1));
            for (std::size_t i = drawn_count(d, 5, 9); i > 0; --i) d.root({{"mesh", mesh}});
          },
      },
      {"DUPLICATE_ACCESSORS", "TRIANGLES_COINCIDE"});
}

// A shape with further vertices among its own, which no corner has.
Shape with_unused(Drawn& d, std::size_t count) {
  Shape shape = d.shape(1);
  for (std::size_t i = 0; i < count; ++i) shape.points.push_back(d.point(0.4));
  return shape;
}

TEST(UnusedVertices, AreCounted) {
  expect_found("UNUSED_VERTICES", "/meshes/0",
               {
                   [](Drawn& d) { d.root_with(with_unused(d, drawn_count(d, 200, 900))); },
                   [](Drawn& d) {
                     Shape shape = with_unused(d, 90);
                     shape.corners.resize(drawn_count(d, 1, 3) * 3);
                     d.root_with(shape);
                   },
                   // All indices are at the end.
                   [](Drawn& d) {
                     Shape shape = d.shape(1);
                     const std::size_t count = drawn_count(d, 100, 300);
                     shape.points.insert(shape.points.begin(), count, d.point(0.4));
                     for (auto& corner : shape.corners) {
                       corner = static_cast<std::uint16_t>(corner + count);
                     }
                     d.root_with(shape);
                   },
               });
  expect_silent({
      [](Drawn& d) { d.root_with(d.shape(1)); },
      [](Drawn& d) { d.root_with(with_unused(d, drawn_count(d, 0, 60))); },
      [](Drawn& d) { show_points(d, d.positions(points(d, 300))); },
      // Two meshes share the vertices and use each a part of them.
      [](Drawn& d) {
        const auto all = points(d, 300);
        const std::size_t positions = d.positions(all);
        for (int half = 0; half < 2; ++half) {
          std::vector<std::uint16_t> indices;
          for (int i = 0; i < 150; ++i) {
            indices.push_back(static_cast<std::uint16_t>(half * 150 + i));
          }
          Json primitive{{"attributes", {{"POSITION", positions}}}};
          primitive["indices"] = d.made.accessor("SCALAR", 5123, indices.size(), packed(indices),
                                                 Json::object(), {{"target", 34963}});
          d.root({{"mesh", d.mesh(std::move(primitive))}});
        }
      },
  });
}

TEST(UnusedVertices, OfFewIndicesAreFoundByDefault) {
  Drawn drawn(1);
  Shape shape = with_unused(drawn, 300);
  drawn.root_with(shape);
  ValidateOptions options;
  const FileReport report = validate_bytes(drawn.text(), "test", options);
  // As many indices as there are vertices may use them all.
  const bool certain = shape.corners.size() < shape.points.size();
  EXPECT_EQ(report.counts.infos, certain ? 1U : 0U);
  shape.corners.resize(6);
  Drawn few(1);
  few.root_with(shape);
  const FileReport second = validate_bytes(few.text(), "test", options);
  ASSERT_EQ(second.diagnostics.size(), 1U);
  EXPECT_EQ(second.diagnostics[0].code, "UNUSED_VERTICES");
  EXPECT_EQ(second.diagnostics[0].severity, Severity::info);
  EXPECT_NE(second.diagnostics[0].message.find("At least"), std::string::npos);
}

TEST(UnusedBytes, AreThoseWithoutABufferView) {
  expect_found("UNUSED_BYTES", "/buffers/0",
               {
                   [](Drawn& d) {
                     d.root_with(d.shape(1));
                     d.made.bytes += std::string(drawn_count(d, 1024, 9000), '\1');
                   },
                   [](Drawn& d) {
                     d.made.bytes = std::string(drawn_count(d, 1024, 9000), '\1');
                     d.root_with(d.shape(1));
                   },
                   [](Drawn& d) {
                     for (int i = 0; i < 4; ++i) {
                       d.root_with(d.shape(d.number(1, 2)));
                       d.made.bytes += std::string(drawn_count(d, 300, 900), '\1');
                     }
                   },
               });
  expect_silent({
      [](Drawn& d) { d.root_with(d.shape(1)); },
      [](Drawn& d) {
        for (int i = 0; i < 200; ++i) {
          show_points(d, d.positions(points(d, 10)));
          d.made.bytes += std::string(drawn_count(d, 0, 240), '\0');
        }
      },
      [](Drawn& d) {
        d.root_with(d.shape(1));
        d.made.bytes += std::string(drawn_count(d, 0, 1000), '\1');
      },
  });
}

void move_along(Drawn& d, const std::vector<Point>& places) {
  std::vector<float> times;
  for (std::size_t i = 0; i < places.size(); ++i) times.push_back(static_cast<float>(i) / 32);
  const std::size_t node = d.root({{"mesh", d.mesh(d.shape(1))}});
  const std::size_t input = d.made.accessor("SCALAR", 5126, times.size(), packed(times),
                                            {{"min", {times.front()}}, {"max", {times.back()}}});
  const std::size_t output = d.values("VEC3", places);
  d.made.add(
      "animations",
      {{"samplers", {{{"input", input}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}});
}

TEST(RedundantKeyframes, AreThoseOnTheWay) {
  expect_found("REDUNDANT_KEYFRAMES", "/animations/0",
               {
                   // It stands still.
                   [](Drawn& d) {
                     std::vector<Point> places(drawn_count(d, 80, 190), d.point(3));
                     places.back() = d.point(3);
                     move_along(d, places);
                   },
                   // It moves evenly.
                   [](Drawn& d) {
                     std::vector<Point> places;
                     const auto step = static_cast<float>(1 << d.pick(0, 4)) / 16;
                     for (std::size_t i = 0; i < 120; ++i) {
                       places.push_back({static_cast<float>(i) * step, 0, 1});
                     }
                     move_along(d, places);
                   },
                   // Half of the time.
                   [](Drawn& d) {
                     std::vector<Point> places = points(d, 90);
                     places.resize(180, d.point(3));
                     move_along(d, places);
                   },
               });
  expect_silent({
      [](Drawn& d) { move_along(d, points(d, drawn_count(d, 80, 190))); },
      [](Drawn& d) { move_along(d, std::vector<Point>(drawn_count(d, 2, 40), d.point(3))); },
      // A few only.
      [](Drawn& d) {
        std::vector<Point> places = points(d, 180);
        for (std::size_t i = 100; i < 110; ++i) places[i] = places[100];
        move_along(d, places);
      },
  });
}

// A primitive with materials for variants, and perhaps one of its own.
void with_variants(Drawn& d, bool material, std::size_t mappings) {
  d.made.json["extensionsUsed"] = Json::array({"KHR_materials_variants"});
  Json primitive = d.primitive(d.shape(1));
  Json list = Json::array();
  for (std::size_t i = 0; i < mappings; ++i) {
    const std::size_t at = d.made.add(
        "materials", Json{{"pbrMetallicRoughness", {{"roughnessFactor", d.number(0, 1)}}}});
    Json& variants = d.made.json["extensions"]["KHR_materials_variants"]["variants"];
    variants.push_back(Json{{"name", fmt::format("wood {}", variants.size())}});
    list.push_back(Json{{"material", at}, {"variants", Json::array({variants.size() - 1})}});
    if (material) primitive["material"] = at;
  }
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = std::move(list);
  d.root({{"mesh", d.mesh(std::move(primitive))}});
}

TEST(VariantWithoutDefault, IsAPrimitiveWithoutMaterial) {
  expect_found("VARIANT_WITHOUT_DEFAULT", "/meshes/",
               {
                   [](Drawn& d) { with_variants(d, false, 1); },
                   [](Drawn& d) { with_variants(d, false, drawn_count(d, 2, 6)); },
                   [](Drawn& d) {
                     for (std::size_t i = drawn_count(d, 1, 4); i > 0; --i) {
                       with_variants(d, true, 2);
                     }
                     with_variants(d, false, 2);
                   },
               });
  expect_silent({
      [](Drawn& d) { with_variants(d, true, drawn_count(d, 1, 6)); },
      [](Drawn& d) {
        with_variants(d, true, 2);
        d.root_with(d.shape(1));
      },
      [](Drawn& d) { d.root_with(d.shape(1)); },
  });
}

}  // namespace
}  // namespace gltfx::test
