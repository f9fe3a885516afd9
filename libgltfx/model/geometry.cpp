// SPDX-License-Identifier: Apache-2.0
#include "model/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/checked.hpp"
#include "model/deformation.hpp"
#include "model/meshopt_view.hpp"
#include "model/skin.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint32_t kNoRestart = UINT32_MAX;

template <std::size_t N>
bool is_finite(const std::array<float, N>& values) {
  return std::all_of(values.begin(), values.end(), [](float each) { return std::isfinite(each); });
}

// Normalizes to length 1; a vector of length 0, or of unknown length, becomes zero.
template <std::size_t N>
void normalize_direction(std::array<float, N>& vector) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    square += static_cast<double>(vector[k]) * static_cast<double>(vector[k]);
  }
  const double factor = square > 0 && std::isfinite(square) ? 1 / std::sqrt(square) : 0;
  for (std::size_t k = 0; k < 3; ++k) {
    vector[k] = factor > 0 ? static_cast<float>(static_cast<double>(vector[k]) * factor) : 0;
  }
}

// Of finite positions.
struct PositionBox {
  Vector3 least{}, greatest{};
  bool empty = true;

  // A number of single precision: differences from it are exact.
  Vector3 middle() const {
    Vector3 middle{};
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] = static_cast<double>(static_cast<float>((least[k] + greatest[k]) / 2));
    }
    return middle;
  }
  double size() const {
    const Vector3 extent{greatest[0] - least[0], greatest[1] - least[1], greatest[2] - least[2]};
    return std::sqrt(dot(extent, extent));
  }
  // The greatest absolute value of a coordinate.
  double reach() const {
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) reach = std::max({reach, -least[k], greatest[k]});
    return reach;
  }
};

PositionBox box_of(const Vectors<3>& positions) {
  PositionBox box;
  for (const auto& position : positions) {
    if (!is_finite(position)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = static_cast<double>(position[k]);
      box.least[k] = box.empty ? value : std::min(box.least[k], value);
      box.greatest[k] = box.empty ? value : std::max(box.greatest[k], value);
    }
    box.empty = false;
  }
  return box;
}

// The distance of numbers of single precision around a value.
double step_at(double value) {
  const auto rounded = static_cast<float>(value);
  const float next = std::nextafter(rounded, std::numeric_limits<float>::infinity());
  return static_cast<double>(next - rounded);
}

// Whether rounding to single precision costs more than it does around 0, but no more than numbers
// of double precision can give back.
bool is_far(const PositionBox& box) {
  constexpr double kFar = 8;  // in extents
  constexpr double kFarthest = 1e12;
  const double reach = box.reach();
  return reach > kFar * box.size() && reach < kFarthest;
}

// Leaves out what has a vertex that is not finite.
GeometryError assemble_finite(const PrimitiveData& data, Geometry& geometry) {
  const auto vertices = static_cast<std::uint32_t>(geometry.positions.size());
  if (!assemble(data, vertices, geometry)) return GeometryError::no_indices;
  const auto is_infinite = [&](std::uint32_t i) { return !is_finite(geometry.positions[i]); };
  const auto has_infinite = [&](const auto& corners) {
    return std::any_of(corners.begin(), corners.end(), is_infinite);
  };
  std::erase_if(geometry.triangles, has_infinite);
  std::erase_if(geometry.segments, has_infinite);
  std::erase_if(geometry.points, is_infinite);
  if (geometry.triangles.size() < geometry.triangles.capacity() / 2) {
    geometry.triangles.shrink_to_fit();
  }
  return geometry.empty() ? GeometryError::empty : GeometryError::none;
}

class GeometryReader {
 public:
  GeometryReader(const PrimitiveData& data, const GeometryRequest& request, Geometry& geometry)
      : data_(data), request_(request), geometry_(geometry) {}

  GeometryError read(MemoryBudget& budget) {
    const auto positions = data_.open(SemanticKind::position);
    if (!positions || positions->components() != 3) return GeometryError::no_positions;
    if (positions->count() >= kNoRestart) return GeometryError::too_large;
    count_ = static_cast<std::size_t>(positions->count());
    if (!budget.take(size())) return GeometryError::too_large;
    geometry_.positions.resize(count_);
    read_elements(*positions, geometry_.positions);
    if (request_.near_origin) move_near_origin(positions->format().component);
    read_attributes();
    morph(data_, request_.weights, request_.tex_coords, geometry_);
    if (!request_.joints.empty()) geometry_.skinned = skin(data_, request_.joints, geometry_);
    finish();
    return assemble_finite(data_, geometry_);
  }

 private:
  // Of normals, tangents and colors.
  bool reads(SemanticKind kind) const {
    return request_.surface && data_.primitive().find(kind) != nullptr;
  }

