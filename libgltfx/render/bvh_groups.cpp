// SPDX-License-Identifier: Apache-2.0
#include "render/bvh_groups.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/packed.hpp"
#include "render/sampler.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"
#include "render/wall.hpp"

namespace gltfx::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Measured with Embree 3.13.
constexpr std::uint64_t kSceneBytes = 5000;  // of a shape that is shared
constexpr std::uint64_t kInstanceBytes = 600;
constexpr std::uint64_t kTriangleBytes = 160;
constexpr std::uint64_t kVertexBytes = 12;

std::uint64_t flat_bytes(const ShapeSize& shape) {
  return shape.triangles * kTriangleBytes + shape.vertices * kVertexBytes;
}

std::uint64_t shared_bytes(const ShapeSize& shape, std::uint64_t instances) {
  return kSceneBytes + flat_bytes(shape) + instances * kInstanceBytes;
}

// The norm of the inverse of a transform: the maximum factor by which rays become longer in the
// space of a mesh. Infinite if there is no inverse, or none in floats.
double inverse_norm(const Matrix34& m) {
  constexpr double kMost = 1e9;
  const double volume = determinant(m);
  const Vec3d x(m[0][0], m[1][0], m[2][0]);
  const Vec3d y(m[0][1], m[1][1], m[2][1]);
  const Vec3d z(m[0][2], m[1][2], m[2][2]);
  const Vec3d place(m[0][3], m[1][3], m[2][3]);
  double most = 0;
  for (const Vec3d& row : {cross(y, z), cross(z, x), cross(x, y)}) {
    const double sum = (std::fabs(row.x) + std::fabs(row.y) + std::fabs(row.z)) / std::fabs(volume);
    const bool fits = sum < kMost && std::fabs(dot(row, place) / volume) < kFarthest;
    if (!fits) return std::numeric_limits<double>::infinity();
    most = std::max(most, sum);
  }
  return most;
}

// Of triangles that may not be closed.
Treatment treatment_by(const SceneMaterial& material) {
  if (has_holes(material)) return Treatment::holed;
  if (is_pane(material)) return Treatment::pane;
  if (!is_culled(material)) return Treatment::solid;
  return is_wall(material) ? Treatment::wall : Treatment::culled;
}

