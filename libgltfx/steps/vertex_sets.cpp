// SPDX-License-Identifier: Apache-2.0
#include "steps/vertex_sets.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "model/draco.hpp"
#include "model/fields.hpp"

namespace gltfx::steps {
namespace {

using model::AccessorData;
using model::Attribute;
using model::Primitive;

constexpr std::size_t kNoSet = SIZE_MAX;
constexpr const char* kBroken = "has members that cannot be read";

/// The uses of one accessor.
struct AccessorReaders {
  std::size_t set = kNoSet;
  bool several_sets = false;
  bool as_indices = false;
  bool as_vertices = false;
  std::uint64_t uses = 0;  ///< by primitives

  void note(std::size_t other, bool indices) {
    several_sets |= set != kNoSet && set != other;
    set = other;
    (indices ? as_indices : as_vertices) = true;
    ++uses;
  }
};

class SetFinder {
 public:
  explicit SetFinder(const StepData& data) : data_(data), readers_(data.views().accessors.size()) {}

  std::vector<VertexSet> run() {
    for (const model::Mesh& mesh : data_.views().meshes) {
      for (const Primitive& primitive : mesh.primitives) {
        if (primitive.node != json::kNoNode) add(primitive);
      }
    }
    for (VertexSet& set : sets_) {
      for (const std::uint32_t accessor : set.accessors) look_at(accessor, false, set);
      for (const Primitive* primitive : set.primitives) {
        if (primitive->indices) look_at(*primitive->indices, true, set);
      }
    }
    return std::move(sets_);
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
      take(model::read_attributes(data_.elements, target));
    }
    std::vector<std::uint32_t> key = accessors;
    std::sort(key.begin(), key.end());
    key.erase(std::unique(key.begin(), key.end()), key.end());
    if (key.empty()) return;
    const auto [place, is_new] = numbers_.try_emplace(std::move(key), sets_.size());
    if (is_new) sets_.push_back({place->first, {}, {}});
    VertexSet& set = sets_[place->second];
    set.primitives.push_back(&primitive);
    if (set.obstacle.empty()) set.obstacle = std::move(obstacle);
    for (const std::uint32_t accessor : accessors) readers_[accessor].note(place->second, false);
    if (primitive.indices) readers_[*primitive.indices].note(place->second, true);
  }

  std::string obstacle_of(const Primitive& primitive) const {
    if (!primitive.mode || primitive.targets_are_broken) return kBroken;
    if (primitive.indices_node != json::kNoNode && !primitive.indices) return kBroken;
    if (model::extension_object(data_.document, primitive.node, model::kDracoExtension) !=
        json::kNoNode)
      return "is compressed; decode it first: --compress none";
    return {};
  }

  void look_at(std::uint32_t accessor, bool as_indices, VertexSet& set) const {
    if (!set.obstacle.empty()) return;
    const AccessorReaders& readers = readers_[accessor];
    if (readers.several_sets) {
      set.obstacle = as_indices ? "shares its indices with primitives that have other vertices"
                                : "shares some but not all of its accessors with other primitives";
      return;
    }
    const auto users = data_.graph.users(data_.views().accessors[accessor].node);
    const bool has_others = users.size() != readers.uses;
    if (has_others || (readers.as_indices && readers.as_vertices))
      set.obstacle = "shares an accessor with objects other than primitives";
  }

  const StepData& data_;
  std::vector<AccessorReaders> readers_;  ///< by accessor
  std::map<std::vector<std::uint32_t>, std::size_t> numbers_;
  std::vector<VertexSet> sets_;
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
  std::vector<std::uint32_t> known;
  for (const Primitive* primitive : set.primitives) {
    if (primitive->indices) known.push_back(*primitive->indices);
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const Primitive* primitive : set.primitives) {
    if (!primitive->indices) continue;
    const auto found = std::lower_bound(known.begin(), known.end(), *primitive->indices);
    if (found == known.end() || *found != *primitive->indices) continue;
    known.erase(found);
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

std::string index_bytes(const std::vector<std::uint32_t>& indices, model::ComponentType type) {
  const std::size_t size = model::component_size(type);
  std::string bytes(size * indices.size(), '\0');
  for (std::size_t i = 0; i < indices.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k)
      bytes[i * size + k] = static_cast<char>(indices[i] >> (8 * k) & 0xFFU);
  }
  return bytes;
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
    changes.contents.set(column.accessor, {std::move(bytes), order.size(), other_values,
                                           model::ViewTarget::vertices});
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const model::AccessorData& data = vertices.indices[i].data;
    changes.contents.set(vertices.indices[i].accessor,
                         {index_bytes(indices[i], data.format().component), data.count(), true,
                          model::ViewTarget::indices});
  }
}

}  // namespace gltfx::steps
