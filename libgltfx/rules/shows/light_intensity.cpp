// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "model/light.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kExtension = "KHR_lights_punctual";

// What is wrong with a light, as a clause; empty: nothing.
std::string strangeness(const model::Light& light) {
  if (!(light.intensity > 0)) return "intensity is 0, so the light is off";
  const float brightest = *std::max_element(light.color.begin(), light.color.end());
  if (!(brightest > 0)) return "color is black, so the light is off";
  constexpr double kSun = 1e5;  // lux
  constexpr double kMostCandela = 1e6;
  constexpr double kMostLux = 1e6;
  const double strength = static_cast<double>(light.intensity);
  if (light.type == model::LightType::directional) {
    if (strength < kMostLux) return {};
    return fmt::format("intensity is {:.0f} lux, {:.0f} times as bright as the sun", strength,
                       strength / kSun);
  }
  if (strength < kMostCandela) return {};
  return fmt::format(
      "intensity is {:.0f} candela: at a distance of 1 m, the light is {:.0f} times as bright as "
      "the "
      "sun",
      strength, strength / kSun);
}

bool may_change(const Context& context) {
  return std::any_of(context.views.animations.begin(), context.views.animations.end(),
                     [](const model::Animation& animation) {
                       return std::any_of(animation.channels.begin(), animation.channels.end(),
                                          [](const model::AnimationChannel& channel) {
                                            return channel.path == model::AnimationPath::other;
                                          });
                     });
}

}  // namespace

void check_light_intensity(DataPhase& phase) {
  const Context& context = phase.context;
  const auto lights = model::read_lights(context.asset);
  if (lights.empty() || may_change(context)) return;
  std::set<std::uint32_t> used;
  for (const model::Node& node : context.views.nodes) {
    if (const auto light = model::light_of(context.asset, node)) used.insert(*light);
  }
  const json::Document& document = context.document;
  const json::NodeId extension = model::object_member(
      document, model::object_member(document, document.root(), "extensions"), kExtension);
  if (extension == json::kNoNode) return;
  const json::NodeId list = document.find(extension, "lights");
  std::uint32_t index = 0;
  for (const json::NodeId object : document.elements(list)) {
    const std::uint32_t i = index++;
    if (i >= lights.size() || !lights[i] || used.count(i) == 0) continue;
    const std::string found = strangeness(*lights[i]);
    if (found.empty()) continue;
    const std::string_view member = found.starts_with("color") ? "color" : "intensity";
    report_at(phase.sink, fmt::format("/extensions/{}/lights/{}/{}", kExtension, i, member),
              finding_on(context, document.find(object, member), Code::LIGHT_INTENSITY_UNUSUAL,
                         found + "."));
  }
}

}  // namespace gltfx::validate
