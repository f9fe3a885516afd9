// SPDX-License-Identifier: Apache-2.0
// Computes normals that have no direction from the faces around their vertices.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "model/accessor_data.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/core/fix_elements.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;
using Direction = std::array<double, 3>;

constexpr double kNoDirection = 1e-6;  // relative to a length that should be 1
constexpr double kUnitLength = 1e-4;

Direction difference(const Direction& a, const Direction& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double scalar_product(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction vector_product(const Direction& a, const Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length_of_direction(const Direction& a) { return std::sqrt(scalar_product(a, a)); }

std::optional<AccessorData> open_data(Fixing& fixing, std::uint32_t accessor) {
  auto data = AccessorData::open(fixing.elements(), fixing.views(), fixing.resources(),
                                 fixing.views().accessors[accessor], model::Malformed::unusable);
  const bool affordable = data && !data->implied() &&
                          fixing.table<ReadBudget>().take(data->count(), data->components());
  return affordable ? std::move(data) : std::nullopt;
}

// Whether an extension stores the geometry in a buffer view of its own, compressed.
bool is_stored_elsewhere(const json::Document& document, const model::Primitive& primitive) {
  const json::NodeId extensions = document.find(primitive.node, "extensions");
  if (extensions == json::kNoNode || !document.is_object(extensions)) return false;
  for (const auto member : document.members(extensions)) {
    if (document.find(member.value, "bufferView") != json::kNoNode) return true;
  }
  return false;
}

/// The sum of the normals of the faces at each vertex, weighted by their angle there.
class Faces {
 public:
  /// Faces of all primitives with these normals. Nothing if the primitives have different
  /// positions, or positions that cannot be read.
  static std::optional<Faces> around(Fixing& fixing, std::uint32_t normals, std::uint64_t count) {
    std::optional<std::uint32_t> positions;
    const auto primitives = primitives_with(fixing, normals);
    for (const model::Primitive* primitive : primitives) {
      const model::Attribute* own = primitive->find(model::SemanticKind::position);
      if (own == nullptr || !own->accessor || (positions && positions != own->accessor)) {
        return std::nullopt;
      }
      positions = own->accessor;
    }
    Faces faces;
    if (!positions || !faces.read_positions(fixing, *positions, count)) return std::nullopt;
    for (const model::Primitive* primitive : primitives) {
      if (!faces.add_primitive(fixing, *primitive)) return std::nullopt;
    }
    return faces;
  }

  bool has(std::uint64_t vertex) const { return angles_[vertex] > 0; }
  /// Length 1; nothing if the faces point in opposite directions.
  std::optional<Direction> direction(std::uint64_t vertex) const {
    constexpr double kCancelled = 1e-3;
    const double total = length_of_direction(sums_[vertex]);
    if (!(total > kCancelled * angles_[vertex])) return std::nullopt;
    Direction unit = sums_[vertex];
    for (double& component : unit) component /= total;
    return unit;
  }

 private:
  bool read_positions(Fixing& fixing, std::uint32_t accessor, std::uint64_t count) {
    const auto data = open_data(fixing, accessor);
    if (!data || data->components() != 3 || data->count() != count) return false;
    positions_.reserve(static_cast<std::size_t>(count));
    model::with_component_type(data->format().component, [&](auto type) {
      data->visit<decltype(type)>([&](const auto* values, std::size_t elements, std::uint64_t) {
        for (std::size_t i = 0; i < elements * 3; i += 3) {
          positions_.push_back({static_cast<double>(values[i]), static_cast<double>(values[i + 1]),
                                static_cast<double>(values[i + 2])});
        }
      });
    });
    sums_.resize(positions_.size());
    angles_.resize(positions_.size());
    return true;
  }

  bool read_indices(Fixing& fixing, const model::Primitive& primitive,
                    std::vector<std::size_t>& indices) {
    if (!primitive.indices) {
      for (std::size_t i = 0; i < positions_.size(); ++i) indices.push_back(i);
      return fixing.table<ReadBudget>().take(positions_.size(), 3);
    }
    const auto data = open_data(fixing, *primitive.indices);
    if (!data || data->components() != 1 || !model::is_integer(data->format().component)) {
      return false;
    }
    model::with_component_type(data->format().component, [&](auto type) {
      data->visit<decltype(type)>([&](const auto* values, std::size_t count, std::uint64_t) {
        for (std::size_t i = 0; i < count; ++i) {
          const auto index = static_cast<double>(values[i]);
          const bool valid = index >= 0 && index < static_cast<double>(positions_.size());
          indices.push_back(valid ? static_cast<std::size_t>(index) : SIZE_MAX);
        }
      });
    });
    return true;
  }

  // The front side of other modes is undefined.
  bool add_primitive(Fixing& fixing, const model::Primitive& primitive) {
    if (!primitive.mode || !model::draws_triangles(*primitive.mode)) return false;
    if (is_stored_elsewhere(fixing.document(), primitive)) return false;
    std::vector<std::size_t> indices;
    if (!read_indices(fixing, primitive, indices)) return false;
    const bool list = *primitive.mode == model::Mode::triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += list ? 3 : 1) {
      const bool fan = *primitive.mode == model::Mode::triangle_fan;
      const bool turned = !list && !fan && i % 2 == 1;
      add_face(
          {indices[fan ? 0 : i], indices[turned ? i + 2 : i + 1], indices[turned ? i + 1 : i + 2]});
    }
    return true;
  }

  void add_face(const std::array<std::size_t, 3>& corners) {
    for (const std::size_t corner : corners) {
      if (corner >= positions_.size()) return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Direction& here = positions_[corners[i]];
      const Direction next = difference(positions_[corners[(i + 1) % 3]], here);
      const Direction before = difference(positions_[corners[(i + 2) % 3]], here);
      const Direction normal = vector_product(next, before);
      const double size = length_of_direction(normal);
      if (!(size > 0) || !std::isfinite(size)) return;
      const double angle = std::atan2(size, scalar_product(next, before));
      for (std::size_t c = 0; c < 3; ++c) sums_[corners[i]][c] += normal[c] / size * angle;
      angles_[corners[i]] += angle;
    }
  }

  std::vector<Direction> positions_, sums_;
  std::vector<double> angles_;
};

// Integers are fractions of the greatest value.
double one_in(const Elements& elements) {
  return elements.is_float() ? 1 : model::value_range(elements.format().component).most;
}

double length_in(const Elements& normals, std::uint64_t vertex) {
  return length_of_direction(
             {normals.get(vertex, 0), normals.get(vertex, 1), normals.get(vertex, 2)}) /
         one_in(normals);
}

bool has_direction(const Elements& normals, std::uint64_t vertex) {
  const double own = length_in(normals, vertex);
  return std::isfinite(own) && own >= kNoDirection;
}

// A vertex without faces is not drawn: any direction is valid.
std::optional<Direction> direction_for(const Faces& faces, std::uint64_t vertex) {
  return faces.has(vertex) ? faces.direction(vertex) : Direction{0, 0, 1};
}

bool fill(Fixing& fixing, std::uint32_t accessor, bool beside_others) {
  auto normals = open_elements(fixing, accessor, "NORMAL");
  const bool readable = normals && normals->components() == 3 &&
                        (normals->is_float() || normals->format().normalized);
  const auto faces = readable ? Faces::around(fixing, accessor, normals->count()) : std::nullopt;
  if (!faces) return false;
  std::vector<std::pair<std::uint64_t, Direction>> made;
  for (std::uint64_t vertex = 0; vertex < normals->count(); ++vertex) {
    if (has_direction(*normals, vertex)) {
      if (faces->has(vertex) && !beside_others) return false;
      continue;
    }
    const auto direction = direction_for(*faces, vertex);
    if (!direction) return false;
    made.emplace_back(vertex, *direction);
  }
  for (const auto& [vertex, direction] : made) {
    for (unsigned c = 0; c < 3; ++c) normals->set(vertex, c, direction[c] * one_in(*normals));
  }
  for (std::uint64_t vertex = 0; normals->is_float() && vertex < normals->count(); ++vertex) {
    const double own = length_in(*normals, vertex);
    if (!(std::abs(own - 1) > kUnitLength)) continue;
    for (unsigned c = 0; c < 3; ++c) normals->set(vertex, c, normals->get(vertex, c) / own);
  }
  if (!made.empty()) follow_with_bounds(fixing, accessor, *normals);
  return !made.empty();
}

bool fill(Fixing& fixing, const Subject& subject, bool beside_others) {
  const auto accessor = fixing.index(model::RootArray::accessors, subject.value);
  return accessor && fill(fixing, *accessor, beside_others);
}

}  // namespace

bool fill_some_normals(Fixing& fixing, const Subject& subject) {
  return fill(fixing, subject, true);
}

bool make_unit_or_fill(Fixing& fixing, const Subject& subject) {
  return make_unit_vectors(fixing, subject) || fill(fixing, subject, false);
}

bool fill_unused_or_normals(Fixing& fixing, const Subject& subject) {
  return fill_unused_vertices(fixing, subject) || fill(fixing, subject, false);
}

}  // namespace gltfx::validate
