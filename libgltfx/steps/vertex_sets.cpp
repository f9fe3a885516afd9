// SPDX-License-Identifier: Apache-2.0
#include "steps/vertex_sets.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "model/draco.hpp"
#include "model/fields.hpp"

namespace gltfx::steps {
namespace {

using model::AccessorData;
using model::Attribute;
using model::Primitive;

constexpr std::uint32_t kNoSet = UINT32_MAX;
constexpr const char* kBroken = "has members that cannot be read";

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The uses of one accessor by primitives.
struct AccessorReaders {
  std::uint32_t set = kNoSet;  ///< the first set that uses it
  bool as_indices = false;
  bool as_vertices = false;
  bool of_other_vertices = false;  ///< indices of sets with different numbers of vertices
  std::uint64_t uses = 0;
};

class SetFinder {
 public:
  explicit SetFinder(const StepData& data) : data_(data), readers_(data.views.accessors.size()) {}

  std::vector<VertexSet> run() {
    for (const model::Mesh& mesh : data_.views.meshes) {
      for (const Primitive& primitive : mesh.primitives) {
        if (primitive.node != json::kNoNode) add(primitive);
      }
    }
    std::vector<VertexSet> joined = join();
    for (VertexSet& set : joined) {
      for (const std::uint32_t accessor : set.accessors) look_at(accessor, set);
      for (const Primitive* primitive : set.primitives) {
        if (primitive->indices) look_at(*primitive->indices, set);
      }
    }
    return joined;
  }

 private:
  void add(const Primitive& primitive) {
    std::string obstacle = obstacle_of(primitive);
    std::vector<std::uint32_t> accessors;
    const auto take = [&](const std::vector<Attribute>& attributes) {
      for (const Attribute& attribute : attributes) {
        if (attribute.accessor) {
          accessors.push_back(*attribute.accessor);
        } else {
          obstacle = kBroken;
        }
      }
    };
    take(primitive.attributes);
    for (const json::NodeId target : primitive.targets) {
      take(model::read_attributes(data_.asset, target));
    }
    std::vector<std::uint32_t> key = accessors;
    sort_unique(key);
    if (key.empty()) return;
    const auto [place, is_new] =
        numbers_.try_emplace(std::move(key), static_cast<std::uint32_t>(sets_.size()));
    if (is_new) {
      sets_.push_back({place->first, {}, {}});
      groups_.add();
    }
    members_.emplace_back(&primitive, place->second);
    std::string& known = sets_[place->second].obstacle;
    if (known.empty()) known = std::move(obstacle);
    for (const std::uint32_t accessor : accessors) note(accessor, place->second, false);
    if (primitive.indices) note(*primitive.indices, place->second, true);
  }

  void note(std::uint32_t accessor, std::uint32_t set, bool as_indices) {
    AccessorReaders& readers = readers_[accessor];
    ++readers.uses;
    (as_indices ? readers.as_indices : readers.as_vertices) = true;
    if (readers.set == kNoSet) readers.set = set;
    if (as_indices && vertices_of(readers.set) != vertices_of(set)) {
      readers.of_other_vertices = true;
    } else {
      groups_.join(set, readers.set);
    }
  }

  std::optional<std::uint64_t> vertices_of(std::uint32_t set) const {
    return data_.views.accessors[sets_[set].accessors.front()].count;
  }

  // Joins the sets that share accessors, so that all of them get the same numbering.
  std::vector<VertexSet> join() {
    std::vector<VertexSet> joined;
    std::vector<std::uint32_t> places(sets_.size(), kNoSet);  // in `joined`, by root
    std::vector<bool> is_taken(sets_.size());
    for (const auto& [primitive, set] : members_) {
      std::uint32_t& place = places[groups_.find(set)];
      if (place == kNoSet) {
        place = static_cast<std::uint32_t>(joined.size());
        joined.emplace_back();
      }
      VertexSet& all = joined[place];
      all.primitives.push_back(primitive);
      if (is_taken[set]) continue;
      is_taken[set] = true;
      const std::vector<std::uint32_t>& own = sets_[set].accessors;
      all.accessors.insert(all.accessors.end(), own.begin(), own.end());
      if (all.obstacle.empty()) all.obstacle = std::move(sets_[set].obstacle);
    }
    for (VertexSet& set : joined) sort_unique(set.accessors);
    return joined;
  }

