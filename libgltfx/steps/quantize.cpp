// SPDX-License-Identifier: Apache-2.0
// Stores vertex attributes as integers, within the bounds of the options. The loss is measured
// afterwards, by the caller.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "container/opened_files.hpp"
#include "model/elements.hpp"
#include "model/image_sides.hpp"
#include "model/skin.hpp"
#include "report/wording.hpp"
#include "steps/attribute_roles.hpp"
#include "steps/grid_plan.hpp"
#include "steps/json_edits.hpp"
#include "steps/mesh_places.hpp"
#include "steps/quantize_store.hpp"
#include "steps/quantize_values.hpp"
#include "steps/references.hpp"
#include "steps/volume_materials.hpp"

namespace gltfx::steps {
namespace {

using model::ComponentType;
using model::SemanticKind;

constexpr std::string_view kQuantization = "KHR_mesh_quantization";

std::string lower_name(SemanticKind kind) {
  switch (kind) {
    case SemanticKind::position:
      return "positions";
    case SemanticKind::normal:
      return "normals";
    case SemanticKind::tangent:
      return "tangents";
    case SemanticKind::texcoord:
      return "texture coordinates";
    case SemanticKind::color:
      return "colors";
    case SemanticKind::weights:
      return "weights";
    default:
      return "joints";
  }
}

class Quantizer {
 public:
  explicit Quantizer(const StepInput& input)
      : bounds_(*input.options.quantize),
        data_(input),
        changes_(data_),
        formats_(data_, changes_),
        roles_(data_) {}

  Result<StepOutcome> run() {
    if (auto doubt = find_offset_doubt(data_.graph)) {
      outcome_.row.left.push_back(*std::move(doubt));
      return std::move(outcome_);
    }
    if (bounds_.position) quantize_positions_of_all();
    if (bounds_.weight) quantize_weights_of_all();
    for (std::uint32_t i = 0; i < data_.views.accessors.size(); ++i) quantize_attribute(i);
    if (formats_.empty()) return std::move(outcome_);
    if (formats_.gain(nodes_) <= 0) {
      leave({}, "integers and the JSON for them would not be smaller");
      return std::move(outcome_);
    }
    formats_.store(outcome_);
    if (needs_extension_) {
      if (auto trouble = require_extension(data_.document, changes_.editor, kQuantization))
        return *std::move(trouble);
    }
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.loss = bounds_;
    outcome_.row.what = summary();
    return std::move(outcome_);
  }

 private:
  void leave(std::string pointer, std::string reason) {
    outcome_.row.left.push_back({std::move(pointer), std::move(reason)});
  }

  void set(std::uint32_t accessor, IntegerElements elements, unsigned bits = 0) {
    const SemanticKind kind = roles_.of(accessor).kind;
    auto& [least, most] = bits_.try_emplace(kind, 32U, 0U).first->second;
    if (bits == 0) bits = 8 * model::component_size(elements.format.component);
    least = std::min(least, bits);
    most = std::max(most, bits);
    needs_extension_ |= kind == SemanticKind::position || kind == SemanticKind::normal ||
                        kind == SemanticKind::tangent;
    const unsigned of_targets = roles_.of(accessor).of_target ? 16 : 0;
    formats_.set(accessor, static_cast<unsigned>(kind) + of_targets, std::move(elements));
  }

  void quantize_positions_of_all() {
    const MeshPlaces places(data_, roles_);
    const VolumeMaterials volumes(data_);
    const GridPlan plan(data_, roles_, places, volumes, *bounds_.position);
    std::set<std::uint32_t> skins, materials;
    for (std::uint32_t i = 0; i < data_.views.meshes.size(); ++i) {
      const auto& grid = plan.of(i);
      if (!grid) {
        auto& notes = plan.is_refused(i) ? outcome_.row.refused : outcome_.row.left;
        if (!plan.obstacle(i).empty())
          notes.push_back({data_.pointer(data_.views.meshes[i].node), plan.obstacle(i)});
        continue;
      }
      for (const PositionLists& lists : plan.positions(i)) set_positions(plan, lists, *grid);
      nodes_ += places.of(i).nodes.size();
      children_ += places.place(i, *grid, changes_, formats_);
      for (const std::uint32_t skin : places.of(i).skins) {
        if (skins.insert(skin).second) set_matrices(places, skin, *grid);
      }
      for (const model::Primitive& primitive : data_.views.meshes[i].primitives) {
        if (primitive.node == json::kNoNode) continue;
        for (const std::uint32_t material : volumes.of(primitive)) {
          if (materials.insert(material).second)
            volumes.set_unit(material, grid->step, changes_.editor);
        }
      }
    }
  }

  void set_positions(const GridPlan& plan, const PositionLists& lists, const Grid& grid) {
    if (!formats_.has(lists.own)) {
      auto points = quantize_positions(plan.elements(lists.own), grid);
      if (points) set(lists.own, *std::move(points), bits_of(plan.elements(lists.own), grid));
    }
    for (const std::uint32_t target : lists.targets) {
      if (formats_.has(target)) continue;
      auto moves = quantize_moves(plan.elements(target), grid.step);
      if (moves) set(target, *std::move(moves));
    }
  }

