// SPDX-License-Identifier: Apache-2.0
#include "model/light.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::string_view kExtension = "KHR_lights_punctual";
constexpr std::string_view kByImages = "EXT_lights_image_based";
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

// An element of an array that does not hold numbers, or nothing.
json::NodeId element_at(const json::Document& document, json::NodeId array, std::uint64_t index) {
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return json::kNoNode;
  for (const json::NodeId element : document.elements(array)) {
    if (index-- == 0) return element;
  }
  return json::kNoNode;
}

// Missing coefficients are 0.
Harmonics read_harmonics(const json::Document& document, json::NodeId array) {
  Harmonics coefficients{};
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const json::NodeId row = element_at(document, array, i);
    if (row == json::kNoNode || document.kind(row) != json::Kind::number_array) continue;
    json::NumberCursor at(document, row);
    for (std::size_t c = 0; c < 3 && at.valid(); ++c, at.advance()) {
      coefficients[i][c] = static_cast<float>(std::clamp(at.number().value, -1e8, 1e8));
    }
  }
  return coefficients;
}

// The images of the first cube map.
std::optional<std::array<std::uint32_t, 6>> read_faces(const Asset& asset, json::NodeId levels) {
  std::array<std::uint32_t, 6> faces{};
  std::size_t found = 0;
  for_each_index(asset, element_at(asset.document(), levels, 0), RootArray::images,
                 [&](std::uint64_t position, std::optional<std::uint32_t> image, Span) {
                   if (position >= faces.size() || !image) return;
                   faces[static_cast<std::size_t>(position)] = *image;
                   ++found;
                 });
  return found == faces.size() ? std::optional(faces) : std::nullopt;
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

std::optional<EnvironmentLight> environment_light_of(const Asset& asset, std::uint32_t scene,
                                                     const AnimatedValues* animated) {
  const json::Document& document = asset.document();
  const json::NodeId use =
      extension_object(document, asset.elements(RootArray::scenes)[scene], kByImages);
  const auto index = unsigned_member(document, use, "light");
  const json::NodeId lights =
      document.find(extension_object(document, document.root(), kByImages), "lights");
  const json::NodeId light = index ? element_at(document, lights, *index) : json::kNoNode;
  if (light == json::kNoNode) return std::nullopt;
  const std::string pointer = fmt::format("/extensions/{}/lights/{}", kByImages, *index);
  const Properties from(document, light, animated, pointer);
  EnvironmentLight read;
  const auto rotation = from.numbers("rotation", std::array<float, 4>{0, 0, 0, 1});
  read.rotation = unit(Quaternion{rotation[0], rotation[1], rotation[2], rotation[3]});
  read.intensity = from.number("intensity", 1, kPositiveLimits);
  read.irradiance = read_harmonics(document, document.find(light, "irradianceCoefficients"));
  const auto faces = read_faces(asset, document.find(light, "specularImages"));
  if (!faces) return std::nullopt;
  read.faces = *faces;
  return read;
}

}  // namespace gltfx::model
