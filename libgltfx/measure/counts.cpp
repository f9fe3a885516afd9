// SPDX-License-Identifier: Apache-2.0
// What is stored: each object of the root arrays once, used or not.
#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "measure/take.hpp"
#include "model/fields.hpp"
#include "model/light.hpp"
#include "model/skin.hpp"

namespace gltfx::measure {
namespace {

using model::RootArray;

// Distinct nodes that skins list as joints.
std::uint64_t bones(const Source& source) {
  std::vector<bool> seen(source.views().nodes.size());
  std::uint64_t count = 0;
  for (const json::NodeId object : source.asset().elements(RootArray::skins)) {
    if (object == json::kNoNode) continue;
    for (const model::NodeIndex joint : model::read_skin(source.asset(), object).joint_nodes) {
      if (!seen[joint]) ++count;
      seen[joint] = true;
    }
  }
  return count;
}

// Objects that a person sees in a tool and that have no name.
std::uint64_t unnamed(const Source& source) {
  std::uint64_t count = 0;
  for (const RootArray array : {RootArray::nodes, RootArray::meshes, RootArray::materials}) {
    for (const json::NodeId object : source.asset().elements(array)) {
      if (object != json::kNoNode && source.asset().name(object).empty()) ++count;
    }
  }
  return count;
}

std::uint64_t double_sided_materials(const Source& source) {
  const auto& objects = source.asset().elements(RootArray::materials);
  return static_cast<std::uint64_t>(
      std::count_if(objects.begin(), objects.end(), [&](json::NodeId object) {
        return object != json::kNoNode &&
               model::true_member(source.document(), object, "doubleSided");
      }));
}

}  // namespace

void take_counts(Taking& taking) {
  const Source& source = taking.source();
  const auto set = [&](Name name, auto count) {
    if (Column* column = taking.column(MeasureScope::asset, name)) column->set(0, count());
  };
  const auto set_size = [&](Name name, RootArray array) {
    set(name, [&] { return std::uint64_t{source.asset().count(array)}; });
  };
  set_size(Name::scenes, RootArray::scenes);
  set_size(Name::nodes, RootArray::nodes);
  set_size(Name::meshes, RootArray::meshes);
  set_size(Name::textures, RootArray::textures);
  set_size(Name::images, RootArray::images);
  set_size(Name::samplers, RootArray::samplers);
  set_size(Name::animations, RootArray::animations);
  set_size(Name::skins, RootArray::skins);
  set_size(Name::cameras, RootArray::cameras);
  set(Name::lights, [&] { return std::uint64_t{model::read_lights(source.asset()).size()}; });
  set(Name::bones, [&] { return bones(source); });
  set(Name::unnamed, [&] { return unnamed(source); });
  set(Name::double_sided_materials, [&] { return double_sided_materials(source); });
}

}  // namespace gltfx::measure
