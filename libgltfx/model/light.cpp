// SPDX-License-Identifier: Apache-2.0
#include "model/light.hpp"

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::string_view kExtension = "KHR_lights_punctual";
constexpr float kHalfPi = 1.57079633F;

std::optional<LightType> read_type(const json::Document& document, json::NodeId light) {
  const std::string name = string_member(document, light, "type");
  if (name == "directional") return LightType::directional;
  if (name == "point") return LightType::point;
  return name == "spot" ? std::optional(LightType::spot) : std::nullopt;
}

std::optional<Light> read_light(const Asset& asset, const Properties& from) {
  const auto type = read_type(asset.document(), from.node());
  if (!type) return std::nullopt;
  Light light;
  light.name = asset.name(from.node());
  light.type = *type;
  light.color = from.numbers("color", light.color, kUnitLimits);
  light.intensity = from.number("intensity", 1, kPositiveLimits);
  light.range = from.number("range", light.range, kPositiveLimits);
  const Properties spot = from.object("spot");
  light.outer_cone_angle = spot.number("outerConeAngle", light.outer_cone_angle, {0, kHalfPi});
  light.inner_cone_angle = spot.number("innerConeAngle", 0, {0, light.outer_cone_angle});
  return light;
}

}  // namespace

std::vector<std::optional<Light>> read_lights(const Asset& asset, const AnimatedValues* animated) {
  const json::Document& document = asset.document();
  std::vector<std::optional<Light>> lights;
  const json::NodeId extension = extension_object(document, document.root(), kExtension);
  const json::NodeId list = document.find(extension, "lights");
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return lights;
  for (const json::NodeId element : document.elements(list)) {
    std::string pointer("/extensions/");
    pointer.append(kExtension).append("/lights/").append(std::to_string(lights.size()));
    lights.push_back(read_light(asset, {document, element, animated, std::move(pointer)}));
  }
  return lights;
}

std::optional<std::uint32_t> light_of(const Asset& asset, const Node& node) {
  if (node.extensions == json::kNoNode) return std::nullopt;
  const json::NodeId object = object_member(asset.document(), node.extensions, kExtension);
  const auto index = unsigned_member(asset.document(), object, "light");
  return index && *index < UINT32_MAX ? std::optional(static_cast<std::uint32_t>(*index))
                                      : std::nullopt;
}

std::string_view unread_lights(const Asset& asset) {
  constexpr std::string_view kByImages = "EXT_lights_image_based";
  const json::Document& document = asset.document();
  const bool there = extension_object(document, document.root(), kByImages) != json::kNoNode;
  return there ? kByImages : std::string_view();
}

}  // namespace gltfx::model
