// SPDX-License-Identifier: Apache-2.0
/// Fixtures compared with themselves, with other storage and with changes.
#include "prove/meaning.hpp"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::compare;
using test::EditedAsset;
using test::Json;
using test::text;
using testing::HasSubstr;

const std::filesystem::path kGood = std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures/good";

std::vector<MeaningRequest> requests() {
  std::vector<MeaningRequest> all(5);
  all[1].order = VertexOrder::free;
  all[2].animations = AnimationComparison::curves;
  all[3].in_world = true;
  all[4].unused_may_go = true;
  all[4].images = ImageComparison::bytes;
  return all;
}

TEST(Meaning, OfAnAssetIsItsOwn) {
  for (const char* folder : {"fixtures/good", "fixtures/legacy", "fixtures/bad"}) {
    for (const auto& path : test::assets_in(std::filesystem::path(GLTFX_SOURCE_DIR) / folder)) {
      auto container = container::open_file(path);
      ASSERT_TRUE(container) << path;
      const model::OpenedAsset opened(path, *std::move(container),
                                      container::Resolver(path.parent_path(), path.parent_path()));
      for (const MeaningRequest& request : requests()) {
        const Meaning meaning = compare_meaning(opened, opened, *schema::builtin_set(), request);
        EXPECT_TRUE(meaning.same()) << path << "\n" << text(meaning);
        EXPECT_TRUE(meaning.measured.empty()) << path;
        if (std::string_view(folder) == "fixtures/good") {
          EXPECT_THAT(meaning.unread, testing::IsEmpty()) << path;
        }
      }
    }
  }
}

/// A change of an asset; false if the asset has nothing to change.
struct Mutation {
  const char* name;
  std::function<bool(EditedAsset&)> make;
  std::string pointer;  ///< a part of the pointer of one of the differences
};

bool has(const Json& object, const char* member) { return object.contains(member); }

bool edit_first(EditedAsset& asset, const char* array, const std::function<void(Json&)>& edit) {
  if (!has(asset.json, array) || asset.json[array].empty()) return false;
  edit(asset.json[array][0]);
  return true;
}

// The smallest possible change.
bool edit_element(EditedAsset& asset, const Json& accessor, std::size_t index) {
  char* at = asset.element(accessor.get<std::size_t>(), index);
  if (at == nullptr) return false;
  at[0] = static_cast<char>(at[0] ^ 1);
  return true;
}

// A vertex that is used by a corner.
bool edit_vertex(EditedAsset& asset, const Json& primitive, const Json& accessor) {
  std::uint32_t vertex = 0;
  if (has(primitive, "indices")) {
    const auto indices = primitive["indices"].get<std::size_t>();
    const char* at = asset.element(indices, 0);
    if (at == nullptr) return false;
    const int type = asset.json["accessors"][indices]["componentType"];
    std::memcpy(&vertex, at, type == 5121 ? 1 : type == 5123 ? 2 : 4);
  }
  return edit_element(asset, accessor, vertex);
}

// The first corner becomes the last one.
bool edit_index(EditedAsset& asset, const Json& accessor) {
  const auto indices = accessor.get<std::size_t>();
  const std::size_t count = asset.json["accessors"][indices]["count"];
  char* first = asset.element(indices, 0);
  if (first == nullptr) return false;
  const auto size = static_cast<std::size_t>(asset.element(indices, 1) - first);
  std::memcpy(first, asset.element(indices, count - 1), size);
  return true;
}

bool for_primitive(EditedAsset& asset, const std::function<bool(Json&)>& edit) {
  for (Json& mesh : asset.json["meshes"]) {
    for (Json& primitive : mesh["primitives"]) {
      if (edit(primitive)) return true;
    }
  }
  return false;
}

