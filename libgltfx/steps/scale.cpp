// SPDX-License-Identifier: Apache-2.0
// Changes the size of an asset: the transforms of roots, and lengths that transforms do not reach.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/light.hpp"
#include "model/scene_graph.hpp"
#include "report/wording.hpp"
#include "steps/node_moves.hpp"

namespace gltfx::steps {
namespace {

/// A length that scales of nodes do not change, or a quantity that depends on one.
struct WorldLength {
  std::string_view type;
  std::string_view property;
  int power = 1;  ///< of the factor
};

// Intensity in candela: light at a distance falls with its square. That of a directional light does
// not (KHR_lights_punctual).
constexpr std::array<WorldLength, 9> kWorldLengths{{
    {"camera.orthographic", "xmag"},
    {"camera.orthographic", "ymag"},
    {"camera.orthographic", "znear"},
    {"camera.orthographic", "zfar"},
    {"camera.perspective", "znear"},
    {"camera.perspective", "zfar"},
    {"KHR_lights_punctual.light", "range"},
    {"KHR_lights_punctual.light", "intensity", 2},
    {"material.KHR_materials_volume", "attenuationDistance"},
}};

const WorldLength* find_world_length(std::string_view type, std::string_view property) {
  const auto found = std::find_if(
      kWorldLengths.begin(), kWorldLengths.end(),
      [&](const WorldLength& each) { return each.type == type && each.property == property; });
  return found == kWorldLengths.end() ? nullptr : found;
}

// Whether a unit depends on the unit of length: "m", "1/m", "N·m". Radiance ("cd/m2") does not.
bool depends_on_length(std::string_view unit) {
  if (unit == "cd/m2") return false;
  std::string word;
  for (const char c : std::string(unit) + ' ') {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += c;
      continue;
    }
    if (word == "m" || word == "N" || word == "cd") return true;
    word.clear();
  }
  return false;
}

class Scaler {
 public:
  explicit Scaler(const StepInput& input)
      : data_(input),
        changes_(data_),
        factor_(input.options.placement.scale),
        set_(data_.graph.set()) {}

  Result<StepOutcome> run() {
    if (factor_ == 1) return std::move(outcome_);
    scale_lengths();
    scale_roots();
    refuse_unknown();
    refuse_pointers();
    if (!outcome_.row.refused.empty()) return std::move(outcome_);
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.own_proof = true;
    std::vector<std::string> parts{report::counted(roots_, "root node")};
    if (lengths_ > 0) parts.push_back(report::counted(lengths_, "length"));
    outcome_.row.what =
        fmt::format("{}, times {}", fmt::join(parts, " and "), number_text(factor_));
    return std::move(outcome_);
  }

 private:
  void refuse(json::NodeId at, std::string why) {
    outcome_.row.refused.push_back({data_.pointer(at), std::move(why)});
  }

  void scale_lengths() {
    for (json::NodeId id = 0; id < data_.document.node_count(); ++id) {
      if (!data_.document.is_object(id) || data_.graph.type(id) == schema::kNone) continue;
      const schema::TypeId origin = set_.type(data_.graph.type(id)).origin;
      for (const schema::Property& property : set_.type(origin).properties) {
        if (depends_on_length(property.unit)) scale_length(id, set_.type(origin), property);
      }
    }
  }

  void scale_length(json::NodeId object, const schema::ObjectType& type,
                    const schema::Property& property) {
    if (type.name == "node" && property.name == "translation") return;  // of roots, below
    const json::NodeId value = data_.document.find(object, property.name);
    const WorldLength* const length = find_world_length(type.name, property.name);
    if (length == nullptr) {
      if (value == json::kNoNode && property.default_json.empty()) return;
      if (refused_types_.insert(type.name).second)
        refuse(object, fmt::format("{} has lengths, forces or speeds, which do not scale safely",
                                   printable(type.name)));
      return;
    }
    const double factor = std::pow(factor_, length->power);
    const bool is_intensity = length->power == 2;
    if (is_intensity && model::string_member(data_.document, object, "type") == "directional")
      return;
    if (value == json::kNoNode) {
      if (!is_intensity) return;  // unlimited
      changes_.editor.append_member(object, property.name, number_text(rounded(factor)));
    } else if (data_.document.is_number(value)) {
      const double old = data_.document.number(value).value;
      changes_.editor.replace_scalar(value, number_text(rounded(old * factor)));
    }
    ++lengths_;
  }

  // Cameras and lights have no scale; a skinned mesh does not follow its node.
  bool needs_scale(const model::Node& node) const {
    if (node.children != json::kNoNode || (node.mesh && !node.skin)) return true;
    if (node.extensions == json::kNoNode) return false;
    const bool only_light = data_.document.object_size(node.extensions) == 1 &&
                            model::light_of(data_.asset, node).has_value();
    return !only_light;
  }

  void scale_roots() {
    const model::SceneGraph graph(data_.asset, data_.views.nodes);
    NodeMoves moves;
    for (model::NodeIndex i = 0; i < graph.size(); ++i) {
      const model::Node& node = data_.views.nodes[i];
      if (node.object == json::kNoNode) continue;
      if (graph.on_loop(i)) return refuse(node.object, "is its own ancestor");
      if (graph.is_root(i)) moves[i] = {factor_, {}, needs_scale(node)};
    }
    roots_ = moves.size();
    auto refused = move_nodes(data_, moves, changes_);
    std::move(refused.begin(), refused.end(), std::back_inserter(outcome_.row.refused));
  }

  void refuse_unknown() {
    for (const json::NodeId extension : data_.graph.unknown_extensions()) {
      const json::Document& document = data_.document;
      for (json::NodeId id = extension; id < document.next(extension); ++id) {
        const bool numbers =
            document.is_number(id) || document.kind(id) == json::Kind::number_array;
        if (!numbers) continue;
        refuse(extension, "may hold lengths (describe it with --schema)");
        break;
      }
    }
  }

  void refuse_pointers() {
    for (const graph::PointerText& pointer : data_.graph.pointers()) {
      const bool of_length =
          std::any_of(pointer.steps.begin(), pointer.steps.end(), [](const std::string& step) {
            return std::any_of(kWorldLengths.begin(), kWorldLengths.end(),
                               [&](const WorldLength& each) { return each.property == step; });
          });
      if (of_length) refuse(pointer.at, "may change a length when the asset runs");
    }
  }

  const StepData data_;
  StepChanges changes_;
  const double factor_;
  const schema::Set& set_;
  StepOutcome outcome_;
  std::set<std::string, std::less<>> refused_types_;
  std::uint64_t roots_ = 0;
  std::uint64_t lengths_ = 0;
};

}  // namespace

StepDescription scale_step();
StepDescription scale_step() {
  return {"scale",
          "multiplies all lengths by a factor",
          "meshes, their data, and the picture: cameras and lights scale, too",
          "nothing beyond rounding of changed numbers",
          [](const ConvertOptions& options) { return options.placement.scale != 1; },
          [](const StepInput& input) { return Scaler(input).run(); }};
}

}  // namespace gltfx::steps
