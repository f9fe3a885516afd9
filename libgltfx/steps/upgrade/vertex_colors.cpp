// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/vertex_colors.hpp"

#include <algorithm>
#include <utility>

#include "model/fields.hpp"
#include "model/mesh.hpp"

namespace gltfx::upgrade {
namespace {

constexpr Rgb kWhite{1, 1, 1};

// The content of one accessor: one colour, or why there is none.
struct Reading {
  std::string problem;
  std::optional<Rgb> color;
};

template <typename T>
Rgb color_of(const T* element) {
  Rgb color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    if constexpr (std::is_floating_point_v<T>) {
      color[i] = element[i];
    } else {
      color[i] = model::normalize(element[i]);
    }
  }
  return color;
}

bool is_color_format(const model::Format& format) {
  using model::ComponentType;
  if (format.type != model::ElementType::vec3 && format.type != model::ElementType::vec4) {
    return false;
  }
  if (format.component == ComponentType::float32) return true;
  const bool whole =
      format.component == ComponentType::uint8 || format.component == ComponentType::uint16;
  return whole && format.normalized;
}

Reading read_color(const model::AccessorData& data) {
  Reading reading;
  bool varies = false;
  model::with_component_type(data.format().component, [&](auto type) {
    using T = decltype(type);
    data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
      for (std::size_t i = 0; i < elements && !varies; ++i) {
        const Rgb color = color_of(values + i * data.components());
        varies = reading.color && *reading.color != color;
        reading.color = color;
      }
    });
  });
  if (varies) return {"differs between vertices", {}};
  const bool sound = reading.color && std::all_of(reading.color->begin(), reading.color->end(),
                                                  [](double x) { return x >= 0 && x <= 1; });
  if (!sound) return {"is outside 0 to 1", {}};
  return reading;
}

// Whether an extension of the primitive has geometry that replaces the accessors.
bool is_encoded(const json::Document& document, json::NodeId primitive) {
  const json::NodeId extensions = document.find(primitive, "extensions");
  if (extensions == json::kNoNode || !document.is_object(extensions)) return false;
  for (const auto member : document.members(extensions)) {
    if (document.find(member.value, "bufferView") != json::kNoNode) return true;
  }
  return false;
}

bool is_morphed(const json::Document& document, json::NodeId primitive) {
  const std::vector<json::NodeId> targets = model::morph_targets(document, primitive);
  return std::any_of(targets.begin(), targets.end(), [&](json::NodeId target) {
    return document.find(target, "COLOR_0") != json::kNoNode;
  });
}

Reading color_of_primitive(const model::Asset& asset, AccessorValues& values,
                           json::NodeId primitive) {
  const json::Document& document = asset.document();
  const json::NodeId attributes = document.find(primitive, "attributes");
  if (document.find(attributes, "COLOR_0") == json::kNoNode) return {{}, kWhite};
  if (is_encoded(document, primitive)) return {"is compressed", {}};
  if (is_morphed(document, primitive)) return {"is changed by morph targets", {}};
  const auto accessor = asset.index(attributes, "COLOR_0", model::RootArray::accessors);
  const auto data = accessor ? values.open(*accessor) : std::nullopt;
  if (!data || !is_color_format(data->format())) return {"cannot be read", {}};
  return read_color(*data);
}

}  // namespace

void AccessorValues::read_all() {
  views_.emplace(asset_);
  for (std::uint64_t i = 0; i < asset_.count(model::RootArray::buffers); ++i) {
    auto bytes = bytes_->buffer(i);
    const json::NodeId buffer = asset_.elements(model::RootArray::buffers)[i];
    const auto length = model::unsigned_member(asset_.document(), buffer, "byteLength");
    const bool enough = bytes && length && bytes->size() >= *length;
    resources_.buffers.push_back(enough ? std::optional(*std::move(bytes)) : std::nullopt);
  }
}

// Extensions of buffer views and accessors may define another encoding.
bool AccessorValues::is_plain(const model::Accessor& accessor) const {
  const json::Document& document = asset_.document();
  const model::BufferView* view = views_->view_of(accessor);
  return document.find(accessor.node, "extensions") == json::kNoNode &&
         (view == nullptr || document.find(view->node, "extensions") == json::kNoNode);
}

std::optional<model::AccessorData> AccessorValues::open(std::uint64_t accessor) {
  if (bytes_ == nullptr) return std::nullopt;
  if (!views_) read_all();
  if (accessor >= views_->accessors.size()) return std::nullopt;
  const model::Accessor& described = views_->accessors[accessor];
  if (described.node == json::kNoNode || !is_plain(described)) return std::nullopt;
  auto data =
      model::AccessorData::open(asset_, *views_, resources_, described, model::Malformed::unusable);
  // Elements without stored bytes may be any number of zeros.
  return data && data->implied() ? std::nullopt : data;
}

std::vector<MaterialUse> find_material_uses(const model::Asset& asset, const graph::Graph& graph,
                                            std::uint64_t material) {
  std::vector<MaterialUse> uses;
  const auto& materials = asset.elements(model::RootArray::materials);
  if (material >= materials.size()) return uses;
  const graph::Tree& tree = graph.tree();
  for (const graph::Use& use : graph.users(materials[material])) {
    const json::NodeId mesh = tree.root_element(use.at.node);
    if (mesh == json::kNoNode || use.kind != graph::UseKind::index || use.at.element) continue;
    json::NodeId primitive = tree.parent(use.at.node);
    while (primitive != mesh && tree.parent(tree.parent(primitive)) != mesh) {
      primitive = tree.parent(primitive);
    }
    const json::NodeId list = tree.parent(primitive);
    const bool is_primitive = tree.name(tree.parent(mesh)) == "meshes" && tree.is_member(list) &&
                              tree.name(list) == "primitives";
    if (is_primitive) uses.push_back({primitive, use.at.node});
  }
  return uses;
}

Tint find_tint(const model::Asset& asset, AccessorValues& values,
               const std::vector<MaterialUse>& uses) {
  Tint tint;
  for (const MaterialUse& use : uses) {
    Reading reading = color_of_primitive(asset, values, use.primitive);
    if (!reading.color) {
      tint.problem = std::move(reading.problem);
      return tint;
    }
    const auto part =
        std::find_if(tint.parts.begin(), tint.parts.end(),
                     [&](const Tint::Part& known) { return known.color == *reading.color; });
    if (part != tint.parts.end()) {
      part->users.push_back(use.index);
    } else {
      tint.parts.push_back({*reading.color, {use.index}});
    }
  }
  return tint;
}

}  // namespace gltfx::upgrade
