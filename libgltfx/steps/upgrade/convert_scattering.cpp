// SPDX-License-Identifier: Apache-2.0
// KHR_materials_sss, and KHR_materials_subsurface after it, define the scattering coefficient by a
// colour and a distance. Their successors split the attenuation of KHR_materials_volume, which
// represented only absorption, by a multi-scatter albedo: so both objects change.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model/fields.hpp"
#include "schema/phrases.hpp"
#include "steps/upgrade/conversion.hpp"
#include "steps/upgrade/scattering.hpp"

namespace gltfx::upgrade {
namespace {

constexpr const char* kVolume = "KHR_materials_volume";
constexpr const char* kWithThinMode = "KHR_materials_scatter";

std::string number_json(double value) { return fmt::format("{:.9g}", value); }

std::string color_json(const Rgb& color) {
  return fmt::format("[{},{},{}]", number_json(color[0]), number_json(color[1]),
                     number_json(color[2]));
}

std::optional<Rgb> color_of(const json::Document& document, json::NodeId list) {
  if (list == json::kNoNode || document.kind(list) != json::Kind::number_array) return {};
  Rgb color{};
  std::size_t count = 0;
  for (json::NumberCursor at(document, list); at.valid(); at.advance(), ++count) {
    if (count == color.size()) return {};
    color[count] = at.number().value;
    if (!(color[count] >= 0 && color[count] <= 1)) return {};
  }
  if (count != color.size()) return {};
  return color;
}

bool is_all(const Rgb& color, double value) {
  return std::all_of(color.begin(), color.end(), [value](double c) { return c == value; });
}

/// A number above 0; nothing if the member has another value.
struct Distance {
  bool there = false;
  std::optional<double> metres;
};

Distance distance_of(const json::Document& document, json::NodeId object, std::string_view name) {
  const auto value = model::number_member(document, object, name);
  const bool there = document.find(object, name) != json::kNoNode;
  return {there, value && *value > 0 ? value : std::nullopt};
}

class Scattering : public Conversion {
 public:
  Problem reason_to_go(const ConversionContext& context) override {
    const json::Document& document = context.run.document;
    if (context.member("scatterDistance") == json::kNoNode) {
      return "no effect: without scatterDistance light does not scatter";
    }
    const json::NodeId color = context.member("scatterColor");
    if (color == json::kNoNode) return "no effect: without scatterColor light does not scatter";
    const auto value = color_of(document, color);
    if (value && is_all(*value, 1))
      return "no effect: with a white scatterColor light does not scatter";
    if (value && is_all(*value, 0) && context.run.options.unsafe) {
      return "a black scatterColor is treated as the default, which does not scatter light";
    }
    return std::nullopt;
  }

  Problem prepare(const ConversionContext& context) override {
    for (const char* name : {"scatterDistance", "scatterColor"}) {
      if (context.is_own_pointed_at(name)) {
        return fmt::format("its {} is animated, but the new values depend on it", name);
      }
    }
    const json::Document& document = context.run.document;
    const Distance distance = distance_of(document, context.host.object, "scatterDistance");
    const auto color = color_of(document, context.member("scatterColor"));
    if (!distance.metres) return "its scatterDistance is invalid; see 'gltfx validate'";
    if (!color) return "its scatterColor is invalid; see 'gltfx validate'";
    if (is_all(*color, 0)) {
      return "a black scatterColor with a finite scatterDistance is ambiguous: infinite density, "
             "or the default without scattering; --unsafe uses the default";
    }
    note_black(context, *color, "scatterColor");
    const json::NodeId volume = model::object_member(document, context.host.extensions, kVolume);
    if (volume == json::kNoNode) return fmt::format("the material has no {}", kVolume);
    if (context.successor.name == kWithThinMode) {
      if (Problem problem = check_thin_mode(context, volume)) return problem;
    }
    return check_volume(context, volume, coefficient(*color, *distance.metres));
  }

  void apply(const ConversionContext& context) override {
    context.drop("scatterDistance");
    context.drop("scatterColor");
    json::Editor& editor = context.run.editor;
    if (context.successor.name == kWithThinMode) {
      editor.append_member(context.host.object, "scatterStrengthFactor", "1");
    }
    editor.append_member(context.host.object, "multiscatterColorFactor",
                         color_json(medium_.multi_scatter_color));
  }

 private:
  static void note_black(const ConversionContext& context, const Rgb& color,
                         std::string_view name) {
    if (*std::min_element(color.begin(), color.end()) >= 1e-6) return;
    context.action.lossy = true;
    context.action.notes.push_back(fmt::format(
        "a channel of {} is 0, which means infinite density; it is replaced by 1e-6", name));
  }

  // That extension scatters in a volume only if there is one and light enters by transmission;
  // otherwise the surface is a thin sheet, which looks different.
  static Problem check_thin_mode(const ConversionContext& context, json::NodeId volume) {
    for (const schema::Relation& needed : context.successor.requires_) {
      if (context.run.has_beside(context.host, needed.extension)) continue;
      return fmt::format("{} requires {}: {}", context.successor.name, needed.extension,
                         schema::clause(needed.because));
    }
    const auto thickness = model::number_member(context.run.document, volume, "thicknessFactor");
    if (thickness.value_or(0) > 0) return std::nullopt;
    return fmt::format("without a thickness, {} renders it as thin-walled", context.successor.name);
  }

  Problem check_volume(const ConversionContext& context, json::NodeId volume,
                       const Rgb& scattering) {
    const json::Document& document = context.run.document;
    for (const char* name : {"attenuationDistance", "attenuationColor"}) {
      if (!context.is_pointed_at(fmt::format("extensions/{}/{}", kVolume, name))) continue;
      return fmt::format("{} of the volume is animated, but the new values depend on it", name);
    }
    const Distance distance = distance_of(document, volume, "attenuationDistance");
    const json::NodeId list = document.find(volume, "attenuationColor");
    const auto color = list == json::kNoNode ? Rgb{1, 1, 1} : color_of(document, list);
    if (!color || (distance.there && !distance.metres)) {
      return "the attenuation of its volume is invalid; see 'gltfx validate'";
    }
    Rgb absorption{};
    if (distance.metres) {
      absorption = coefficient(*color, *distance.metres);
      note_black(context, *color, "attenuationColor");
    }
    medium_ = medium_of(scattering, absorption);
    if (!std::isnormal(medium_.attenuation_distance)) return "its distances are out of range";
    const std::string path = fmt::format("extensions/{}/", kVolume);
    if (Problem problem = context.placements.put(path + "attenuationColor",
                                                 color_json(medium_.attenuation_color))) {
      return problem;
    }
    return context.placements.put(path + "attenuationDistance",
                                  number_json(medium_.attenuation_distance));
  }

  Medium medium_{};
};

}  // namespace

std::unique_ptr<Conversion> make_scattering() { return std::make_unique<Scattering>(); }

}  // namespace gltfx::upgrade
