// SPDX-License-Identifier: Apache-2.0
// Merges vertices of a primitive that are equal bit by bit (glTF 2.0 section 3.7.2).
#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/equal_records.hpp"
#include "graph/unknown_indices.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"
#include "steps/storage.hpp"
#include "steps/vertex_sets.hpp"

namespace gltfx::steps {
namespace {

// The new number of each vertex, and the vertices that stay.
struct Merging {
  std::vector<std::uint32_t> numbers;  ///< by old number
  std::vector<std::uint32_t> kept;     ///< old numbers, sorted
};

// The bytes of a vertex in all columns.
std::size_t record_size(const OpenedVertices& vertices) {
  std::size_t size = 0;
  for (const VertexColumn& column : vertices.columns)
    size += model::packed_stride(column.data.format());
  return size;
}

// All vertices, one record each.
std::string records_of(const OpenedVertices& vertices) {
  const std::size_t record = record_size(vertices);
  std::string records(record * vertices.count, '\0');
  std::size_t offset = 0;
  for (const VertexColumn& column : vertices.columns) {
    const std::size_t size = model::packed_stride(column.data.format());
    const std::string bytes = packed_bytes(column.data);
    for (std::size_t i = 0; i < vertices.count; ++i)
      std::memcpy(records.data() + i * record + offset, bytes.data() + i * size, size);
    offset += size;
  }
  return records;
}

Merging merge(const std::vector<std::uint32_t>& first) {
  Merging merging;
  merging.numbers.resize(first.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      merging.numbers[i] = static_cast<std::uint32_t>(merging.kept.size());
      merging.kept.push_back(i);
    } else {
      merging.numbers[i] = merging.numbers[first[i]];
    }
  }
  return merging;
}

class Welder {
 public:
  explicit Welder(const StepInput& input) : data_(input), changes_(data_), numbers_(data_) {}

  Result<StepOutcome> run() {
    for (const VertexSet& set : find_vertex_sets(data_)) {
      std::string why = set.obstacle.empty() ? weld(set) : set.obstacle;
      if (!why.empty()) row().left.push_back({place_of(data_, set), std::move(why)});
    }
    if (merged_ == 0) return std::move(outcome_);
    if (std::string why = find_doubt(data_.graph, "accessors"); !why.empty()) {
      row().refused.push_back({{}, std::move(why)});
      return std::move(outcome_);
    }
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    row().what = fmt::format("{} {} merged in {}", merged_, merged_ == 1 ? "vertex" : "vertices",
                             report::counted(primitives_, "primitive"));
    return std::move(outcome_);
  }

 private:
  ConvertStep& row() { return outcome_.row; }

  // Why a set is left; empty: it is not.
  std::string weld(const VertexSet& set) {
    OpenedVertices vertices;
    if (std::string why = open_vertices(data_, set, vertices); !why.empty()) return why;
    const std::size_t record = record_size(vertices);
    const Merging merging = merge(first_equal_records(records_of(vertices), record));
    const std::uint64_t merged = vertices.count - merging.kept.size();
    if (merged == 0) return {};
    if (std::string why = find_loss(set, merging, record); !why.empty()) return why;
    std::vector<std::vector<std::uint32_t>> lists;
    for (const IndexList& list : vertices.indices) {
      auto numbers = renumbered(list, merging);
      if (numbers.empty()) return "has an index that is out of range";
      lists.push_back(std::move(numbers));
    }
    if (std::string why = numbers_.find(set); !why.empty()) {
      row().refused.push_back({place_of(data_, set), std::move(why)});
      return {};
    }
    store(set, vertices, merging, lists);
    merged_ += merged;
    primitives_ += set.primitives.size();
    return {};
  }

  // Why a set would become larger: new indices may need more bytes than merged vertices save.
  static std::string find_loss(const VertexSet& set, const Merging& merging, std::size_t size) {
    constexpr std::uint64_t kTextOfIndices = 200;
    bool is_new = false;
    for (const model::Primitive* primitive : set.primitives) {
      if (primitive->indices) continue;
      if (primitive->mode == model::Mode::points) return "has points without indices";
      is_new = true;
    }
    if (!is_new) return {};
    const std::uint64_t count = merging.numbers.size();
    const std::uint64_t saved = (count - merging.kept.size()) * size;
    const std::uint64_t cost = count * model::component_size(index_type(merging)) + kTextOfIndices;
    return saved > cost ? std::string() : "would be larger with indices";
  }

  // The greatest index of a type is reserved for primitive restart.
  static model::ComponentType index_type(const Merging& merging) {
    return merging.kept.size() <= UINT16_MAX ? model::ComponentType::uint16
                                             : model::ComponentType::uint32;
  }

  // Empty: an index is out of range.
  static std::vector<std::uint32_t> renumbered(const IndexList& list, const Merging& merging) {
    std::vector<std::uint32_t> indices = read_index_list(list.data);
    const std::uint32_t restart = restart_index(list.data);
    for (std::uint32_t& index : indices) {
      if ((index < merging.numbers.size()) == (index == restart)) return {};
      if (index != restart) index = merging.numbers[index];
    }
    return indices;
  }

  void store(const VertexSet& set, const OpenedVertices& vertices, const Merging& merging,
             const std::vector<std::vector<std::uint32_t>>& lists) {
    store_vertices(changes_, vertices, merging.kept, lists, false);
    std::string added;  // new indices of the primitives that have none
    for (const model::Primitive* primitive : set.primitives) {
      if (primitive->indices) continue;
      if (added.empty()) added = std::to_string(add_indices(merging));
      changes_.editor.append_member(primitive->node, "indices", added);
    }
  }

  std::uint64_t add_indices(const Merging& merging) {
    const model::ComponentType type = index_type(merging);
    std::string bytes = index_bytes(merging.numbers, type);
    const std::size_t length = bytes.size();
    const std::uint64_t offset = changes_.buffer.add(std::move(bytes));
    const std::uint64_t view = changes_.additions.add_element(
        "bufferViews",
        view_json({changes_.buffer.index(), offset, length, 0, model::ViewTarget::indices}));
    return changes_.additions.add_element(
        "accessors",
        fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"SCALAR"}})", view,
                    static_cast<unsigned>(type), merging.numbers.size()));
  }

  const StepData data_;
  StepChanges changes_;
  VertexNumbers numbers_;
  StepOutcome outcome_;
  std::uint64_t merged_ = 0;
  std::uint64_t primitives_ = 0;
};

}  // namespace

StepDescription weld_step();
StepDescription weld_step() {
  return {"weld",
          "merges vertices of a primitive that are equal bit by bit",
          "all corners in their order, with all attributes and morph targets",
          "nothing",
          [](const ConvertOptions& options) {
            return options.weld || options.shrink || options.simplify;
          },
          [](const StepInput& input) { return Welder(input).run(); }};
}

}  // namespace gltfx::steps