  std::string obstacle_of(const Primitive& primitive) const {
    if (!primitive.mode || primitive.targets_are_broken) return kBroken;
    if (primitive.indices_node != json::kNoNode && !primitive.indices) return kBroken;
    if (model::extension_object(data_.document, primitive.node, model::kDracoExtension) !=
        json::kNoNode)
      return "is compressed; decode it first: --compress none";
    return {};
  }

  void look_at(std::uint32_t accessor, VertexSet& set) const {
    if (!set.obstacle.empty()) return;
    const AccessorReaders& readers = readers_[accessor];
    if (readers.of_other_vertices) {
      set.obstacle = "shares its indices with primitives that have other vertices";
      return;
    }
    const auto users = data_.graph.users(data_.views.accessors[accessor].node);
    const bool has_others = users.size() != readers.uses;
    if (has_others || (readers.as_indices && readers.as_vertices))
      set.obstacle = "shares an accessor with objects other than primitives";
  }

  const StepData& data_;
  std::vector<AccessorReaders> readers_;  ///< by accessor
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;
  std::vector<VertexSet> sets_;  ///< by their exact accessors, without primitives
  DisjointSets groups_;          ///< of sets that share accessors
  std::vector<std::pair<const Primitive*, std::uint32_t>> members_;  ///< with their sets
};

}  // namespace

std::vector<VertexSet> find_vertex_sets(const StepData& data) { return SetFinder(data).run(); }

std::string open_vertices(const StepData& data, const VertexSet& set, OpenedVertices& opened) {
  std::optional<AccessorData> elements;
  for (const std::uint32_t accessor : set.accessors) {
    if (std::string why = data.open(accessor, elements); !why.empty()) return why;
    if (!opened.columns.empty() && elements->count() != opened.count)
      return "has attributes of different lengths";
    opened.count = elements->count();
    opened.columns.push_back({accessor, *std::move(elements)});
  }
  if (opened.count > UINT32_MAX - 1) return "has too many vertices";
  std::unordered_set<std::uint32_t> known;
  for (const Primitive* primitive : set.primitives) {
    if (!primitive->indices || !known.insert(*primitive->indices).second) continue;
    if (std::string why = data.open(*primitive->indices, elements); !why.empty()) return why;
    const model::Format& format = elements->format();
    if (format.type != model::ElementType::scalar || format.normalized ||
        !model::can_index_elements(format.component))
      return "has indices that are not integers";
    opened.indices.push_back({*primitive->indices, *std::move(elements)});
  }
  return {};
}

std::vector<std::uint32_t> read_index_list(const AccessorData& data) {
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(data.count()));
  model::with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
      for (std::size_t i = 0; i < elements; ++i)
        indices.push_back(static_cast<std::uint32_t>(values[i]));
    });
  });
  return indices;
}

std::uint32_t restart_index(const AccessorData& indices) {
  return static_cast<std::uint32_t>(model::value_range(indices.format().component).most);
}

std::string place_of(const StepData& data, const VertexSet& set) {
  return data.pointer(set.primitives.front()->node);
}

void store_vertices(StepChanges& changes, const OpenedVertices& vertices,
                    const std::vector<std::uint32_t>& order,
                    const std::vector<std::vector<std::uint32_t>>& indices, bool other_values) {
  for (const VertexColumn& column : vertices.columns) {
    const std::size_t size = model::packed_stride(column.data.format());
    const std::string old = packed_bytes(column.data);
    std::string bytes;
    bytes.reserve(size * order.size());
    for (const std::uint32_t vertex : order) bytes.append(old, vertex * size, size);
    changes.contents.set(column.accessor, {std::move(bytes), order.size(), other_values});
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const model::AccessorData& data = vertices.indices[i].data;
    changes.contents.set(
        vertices.indices[i].accessor,
        {index_bytes(indices[i], data.format().component), indices[i].size(), true});
  }
}

}  // namespace gltfx::steps
