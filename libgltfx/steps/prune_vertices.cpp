// SPDX-License-Identifier: Apache-2.0
#include "steps/prune_vertices.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "steps/references.hpp"
#include "steps/vertex_sets.hpp"

namespace gltfx::steps {
namespace {

constexpr std::uint32_t kUnread = UINT32_MAX;

/// The vertices that indices use.
struct ReadVertices {
  std::vector<std::uint32_t> numbers;  ///< new number by old number; kUnread: none
  std::vector<std::uint32_t> kept;     ///< old numbers, sorted
};

class VertexPruner {
 public:
  VertexPruner(const StepInput& input, ConvertStep& row)
      : data_(input), changes_(data_), extensions_(data_), row_(row) {}

  Result<PrunedVertices> run() {
    for (const VertexSet& set : find_vertex_sets(data_)) {
      const bool reads_all =
          std::any_of(set.primitives.begin(), set.primitives.end(),
                      [](const model::Primitive* primitive) { return !primitive->indices; });
      if (reads_all) continue;
      std::string why = set.obstacle.empty() ? prune(set) : set.obstacle;
      if (!why.empty() && !is_known_to_read_all(set))
        row_.left.push_back({place_of(data_, set), std::move(why)});
    }
    PrunedVertices pruned;
    if (gone_ == 0) return pruned;
    if (auto note = find_unknown_index(data_.graph, [](json::NodeId) { return false; })) {
      row_.refused.push_back(*std::move(note));
      return pruned;
    }
    auto change = changes_.finish();
    if (!change) return change.error();
    pruned.change = *std::move(change);
    pruned.vertices = gone_;
    return pruned;
  }

 private:
  // Why a set is left; empty: it is not.
  std::string prune(const VertexSet& set) {
    OpenedVertices vertices;
    if (std::string why = open_vertices(data_, set, vertices); !why.empty()) return why;
    std::vector<std::vector<std::uint32_t>> lists;
    for (const IndexList& list : vertices.indices) lists.push_back(read_index_list(list.data));
    ReadVertices read;
    if (std::string why = find_read(vertices, lists, read); !why.empty()) return why;
    const std::uint64_t gone = vertices.count - read.kept.size();
    if (gone == 0) return {};
    if (read.kept.empty()) return "has no valid index";
    if (std::string why = extensions_.find(set); !why.empty()) {
      row_.refused.push_back({place_of(data_, set), std::move(why)});
      return {};
    }
    store(vertices, lists, read);
    gone_ += gone;
    return {};
  }

  // Whether indices use all vertices, so that a set that stays needs no note.
  bool is_known_to_read_all(const VertexSet& set) {
    const model::Views& views = data_.views;
    std::uint64_t count = 0;
    for (const std::uint32_t accessor : set.accessors) {
      count = std::max(count, views.accessors[accessor].count.value_or(0));
    }
    std::vector<std::vector<std::uint32_t>> lists;
    std::uint64_t total = 0;
    for (const model::Primitive* primitive : set.primitives) {
      const auto list = model::AccessorData::open(data_.asset, views, data_.resources,
                                                  views.accessors[*primitive->indices],
                                                  model::Malformed::unusable);
      if (!list || list->implied() || list->components() != 1) return false;
      if (!model::can_index_elements(list->format().component)) return false;
      if (!data_.budget.take(checked_mul(list->count(), sizeof(std::uint32_t)))) return false;
      lists.push_back(read_index_list(*list));
      total += list->count();
    }
    if (total < count) return false;
    std::vector<bool> is_read(count, false);
    for (const auto& list : lists) {
      for (const std::uint32_t index : list) {
        if (index >= count) return false;
        is_read[index] = true;
      }
    }
    return std::find(is_read.begin(), is_read.end(), false) == is_read.end();
  }

  // Finds the vertices that indices use. Returns why that is unknown, or an empty string. The
  // greatest index of a type is never a vertex, because it may restart a primitive.
  static std::string find_read(const OpenedVertices& vertices,
                               const std::vector<std::vector<std::uint32_t>>& lists,
                               ReadVertices& read) {
    read.numbers.assign(vertices.count, kUnread);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      const std::uint32_t restart = restart_index(vertices.indices[i].data);
      for (const std::uint32_t index : lists[i]) {
        if ((index < vertices.count) == (index == restart))
          return "has an index that is out of range";
        if (index != restart) read.numbers[index] = 0;
      }
    }
    for (std::uint32_t i = 0; i < vertices.count; ++i) {
      if (read.numbers[i] == kUnread) continue;
      read.numbers[i] = static_cast<std::uint32_t>(read.kept.size());
      read.kept.push_back(i);
    }
    return {};
  }

  void store(const OpenedVertices& vertices, std::vector<std::vector<std::uint32_t>>& lists,
             const ReadVertices& read) {
    for (std::vector<std::uint32_t>& list : lists) {
      for (std::uint32_t& index : list) {
        if (index < read.numbers.size()) index = read.numbers[index];
      }
    }
    store_vertices(changes_, vertices, read.kept, lists, true);
  }

  const StepData data_;
  StepChanges changes_;
  VertexNumbers extensions_;
  ConvertStep& row_;
  std::uint64_t gone_ = 0;  ///< vertices
};

}  // namespace

Result<PrunedVertices> prune_vertices(const StepInput& input, ConvertStep& row) {
  return VertexPruner(input, row).run();
}

}  // namespace gltfx::steps
