// SPDX-License-Identifier: Apache-2.0
#include "model/tangent_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "base/checked.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

template <std::size_t N>
Vector3 wide(const std::array<float, N>& from) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The projection of `a` on the plane perpendicular to `normal`, with length 1.
Vector3 in_plane(const Vector3& a, const Vector3& normal) {
  const double along = dot(a, normal);
  return unit(
      Vector3{a[0] - along * normal[0], a[1] - along * normal[1], a[2] - along * normal[2]});
}

Vector3 any_across(const Vector3& normal) {
  const Vector3 axis = std::abs(normal[0]) < 0.7 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  return in_plane(axis, normal);
}

/// A triangle of the algorithm. Corners are numbered 3 * triangle + 0, 1, 2.
struct Face {
  std::array<std::uint32_t, 3> welded{};  ///< vertices that are equal count as one
  std::array<std::uint32_t, 3> beyond{kNone, kNone, kNone};  ///< face across edge k to k + 1
  Vector3 tangent{};        ///< direction of increasing u, length 1
  bool plain = false;       ///< coordinates have the same orientation as the corners
  bool shapeless = false;   ///< no area in texture or space, or no direction: joins any group
  bool degenerate = false;  ///< two corners in one place: not part of the surface
};

/// One side of an edge between two welded vertices, stored by the lower one.
struct Edge {
  std::uint32_t high;
  bool backward;         ///< from high to low
  std::uint32_t corner;  ///< start of the edge

  bool operator<(const Edge& other) const {
    return std::tie(high, backward, corner) < std::tie(other.high, other.backward, other.corner);
  }
};

/// Corners that share a tangent.
struct Group {
  std::uint32_t vertex = kNone;  ///< welded
  bool plain = false;
  Vector3 sum{};
};

class TangentSpace {
 public:
  TangentSpace(Geometry& geometry, const Vectors<2>& coordinates)
      : geometry_(geometry),
        uvs_(coordinates),
        faces_(geometry.triangles.size()),
        groups_of_(geometry.triangles.size() * 3, kNone) {}