std::vector<Mutation> mutations_of_geometry() {
  return {
      {"a vertex moves",
       [](EditedAsset& asset) {
         return for_primitive(asset, [&](Json& p) {
           return !has(p, "extensions") && has(p["attributes"], "POSITION") &&
                  edit_vertex(asset, p, p["attributes"]["POSITION"]);
         });
       },
       "/attributes/POSITION"},
      {"a normal turns",
       [](EditedAsset& asset) {
         return for_primitive(asset, [&](Json& p) {
           return !has(p, "extensions") && has(p["attributes"], "NORMAL") &&
                  edit_vertex(asset, p, p["attributes"]["NORMAL"]);
         });
       },
       "/attributes/NORMAL"},
      {"an index changes",
       [](EditedAsset& asset) {
         return for_primitive(asset, [&](Json& p) {
           return !has(p, "extensions") && has(p, "indices") && edit_index(asset, p["indices"]);
         });
       },
       "/primitives/"},
      {"an attribute goes",
       [](EditedAsset& asset) {
         return for_primitive(asset, [&](Json& p) {
           return !has(p, "extensions") && p["attributes"].erase("NORMAL") > 0;
         });
       },
       "/attributes/NORMAL"},
      {"a mode changes",
       [](EditedAsset& asset) {
         return for_primitive(asset, [](Json& p) {
           p["mode"] = p.value("mode", 4) == 0 ? 4 : 0;
           return true;
         });
       },
       "/primitives/0"},
      {"a morph target changes",
       [](EditedAsset& asset) {
         return for_primitive(asset, [&](Json& p) {
           return has(p, "targets") && has(p["targets"][0], "POSITION") &&
                  edit_vertex(asset, p, p["targets"][0]["POSITION"]);
         });
       },
       "/targets/0/POSITION"},
      {"morph targets go",
       [](EditedAsset& asset) {
         return for_primitive(asset, [](Json& p) { return p.erase("targets") > 0; });
       },
       "/primitives/0"},
  };
}

std::vector<Mutation> mutations_of_objects() {
  return {
      {"a name changes",
       [](EditedAsset& asset) {
         return edit_first(asset, "nodes", [](Json& n) { n["name"] = "another"; });
       },
       "/nodes/0"},
      {"the generator goes",
       [](EditedAsset& asset) { return asset.json["asset"].erase("generator") > 0; },
       "/asset/generator"},
      {"extras go",
       [](EditedAsset& asset) {
         for (auto& [key, array] : asset.json.items()) {
           if (!array.is_array()) continue;
           for (Json& object : array) {
             if (object.is_object() && object.erase("extras") > 0) return true;
           }
         }
         return false;
       },
       "/extras"},
      {"extras change",
       [](EditedAsset& asset) {
         return edit_first(asset, "nodes", [](Json& n) { n["extras"] = {{"a", 1}}; });
       },
       "/nodes/0"},
      {"an unknown extension comes",
       [](EditedAsset& asset) {
         return edit_first(asset, "nodes", [](Json& n) {
           n["extensions"]["ACME_thing"] = {{"index", 3}};
         });
       },
       "/nodes/0"},
      {"a factor changes",
       [](EditedAsset& asset) {
         return edit_first(asset, "materials",
                           [](Json& m) { m["pbrMetallicRoughness"]["roughnessFactor"] = 0.4321; });
       },
       "/materials/0"},
      {"a texture is chosen anew",
       [](EditedAsset& asset) {
         if (!has(asset.json, "textures") || asset.json["textures"].size() < 2) return false;
         asset.json["textures"][0]["sampler"] = asset.json["samplers"].size();
         asset.json["samplers"].push_back({{"wrapS", 33071}});
         return true;
       },
       "sampler"},
      {"a material is chosen anew",
       [](EditedAsset& asset) {
         return for_primitive(asset, [](Json& p) { return p.erase("material") > 0; });
       },
       "/material"},
      {"a camera changes",
       [](EditedAsset& asset) {
         return edit_first(asset, "cameras", [](Json& c) { c[c["type"]]["znear"] = 0.0123; });
       },
       "/cameras/0"},
      {"an extension is declared",
       [](EditedAsset& asset) {
         asset.json["extensionsUsed"].push_back("ACME_declared");
         return true;
       },
       "/extensionsUsed"},
  };
}

