// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/primitive_extent.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "model/elements.hpp"
#include "model/material.hpp"
#include "rules/payload/topology.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;
using model::Primitive;
using model::SemanticKind;
using model::Vector3;

Vector3 place_of(const AccessorData& data, std::uint64_t index) {
  const std::vector<float> element = model::element_at(data, index);
  Vector3 point{};
  for (std::size_t k = 0; k < std::min<std::size_t>(3, element.size()); ++k) {
    point[k] = static_cast<double>(element[k]);
  }
  return point;
}

Vector3 edge_between(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// Whether three corners are neither at one place nor on one line.
bool has_area(const std::array<Vector3, 3>& corners) {
  const Vector3 a = edge_between(corners[1], corners[0]);
  const Vector3 b = edge_between(corners[2], corners[0]);
  const Vector3 across = model::cross(a, b);
  constexpr double kFlat = 1e-20;
  return model::dot(across, across) > kFlat * model::dot(a, a) * model::dot(b, b);
}

// Positions and indices of a primitive, read one by one.
class Corners {
 public:
  Corners(AccessorData positions, std::optional<AccessorData> indices)
      : positions_(std::move(positions)), indices_(std::move(indices)) {}

  std::uint64_t count() const { return indices_ ? indices_->count() : positions_.count(); }
  std::uint64_t vertices() const { return positions_.count(); }
  Vector3 operator[](std::uint64_t corner) const {
    return place_of(positions_, indices_ ? model::index_at(*indices_, corner).value_or(0) : corner);
  }
  Vector3 vertex(std::uint64_t index) const { return place_of(positions_, index); }

 private:
  AccessorData positions_;
  std::optional<AccessorData> indices_;
};

// The greatest alpha of vertex colours; 1 without them or if they cannot be read.
double greatest_alpha(DataPhase& phase, const Primitive& primitive) {
  const model::Attribute* colors = primitive.find(SemanticKind::color);
  if (colors == nullptr || !colors->accessor) return 1;
  const auto data = phase.open(*colors->accessor);
  if (!data || data->implied() || data->components() != 4) return 1;
  if (model::element_at(*data, 0)[3] > 0) return 1;
  if (!phase.budget.take(data->count(), 4)) return 1;
  float alpha = 0;
  model::for_each_component(*data, static_cast<std::size_t>(data->count()),
                            [&](std::size_t, unsigned k, float value) {
                              if (k == 3) alpha = std::max(alpha, value);
                            });
  return static_cast<double>(alpha);
}

// The greatest alpha in the images of the texture of the base color; 1 without them or if they
// cannot be decoded.
double greatest_texel_alpha(const DataPhase& phase, const model::Material& material,
                            PixelSource& pixels) {
  const model::Asset& asset = phase.context.asset;
  const auto& texture = material.of(MaterialSlot::base_color).texture;
  if (!texture) return 1;
  const std::vector<std::uint32_t> images =
      model::read_texture(asset, asset.elements(model::RootArray::textures)[*texture]).images;
  double greatest = images.empty() ? 1 : 0;
  for (const std::uint32_t image : images) {
    const auto& header = phase.resources.images[image].header;
    if (!header || !image::can_be_transparent(*header)) return 1;
    if (pixels.of(image) == nullptr && pixels.error(image) == nullptr) {
      pixels.decode({{image}}, phase.context.options.jobs);
    }
    const codec::Image* decoded = pixels.of(image);
    if (decoded == nullptr || !decoded->has_alpha() || decoded->bits > 16) return 1;
    const double full = static_cast<double>((1U << decoded->bits) - 1);
    greatest = std::max(greatest, decoded->alpha().greatest / full);
  }
  return greatest;
}

}  // namespace

// The first triangles answer nearly always; the others are read where they do not.
std::optional<bool> has_extent(DataPhase& phase, const Primitive& primitive,
                               const AccessorData& positions) {
  std::optional<AccessorData> indices;
  if (primitive.indices) {
    indices = phase.open(*primitive.indices);
    if (!indices) return std::nullopt;
  }
  const Corners corners(positions, std::move(indices));
  const model::Mode mode = *primitive.mode;
  if (corners.count() == 0) return false;
  if (mode == model::Mode::points) return true;
  const bool triangles = model::draws_triangles(mode);
  constexpr std::uint64_t kFew = 48;
  const std::uint64_t step =
      mode == model::Mode::triangles || mode == model::Mode::lines ? (triangles ? 3 : 2) : 1;
  for (std::uint64_t i = 0; i + (triangles ? 3 : 2) <= std::min(corners.count(), kFew); i += step) {
    const std::uint64_t first = mode == model::Mode::triangle_fan ? 0 : i;
    const Vector3 a = corners[first];
    const Vector3 b = corners[i + 1];
    if (triangles ? has_area({a, b, corners[i + 2]}) : a != b) return true;
  }
  if (corners.count() <= kFew) return false;
  if (!triangles) return std::nullopt;
  const auto all = read_triangles(phase, primitive);
  if (!all || !phase.budget.take(positions.count(), 3)) return std::nullopt;
  model::Vectors<3> places(static_cast<std::size_t>(positions.count()));
  if (positions.components() != 3) return std::nullopt;
  model::read_elements(positions, places);
  const auto wide = [&](std::uint32_t vertex) {
    if (vertex >= places.size()) return Vector3{};
    const auto& place = places[vertex];
    return Vector3{static_cast<double>(place[0]), static_cast<double>(place[1]),
                   static_cast<double>(place[2])};
  };
  return std::any_of(all->begin(), all->end(), [&](const Triangle& each) {
    return has_area({wide(each[0]), wide(each[1]), wide(each[2])});
  });
}

bool is_clear(DataPhase& phase, const Primitive& primitive, PixelSource* pixels) {
  if (!primitive.material) return false;
  const model::Material material = model::read_material(phase.context.asset, *primitive.material);
  if (material.alpha_mode == model::AlphaMode::opaque) return false;
  const double factor = static_cast<double>(material.of(MaterialParameter::base_color)[3]);
  const double cutoff = material.alpha_mode == model::AlphaMode::mask
                            ? static_cast<double>(material.of(MaterialParameter::alpha_cutoff)[0])
                            : 0;
  const bool mask = material.alpha_mode == model::AlphaMode::mask;
  const auto unseen = [&](double alpha) { return mask ? alpha < cutoff : alpha <= 0; };
  if (unseen(factor)) return true;
  const double colored = factor * greatest_alpha(phase, primitive);
  if (unseen(colored)) return true;
  return pixels != nullptr && unseen(colored * greatest_texel_alpha(phase, material, *pixels));
}

}  // namespace gltfx::validate