  void group() {
    weld();
    for (std::uint32_t f = 0; f < faces_.size(); ++f) describe(f);
    find_neighbours();
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (!faces_[f].shapeless && groups_of_[f * 3 + k] == kNone) grow(f, k);
      }
    }
    adopt();
  }

  // Number of vertices when each has one tangent.
  std::uint64_t vertices_after() { return geometry_.positions.size() + split(false); }

  void write() {
    geometry_.tangents.resize(geometry_.positions.size());
    split(true);
  }

 private:
  // Uses a table with open addressing: a million vertices are common.
  void weld() {
    const auto count = static_cast<std::uint32_t>(geometry_.positions.size());
    std::size_t size = 16;
    while (size < std::size_t{count} * 2) size *= 2;
    std::vector<std::uint32_t> table(size, kNone);
    std::vector<std::uint32_t> firsts(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::size_t at = hash(i) & (size - 1);
      while (table[at] != kNone && !is_equal(table[at], i)) at = (at + 1) & (size - 1);
      if (table[at] == kNone) table[at] = i;
      firsts[i] = table[at];
    }
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        faces_[f].welded[k] = firsts[geometry_.triangles[f][k]];
      }
    }
  }

  bool is_equal(std::uint32_t a, std::uint32_t b) const {
    return geometry_.positions[a] == geometry_.positions[b] &&
           geometry_.normals[a] == geometry_.normals[b] && uvs_[a] == uvs_[b];
  }

  std::size_t hash(std::uint32_t i) const {
    std::uint64_t sum = 0;
    const auto mix = [&sum](float value) {
      const float plus_zero = value + 0.0F;  // both zeros are equal
      std::uint32_t bits = 0;
      std::memcpy(&bits, &plus_zero, sizeof(bits));
      sum = (sum ^ bits) * 0x9E3779B97F4A7C15U;
      sum ^= sum >> 29U;
    };
    for (const float value : geometry_.positions[i]) mix(value);
    for (const float value : geometry_.normals[i]) mix(value);
    for (const float value : uvs_[i]) mix(value);
    return static_cast<std::size_t>(sum);
  }

  Vector3 position(const Face& face, std::size_t k) const {
    return wide(geometry_.positions[face.welded[k % 3]]);
  }

  void describe(std::uint32_t f) {
    Face& face = faces_[f];
    const Vector3 d1 = minus(position(face, 1), position(face, 0));
    const Vector3 d2 = minus(position(face, 2), position(face, 0));
    const auto uv = [&](std::size_t k, std::size_t axis) {
      return static_cast<double>(uvs_[face.welded[k]][axis]) -
             static_cast<double>(uvs_[face.welded[0]][axis]);
    };
    const double area = uv(1, 0) * uv(2, 1) - uv(1, 1) * uv(2, 0);
    face.plain = area > 0;
    const Vector3 zero{};
    face.degenerate = d1 == zero || d2 == zero || d1 == d2;
    const double sign = face.plain ? 1 : -1;
    Vector3 along{};
    Vector3 across{};
    for (std::size_t i = 0; i < 3; ++i) {
      along[i] = sign * (uv(2, 1) * d1[i] - uv(1, 1) * d2[i]);
      across[i] = sign * (uv(1, 0) * d2[i] - uv(2, 0) * d1[i]);
    }
    face.tangent = unit(along);
    face.shapeless = face.degenerate || !std::isfinite(area) || area == 0 || face.tangent == zero ||
                     unit(across) == zero;
  }

  // Calls visit(lower vertex, edge) for the edges of all faces.
  template <class Visit>
  void for_edges(const Visit& visit) const {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::uint32_t k = 0; k < 3 && !faces_[f].degenerate; ++k) {
        const std::uint32_t from = faces_[f].welded[k];
        const std::uint32_t to = faces_[f].welded[(k + 1) % 3];
        visit(std::min(from, to), Edge{std::max(from, to), from > to, f * 3 + k});
      }
    }
  }

  // A counting sort by the lower vertex leaves few edges to compare.
  void find_neighbours() {
    std::vector<std::uint32_t> ends(geometry_.positions.size() + 1);
    for_edges([&](std::uint32_t low, const Edge& /*edge*/) { ++ends[low + 1]; });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Edge> edges(ends.back());
    for_edges([&](std::uint32_t low, const Edge& edge) { edges[ends[low]++] = edge; });
    std::uint32_t first = 0;
    for (const std::uint32_t end : ends) {
      connect_sides(std::span(edges).subspan(first, end - first));
      first = end;
    }
  }

  // Faces on both sides of an edge run along it in opposite directions. If there are more than two,
  // the first in one direction is paired with the first in the other, and so on.
  void connect_sides(std::span<Edge> edges) {
    std::sort(edges.begin(), edges.end());
    for (std::size_t first = 0; first < edges.size();) {
      const std::uint32_t high = edges[first].high;
      std::size_t back = first;
      while (back < edges.size() && edges[back].high == high && !edges[back].backward) ++back;
      std::size_t end = back;
      while (end < edges.size() && edges[end].high == high) ++end;
      for (std::size_t i = 0; first + i < back && back + i < end; ++i) {
        connect(edges[first + i].corner, edges[back + i].corner);
      }
      first = end;
    }
  }

  void connect(std::uint32_t a, std::uint32_t b) {
    faces_[a / 3].beyond[a % 3] = b / 3;
    faces_[b / 3].beyond[b % 3] = a / 3;
  }

  void grow(std::uint32_t face, std::uint32_t corner) {
    const auto id = static_cast<std::uint32_t>(groups_.size());
    groups_.push_back({faces_[face].welded[corner], faces_[face].plain, {}});
    waiting_.push_back(face);
    while (!waiting_.empty()) {
      const std::uint32_t f = waiting_.back();
      waiting_.pop_back();
      if (f == kNone) continue;
      const auto k = join(f, id);
      if (k == kNone) continue;
      waiting_.push_back(faces_[f].beyond[k]);
      waiting_.push_back(faces_[f].beyond[(k + 2) % 3]);
    }
  }

  // The corner with which a face joins a group, or kNone.
  std::uint32_t join(std::uint32_t f, std::uint32_t id) {
    Face& face = faces_[f];
    Group& group = groups_[id];
    const auto* const at = std::find(face.welded.begin(), face.welded.end(), group.vertex);
    const auto k = static_cast<std::uint32_t>(at - face.welded.begin());
    if (k == 3 || groups_of_[f * 3 + k] != kNone) return kNone;
    const auto* const corners = &groups_of_[std::size_t{f} * 3];
    const bool untouched = std::all_of(corners, corners + 3, [](auto g) { return g == kNone; });
    if (face.shapeless && untouched) face.plain = group.plain;
    if (face.plain != group.plain) return kNone;
    groups_of_[f * 3 + k] = id;
    if (!face.shapeless) add(face, k, group);
    return k;
  }

  void add(const Face& face, std::uint32_t k, Group& group) const {
    const Vector3 normal = wide(geometry_.normals[group.vertex]);
    const Vector3 here = position(face, k);
    const Vector3 before = in_plane(minus(position(face, k + 2), here), normal);
    const Vector3 after = in_plane(minus(position(face, k + 1), here), normal);
    const double angle = std::acos(std::clamp(dot(before, after), -1.0, 1.0));
    const Vector3 tangent = in_plane(face.tangent, normal);
    for (std::size_t i = 0; i < 3; ++i) group.sum[i] += angle * tangent[i];
  }

  // A corner without a group takes that of another corner with the same vertex.
  void adopt() {
    if (std::find(groups_of_.begin(), groups_of_.end(), kNone) == groups_of_.end()) return;
    std::unordered_map<std::uint32_t, std::uint32_t> groups;
    for (std::uint32_t g = 0; g < groups_.size(); ++g) groups.try_emplace(groups_[g].vertex, g);
    for (std::size_t corner = 0; corner < groups_of_.size(); ++corner) {
      if (groups_of_[corner] != kNone) continue;
      const std::uint32_t vertex = faces_[corner / 3].welded[corner % 3];
      const auto [found, fresh] =
          groups.try_emplace(vertex, static_cast<std::uint32_t>(groups_.size()));
      if (fresh) groups_.push_back({vertex, false, {}});
      groups_of_[corner] = found->second;
    }
  }

  std::array<float, 4> tangent_of(const Group& group) const {
    const Vector3 normal = wide(geometry_.normals[group.vertex]);
    Vector3 tangent = in_plane(group.sum, normal);
    if (tangent == Vector3{}) tangent = any_across(normal);
    return {static_cast<float>(tangent[0]), static_cast<float>(tangent[1]),
            static_cast<float>(tangent[2]), group.plain ? -1.0F : 1.0F};
  }

  // Gives each vertex the tangent of its first corner, and corners that disagree separate vertices.
  // Returns the number of these; changes nothing unless `write`.
  std::uint64_t split(bool write) {
    std::vector<std::uint32_t> first(geometry_.positions.size(), kNone);
    std::unordered_map<std::uint64_t, std::uint32_t> others;
    for (std::size_t corner = 0; corner < groups_of_.size(); ++corner) {
      std::uint32_t& vertex = geometry_.triangles[corner / 3][corner % 3];
      const std::uint32_t group = groups_of_[corner];
      if (first[vertex] == kNone) {
        first[vertex] = group;
        if (write) geometry_.tangents[vertex] = tangent_of(groups_[group]);
      }
      if (first[vertex] == group) continue;
      const auto copy = static_cast<std::uint32_t>(first.size() + others.size());
      const auto [found, fresh] = others.try_emplace(std::uint64_t{vertex} << 32U | group, copy);
      if (!write) continue;
      if (fresh) duplicate(vertex, tangent_of(groups_[group]));
      vertex = found->second;
    }
    return others.size();
  }

  void duplicate(std::uint32_t vertex, const std::array<float, 4>& tangent) {
    const auto copy = [vertex](auto& list) {
      if (list.empty()) return;
      const auto element = list[vertex];
      list.push_back(element);
    };
    copy(geometry_.positions);
    copy(geometry_.normals);
    copy(geometry_.colors);
    for (auto& set : geometry_.tex_coords) copy(set);
    geometry_.tangents.push_back(tangent);
  }

  Geometry& geometry_;
  const Vectors<2>& uvs_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> groups_of_;  ///< by corner
  std::vector<Group> groups_;
  std::vector<std::uint32_t> waiting_;  ///< faces that grow() will visit
};

}  // namespace

bool generate_tangents(Geometry& geometry, const Vectors<2>& coordinates, MemoryBudget& budget) {
  const std::uint64_t vertex = sizeof(float) * (3 + 3 + 4 + 4 + 2 * geometry.tex_coords.size());
  TangentSpace space(geometry, coordinates);
  space.group();
  const std::uint64_t after = space.vertices_after();
  const std::uint64_t added = after - geometry.positions.size();
  const Checked size = checked_mul(added, vertex);
  const std::uint64_t own = geometry.positions.size() * sizeof(float) * 4;
  if (after >= kNone || !size || !budget.take(checked_add(*size, own))) return false;
  space.write();
  return true;
}

}  // namespace gltfx::model