  // Of the greatest coordinate in steps.
  static unsigned bits_of(const FloatElements& elements, const Grid& grid) {
    double greatest = 1;
    for (std::size_t i = 0; i < elements.values.size(); ++i) {
      const double steps =
          (static_cast<double>(elements.values[i]) - grid.origin[i % 3]) / grid.step;
      greatest = std::max(greatest, steps);
    }
    unsigned bits = 1;
    while (std::round(greatest) >= std::ldexp(1.0, static_cast<int>(bits))) ++bits;
    return bits;
  }

  void set_matrices(const MeshPlaces& places, std::uint32_t index, const Grid& grid) {
    const json::NodeId object = data_.asset.elements(model::RootArray::skins)[index];
    const model::Skin skin = model::read_skin(data_.asset, object);
    auto matrices = places.gridded_matrices(index, grid);
    if (!matrices) return;
    if (!skin.inverse_bind_matrices) {
      return changes_.editor.append_member(
          object, "inverseBindMatrices",
          std::to_string(formats_.add_floats(model::ElementType::mat4, *std::move(matrices))));
    }
    const std::uint32_t old = *skin.inverse_bind_matrices;
    if (can_replace_matrices(old)) return formats_.set_plain(old, *std::move(matrices));
    set_number(data_.document, changes_.editor, object, "inverseBindMatrices",
               formats_.add_floats(model::ElementType::mat4, *std::move(matrices)));
  }

  // Whether only one skin uses an accessor.
  bool can_replace_matrices(std::uint32_t accessor) const {
    const model::Accessor& described = data_.views.accessors[accessor];
    if (!described.buffer_view || described.sparse != json::kNoNode) return false;
    if (!roles_.find_unknown(accessor).empty()) return false;
    return data_.graph.users(described.node).size() == 1;
  }

  FloatElements elements_of(const model::AccessorData& data) const {
    FloatElements elements{{}, data.components()};
    elements.values.reserve(static_cast<std::size_t>(data.count()) * data.components());
    model::for_each_component(
        data, static_cast<std::size_t>(data.count()),
        [&](std::size_t, unsigned, float value) { elements.values.push_back(value); });
    return elements;
  }

  // Nothing, with a note: the elements cannot get another format.
  std::optional<FloatElements> open(std::uint32_t accessor) {
    std::string why = roles_.find_obstacle(accessor);
    std::optional<model::AccessorData> data;
    if (why.empty()) {
      if (std::string unknown = roles_.find_unknown(accessor); !unknown.empty()) {
        outcome_.row.refused.push_back({pointer_of(accessor), std::move(unknown)});
        return std::nullopt;
      }
      why = data_.open(accessor, data);
    }
    if (why.empty()) return elements_of(*data);
    leave(pointer_of(accessor), std::move(why));
    return std::nullopt;
  }
  std::string pointer_of(std::uint32_t accessor) const {
    return data_.pointer(data_.views.accessors[accessor].node);
  }

  void quantize_attribute(std::uint32_t accessor) {
    const AttributeRole& role = roles_.of(accessor);
    const model::Accessor& described = data_.views.accessors[accessor];
    if (role.uses == 0 || !described.buffer_view) return;
    if (role.kind == SemanticKind::joints && !role.is_mixed) return narrow_joints(accessor);
    const auto& bound = bound_of(role);
    if (!bound || !roles_.is_float(accessor)) return;
    const auto exact = open(accessor);
    if (!exact) return;
    if (auto rounded = quantize(role, *exact, *bound)) return set(accessor, *std::move(rounded));
    const bool is_unit = role.kind == SemanticKind::texcoord || role.kind == SemanticKind::color;
    leave(pointer_of(accessor), is_unit ? "has values outside of 0 to 1, or beyond the bound"
                                        : "has values that integers do not keep within the bound");
  }

  // Nothing: such attributes stay.
  std::optional<double> bound_of(const AttributeRole& role) const {
    switch (role.kind) {
      case SemanticKind::normal:
      case SemanticKind::tangent:
        return bounds_.normal;
      case SemanticKind::texcoord:
        return role.of_target ? std::nullopt : bounds_.texcoord;
      case SemanticKind::color:
        return role.of_target ? std::nullopt : bounds_.color;
      default:
        return std::nullopt;
    }
  }

