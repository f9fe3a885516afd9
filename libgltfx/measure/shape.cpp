// SPDX-License-Identifier: Apache-2.0
#include "measure/shape.hpp"

#include <algorithm>
#include <map>

#include "base/checked.hpp"

namespace gltfx::measure {
namespace {

using model::Primitive;
using model::PrimitiveData;
using model::SemanticKind;

// The positions of distinct accessors, one behind the other.
class Positions {
 public:
  explicit Positions(std::vector<Float3>& to) : to_(to) {}

  // The number of the first position of a primitive.
  std::size_t add(const VertexKey& key, const model::AccessorData& data) {
    const auto [known, fresh] = begins_.try_emplace(key, to_.size());
    if (!fresh) return known->second;
    const std::size_t begin = to_.size();
    to_.resize(begin + static_cast<std::size_t>(data.count()));
    model::for_each_component(
        data, static_cast<std::size_t>(data.count()),
        [&](std::size_t i, unsigned k, float value) { to_[begin + i][k] = value; });
    return begin;
  }
  bool has(const VertexKey& key) const { return begins_.count(key) != 0; }

 private:
  std::vector<Float3>& to_;
  std::map<VertexKey, std::size_t> begins_;
};

class ShapeReader {
 public:
  ShapeReader(const Source& source, model::MemoryBudget& budget, Shape& shape)
      : source_(source), budget_(budget), shape_(shape), positions_(shape.positions) {}

  std::string_view read(const model::Mesh& mesh) {
    for (const Primitive& primitive : mesh.primitives) {
      if (!draws_triangles(primitive)) continue;
      if (const std::string_view why = add(primitive); !why.empty()) return why;
    }
    return {};
  }

 private:
  // Bytes of a position and a triangle with all that is made of them.
  static constexpr std::uint64_t kPerPosition = 48, kPerTriangle = 96;

  std::string_view add(const Primitive& primitive) {
    const PrimitiveData data(source_.geometry(), primitive);
    const auto positions = data.open(SemanticKind::position);
    if (!positions || positions->components() != 3) return missing_positions(data);
    const VertexKey key = vertex_key(source_, primitive);
    const bool separate = data.packed() != nullptr || primitive.mode == model::Mode::triangles;
    const std::uint64_t most = model::index_count(data, positions->count()) / (separate ? 3 : 1);
    const Checked vertices =
        checked_mul(positions_.has(key) ? 0 : positions->count(), kPerPosition);
    const Checked triangles = checked_mul(most, kPerTriangle);
    const Checked bytes = vertices && triangles ? checked_add(*vertices, *triangles) : std::nullopt;
    if (!budget_.take(bytes)) return kTooLarge;
    const std::size_t begin = positions_.add(key, *positions);
    // Corners of triangles are numbered, too.
    if (shape_.positions.size() >= UINT32_MAX || most >= UINT32_MAX / 3) return kTooLarge;
    model::Geometry geometry;
    if (!model::assemble(data, static_cast<std::uint32_t>(positions->count()), geometry)) {
      return kNoIndices;
    }
    shape_.collapsed += geometry.collapsed;
    append(geometry.triangles, static_cast<std::uint32_t>(begin));
    return shape_.triangles.size() < UINT32_MAX / 3 ? std::string_view() : kTooLarge;
  }

  void append(std::vector<model::Triangle>& triangles, std::uint32_t begin) {
    if (begin == 0 && shape_.triangles.empty()) {
      shape_.triangles = std::move(triangles);
      return;
    }
    for (const auto& [a, b, c] : triangles) {
      shape_.triangles.push_back({a + begin, b + begin, c + begin});
    }
  }

  const Source& source_;
  model::MemoryBudget& budget_;
  Shape& shape_;
  Positions positions_;
};

bool moves_vertices(std::span<const float> weights) {
  return std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0; });
}

// What the requested vertices of a primitive are read from.
std::vector<std::uint64_t> vertices_key(const Source& source, const Primitive& primitive,
                                        const model::GeometryRequest& request) {
  const auto draco = model::read_draco(source.asset(), primitive);
  std::vector<std::uint64_t> key{draco ? std::uint64_t{draco->buffer_view} + 1 : 0};
  const auto add = [&](const model::Attribute& each) {
    const auto kind = static_cast<std::uint64_t>(each.semantic.kind);
    const std::uint64_t accessor = each.accessor ? std::uint64_t{*each.accessor} + 1 : 0;
    key.insert(key.end(), {kind, each.semantic.set, accessor});
  };
  const auto is_read = [&](const model::Attribute& each) {
    const auto& [kind, set] = each.semantic;
    if (kind == SemanticKind::joints || kind == SemanticKind::weights) {
      return !request.joints.empty();
    }
    const auto& sets = request.tex_coords;
    return kind == SemanticKind::position ||
           (kind == SemanticKind::texcoord &&
            std::find(sets.begin(), sets.end(), set) != sets.end());
  };
  for (const model::Attribute& each : primitive.attributes) {
    if (is_read(each)) add(each);
  }
  if (!moves_vertices(request.weights)) return key;
  for (const json::NodeId target : primitive.targets) {
    key.push_back(UINT64_MAX);
    for (const auto& each : model::read_attributes(source.asset(), target)) add(each);
  }
  return key;
}