class Grouping {
 public:
  explicit Grouping(const Scene& scene)
      : scene_(scene), uses_(scene.meshes.size(), 0), shape_of_(scene.meshes.size(), kNone) {
    sums_.reserve(scene.meshes.size() + 1);
    sums_.emplace_back();
    for (const Mesh& mesh : scene.meshes) {
      sums_.push_back({sums_.back().triangles + mesh.triangles.size(),
                       sums_.back().vertices + mesh.positions.size()});
    }
    for (const Instance& instance : scene.instances) ++uses_[shapes_.of(scene, instance)];
    groups_.closed.assign(scene.meshes.size(), false);
    treatments_.reserve(scene.meshes.size());
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) treatments_.push_back(treatment_of(i));
  }

  Groups run() {
    groups_.facing.reserve(scene_.instances.size());
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) add(i);
    return std::move(groups_);
  }

 private:
  ShapeSize size_of(const Instance& instance) const {
    const ShapeSize& before = sums_[instance.mesh];
    const ShapeSize& after = sums_[instance.mesh + instance.count];
    return {after.triangles - before.triangles, after.vertices - before.vertices};
  }

  Treatment treatment_of(std::uint32_t number) {
    const Mesh& mesh = scene_.meshes[number];
    const Treatment open = treatment_by(material_of(scene_, mesh));
    if (open != Treatment::wall) return open;
    const bool shared = mesh.positions.shared();
    const auto before = closed_.find({mesh.positions.data(), mesh.triangles.data()});
    const bool closed = shared && before != closed_.end() ? before->second : is_closed(mesh);
    if (shared) closed_.emplace(std::pair(mesh.positions.data(), mesh.triangles.data()), closed);
    groups_.closed[number] = closed;
    return closed ? Treatment::body : Treatment::wall;
  }

  void add(std::uint32_t number) {
    constexpr std::uint64_t kMostForced = 1U << 18U;  // triangles that are flattened by need
    const Instance& instance = scene_.instances[number];
    groups_.facing.push_back(determinant(instance.to_world) < 0 ? -1 : 1);
    const ShapeSize size = size_of(instance);
    if (size.triangles == 0) return;
    groups_.triangles += size.triangles;
    const std::uint32_t uses = uses_[shapes_.of(scene_, instance)];
    if (uses > 1 && shared_bytes(size, uses) < flat_bytes(size) * uses) {
      const double scale = inverse_norm(instance.to_world);
      if (scale > 0 && std::isfinite(scale)) {
        share(number, scale);
        return;
      }
      forced_ += size.triangles;
      if (forced_ > kMostForced) return;
    }
    append(groups_.flat, number);
  }

  void share(std::uint32_t number, double ray_scale) {
    const Instance& instance = scene_.instances[number];
    std::uint32_t& shape = shape_of_[shapes_.of(scene_, instance)];
    if (shape == kNone) {
      shape = static_cast<std::uint32_t>(groups_.shared.size());
      groups_.first.push_back(instance.mesh);
      append(groups_.shared.emplace_back(), number);
    }
    if (groups_.shared[shape][static_cast<std::size_t>(Treatment::holed)].triangles == 0 &&
        !places_.emplace(shape, instance.to_world).second) {
      return;  // each ray would hit it again
    }
    groups_.instanced.push_back(number);
    groups_.shape.push_back(shape);
    groups_.farthest = std::min(groups_.farthest, kFarthest / ray_scale);
  }

  void append(TreatedGroups& groups, std::uint32_t number) const {
    const Instance& instance = scene_.instances[number];
    for (std::uint32_t m = instance.mesh; m < instance.mesh + instance.count; ++m) {
      const Mesh& mesh = scene_.meshes[m];
      if (mesh.triangles.empty()) continue;
      Group& group = groups[static_cast<std::size_t>(treatments_[m])];
      group.parts.push_back({number, m, group.triangles});
      group.triangles += mesh.triangles.size();
      group.vertices += mesh.positions.size();
      group.mirrored = group.mirrored || groups_.facing[number] < 0;
    }
  }

  const Scene& scene_;
  std::vector<ShapeSize> sums_;  // of all meshes before one
  Shapes shapes_;
  std::vector<std::uint32_t> uses_;                                   // by Shapes
  std::vector<std::uint32_t> shape_of_;                               // by Shapes
  std::map<std::pair<const Float3*, const Triangle*>, bool> closed_;  // of shared arrays
  std::set<std::pair<std::uint32_t, Matrix34>> places_;               // of shapes without holes
  std::vector<Treatment> treatments_;                                 // by mesh
  std::uint64_t forced_ = 0;
  Groups groups_;
};

constexpr std::size_t kRepeatProbes = 4096;

using CornerPoints = std::array<Float3, 3>;

std::uint32_t hash_of(const CornerPoints& corners) {
  std::uint32_t hash = 0;
  for (const Float3& corner : corners) {
    for (const float value : corner) hash = mix_bits(hash, std::bit_cast<std::uint32_t>(value));
  }
  return hash;
}

/// A set of triangles by their corners. Open addressing.
class Kinds {
 public:
  Kinds(std::span<const Triangle> triangles, std::span<const Float3> points, std::size_t count)
      : triangles_(triangles), points_(points), slots_(std::bit_ceil(2 * count + 1), kNone) {}

  /// False if the set has an equal triangle.
  bool add(std::uint32_t number) {
    const CornerPoints corners = corners_of(number);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash_of(corners) & mask;; at = (at + 1) & mask) {
      std::uint32_t& slot = slots_[at];
      if (slot == kNone) {
        slot = number;
        return true;
      }
      if (corners_of(slot) == corners) return false;
    }
  }

 private:
  CornerPoints corners_of(std::uint32_t number) const {
    const Triangle& t = triangles_[number];
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }

  std::span<const Triangle> triangles_;
  std::span<const Float3> points_;
  std::vector<std::uint32_t> slots_;
};

