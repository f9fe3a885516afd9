// SPDX-License-Identifier: Apache-2.0
// Orders triangles and vertices for GPU caches.
#include <algorithm>
#include <numeric>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "model/material.hpp"
#include "model/vertex_cache.hpp"
#include "report/wording.hpp"
#include "steps/storage.hpp"
#include "steps/vertex_sets.hpp"

namespace gltfx::steps {
namespace {

using Indices = std::vector<std::uint32_t>;

constexpr std::uint32_t kNoNumber = UINT32_MAX;

/// Orders the triangles of lists that share vertices.
class TriangleOrder {
 public:
  explicit TriangleOrder(std::uint64_t vertices)
      : local_(static_cast<std::size_t>(vertices), kNoNumber) {}

  // Whether the order of the list changed. Repeats as long as an order is better by more than 1 %,
  // so a second call changes nothing.
  bool improve(Indices& indices) {
    constexpr double kWorthwhile = 0.99;
    bool improved = false;
    for (;;) {
      Indices numbers = localized(indices);
      const double misses = model::cache_miss_ratio(numbers, used_.size());
      numbers = model::order_for_cache(numbers, used_.size());
      if (model::cache_miss_ratio(numbers, used_.size()) >= kWorthwhile * misses) return improved;
      for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = used_[numbers[i]];
      improved = true;
    }
  }

 private:
  // Numbers vertices by first use, so that the time depends only on the length of the list.
  Indices localized(const Indices& indices) {
    Indices numbers;
    numbers.reserve(indices.size());
    used_.clear();
    for (const std::uint32_t index : indices) {
      if (local_[index] == kNoNumber) {
        local_[index] = static_cast<std::uint32_t>(used_.size());
        used_.push_back(index);
      }
      numbers.push_back(local_[index]);
    }
    for (const std::uint32_t vertex : used_) local_[vertex] = kNoNumber;
    return numbers;
  }

  Indices local_;  ///< by vertex; kNoNumber between calls
  Indices used_;   ///< vertices by local number
};

// Old vertices by first use, followed by unused ones in their old order.
Indices order_of_use(const std::vector<Indices>& lists, std::uint64_t vertices) {
  std::vector<bool> is_used(static_cast<std::size_t>(vertices));
  Indices order;
  order.reserve(is_used.size());
  const auto use = [&](std::uint32_t vertex) {
    if (is_used[vertex]) return;
    is_used[vertex] = true;
    order.push_back(vertex);
  };
  for (const Indices& list : lists) std::for_each(list.begin(), list.end(), use);
  for (std::uint32_t i = 0; i < vertices; ++i) use(i);
  return order;
}

class Reorderer {
 public:
  explicit Reorderer(const StepInput& input)
      : data_(input),
        changes_(data_),
        numbers_(data_),
        materials_(data_.document.find(data_.document.root(), "materials")) {}

  Result<StepOutcome> run() {
    for (const VertexSet& set : find_vertex_sets(data_)) {
      std::string why = set.obstacle.empty() ? reorder(set) : set.obstacle;
      if (!why.empty()) outcome_.row.left.push_back({place_of(data_, set), std::move(why)});
    }
    if (primitives_ == 0) return std::move(outcome_);
    if (std::string why = find_doubt(data_.graph, "accessors"); !why.empty()) {
      outcome_.row.refused.push_back({{}, std::move(why)});
      return std::move(outcome_);
    }
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.vertex_order = true;
    outcome_.row.what = report::counted(primitives_, "primitive");
    return std::move(outcome_);
  }

 private:
  // Why a set is left; empty: it is not.
  std::string reorder(const VertexSet& set) {
    std::vector<ConvertNote> notes;  // about primitives that keep the order of their triangles
    std::unordered_set<std::uint32_t> kept;  // their indices
    for (const model::Primitive* primitive : set.primitives) {
      std::string why = find_fixed_order(*primitive);
      if (!primitive->indices) return why.empty() ? "has triangles without indices" : why;
      if (why.empty()) continue;
      kept.insert(*primitive->indices);
      notes.push_back({data_.pointer(primitive->node), std::move(why)});
    }
    if (notes.size() == set.primitives.size()) return notes.front().reason;
    OpenedVertices vertices;
    if (std::string why = open_vertices(data_, set, vertices); !why.empty()) return why;
    std::vector<Indices> lists;
    for (const IndexList& list : vertices.indices) {
      lists.push_back(read_index_list(list.data));
      if (!kept.contains(list.accessor) && lists.back().size() % 3 != 0)
        return "has an incomplete triangle";
      const std::uint32_t restart = restart_index(list.data);
      for (const std::uint32_t index : lists.back()) {
        if (index >= vertices.count) return "has an index that is out of range";
        if (index == restart) return "has an index that is reserved for primitive restart";
      }
    }
    outcome_.row.left.insert(outcome_.row.left.end(), notes.begin(), notes.end());
    TriangleOrder triangles(vertices.count);
    bool changed = false;
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (!kept.contains(vertices.indices[i].accessor)) changed |= triangles.improve(lists[i]);
    }
    const Indices order = order_of_use(lists, vertices.count);
    changed |= !std::is_sorted(order.begin(), order.end());
    if (!changed) return {};
    if (std::string why = numbers_.find(set); !why.empty()) {
      outcome_.row.refused.push_back({place_of(data_, set), std::move(why)});
      return {};
    }
    store(vertices, order, std::move(lists));
    primitives_ += set.primitives.size();
    return {};
  }

  // Why the triangles of a primitive keep their order; empty: they may change it.
  std::string find_fixed_order(const model::Primitive& primitive) {
    if (primitive.mode != model::Mode::triangles) return "has primitives that are not triangles";
    if (is_blended(primitive)) return "is blended, so the order of its triangles is visible";
    return {};
  }

  // Whether any material of the primitive, including those of variants, is blended.
  bool is_blended(const model::Primitive& primitive) {
    bool found = false;
    data_.graph.each_use_in(primitive.node, [&](const graph::Use& use) {
      if (data_.graph.tree().parent(use.target) != materials_) return;
      const auto [known, is_new] = blended_.try_emplace(use.target);
      if (is_new) known->second = is_blended(data_.graph.tree().position(use.target));
      found |= known->second;
    });
    return found;
  }
  bool is_blended(std::uint32_t material) const {
    const model::Material read = model::read_material(data_.asset, material);
    return read.alpha_mode == model::AlphaMode::blend ||
           read.of(MaterialParameter::transmission)[0] > 0;
  }

  void store(const OpenedVertices& vertices, const Indices& order, std::vector<Indices> lists) {
    Indices numbers(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) numbers[order[i]] = i;
    for (Indices& list : lists) {
      for (std::uint32_t& index : list) index = numbers[index];
    }
    store_vertices(changes_, vertices, order, lists, false);
  }

  const StepData data_;
  StepChanges changes_;
  VertexNumbers numbers_;
  const json::NodeId materials_;  ///< the array
  StepOutcome outcome_;
  std::unordered_map<json::NodeId, bool> blended_;  ///< by material
  std::uint64_t primitives_ = 0;
};

}  // namespace

StepDescription reorder_step();
StepDescription reorder_step() {
  return {"reorder",
          "orders triangles and vertices for GPU caches",
          "all triangles with all attributes and morph targets, and their winding",
          "the order of triangles and vertices",
          [](const ConvertOptions& options) { return options.reorder || options.shrink; },
          [](const StepInput& input) { return Reorderer(input).run(); }};
}

}  // namespace gltfx::steps