std::vector<Mutation> mutations_of_scenes() {
  return {
      {"a node moves",
       [](EditedAsset& asset) {
         return edit_first(asset, "nodes", [](Json& n) {
           n.erase("matrix");
           n["translation"] = {0.25, 17, -3};
         });
       },
       "/nodes/0"},
      {"a child gets another parent",
       [](EditedAsset& asset) {
         for (Json& node : asset.json["nodes"]) {
           if (!has(node, "children") || asset.json["scenes"].empty()) continue;
           Json children = node["children"];
           node.erase("children");
           for (const Json& child : children) asset.json["scenes"][0]["nodes"].push_back(child);
           return true;
         }
         return false;
       },
       "/children"},
      {"a scene loses a root",
       [](EditedAsset& asset) {
         if (!has(asset.json, "scenes") || !has(asset.json["scenes"][0], "nodes")) return false;
         Json& roots = asset.json["scenes"][0]["nodes"];
         roots.erase(roots.size() - 1);
         return true;
       },
       "/scenes/0/nodes"},
      {"an animation goes", [](EditedAsset& asset) { return asset.json.erase("animations") > 0; },
       "/animations"},
      {"a keyframe moves",
       [](EditedAsset& asset) {
         return has(asset.json, "animations") &&
                edit_element(asset, asset.json["animations"][0]["samplers"][0]["output"], 0);
       },
       "/animations/0/"},
      {"an interpolation changes",
       [](EditedAsset& asset) {
         return edit_first(asset, "animations", [](Json& a) {
           Json& sampler = a["samplers"][0];
           sampler["interpolation"] =
               sampler.value("interpolation", "LINEAR") == "STEP" ? "LINEAR" : "STEP";
         });
       },
       "/animations/0/samplers/0"},
      {"a channel moves something else",
       [](EditedAsset& asset) {
         if (!has(asset.json, "animations") || asset.json["nodes"].size() < 2) return false;
         Json& target = asset.json["animations"][0]["channels"][0]["target"];
         if (!has(target, "node")) return false;
         target["node"] = (target["node"].get<std::size_t>() + 1) % asset.json["nodes"].size();
         return true;
       },
       "/animations/0/channels/0/target/node"},
      {"joints are swapped",
       [](EditedAsset& asset) {
         if (!has(asset.json, "skins")) return false;
         Json& joints = asset.json["skins"][0]["joints"];
         if (joints.size() < 2) return false;
         std::swap(joints[0], joints[1]);
         return true;
       },
       "/skins/0/joints"},
      {"a bind matrix changes",
       [](EditedAsset& asset) {
         return has(asset.json, "skins") && has(asset.json["skins"][0], "inverseBindMatrices") &&
                edit_element(asset, asset.json["skins"][0]["inverseBindMatrices"], 0);
       },
       "/skins/0/inverseBindMatrices"},
      {"another scene is shown",
       [](EditedAsset& asset) {
         if (!has(asset.json, "scene")) return false;
         asset.json["scenes"].push_back(Json{{"name", "another"}});
         asset.json["scene"] = asset.json["scenes"].size() - 1;
         return true;
       },
       "/scenes"},
  };
}

std::vector<Mutation> mutations() {
  std::vector<Mutation> all = mutations_of_geometry();
  for (const auto& more : {mutations_of_objects(), mutations_of_scenes()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

// Each change, applied to each fixture that contains its target.
TEST(Meaning, OfAnotherAssetIsAnother) {
  const std::vector<Mutation> all = mutations();
  std::map<std::string, int> made;
  for (const auto& path : test::assets_in(kGood)) {
    const EditedAsset before = EditedAsset::load(path);
    for (const Mutation& mutation : all) {
      EditedAsset after = before;
      if (!mutation.make(after) || (after.json == before.json && after.files == before.files)) {
        continue;
      }
      ++made[mutation.name];
      const Meaning meaning = compare(before, after);
      EXPECT_FALSE(meaning.same()) << path << ": " << mutation.name;
      EXPECT_THAT(text(meaning), HasSubstr(mutation.pointer)) << path << ": " << mutation.name;
    }
  }
  for (const Mutation& mutation : all) EXPECT_GT(made[mutation.name], 0) << mutation.name;
}

}  // namespace
}  // namespace gltfx::prove
