// SPDX-License-Identifier: Apache-2.0
// Assets that are valid and want harm, or nearly: each gives a picture or says why not.
#include <functional>
#include <ostream>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using render::cube;
using render::quad;
using render::sphere;

struct HostileCase {
  std::string name;
  std::function<void(AssetText&)> fill;
  bool seen = true;  ///< there is a picture; else there is nothing to see
};
void PrintTo(const HostileCase& shown, std::ostream* out) { *out << shown.name; }

render::Mesh moved(render::Mesh mesh, float x) {
  for (auto& p : mesh.positions) p[0] += x;
  return mesh;
}

void add_lamps(AssetText& asset, int count, const Json& light) {
  for (int i = 0; i < count; ++i) asset.light(light, {{"translation", {0.1 * (i % 7), 0, 2}}});
}

// A chain of nodes, the mesh at its end.
void chain(AssetText& asset, int length) {
  const int mesh = asset.mesh(cube(), asset.material(plastic()));
  for (int i = 0; i + 1 < length; ++i) asset.add("nodes", {{"children", {i + 1}}});
  asset.add("nodes", {{"mesh", mesh}});
  asset.json()["scenes"][0]["nodes"] = {0};
}

void copies(AssetText& asset, int count) {
  std::vector<Float3> places;
  for (int i = 0; i < count; ++i) {
    places.push_back({static_cast<float>(i % 100), static_cast<float>(i / 100), 0});
  }
  asset.uses("EXT_mesh_gpu_instancing");
  const int accessor = asset.accessor("VEC3", 5126, places.size(), packed(places));
  asset.draw(cube(0.4F), plastic(),
             {{"extensions",
               {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", accessor}}}}}}}});
}

Json alpha(const char* mode, double cutoff, double value) {
  Json material = dielectric({0.8, 0.5, 0.3, value}, 0.5);
  material["alphaMode"] = mode;
  if (std::string_view(mode) == "MASK") material["alphaCutoff"] = cutoff;
  return material;
}

Json& primitive(AssetText& asset, int mesh) {
  return asset.json()["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0];
}

void skinned(AssetText& asset, float weight) {
  const int mesh = asset.mesh(quad(), asset.material(plastic()));
  const std::vector<std::array<std::uint8_t, 4>> joints(4);
  const std::vector<std::array<float, 4>> weights(4, {weight, 0, 0, 0});
  Json& attributes = primitive(asset, mesh)["attributes"];
  const int first = asset.accessor("VEC4", 5121, 4, packed(joints));
  const int second = asset.accessor("VEC4", 5126, 4, packed(weights));
  attributes["JOINTS_0"] = first;
  attributes["WEIGHTS_0"] = second;
  const int joint = asset.node({{"scale", {0, 0, 0}}});
  asset.add("skins", {{"joints", Json::array({joint})}});
  asset.node({{"mesh", mesh}, {"skin", 0}});
}

void morphed(AssetText& asset, double weight) {
  const int mesh = asset.mesh(quad(), asset.material(plastic()));
  const int target = asset.positions({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  primitive(asset, mesh)["targets"] = Json::array({Json::object({{"POSITION", target}})});
  asset.node({{"mesh", mesh}, {"weights", Json::array({weight})}});
}

void only_mode(AssetText& asset, int mode) {
  const int mesh = asset.mesh(quad(), -1);
  primitive(asset, mesh)["mode"] = mode;
  asset.node({{"mesh", mesh}});
}

// Copies of one mesh, each in a place of its own.
void twice(AssetText& asset, const Json& first, const Json& second) {
  const int mesh = asset.mesh(cube(), asset.material(plastic()));
  for (Json place : {first, second}) {
    place["mesh"] = mesh;
    asset.node(place);
  }
}

const Json kVolume = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                      {"KHR_materials_volume", {{"thicknessFactor", 1}}}};
Json with(Json extensions, const char* name, const Json& value) {
  extensions[name] = value;
  return extensions;
}

const HostileCase kCases[] = {
    {"degenerate_triangles",
     [](AssetText& asset) {
       render::Mesh mesh = quad();
       mesh.triangles.push_back({0, 0, 0});
       mesh.triangles.push_back({0, 1, 1});
       asset.draw(mesh, plastic());
     }},
    {"all_triangles_degenerate",
     [](AssetText& asset) {
       render::Mesh mesh = quad();
       mesh.triangles = {{0, 0, 0}, {1, 1, 2}};
       asset.draw(mesh, plastic());
     },
     false},
    {"one_point", [](AssetText& asset) { asset.draw(scaled(quad(), 0), plastic()); }, false},
    {"enormous", [](AssetText& asset) { asset.draw(scaled(cube(), 1e30F), plastic()); }, false},
    {"large", [](AssetText& asset) { asset.draw(scaled(cube(), 1e15F), plastic()); }},
    {"tiny", [](AssetText& asset) { asset.draw(scaled(cube(), 1e-15F), plastic()); }},
    {"tinier", [](AssetText& asset) { asset.draw(scaled(cube(), 1e-30F), plastic()); }},
    {"far_away", [](AssetText& asset) { asset.draw(moved(cube(), 1e8F), plastic()); }},
    {"tiny_scale",
     [](AssetText& asset) {
       asset.draw(cube(), plastic(), {{"scale", {1e-30, 1e-30, 1e-30}}});
     }},
    {"enormous_scale",
     [](AssetText& asset) {
       asset.draw(cube(), plastic(), {{"scale", {1e38, 1e38, 1e38}}});
     },
     false},
    {"overflowing_scale",
     [](AssetText& asset) {
       asset.draw(scaled(cube(), 1e20F), plastic(), {{"scale", {1e30, 1e30, 1e30}}});
     },
     false},
    {"flattened",
     [](AssetText& asset) {
       asset.draw(cube(), plastic(), {{"scale", {1, 0, 1}}});
     }},
    {"flattened_to_a_point",
     [](AssetText& asset) {
       asset.draw(cube(), plastic(), {{"scale", {0, 0, 0}}});
     },
     false},
    {"singular_matrix",
     [](AssetText& asset) {
       asset.draw(cube(), plastic(),
                  {{"matrix", {1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
     }},
    {"copies_without_extent",
     [](AssetText& asset) {
       twice(asset, {{"scale", {0, 0, 0}}}, {{"scale", {1, 0, 1}}});
     }},
    {"copies_of_tiny_scale",
     [](AssetText& asset) {
       twice(asset, {{"scale", {1e-30, 1e-30, 1e-30}}}, {{"scale", {1e-38, 1, 1}}});
     }},
    {"copies_of_enormous_scale",
     [](AssetText& asset) {
       twice(asset, {{"scale", {1e30, 1e30, 1e30}}}, {{"scale", {1, 1e37, 1}}});
     },
     false},
    {"copies_far_apart",
     [](AssetText& asset) {
       twice(asset, {{"translation", {1e30, 0, 0}}}, {{"translation", {-1e17, 0, 1e38}}});
     },
     false},
    {"index_of_refraction_1000",
     [](AssetText& asset) {
       asset.draw(sphere(1, 8),
                  dielectric({1, 1, 1, 1}, 0, with(kVolume, "KHR_materials_ior", {{"ior", 1e30}})));
     }},
    {"index_of_refraction_0",
     [](AssetText& asset) {
       asset.draw(sphere(1, 8),
                  dielectric({1, 1, 1, 1}, 0.3, with(kVolume, "KHR_materials_ior", {{"ior", 0}})));
     }},
    {"dispersion",
     [](AssetText& asset) {
       asset.draw(sphere(1, 8),
                  dielectric({1, 1, 1, 1}, 0,
                             with(kVolume, "KHR_materials_dispersion", {{"dispersion", 1e30}})));
     }},
    {"dense_medium",
     [](AssetText& asset) {
       asset.draw(sphere(1, 8),
                  dielectric({1, 1, 1, 1}, 0,
                             with(kVolume, "KHR_materials_sss",
                                  {{"scatterDistance", 1e-30}, {"scatterColor", {0, 1, 1e-30}}})));
     }},
    {"black_attenuation",
     [](AssetText& asset) {
       Json extensions = kVolume;
       extensions["KHR_materials_volume"] = {{"thicknessFactor", 1e30},
                                             {"attenuationDistance", 1e-30},
                                             {"attenuationColor", {0, 0, 0}}};
       asset.draw(sphere(1, 8), dielectric({1, 1, 1, 1}, 0, extensions));
     }},
    {"dazzling",
     [](AssetText& asset) {
       Json lamp = dielectric({1, 1, 1, 1}, 1,
                              {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e38}}}});
       lamp["emissiveFactor"] = {1, 1, 1};
       asset.draw(sphere(1, 8), lamp);
     }},
    {"film",
     [](AssetText& asset) {
       asset.draw(sphere(1, 8), dielectric({1, 1, 1, 1}, 0,
                                           {{"KHR_materials_iridescence",
                                             {{"iridescenceFactor", 1},
                                              {"iridescenceIor", 1e30},
                                              {"iridescenceThicknessMaximum", 1e30}}}}));
     }},
    {"cutoff_0", [](AssetText& asset) { asset.draw(cube(), alpha("MASK", 0, 0)); }},
    {"cutoff_1", [](AssetText& asset) { asset.draw(cube(), alpha("MASK", 1, 1)); }},
    {"cutoff_2", [](AssetText& asset) { asset.draw(cube(), alpha("MASK", 2, 1)); }, false},
    {"transparent", [](AssetText& asset) { asset.draw(cube(), alpha("BLEND", 0, 0)); }, false},
    {"hundred_veils",
     [](AssetText& asset) {
       const int mesh = asset.mesh(quad(), asset.material(alpha("BLEND", 0, 0.01)));
       for (int i = 0; i < 100; ++i)
         asset.node({{"mesh", mesh}, {"translation", {0, 0, i * 0.01}}});
     }},
    {"range_0",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       add_lamps(asset, 2, {{"type", "point"}, {"range", 1e-38}});
     }},
    {"lamp_without_light",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       add_lamps(asset, 2, {{"type", "point"}, {"intensity", 0}});
       add_lamps(asset, 1, {{"type", "spot"}, {"color", {0, 0, 0}}, {"spot", Json::object()}});
     }},
    {"lamp_too_bright",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       add_lamps(asset, 3, {{"type", "directional"}, {"intensity", 3e38}});
       add_lamps(asset, 3, {{"type", "point"}, {"intensity", 3e38}});
     }},
    {"lamp_in_a_corner",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       asset.light({{"type", "point"}}, {{"translation", {1, 1, 1}}});
     }},
    {"equal_cones",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       add_lamps(asset, 1,
                 {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}});
       add_lamps(asset, 1,
                 {{"type", "spot"}, {"spot", {{"innerConeAngle", 0}, {"outerConeAngle", 1e-30}}}});
     }},
    {"lamp_of_no_direction",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       asset.light({{"type", "directional"}}, {{"scale", {0, 0, 0}}});
     }},
    {"ten_thousand_lamps",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       add_lamps(asset, 1, {{"type", "point"}, {"intensity", 0.1}});
       for (int i = 0; i < 10000; ++i) {
         asset.node({{"translation", {i % 100 * 0.1, i / 100 * 0.1, 2}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
       }
     }},
    {"nothing", [](AssetText& asset) { asset.json().erase("scenes"), asset.json().erase("scene"); },
     false},
    {"empty_scene", [](AssetText&) {}, false},
    {"no_scene",
     [](AssetText& asset) {
       asset.draw(cube(), plastic());
       asset.json().erase("scenes");
       asset.json().erase("scene");
     }},
    {"all_hidden",
     [](AssetText& asset) {
       asset.uses("KHR_node_visibility");
       asset.draw(cube(), plastic(),
                  {{"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
     },
     false},
    {"points_only", [](AssetText& asset) { only_mode(asset, 0); }},
    {"lines_only", [](AssetText& asset) { only_mode(asset, 1); }},
    {"long_chain", [](AssetText& asset) { chain(asset, 20000); }},
    {"many_copies", [](AssetText& asset) { copies(asset, 10000); }},
    {"weights_of_0", [](AssetText& asset) { skinned(asset, 0); }},
    {"joint_that_shrinks_to_nothing", [](AssetText& asset) { skinned(asset, 1); }, false},
    {"huge_morph", [](AssetText& asset) { morphed(asset, 1e6); }},
    {"infinite_morph", [](AssetText& asset) { morphed(asset, 3e38); }, false},
};

class Hostile : public Baking, public testing::WithParamInterface<HostileCase> {
 protected:
  Hostile() {
    options.cameras.clear();
    options.samples = 2;
    options.denoise = true;
  }
};

TEST_P(Hostile, GivesAPictureOrSaysWhyNot) {
  AssetText asset;
  GetParam().fill(asset);
  const BakeReport done = report(asset);
  EXPECT_EQ(done.problem, GetParam().seen ? BakeProblem::none : BakeProblem::nothing_to_see)
      << done.error;
  EXPECT_EQ(done.pixels.bytes.size(), GetParam().seen ? 8U * 8 * 3 : 0U);
  EXPECT_EQ(done.error.empty(), GetParam().seen);
}

INSTANTIATE_TEST_SUITE_P(Assets, Hostile, testing::ValuesIn(kCases),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace gltfx::test