constexpr double kSeamSteps = 1U << 14U;  // of the size of a mesh

// The longest side of its box.
double extent_of(const Mesh& mesh) {
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float least = std::numeric_limits<float>::infinity();
    float greatest = -least;
    for (const Float3& p : mesh.positions) {
      least = std::min(least, p[axis]);
      greatest = std::max(greatest, p[axis]);
    }
    longest = std::max(longest, static_cast<double>(greatest) - static_cast<double>(least));
  }
  return longest;
}

bool may_repeat(std::span<const Triangle> triangles, std::span<const Float3> points) {
  const std::size_t count = std::min(kRepeatProbes, triangles.size());
  Kinds kinds(triangles, points, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!kinds.add(static_cast<std::uint32_t>(i * triangles.size() / count))) return true;
  }
  return false;
}

}  // namespace

std::uint32_t Shapes::of(const Scene& scene, const Instance& instance) {
  const auto [known, fresh] = by_mesh_.try_emplace(instance.mesh, instance.mesh);
  if (!fresh) return known->second;
  std::vector<std::uintptr_t> key;
  bool shared = true;
  for (std::uint32_t i = instance.mesh; i < instance.mesh + instance.count; ++i) {
    const Mesh& mesh = scene.meshes[i];
    shared = shared && mesh.positions.shared() && mesh.triangles.shared();
    key.push_back(reinterpret_cast<std::uintptr_t>(mesh.positions.data()));
    key.push_back(reinterpret_cast<std::uintptr_t>(mesh.triangles.data()));
    key.push_back(static_cast<std::uintptr_t>(treatment_by(material_of(scene, mesh))));
  }
  if (shared) known->second = known_.try_emplace(std::move(key), instance.mesh).first->second;
  return known->second;
}

std::uint64_t hierarchy_bytes(const ShapeSize& shape, std::uint64_t instances) {
  const std::uint64_t flat = flat_bytes(shape) * instances;
  return instances > 1 ? std::min(flat, shared_bytes(shape, instances)) : flat;
}

// By a sum of the hashes of edges: edges in both directions cancel each other out. Ends of edges
// are rounded: the seam of a sphere of revolution is open by rounding errors alone.
bool is_closed(const Mesh& mesh) {
  const double step = extent_of(mesh) / kSeamSteps;
  if (!(step > 0)) return false;
  const auto bits = [step](const Float3& p) {
    const auto part = [&](std::size_t i) {
      const double rounded = std::nearbyint(static_cast<double>(p[i]) / step);
      return std::bit_cast<std::uint32_t>(static_cast<float>(rounded) + 0.0F);
    };
    return mix_bits(part(0), mix_bits(part(1), part(2)));
  };
  std::vector<std::uint32_t> corners;
  corners.reserve(mesh.positions.size());
  for (const Float3& p : mesh.positions) corners.push_back(bits(p));
  std::uint64_t edges = 0;
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto edge = [&corners](std::uint32_t from, std::uint32_t to) {
      const std::uint64_t key = std::uint64_t{corners[from]} << 32U | corners[to];
      return (key ^ (key >> 29U)) * 0x9e3779b97f4a7c15U;
    };
    edges += edge(a, b) - edge(b, a) + edge(b, c) - edge(c, b) + edge(c, a) - edge(a, c);
    volume +=
        dot(to_vec(mesh.positions[a]), cross(to_vec(mesh.positions[b]), to_vec(mesh.positions[c])));
  }
  return edges == 0 && volume > 0;
}

Groups group_instances(const Scene& scene) { return Grouping(scene).run(); }

std::vector<std::uint32_t> find_repeats(std::span<const Triangle> triangles,
                                        std::span<const Float3> points) {
  std::vector<std::uint32_t> repeats;
  if (!may_repeat(triangles, points)) return repeats;
  Kinds kinds(triangles, points, triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (!kinds.add(i)) repeats.push_back(i);
  }
  return repeats;
}

}  // namespace gltfx::render