using PrimitiveGroup = std::vector<std::size_t>;

// By their vertices, in the order of their first ones.
std::vector<PrimitiveGroup> groups_of(const Source& source,
                                      std::span<const Primitive* const> primitives,
                                      const model::GeometryRequest& request) {
  std::vector<PrimitiveGroup> groups;
  std::map<std::vector<std::uint64_t>, std::size_t> known;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const bool draws =
        primitives[i]->mode && primitives[i]->find(SemanticKind::position) != nullptr;
    if (!draws) continue;
    std::size_t group = groups.size();
    if (primitives.size() > 1) {
      group = known.emplace(vertices_key(source, *primitives[i], request), group).first->second;
    }
    if (group == groups.size()) groups.emplace_back();
    groups[group].push_back(i);
  }
  return groups;
}

}  // namespace

bool draws_triangles(const Primitive& primitive) {
  return primitive.mode && model::draws_triangles(*primitive.mode) &&
         primitive.find(SemanticKind::position) != nullptr;
}

std::vector<const Primitive*> pointers_to(const std::vector<Primitive>& primitives) {
  std::vector<const Primitive*> pointers;
  for (const Primitive& primitive : primitives) pointers.push_back(&primitive);
  return pointers;
}

bool is_fault(model::GeometryError error) {
  return error != model::GeometryError::none && error != model::GeometryError::empty;
}

void read_primitives(const Source& source, std::span<const Primitive* const> primitives,
                     const model::GeometryRequest& request, model::MemoryBudget& budget,
                     const std::function<bool(const ReadPrimitive&)>& use) {
  using Error = model::GeometryError;
  for (const PrimitiveGroup& group : groups_of(source, primitives, request)) {
    model::Geometry geometry;
    bool known = false;
    for (const std::size_t i : group) {
      if (!known) geometry = {};
      const Error error =
          known
              ? model::read_elements(source.geometry(), *primitives[i], budget, geometry)
              : model::read_geometry(source.geometry(), *primitives[i], request, budget, geometry);
      const bool read = error == Error::none || error == Error::empty || error == Error::no_indices;
      if (!use({i, !known && read, error, geometry})) return;
      known = known || read;
    }
  }
}

std::uint64_t geometry_bytes(const Source& source) {
  constexpr std::uint64_t kFree = std::uint64_t{256} << 20U;
  constexpr std::uint64_t kPlainWorth = 32, kCompressedWorth = 256;
  const bool compressed = model::has_compressed_geometry(source.document());
  const Checked worth =
      checked_mul(source.resources().buffer_bytes(), compressed ? kCompressedWorth : kPlainWorth);
  return saturating_add(worth.value_or(UINT64_MAX), kFree);
}

VertexKey vertex_key(const Source& source, const Primitive& primitive) {
  const model::Attribute* position = primitive.find(SemanticKind::position);
  const auto draco = model::read_draco(source.asset(), primitive);
  return {draco ? std::uint64_t{draco->buffer_view} + 1 : 0,
          position != nullptr && position->accessor ? std::uint64_t{*position->accessor} + 1 : 0};
}

std::string_view missing_positions(const PrimitiveData& data) {
  const bool undecoded =
      data.packed() == nullptr && model::read_draco(data.source().asset, data.primitive());
  return undecoded ? "A primitive is compressed and could not be decoded."
                   : "A primitive has no positions that can be read.";
}

std::string_view read_shape(const Source& source, const model::Mesh& mesh,
                            model::MemoryBudget& budget, Shape& shape) {
  return ShapeReader(source, budget, shape).read(mesh);
}

std::vector<std::uint64_t> shape_key(const Source& source, const model::Mesh& mesh) {
  std::vector<std::uint64_t> key;
  for (const Primitive& primitive : mesh.primitives) {
    if (!draws_triangles(primitive)) continue;
    const auto [stream, positions] = vertex_key(source, primitive);
    const bool has_indices = primitive.indices_node != json::kNoNode;
    const std::uint64_t indices = primitive.indices ? *primitive.indices + std::uint64_t{2} : 1;
    key.insert(key.end(), {stream, positions, has_indices ? indices : 0,
                           static_cast<std::uint64_t>(*primitive.mode)});
  }
  return key;
}

}  // namespace gltfx::measure
