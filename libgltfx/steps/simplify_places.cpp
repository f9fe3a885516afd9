// SPDX-License-Identifier: Apache-2.0
#include "steps/simplify_places.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "codec/client.hpp"
#include "model/instancing.hpp"
#include "model/pose.hpp"
#include "model/scene_box.hpp"

namespace gltfx::steps {
namespace {

using model::Affine;
using model::Vector3;

// Points of borders in all places together; beyond that all borders are locked.
constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 24U;
constexpr std::uint64_t kInstanceBytes = std::uint64_t{1} << 26U;

// How much longer a vector may become.
double stretch(const Affine& transform) {
  const auto& [x, y, z, translation] = transform.columns;
  const double longest =
      std::sqrt(std::max({model::dot(x, x), model::dot(y, y), model::dot(z, z)}));
  const double skew = std::max(
      {std::abs(model::dot(x, y)), std::abs(model::dot(x, z)), std::abs(model::dot(y, z))});
  if (skew <= 1e-6 * longest * longest) return longest;
  return std::sqrt(model::dot(x, x) + model::dot(y, y) + model::dot(z, z));
}

/// Cells of a grid, each with the surface in one place that has a point there.
class TouchGrid {
 public:
  explicit TouchGrid(double cell) : cell_(cell) {}

  void add(const Vector3& point, std::uint64_t owner) {
    const auto [found, is_new] = cells_.try_emplace(key(cell_of(point)), owner);
    if (!is_new && found->second != owner) found->second = kSeveral;
  }
  // Whether another owner has a point within a cell.
  bool touches(const Vector3& point, std::uint64_t owner) const {
    for (unsigned corner = 0; corner < 8; ++corner) {
      Vector3 at = point;
      for (unsigned i = 0; i < 3; ++i) at[i] += (corner >> i & 1U) != 0 ? cell_ / 2 : -cell_ / 2;
      const auto found = cells_.find(key(cell_of(at)));
      if (found != cells_.end() && found->second != owner) return true;
    }
    return false;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::uint64_t kSeveral = UINT64_MAX;

  Cell cell_of(const Vector3& point) const {
    Cell cell{};
    for (std::size_t i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(std::clamp(std::floor(point[i] / cell_), -9e15, 9e15));
    return cell;
  }
  // Equal keys of different cells only lock more.
  static std::uint64_t key(const Cell& cell) {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (const std::int64_t each : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(each)) * 0xBF58476D1CE4E5B9U;
      hash ^= hash >> 29U;
    }
    return hash;
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::uint64_t> cells_;
};

class PlaceFinder {
 public:
  PlaceFinder(const StepData& data, std::vector<SimplifyJob>& jobs) : data_(data), jobs_(jobs) {}

  Result<SimplifyPlaces> run(bool lock_all) {
    model::DracoMeshes draco;
    draco.add_all(data_.asset, data_.views, data_.resources);
    draco.decode(codec::Client::shared(), data_.input.options.jobs);
    const model::GeometrySource source{data_.asset, data_.views, data_.resources, draco};
    const model::Pose pose = model::compute_pose(data_.asset, data_.views,
                                                 model::choose_scene(data_.asset, data_.views));
    const auto box = model::scene_box(source, pose);
    if (!box) return Error{fmt::format("the default scene {}", box.error().message)};
    if (!find_transforms(pose)) lock_all = true;
    SimplifyPlaces places;
    std::map<std::uint32_t, double> own;  // of meshes outside of the scene
    for (SimplifyJob& job : jobs_) {
      const std::vector<Affine>& transforms = transforms_[job.mesh];
      double diagonal = box->diagonal();
      if (transforms.empty()) {
        const auto [known, is_new] = own.try_emplace(job.mesh, 0);
        if (is_new) {
          const auto mesh = model::mesh_box(source, data_.views.meshes[job.mesh]);
          if (mesh) known->second = mesh->diagonal();
        }
        diagonal = known->second;
      }
      job.scale = 0;
      for (const Affine& each : transforms) job.scale = std::max(job.scale, stretch(each));
      if (!(job.scale > 0) || !std::isfinite(job.scale)) job.scale = 1;
      places.diagonals.push_back(diagonal);
    }
    if (!lock_all) lock_all = !lock_touching(box->diagonal());
    if (lock_all) {
      for (SimplifyJob& job : jobs_) job.lock_borders = true;
    }
    return places;
  }

 private:
  // Of all places of each mesh in the scene. False: there are too many.
  bool find_transforms(const model::Pose& pose) {
    model::MemoryBudget budget(kInstanceBytes);
    bool all = true;
    for (std::size_t i = 0; i < data_.views.nodes.size(); ++i) {
      const model::Node& node = data_.views.nodes[i];
      if (pose.in_scene[i] == 0 || !node.mesh) continue;
      std::vector<Affine>& transforms = transforms_[*node.mesh];
      const auto instances =
          model::read_instancing(data_.asset, data_.views, data_.resources, node, budget);
      if (!instances) {
        transforms.push_back(pose.world[i]);
        continue;
      }
      all &= instances->readable;
      for (const Affine& each : instances->transforms) transforms.push_back(pose.world[i] * each);
    }
    return all;
  }

  // False: there are too many points.
  bool lock_touching(double diagonal) {
    constexpr double kTouching = 1e-6;  // of the diagonal
    if (!(diagonal > 0) || !std::isfinite(diagonal)) return false;
    TouchGrid grid(2 * kTouching * diagonal);
    std::uint64_t points = 0;
    std::vector<std::vector<std::uint32_t>> borders;
    for (const SimplifyJob& job : jobs_) {
      std::vector<std::uint32_t>& border = borders.emplace_back();
      for (const auto& edge : model::open_edges(job.corners, job.same))
        border.insert(border.end(), edge.begin(), edge.end());
      std::sort(border.begin(), border.end());
      border.erase(std::unique(border.begin(), border.end()), border.end());
      points += border.size() * std::max<std::size_t>(transforms_[job.mesh].size(), 1);
    }
    if (points > kMostPoints) return false;
    const auto each_place = [&](std::size_t at, const auto& use) {
      std::vector<Affine> transforms = transforms_[jobs_[at].mesh];
      if (transforms.empty()) transforms.emplace_back();
      for (std::size_t i = 0; i < transforms.size(); ++i) {
        const std::uint64_t owner = (std::uint64_t{at} << 32U) + i;
        for (const std::uint32_t point : borders[at]) {
          const auto& p = jobs_[at].positions[point];
          if (!use(transforms[i].point({double{p[0]}, double{p[1]}, double{p[2]}}), owner)) return;
        }
      }
    };
    for (std::size_t at = 0; at < jobs_.size(); ++at) {
      each_place(at, [&](const Vector3& point, std::uint64_t owner) {
        grid.add(point, owner);
        return true;
      });
    }
    for (std::size_t at = 0; at < jobs_.size(); ++at) {
      each_place(at, [&](const Vector3& point, std::uint64_t owner) {
        jobs_[at].lock_borders |= grid.touches(point, owner);
        return !jobs_[at].lock_borders;
      });
    }
    return true;
  }

  const StepData& data_;
  std::vector<SimplifyJob>& jobs_;
  std::map<std::uint32_t, std::vector<Affine>> transforms_;  ///< by mesh
};

}  // namespace

Result<SimplifyPlaces> find_simplify_places(const StepData& data, std::vector<SimplifyJob>& jobs,
                                            bool lock_all) {
  return PlaceFinder(data, jobs).run(lock_all);
}

}  // namespace gltfx::steps
