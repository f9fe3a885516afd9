// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "cases.hpp"
#include "render/light.hpp"
#include "render/texture.hpp"
#include "render/tonemap.hpp"

namespace gltfx::ground_truth {
namespace {

Value transformed(const std::array<double, 2>& offset, double rotation,
                  const std::array<double, 2>& scale, const std::vector<double>& uv) {
  const auto narrow = [](double value) { return static_cast<float>(value); };
  const auto m = render::texture_transform({narrow(offset[0]), narrow(offset[1])}, narrow(rotation),
                                           {narrow(scale[0]), narrow(scale[1])});
  Value list;
  list.kind = Value::Kind::list;
  for (const auto& row : m) {
    list.items.push_back(double{row[0]} * uv[0] + double{row[1]} * uv[1] + double{row[2]});
  }
  return list;
}

std::array<double, 2> pair(Inputs& inputs, const std::string& key, double otherwise) {
  const std::vector<double> read = inputs.numbers(key, {otherwise, otherwise});
  return {read.empty() ? otherwise : read[0], read.size() < 2 ? otherwise : read[1]};
}

}  // namespace

Value texture_transform(Inputs& inputs, const Value& expected) {
  const std::array<double, 2> offset = pair(inputs, "offset", 0);
  const std::array<double, 2> scale = pair(inputs, "scale", 1);
  const double rotation = inputs.number("rotation", 0);
  const std::array<double, 2> at = pair(inputs, "uv", 0);
  const std::vector<double> uv(at.begin(), at.end());
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "uv") return transformed(offset, rotation, scale, uv);
    // The reading that is not followed turns the other way.
    if (key == "uv_readme_glsl_read_column_major") {
      return transformed(offset, -rotation, scale, uv);
    }
    return {};
  });
}

namespace {

render::Light read_light(Inputs& inputs) {
  render::Light light;
  const std::string type = inputs.text("type");
  if (type == "directional") light.kind = render::Light::Kind::directional;
  if (type == "spot") light.kind = render::Light::Kind::spot;
  const double intensity = inputs.number("candela", 1) * inputs.number("lux", 1);
  const Rgb color = inputs.color("color", Rgb(1)) * intensity;
  light.intensity = {static_cast<float>(color.x), static_cast<float>(color.y),
                     static_cast<float>(color.z)};
  light.range = static_cast<float>(inputs.number("range", 0));
  const std::vector<double> cone = inputs.numbers("cone", {0, std::numbers::pi / 4});
  light.inner_cone = static_cast<float>(cone.empty() ? 0 : cone[0]);
  light.outer_cone = static_cast<float>(cone.size() < 2 ? std::numbers::pi / 4 : cone[1]);
  return light;
}

}  // namespace

Value punctual(Inputs& inputs, const Value& expected) {
  const render::Light light = read_light(inputs);
  const double distance = inputs.number("distance", 1);
  const double angle = inputs.number("angle", 0);
  // The light is in the origin and shines along -z; the surface faces it.
  const Vec3d point(distance * std::sin(angle), 0, -distance * std::cos(angle));
  const Rgb lux = render::illuminate(light, point).irradiance;
  Material lambert;
  lambert.metallic = 0;
  lambert.specular = 0;
  const Vec3d up(0, 0, 1);
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "illuminance_normal") return lux;
    if (key == "lambert_white_radiance") return lux * evaluate(lambert, up, up, kSpec);
    return {};
  });
}

Value output(Inputs& inputs, const Value& expected) {
  const Rgb linear = inputs.color("linear", {});
  const auto number = [](double x) { return static_cast<float>(x); };
  const float srgb = render::srgb_encode(number(linear.x));
  const auto neutral = render::tone_map({number(linear.x), number(linear.y), number(linear.z)});
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "pbr_neutral") return Rgb(neutral[0], neutral[1], neutral[2]);
    if (key == "srgb") return static_cast<double>(srgb);
    if (key == "byte") return static_cast<double>(render::to_byte(srgb));
    return {};
  });
}

}  // namespace gltfx::ground_truth
