// SPDX-License-Identifier: Apache-2.0
// Lists of triangles and lines in place of other primitives, and indices for those without (glTF
// 2.0 section 3.7.2).
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "graph/unknown_indices.hpp"
#include "model/geometry.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"
#include "steps/step_data.hpp"
#include "steps/vertex_sets.hpp"

namespace gltfx::steps {
namespace {

using model::ComponentType;
using target::Repair;

/// The source of an index list. Equal ones get the same accessor.
struct ListSource {
  model::Mode mode = model::Mode::triangles;
  std::optional<std::uint32_t> indices;  ///< nothing: all vertices in order
  std::uint64_t vertices = 0;
  auto operator<=>(const ListSource&) const = default;
};

class PrimitiveStep {
 public:
  explicit PrimitiveStep(const StepInput& input) : data_(input), changes_(data_) {}

  Result<StepOutcome> run() {
    for (const model::Mesh& mesh : data_.views.meshes) {
      for (const model::Primitive& primitive : mesh.primitives) {
        if (primitive.node == json::kNoNode || !primitive.mode) continue;
        if (std::string why = convert(primitive); !why.empty()) {
          outcome_.row.refused.push_back({data_.pointer(primitive.node), std::move(why)});
        }
      }
    }
    if (primitives_ == 0) return std::move(outcome_);
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.row.what = report::counted(primitives_, "primitive");
    return std::move(outcome_);
  }

 private:
  static bool is_list(model::Mode mode) {
    return mode == model::Mode::points || mode == model::Mode::lines ||
           mode == model::Mode::triangles;
  }

  bool is_wanted(const model::Primitive& primitive) const {
    const target::Repairs& repairs = data_.input.repairs;
    if (!is_list(*primitive.mode)) return repairs.has(Repair::lists);
    return primitive.indices_node == json::kNoNode && repairs.has(Repair::write_indices);
  }

  // Why a primitive is not converted; empty: it is, or it need not be.
  std::string convert(const model::Primitive& primitive) {
    if (!is_wanted(primitive)) return {};
    const model::Attribute* position = primitive.find(model::SemanticKind::position);
    if (position == nullptr || !position->accessor) return "it has no positions";
    const std::uint64_t vertices = data_.views.accessors[*position->accessor].count.value_or(0);
    if (vertices == 0 || vertices >= UINT32_MAX) return "its vertices cannot be counted";
    for (const json::NodeId extension : data_.graph.unknown_extensions()) {
      if (extension > primitive.node && extension < data_.document.next(primitive.node)) {
        return fmt::format("{} may hold its indices (describe it with --schema)",
                           data_.pointer(extension));
      }
    }
    const ListSource source{*primitive.mode, primitive.indices, vertices};
    auto [found, is_new] = lists_.try_emplace(source);
    if (is_new) {
      if (std::string why = make(primitive, source, found->second); !why.empty()) {
        lists_.erase(found);
        return why;
      }
    }
    declare(primitive, found->second);
    ++primitives_;
    return {};
  }

  std::string make(const model::Primitive& primitive, const ListSource& source,
                   std::uint64_t& accessor) {
    std::vector<std::uint32_t> list;
    if (std::string why = read(primitive, source, list); !why.empty()) return why;
    if (list.empty()) return "it draws nothing";
    if (source.indices && users_of(*source.indices) == 1) {
      accessor = *source.indices;
      const ComponentType own = data_.views.accessors[accessor].format.component;
      changes_.contents.set(*source.indices, {index_bytes(list, own), list.size(), true});
      return {};
    }
    const ComponentType type =
        source.vertices < UINT16_MAX ? ComponentType::uint16 : ComponentType::uint32;
    std::string bytes = index_bytes(list, type);
    const std::size_t length = bytes.size();
    const std::uint64_t offset = changes_.buffer.add(std::move(bytes));
    const std::uint64_t view = changes_.additions.add_element(
        "bufferViews",
        view_json({changes_.buffer.index(), offset, length, 0, model::ViewTarget::indices}));
    accessor = changes_.additions.add_element(
        "accessors",
        fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"SCALAR"}})", view,
                    static_cast<unsigned>(type), list.size()));
    return {};
  }

  std::size_t users_of(std::uint32_t accessor) const {
    return data_.graph.users(data_.views.accessors[accessor].node).size();
  }

  std::string read(const model::Primitive& primitive, const ListSource& source,
                   std::vector<std::uint32_t>& list) const {
    std::uint32_t restart = UINT32_MAX;
    if (primitive.indices) {
      std::optional<model::AccessorData> opened;
      if (std::string why = data_.open(*primitive.indices, opened); !why.empty()) {
        return "it " + why;
      }
      list = read_index_list(*opened);
      restart = restart_index(*opened);
    } else {
      if (primitive.indices_node != json::kNoNode) return "its indices cannot be read";
      if (!data_.budget.take(checked_mul(source.vertices, sizeof(std::uint32_t)))) {
        return "it has too many vertices";
      }
      list.resize(static_cast<std::size_t>(source.vertices));
      std::iota(list.begin(), list.end(), 0U);
    }
    if (is_list(source.mode)) return {};
    if (!data_.budget.take(checked_mul(list.size(), 3 * sizeof(std::uint32_t)))) {
      return "it has too many vertices";
    }
    model::Geometry geometry;
    model::PrimitiveAssembly assembly(source.mode, static_cast<std::uint32_t>(source.vertices),
                                      restart, geometry);
    for (const std::uint32_t index : list) assembly.add(index);
    assembly.finish();
    list.clear();
    for (const auto& each : geometry.triangles) list.insert(list.end(), each.begin(), each.end());
    for (const auto& each : geometry.segments) list.insert(list.end(), each.begin(), each.end());
    return {};
  }

  void declare(const model::Primitive& primitive, std::uint64_t accessor) {
    set_number(data_.document, changes_.editor, primitive.node, "indices", accessor);
    if (is_list(*primitive.mode)) return;
    const model::Mode mode =
        model::draws_triangles(*primitive.mode) ? model::Mode::triangles : model::Mode::lines;
    set_number(data_.document, changes_.editor, primitive.node, "mode",
               static_cast<unsigned>(mode));
  }

  const StepData data_;
  StepChanges changes_;
  std::map<ListSource, std::uint64_t> lists_;  ///< accessors
  StepOutcome outcome_;
  std::uint64_t primitives_ = 0;
};

}  // namespace

StepDescription primitives_step();
StepDescription primitives_step() {
  return {"primitives",
          "writes strips, fans and loops as lists, and missing indices, as a target reads them",
          "all triangles and lines in their order, and all vertices",
          "triangles and lines that repeat a vertex",
          [](const ConvertOptions&) { return false; },
          [](const StepInput& input) { return PrimitiveStep(input).run(); },
          {Repair::lists, Repair::write_indices}};
}

}  // namespace gltfx::steps
