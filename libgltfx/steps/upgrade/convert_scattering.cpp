// SPDX-License-Identifier: Apache-2.0
// KHR_materials_sss, and KHR_materials_subsurface after it, give the scattering coefficient by a
// colour and a distance. Their successors split the attenuation of KHR_materials_volume, which
// stood for absorption alone, by a multi-scatter albedo: so both objects change.
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

/// A number above 0, or nothing when it is there and something else.
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
  Problem reason_to_go(const ConversionContext& bench) override {
    const json::Document& document = bench.context.document;
    if (bench.member("scatterDistance") == json::kNoNode) {
      return "no effect: without scatterDistance light does not scatter";
    }
    const json::NodeId color = bench.member("scatterColor");
    if (color == json::kNoNode) return "no effect: without scatterColor light does not scatter";
    const auto value = color_of(document, color);
    if (value && is_all(*value, 1))
      return "no effect: with a white scatterColor light does not scatter";
    if (value && is_all(*value, 0) && bench.context.options.unsafe) {
      return "a black scatterColor is treated as the default, which does not scatter light";
    }
    return std::nullopt;
  }

  Problem judge(const ConversionContext& bench) override {
    for (const char* name : {"scatterDistance", "scatterColor"}) {
      if (bench.is_own_pointed_at(name)) {
        return fmt::format("its {} is animated, but the new values depend on it", name);
      }
    }
    const json::Document& document = bench.context.document;
    const Distance distance = distance_of(document, bench.carrier.object, "scatterDistance");
    const auto color = color_of(document, bench.member("scatterColor"));
    if (!distance.metres) return "its scatterDistance is invalid; see 'gltfx validate'";
    if (!color) return "its scatterColor is invalid; see 'gltfx validate'";
    if (is_all(*color, 0)) {
      return "a black scatterColor with a finite scatterDistance is ambiguous: infinite density, "
             "or the default without scattering; --unsafe uses the default";
    }
    note_black(bench, *color, "scatterColor");
    const json::NodeId volume = model::object_member(document, bench.carrier.extensions, kVolume);
    if (volume == json::kNoNode) return fmt::format("the material has no {}", kVolume);
    if (bench.successor.name == kWithThinMode) {
      if (Problem problem = judge_thin_mode(bench, volume)) return problem;
    }
    return judge_volume(bench, volume, coefficient(*color, *distance.metres));
  }

  void apply(const ConversionContext& bench) override {
    bench.drop("scatterDistance");
    bench.drop("scatterColor");
    json::Editor& editor = bench.context.editor;
    if (bench.successor.name == kWithThinMode) {
      editor.append_member(bench.carrier.object, "scatterStrengthFactor", "1");
    }
    editor.append_member(bench.carrier.object, "multiscatterColorFactor",
                         color_json(medium_.multi_scatter_color));
  }

 private:
  static void note_black(const ConversionContext& bench, const Rgb& color, std::string_view name) {
    if (*std::min_element(color.begin(), color.end()) >= 1e-6) return;
    bench.action.lossy = true;
    bench.action.notes.push_back(fmt::format(
        "a channel of {} is 0, which means infinite density; it is replaced by 1e-6", name));
  }

  // That extension scatters in a volume only where there is one and light gets in by transmission;
  // otherwise it is a thin sheet, which is another picture.
  static Problem judge_thin_mode(const ConversionContext& bench, json::NodeId volume) {
    for (const schema::Relation& needed : bench.successor.requires_) {
      if (bench.context.has_beside(bench.carrier, needed.extension)) continue;
      return fmt::format("{} requires {}: {}", bench.successor.name, needed.extension,
                         schema::clause(needed.because));
    }
    const auto thickness = model::number_member(bench.context.document, volume, "thicknessFactor");
    if (thickness.value_or(0) > 0) return std::nullopt;
    return fmt::format("without a thickness, {} renders it as thin-walled", bench.successor.name);
  }

  Problem judge_volume(const ConversionContext& bench, json::NodeId volume, const Rgb& scattering) {
    const json::Document& document = bench.context.document;
    for (const char* name : {"attenuationDistance", "attenuationColor"}) {
      if (!bench.is_pointed_at(fmt::format("extensions/{}/{}", kVolume, name))) continue;
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
      note_black(bench, *color, "attenuationColor");
    }
    medium_ = medium_of(scattering, absorption);
    if (!std::isnormal(medium_.attenuation_distance)) return "its distances are out of range";
    const std::string path = fmt::format("extensions/{}/", kVolume);
    if (Problem problem = bench.placements.put(path + "attenuationColor",
                                               color_json(medium_.attenuation_color))) {
      return problem;
    }
    return bench.placements.put(path + "attenuationDistance",
                                number_json(medium_.attenuation_distance));
  }

  Medium medium_{};
};

}  // namespace

std::unique_ptr<Conversion> make_scattering() { return std::make_unique<Scattering>(); }

}  // namespace gltfx::upgrade
