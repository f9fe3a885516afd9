// SPDX-License-Identifier: Apache-2.0
/// Chooses the grid of each mesh: the coarsest powers of two that keep a bound, the same for meshes
/// that touch.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "steps/attribute_roles.hpp"
#include "steps/mesh_places.hpp"
#include "steps/quantize_values.hpp"
#include "steps/step_data.hpp"
#include "steps/volume_materials.hpp"

namespace gltfx::steps {

/// The positions of the vertices of a primitive, and of its morph targets.
struct PositionLists {
  std::uint32_t own = 0;
  std::vector<std::uint32_t> targets;
  auto operator<=>(const PositionLists&) const = default;
};

/// The grids of an asset. All arguments must outlive it.
class GridPlan {
 public:
  /// `bound`: greatest distance as a part of the diagonal of the default scene.
  GridPlan(const StepData& data, const AttributeRoles& roles, const MeshPlaces& places,
           const VolumeMaterials& volumes, double bound);

  /// The grid of a mesh; nothing: it keeps its coordinates.
  const std::optional<Grid>& of(std::uint32_t mesh) const { return meshes_[mesh].grid; }
  /// Why a mesh keeps its coordinates, half a sentence; empty: it does not, or has integers.
  const std::string& obstacle(std::uint32_t mesh) const { return meshes_[mesh].obstacle; }
  /// Whether the obstacle is an extension that may refer to the mesh.
  bool is_refused(std::uint32_t mesh) const { return meshes_[mesh].is_refused; }

  /// The accessors of positions of a mesh.
  const std::vector<PositionLists>& positions(std::uint32_t mesh) const {
    return meshes_[mesh].positions;
  }
  const FloatElements& elements(std::uint32_t accessor) const { return elements_.at(accessor); }

 private:
  struct MeshGrid {
    std::vector<PositionLists> positions;
    std::vector<std::uint32_t> volumes;  ///< materials
    std::optional<Grid> grid;
    std::string obstacle;
    bool is_refused = false;
    bool has_integers = false;
    double scale = 0;      ///< greatest length in the scene of a vector of length 1
    double permitted = 0;  ///< distance in the scene
    model::Vector3 least{}, greatest{};
  };
  using Unit = std::vector<std::uint32_t>;  ///< meshes with one grid

  void read(std::uint32_t mesh);
  void read_primitive(const model::Primitive& primitive, MeshGrid& mesh);
  std::string open(std::uint32_t accessor, MeshGrid& mesh);
  void measure(std::uint32_t mesh, double bound, double scene);
  void join_meshes();
  std::vector<Unit> make_units();
  std::vector<std::vector<Unit>> group_units(std::vector<Unit> units) const;
  void choose(const std::vector<Unit>& group);
  bool try_step(const std::vector<Unit>& group, double step, bool shared, bool& too_far);
  bool fits(std::uint32_t mesh, const Grid& grid, bool& too_far) const;
  double farthest(const PositionLists& lists, const Grid& grid) const;
  double first_step(const std::vector<Unit>& group) const;
  Grid grid_of(const std::vector<Unit>& units, double step) const;

  const StepData& data_;
  const AttributeRoles& roles_;
  const MeshPlaces& places_;
  const VolumeMaterials& volumes_;
  std::vector<MeshGrid> meshes_;
  std::map<std::uint32_t, FloatElements> elements_;  ///< by accessor
  std::uint64_t work_ = 0;                           ///< numbers of all PositionLists
  DisjointSets bonds_;                               ///< of meshes that need one grid
};

}  // namespace gltfx::steps