  // Bytes of all data that will be read. Morph targets and sets of joints are not kept, but count
  // as work: a file may have any number of them over the same bytes.
  Checked size() const {
    std::uint64_t vertex = sizeof(float) * (3 + 2 * request_.tex_coords.size());
    if (reads(SemanticKind::normal)) vertex += sizeof(float) * 3;
    if (reads(SemanticKind::tangent)) vertex += sizeof(float) * 4;
    if (reads(SemanticKind::color)) vertex += sizeof(float) * 4;
    const auto moving = std::count_if(request_.weights.begin(), request_.weights.end(),
                                      [](float weight) { return weight != 0; });
    vertex += sizeof(float) * static_cast<std::uint64_t>(moving);
    if (!request_.joints.empty()) vertex += sizeof(float) * joint_sets(data_.primitive());
    const Checked vertices = checked_mul(count_, vertex);
    const Checked triangles = checked_mul(index_count(data_, count_), sizeof(Triangle));
    return vertices && triangles ? checked_add(*triangles, *vertices) : std::nullopt;
  }

  void move_near_origin(ComponentType stored) {
    const PositionBox box = box_of(geometry_.positions);
    const bool rounded = stored == ComponentType::float32 || stored == ComponentType::float64;
    const double step = step_at(box.reach());
    if (rounded && box.size() > 0 && step > box.size() / 1000) geometry_.coarse_step = step;
    if (!is_far(box)) return;
    geometry_.origin = box.middle();
    for (auto& position : geometry_.positions) {
      for (std::size_t k = 0; k < 3; ++k) {
        position[k] = static_cast<float>(static_cast<double>(position[k]) - geometry_.origin[k]);
      }
    }
  }

  // True when there are as many elements as vertices. An attribute without bytes is all zeros,
  // which is useful for morph targets and texture coordinates.
  template <std::size_t N>
  bool read(SemanticKind kind, std::uint64_t set, unsigned least, Vectors<N>& to) const {
    const Attribute* attribute = data_.primitive().find(kind, set);
    if (attribute == nullptr) return false;
    const auto elements = data_.open(kind, set);
    if (!elements && !is_implied(*attribute)) return false;
    if (elements && (elements->count() != count_ || elements->components() < least ||
                     elements->components() > N)) {
      return false;
    }
    to.resize(count_);
    if (elements) read_elements(*elements, to);
    return true;
  }

  bool is_implied(const Attribute& attribute) const {
    if (!attribute.accessor || data_.packed() != nullptr) return false;
    const Accessor& accessor = data_.source().views.accessors[*attribute.accessor];
    return accessor.count == count_ && !accessor.buffer_view && accessor.sparse == json::kNoNode;
  }

  void read_attributes() {
    if (reads(SemanticKind::normal)) read(SemanticKind::normal, 0, 3, geometry_.normals);
    // Tangents without normals are meaningless.
    if (!geometry_.normals.empty()) read(SemanticKind::tangent, 0, 4, geometry_.tangents);
    for (const std::uint32_t set : request_.tex_coords) {
      read(SemanticKind::texcoord, set, 2, geometry_.tex_coords.emplace_back());
    }
    if (!reads(SemanticKind::color)) return;
    geometry_.colors.assign(count_, {1, 1, 1, 1});
    if (!read(SemanticKind::color, 0, 3, geometry_.colors)) geometry_.colors.clear();
  }

  void finish() {
    for (auto& normal : geometry_.normals) normalize_direction(normal);
    for (auto& tangent : geometry_.tangents) {
      normalize_direction(tangent);
      tangent[3] = tangent[3] < 0 ? -1.0F : 1.0F;
    }
    for (auto& color : geometry_.colors) {
      for (float& value : color) value = std::clamp(value, 0.0F, 1.0F);
    }
  }

  const PrimitiveData& data_;
  const GeometryRequest& request_;
  Geometry& geometry_;
  std::size_t count_ = 0;
};

}  // namespace

void PrimitiveAssembly::emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (std::max({a, b, c}) >= vertices_) return;
  if (a != b && b != c && c != a) {
    to_.triangles.push_back({a, b, c});
  } else {
    ++to_.collapsed;
  }
}

void PrimitiveAssembly::emit(std::uint32_t a, std::uint32_t b) {
  if (std::max(a, b) < vertices_ && a != b) to_.segments.push_back({a, b});
}

void PrimitiveAssembly::add(std::uint32_t index) {
  if (index == restart_) {
    finish();
    count_ = 0;
  } else if (draws_triangles(mode_)) {
    add_to_triangles(index);
  } else if (mode_ != Mode::points) {
    add_to_segments(index);
  } else if (index < vertices_) {
    to_.points.push_back(index);
  }
}

void PrimitiveAssembly::finish() {
  if (mode_ == Mode::line_loop && count_ > 1) emit(held_[1], held_[0]);
}

// Keeps the first vertex of a loop, and the previous one.
void PrimitiveAssembly::add_to_segments(std::uint32_t index) {
  if (count_ == 0) held_[0] = index;
  if (count_ > 0) emit(held_[1], index);
  held_[1] = index;
  ++count_;
  if (mode_ == Mode::lines && count_ == 2) count_ = 0;
}