  std::optional<IntegerElements> quantize(const AttributeRole& role, const FloatElements& exact,
                                          double bound) {
    switch (role.kind) {
      case SemanticKind::texcoord:
        if (exact.width != 2) return std::nullopt;
        if (!side_) side_ = image_side();
        return quantize_texcoords(exact, bound / *side_, is_coarse());
      case SemanticKind::color:
        return exact.width < 3 ? std::nullopt : quantize_colors(exact, bound, is_coarse());
      default:
        break;
    }
    if (role.of_target) return exact.width == 3 ? quantize_turns(exact, bound) : std::nullopt;
    const unsigned width = role.kind == SemanticKind::tangent ? 4 : 3;
    return exact.width == width ? quantize_directions(exact, bound) : std::nullopt;
  }

  bool is_coarse() const { return data_.input.options.compress == Compression::draco; }

  double image_side() const {
    container::OpenedFiles files(data_.input.asset.resolver());
    return model::longest_image_side(model::load_resources(data_.input.asset.container(), files,
                                                           data_.asset, data_.views,
                                                           data_.input.options.jobs)
                                         .data);
  }

  void narrow_joints(std::uint32_t accessor) {
    const model::Format format = data_.views.accessors[accessor].format;
    if (format.component != ComponentType::uint16) return;
    const auto joints = open(accessor);
    if (!joints || joints->width != 4) return;
    IntegerElements bytes{{format.type, ComponentType::uint8, format.normalized}, {}};
    for (const float joint : joints->values) {
      if (joint > 255.0F) return;
      bytes.bytes += static_cast<char>(static_cast<std::uint8_t>(joint));
    }
    set(accessor, std::move(bytes));
  }

  // Weights of all sets of a vertex add up to 1, so that sets are rounded together.
  void quantize_weights_of_all() {
    std::map<std::uint32_t, std::set<std::vector<std::uint32_t>>> lists;  // by accessor
    std::set<std::vector<std::uint32_t>> all;
    for (const model::Mesh& mesh : data_.views.meshes) {
      for (const model::Primitive& primitive : mesh.primitives) {
        std::vector<std::uint32_t> sets;
        for (const model::Attribute& each : primitive.attributes) {
          if (each.semantic.kind == SemanticKind::weights && each.accessor)
            sets.push_back(*each.accessor);
        }
        std::sort(sets.begin(), sets.end());
        if (sets.empty() || !all.insert(sets).second) continue;
        for (const std::uint32_t set : sets) lists[set].insert(sets);
      }
    }
    for (const std::vector<std::uint32_t>& sets : all) {
      const bool alone = std::all_of(sets.begin(), sets.end(), [&](std::uint32_t each) {
        return lists.at(each).size() == 1 && roles_.is_float(each);
      });
      if (alone) quantize_sets(sets);
    }
  }

  void quantize_sets(const std::vector<std::uint32_t>& sets) {
    if (std::adjacent_find(sets.begin(), sets.end()) != sets.end())
      return leave(pointer_of(sets.front()), "has the weights of several sets");
    std::vector<FloatElements> exact;
    for (const std::uint32_t each : sets) {
      auto elements = open(each);
      if (!elements) return;
      if (elements->width != 4 ||
          (!exact.empty() && elements->values.size() != exact.front().values.size()))
        return leave(pointer_of(each), "has weights of another number of joints");
      exact.push_back(*std::move(elements));
    }
    auto rounded = quantize_weights(exact, *bounds_.weight);
    if (!rounded) {
      return leave(pointer_of(sets.front()),
                   "has weights that do not add up to 1 within the bound");
    }
    for (std::size_t i = 0; i < sets.size(); ++i) set(sets[i], std::move((*rounded)[i]));
  }

  // "positions 14 bits, normals 8; 2 new nodes".
  std::string summary() const {
    std::string text;
    for (const auto& [kind, range] : bits_) {
      const auto& [least, most] = range;
      if (!text.empty()) text += ", ";
      text += lower_name(kind) + " ";
      text += least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most);
      if (text.find("bits") == std::string::npos) text += " bits";
    }
    if (children_ > 0) text += fmt::format("; {}", report::counted(children_, "new node"));
    return text;
  }

  const LossBounds bounds_;
  const StepData data_;
  StepChanges changes_;
  FormatChanges formats_;
  const AttributeRoles roles_;
  StepOutcome outcome_;
  std::map<SemanticKind, std::pair<unsigned, unsigned>> bits_;  ///< least and greatest
  std::optional<double> side_;                                  ///< of images, in texels
  std::size_t nodes_ = 0;                                       ///< with a mesh that got a grid
  std::size_t children_ = 0;                                    ///< new nodes
  bool needs_extension_ = false;
};

}  // namespace

StepDescription quantize_step();
StepDescription quantize_step() {
  return {"quantize",
          "stores positions, normals, tangents, texture coordinates, colors, weights and joints as "
          "integers",
          "vertices and their order, hierarchy and names; each transform changes with the "
          "coordinates that it moves",
          "each quantity up to its bound; what cannot keep it stays as it is",
          [](const ConvertOptions& options) { return options.quantize.has_value(); },
          [](const StepInput& input) { return Quantizer(input).run(); },
          {},
          [](const ConvertOptions&) { return true; }};
}

}  // namespace gltfx::steps
