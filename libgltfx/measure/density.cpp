// SPDX-License-Identifier: Apache-2.0
// Texels per metre of what the default scene draws.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/drawn.hpp"
#include "measure/take.hpp"
#include "measure/texture_uses.hpp"
#include "measure/uv_surface.hpp"
#include "measure/weighted_values.hpp"
#include "model/instancing.hpp"
#include "model/pose.hpp"

namespace gltfx::measure {
namespace {

constexpr std::array kDensityNames{Name::texel_density, Name::texel_density_min,
                                   Name::texel_density_max, Name::texel_density_low,
                                   Name::texel_density_high};

constexpr std::string_view kTooManyCopies = "The scene draws the triangles too often.";

// How a transform changes areas: the triangle with the normal n of twice its length has the area
// sqrt(n' H n) / 2 then. H is symmetric: xx, yy, zz, xy, xz, yz.
using AreaScale = std::array<float, 6>;

AreaScale area_scale(const model::Affine& transform) {
  const auto& [x, y, z, place] = transform.columns;
  const std::array<model::Vector3, 3> rows{model::cross(y, z), model::cross(z, x),
                                           model::cross(x, y)};
  const auto entry = [&](std::size_t i, std::size_t k) {
    return static_cast<float>(model::dot(rows[i], rows[k]));
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

double area_of(const model::Vector3& normal, const AreaScale& scale) {
  const auto& [x, y, z] = normal;
  const auto at = [&](std::size_t i) { return static_cast<double>(scale[i]); };
  const double square = x * x * at(0) + y * y * at(1) + z * z * at(2) +
                        2 * (x * y * at(3) + x * z * at(4) + y * z * at(5));
  return std::sqrt(std::max(0.0, square)) / 2;
}

// What the scene draws of a mesh.
struct MeshDraws {
  std::map<AreaScale, std::uint64_t> rigid;  // and how often
  std::vector<model::NodeIndex> moved;       // nodes with a skin or morph targets
  bool unread = false;                       // copies that could not be read
};

class SceneDraws {
 public:
  SceneDraws(const Source& source, std::uint32_t scene)
      : source_(source), pose_(source.pose(scene)), meshes_(source.views().meshes.size()) {
    constexpr std::uint64_t kCopyBytes = std::uint64_t{1} << 28U;
    model::MemoryBudget copies(kCopyBytes);
    for (const model::NodeIndex node : nodes_of_scene(source, scene).drawn) add(node, copies);
  }

  const MeshDraws& of(std::uint32_t mesh) const { return meshes_[mesh]; }
  const model::Pose& pose() const { return pose_; }
  std::vector<float> weights_of(model::NodeIndex node) const {
    return model::morph_weights(source_.asset(), source_.views(), node);
  }

 private:
  void add(model::NodeIndex index, model::MemoryBudget& budget) {
    const model::Node& node = source_.views().nodes[index];
    MeshDraws& draws = meshes_[*node.mesh];
    const std::vector<float> weights = weights_of(index);
    const bool morphed =
        std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0; });
    if (node.skin || morphed) {
      draws.moved.push_back(index);
      return;
    }
    const auto copies =
        model::read_instancing(source_.asset(), source_.views(), source_.resources(), node, budget);
    if (!copies) {
      ++draws.rigid[area_scale(pose_.world[index])];
      return;
    }
    if (!copies->readable) draws.unread = true;
    for (const model::Affine& copy : copies->transforms) {
      ++draws.rigid[area_scale(pose_.world[index] * copy)];
    }
  }

  const Source& source_;
  const model::Pose& pose_;
  std::vector<MeshDraws> meshes_;
};

// The values of one material.
class DensityMeasurer {
 public:
  DensityMeasurer(const Source& source, const SceneDraws& draws, double texels, std::uint32_t set,
                  bool keeps_values)
      : source_(source), draws_(draws), texels_(texels), sets_{set}, keeps_values_(keeps_values) {}

  // A sentence about what failed; empty: nothing did. `left`: triangles that may still be measured.
  std::string add(const MeasuredPrimitive& at, model::MemoryBudget& budget, std::uint64_t& left) {
    const model::Primitive& primitive = source_.views().meshes[at.mesh].primitives[at.index];
    if (primitive.find(model::SemanticKind::texcoord, sets_[0]) == nullptr) return {};
    const MeshDraws& draws = draws_.of(at.mesh);
    if (draws.unread) return "The transforms of copies could not be read.";
    model::GeometryRequest request;
    request.tex_coords = sets_;
    request.surface = false;
    if (!draws.rigid.empty()) {
      std::string problem = measure(primitive, request, draws.rigid, budget, left);
      if (!problem.empty()) return problem;
    }
    for (const model::NodeIndex node : draws.moved) {
      const std::vector<float> weights = draws_.weights_of(node);
      request.weights = weights;
      std::vector<model::Affine> joints;
      const auto& skin = source_.views().nodes[node].skin;
      if (skin) {
        joints = model::joint_matrices(source_.asset(), source_.views(), source_.resources(), *skin,
                                       draws_.pose());
      }
      request.joints = joints;
      const model::Affine transform = joints.empty() ? draws_.pose().world[node] : model::Affine();
      std::string problem = measure(primitive, request, {{area_scale(transform), 1}}, budget, left);
      if (!problem.empty()) return problem;
    }
    return {};
  }