void PrimitiveAssembly::add_to_triangles(std::uint32_t index) {
  if (count_ < 2) {
    held_[count_++] = index;
    return;
  }
  const auto [a, b] = held_;
  const bool odd = mode_ == Mode::triangle_strip && count_ % 2 == 1;
  emit(odd ? b : a, odd ? a : b, index);
  ++count_;
  if (mode_ == Mode::triangles) count_ = 0;
  if (mode_ == Mode::triangle_strip) held_[0] = b;
  if (mode_ != Mode::triangles) held_[1] = index;
}

std::uint64_t index_count(const PrimitiveData& data, std::uint64_t vertices) {
  if (data.packed() != nullptr) return data.packed()->indices.size();
  const auto& indices = data.primitive().indices;
  if (!indices) return vertices;
  return data.source().views.accessors[*indices].count.value_or(0);
}

std::uint32_t restart_index(const PrimitiveData& data) {
  const auto& indices = data.primitive().indices;
  if (data.packed() != nullptr || !indices) return kNoRestart;
  const ComponentType type = data.source().views.accessors[*indices].format.component;
  return can_index_elements(type) ? static_cast<std::uint32_t>(value_range(type).most) : kNoRestart;
}

bool assemble(const PrimitiveData& data, std::uint32_t vertices, Geometry& to) {
  const codec::DracoMesh* packed = data.packed();
  const Mode mode = packed != nullptr ? Mode::triangles : *data.primitive().mode;
  PrimitiveAssembly assembly(mode, vertices, restart_index(data), to);
  if (draws_triangles(mode)) {
    const std::uint64_t most = index_count(data, vertices) / (mode == Mode::triangles ? 3 : 1);
    to.triangles.reserve(to.triangles.size() + static_cast<std::size_t>(most));
  }
  if (!for_each_index(data, vertices, [&](std::uint32_t index) { assembly.add(index); })) {
    return false;
  }
  assembly.finish();
  return true;
}

bool has_compressed_geometry(const json::Document& document) {
  const auto uses = [&](std::string_view name) { return document.key_id(name) != json::kNoKey; };
  return uses(kDracoExtension) ||
         std::any_of(kMeshoptExtensions.begin(), kMeshoptExtensions.end(), uses);
}

PrimitiveData::PrimitiveData(const GeometrySource& source, const Primitive& primitive)
    : source_(source), primitive_(primitive), reference_(read_draco(source.asset, primitive)) {
  if (reference_) packed_ = source.draco.mesh(reference_->buffer_view);
}

std::optional<AccessorData> PrimitiveData::open(SemanticKind kind, std::uint64_t set) const {
  const Attribute* attribute = primitive_.find(kind, set);
  return attribute != nullptr ? open(*attribute) : std::nullopt;
}

std::optional<AccessorData> PrimitiveData::open(const Attribute& attribute) const {
  if (!attribute.accessor) return std::nullopt;
  const auto id =
      packed_ != nullptr ? draco_id(source_.asset, *reference_, attribute.name) : std::nullopt;
  if (!id) return open(attribute.accessor);
  const codec::DracoAttribute* found = find_attribute(*packed_, *id);
  if (found == nullptr) return std::nullopt;
  const bool normalized = source_.views.accessors[*attribute.accessor].format.normalized;
  return AccessorData::packed(format_of(*found, normalized), packed_->points,
                              {found->values, packed_->owner}, found->quantization_step);
}

std::optional<AccessorData> PrimitiveData::open(
    const std::optional<std::uint32_t>& accessor) const {
  if (!accessor) return std::nullopt;
  return AccessorData::open(source_.asset, source_.views, source_.resources,
                            source_.views.accessors[*accessor], Malformed::unusable);
}

std::string_view error_text(GeometryError error) {
  static constexpr std::array<std::string_view, 6> kTexts{
      "can be drawn",
      "has no positions that can be read",
      "has no indices that can be read",
      "is compressed and could not be decoded",
      "asks for more memory than its bytes can be worth",
      "has nothing to draw: no triangle with an area, no line, no point"};
  return kTexts[static_cast<std::size_t>(error)];
}

GeometryError read_geometry(const GeometrySource& source, const Primitive& primitive,
                            const GeometryRequest& request, MemoryBudget& budget,
                            Geometry& geometry) {
  if (!primitive.mode) return GeometryError::empty;
  const PrimitiveData data(source, primitive);
  const GeometryError error = GeometryReader(data, request, geometry).read(budget);
  const bool undecoded = data.packed() == nullptr && read_draco(source.asset, primitive);
  return error == GeometryError::no_positions && undecoded ? GeometryError::packed : error;
}

GeometryError read_elements(const GeometrySource& source, const Primitive& primitive,
                            MemoryBudget& budget, Geometry& geometry) {
  geometry.triangles.clear();
  geometry.segments.clear();
  geometry.points.clear();
  geometry.collapsed = 0;
  if (!primitive.mode) return GeometryError::empty;
  const PrimitiveData data(source, primitive);
  const std::uint64_t indices = index_count(data, geometry.positions.size());
  if (!budget.take(checked_mul(indices, sizeof(Triangle)))) return GeometryError::too_large;
  return assemble_finite(data, geometry);
}

}  // namespace gltfx::model
