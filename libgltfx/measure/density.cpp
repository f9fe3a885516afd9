// SPDX-License-Identifier: Apache-2.0
// Texels per metre of what the default scene draws.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/drawn.hpp"
#include "measure/shape.hpp"
#include "measure/take.hpp"
#include "measure/texture_uses.hpp"
#include "measure/uv_surface.hpp"
#include "measure/weighted_values.hpp"

namespace gltfx::measure {
namespace {

constexpr std::array kDensityNames{Name::texel_density, Name::texel_density_min,
                                   Name::texel_density_max, Name::texel_density_low,
                                   Name::texel_density_high};

constexpr std::string_view kTooOften = "The scene draws the triangles too often.";

// How a transform changes areas: the triangle with the normal n of twice its length has the area
// sqrt(n' H n) / 2 then. H is symmetric: xx, yy, zz, xy, xz, yz.
using AreaScale = std::array<float, 6>;

AreaScale area_scale(const Linear& linear) {
  if (const auto factor = common_factor(linear)) {
    const auto square = static_cast<float>(*factor * *factor);
    return {square, square, square, 0, 0, 0};
  }
  const auto& [x, y, z] = linear;
  const std::array<model::Vector3, 3> rows{model::cross(y, z), model::cross(z, x),
                                           model::cross(x, y)};
  const auto entry = [&](std::size_t i, std::size_t k) {
    return static_cast<float>(model::dot(rows[i], rows[k]));
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

// And how often.
using AreaScales = std::map<AreaScale, std::uint64_t>;

double area_of(const model::Vector3& normal, const AreaScale& scale) {
  const auto& [x, y, z] = normal;
  const auto at = [&](std::size_t i) { return static_cast<double>(scale[i]); };
  const double square = x * x * at(0) + y * y * at(1) + z * z * at(2) +
                        2 * (x * y * at(3) + x * z * at(4) + y * z * at(5));
  return std::sqrt(std::max(0.0, square)) / 2;
}

// A node that moves the vertices of its mesh.
struct MovedDraw {
  model::NodeIndex node = 0;
  AreaScales scales;
};

// What the scene draws of a mesh.
struct MeshDraws {
  AreaScales rigid;
  std::vector<MovedDraw> moved;
  std::string_view why;  // not empty: it is not known
};

class SceneDraws {
 public:
  SceneDraws(const Source& source, std::uint32_t scene)
      : drawn_(source), meshes_(source.views().meshes.size()) {
    drawn_.enter(scene);
    for (const auto& [mesh, nodes] : drawn_.by_mesh()) {
      for (const model::NodeIndex node : nodes) add(node, meshes_[mesh]);
    }
  }

  const MeshDraws& of(std::uint32_t mesh) const { return meshes_[mesh]; }
  std::optional<MeshPose> pose_of(model::NodeIndex node) { return drawn_.pose_of(node); }

 private:
  void add(model::NodeIndex node, MeshDraws& draws) {
    const auto pose = drawn_.pose_of(node);
    if (!pose) {
      draws.why = kTooMuchDrawn;
      return;
    }
    const std::vector<model::Affine> transforms = drawn_.transforms_of(node, *pose);
    if (transforms.empty()) draws.why = drawn_.why();
    if (!pose->is_rigid()) draws.moved.push_back({node, {}});
    AreaScales& scales = pose->is_rigid() ? draws.rigid : draws.moved.back().scales;
    for (const model::Affine& transform : transforms) {
      const AreaScale scale = area_scale(linear_part(transform));
      const bool finite =
          std::all_of(scale.begin(), scale.end(), [](float each) { return std::isfinite(each); });
      if (finite && scales_left_ > 0 && ++scales[scale] == 1) --scales_left_;
    }
    if (scales_left_ == 0) draws.why = kTooOften;
  }

  DrawnMeshes drawn_;
  std::vector<MeshDraws> meshes_;
  std::size_t scales_left_ = std::size_t{1} << 20U;  // that differ
};

// The values of one material.
class DensityMeasurer {
 public:
  DensityMeasurer(const Source& source, SceneDraws& draws, double texels, std::uint32_t set,
                  bool keeps_values)
      : source_(source), draws_(draws), texels_(texels), sets_{set}, keeps_values_(keeps_values) {}

  // A sentence about what failed; empty: nothing did. `left`: triangles that may still be measured.
  std::string add(std::span<const MeasuredPrimitive> uses, model::MemoryBudget& budget,
                  std::uint64_t& left) {
    Draws rigid;
    std::map<std::uint32_t, std::vector<const model::Primitive*>> by_mesh;
    for (const auto& [mesh, index] : uses) {
      const model::Primitive& primitive = source_.views().meshes[mesh].primitives[index];
      if (primitive.find(model::SemanticKind::texcoord, sets_[0]) == nullptr) continue;
      if (!draws_.of(mesh).why.empty()) return std::string(draws_.of(mesh).why);
      by_mesh[mesh].push_back(&primitive);
      if (!draws_.of(mesh).rigid.empty()) rigid.add(primitive, draws_.of(mesh).rigid);
    }
    std::string problem = measure(rigid, {}, budget, left);
    for (const auto& [mesh, primitives] : by_mesh) {
      for (const MovedDraw& draw : draws_.of(mesh).moved) {
        if (!problem.empty()) return problem;
        const auto pose = draws_.pose_of(draw.node);
        if (!pose) return std::string(kTooMuchDrawn);
        Draws moved;
        for (const model::Primitive* primitive : primitives) moved.add(*primitive, draw.scales);
        problem = measure(moved, *pose, budget, left);
      }
    }
    return problem;
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
  struct Draws {
    std::vector<const model::Primitive*> primitives;
    std::vector<const AreaScales*> scales;  // of each

    void add(const model::Primitive& primitive, const AreaScales& of) {
      primitives.push_back(&primitive);
      scales.push_back(&of);
    }
  };

  std::string measure(const Draws& draws, const MeshPose& pose, model::MemoryBudget& budget,
                      std::uint64_t& left) {
    model::GeometryRequest request;
    request.tex_coords = sets_;
    request.weights = pose.weights;
    request.joints = pose.joints;
    request.surface = false;
    std::string problem;
    read_primitives(source_, draws.primitives, request, budget, [&](const ReadPrimitive& read) {
      if (is_fault(read.error)) {
        problem = "A primitive " + std::string(model::error_text(read.error)) + ".";
      } else if (read.error == model::GeometryError::none) {
        problem = add_triangles(read.geometry, *draws.scales[read.at], left);
      }
      return problem.empty();
    });
    return problem;
  }

  std::string add_triangles(const model::Geometry& geometry, const AreaScales& scales,
                            std::uint64_t& left) {
    if (geometry.tex_coords.front().empty()) return "Texture coordinates could not be read.";
    for (const auto& [scale, times] : scales) {
      if (left < geometry.triangles.size()) return std::string(kTooOften);
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
  SceneDraws& draws_;
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
    SceneDraws draws(source, *scene);
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
  void take(std::size_t material, const model::TextureSlot& slot, SceneDraws& draws,
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
    const std::string problem = measurer.add(primitives, budget_, triangles_left_);
    if (!problem.empty()) return miss(material, problem, true);
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
  model::MemoryBudget budget_{geometry_bytes(taking_.source())};
  std::uint64_t triangles_left_ = std::uint64_t{1} << 26U;  // in all copies that differ
};

}  // namespace

void take_density(Taking& taking) { DensityTaker(taking).run(); }

}  // namespace gltfx::measure