  bool any() const { return area_ > 0; }
  double value(Name name) {
    if (name == Name::texel_density) return std::sqrt(texels_ * uv_area_ / area_);
    if (name == Name::texel_density_min) return least_;
    if (name == Name::texel_density_max) return most_;
    constexpr double kShare = 0.05;
    return values_.value_at(name == Name::texel_density_low ? kShare : 1 - kShare);
  }

 private:
  std::string measure(const model::Primitive& primitive, const model::GeometryRequest& request,
                      const std::map<AreaScale, std::uint64_t>& scales, model::MemoryBudget& budget,
                      std::uint64_t& left) {
    model::Geometry geometry;
    const auto error =
        model::read_geometry(source_.geometry(), primitive, request, budget, geometry);
    if (error == model::GeometryError::empty) return {};
    if (error != model::GeometryError::none) {
      return "A primitive " + std::string(model::error_text(error)) + ".";
    }
    if (geometry.tex_coords.front().empty()) return "Texture coordinates could not be read.";
    for (const auto& [scale, times] : scales) {
      if (left < geometry.triangles.size()) return std::string(kTooManyCopies);
      left -= geometry.triangles.size();
      for (const model::Triangle& triangle : geometry.triangles) {
        add_triangle(geometry, triangle, scale, static_cast<double>(times));
      }
    }
    return {};
  }

  void add_triangle(const model::Geometry& geometry, const model::Triangle& triangle,
                    const AreaScale& scale, double times) {
    const auto& uv = geometry.tex_coords.front();
    const UvTriangle corners{uv[triangle[0]], uv[triangle[1]], uv[triangle[2]]};
    if (!is_finite(corners)) return;
    std::array<model::Vector3, 2> sides{};
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        sides[i][k] = double{geometry.positions[triangle[i + 1]][k]} -
                      double{geometry.positions[triangle[0]][k]};
      }
    }
    const model::Vector3 normal = model::cross(sides[0], sides[1]);
    constexpr double kFlat = 1e-12;  // height over length
    const double longest = std::max(model::dot(sides[0], sides[0]), model::dot(sides[1], sides[1]));
    if (model::dot(normal, normal) <= kFlat * kFlat * longest * longest) return;
    const double area = area_of(normal, scale);
    if (!(area > 0) || !std::isfinite(area)) return;
    const double shown = std::abs(signed_area(corners));
    const double density = std::sqrt(texels_ * shown / area);
    least_ = std::min(least_, density);
    most_ = std::max(most_, density);
    uv_area_ += shown * times;
    area_ += area * times;
    if (keeps_values_) values_.add(density, area * times);
  }

  const Source& source_;
  const SceneDraws& draws_;
  const double texels_;  // of the square from 0 to 1
  const std::array<std::uint32_t, 1> sets_;
  const bool keeps_values_;
  double uv_area_ = 0, area_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), most_ = 0;
  WeightedValues values_;
};

class DensityTaker {
 public:
  explicit DensityTaker(Taking& taking) : taking_(taking) {}

  void run() {
    const Source& source = taking_.source();
    const auto scene = source.default_scene();
    const std::size_t count = taking_.count(MeasureScope::material);
    if (!scene) {
      for (std::size_t i = 0; i < count; ++i) miss(i, "The asset has no scene.", false);
      return;
    }
    const SceneDraws draws(source, *scene);
    const auto textures = material_textures(source);
    const auto primitives = primitives_by_material(taking_);
    for (std::size_t i = 0; i < count; ++i) {
      const model::TextureSlot* slot =
          i < textures.size() ? textures[i].find(taking_.parameters().density_slot) : nullptr;
      if (slot == nullptr) {
        miss(i, "The material has no such texture.", false);
      } else {
        take(i, *slot, draws, primitives[i]);
      }
    }
  }

 private:
  void take(std::size_t material, const model::TextureSlot& slot, const SceneDraws& draws,
            const std::vector<MeasuredPrimitive>& primitives) {
    const auto size = size_of_texture(taking_.source(), *slot.texture);
    if (!size) return miss(material, "The header of an image could not be read.", true);
    const double texels = static_cast<double>(size->width) * static_cast<double>(size->height) *
                          std::abs(double{slot.scale[0]} * double{slot.scale[1]});
    const auto wants = [&](Name name) {
      return taking_.column(MeasureScope::material, name) != nullptr;
    };
    DensityMeasurer measurer(taking_.source(), draws, texels, slot.tex_coord,
                             wants(Name::texel_density_low) || wants(Name::texel_density_high));
    for (const MeasuredPrimitive& primitive : primitives) {
      const std::string problem = measurer.add(primitive, budget_, triangles_left_);
      if (!problem.empty()) return miss(material, problem, true);
    }
    if (!measurer.any()) {
      return miss(material, "The scene draws no triangle with the material and an area.", false);
    }
    for (const Name name : kDensityNames) {
      Column* column = taking_.column(MeasureScope::material, name);
      if (column != nullptr) column->set(material, MeasureValue(measurer.value(name)));
    }
  }

  void miss(std::size_t material, std::string_view why, bool fault) {
    for (const Name name : kDensityNames) {
      Column* column = taking_.column(MeasureScope::material, name);
      if (column == nullptr) continue;
      fault ? column->could_not_be_taken(material, why) : column->does_not_apply(material, why);
    }
  }

  Taking& taking_;
  model::MemoryBudget budget_ = reading_budget(taking_.source());
  std::uint64_t triangles_left_ = std::uint64_t{1} << 26U;  // in all copies that differ
};

}  // namespace

void take_density(Taking& taking) { DensityTaker(taking).run(); }

}  // namespace gltfx::measure
