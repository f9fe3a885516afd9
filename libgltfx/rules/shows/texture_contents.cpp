// SPDX-License-Identifier: Apache-2.0
// What decoded images make of a surface.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/elements.hpp"
#include "model/fields.hpp"
#include "model/material.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/uv_reading.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;
using model::Primitive;
using model::SemanticKind;
using model::Vector3;

// --- Occlusion ---

void check_occlusion(DataPhase& phase, const TextureSlot& slot, const codec::Image& image) {
  if (slot.property != "occlusionTexture" || !slot.effective.has('r')) return;
  constexpr std::uint64_t kBlack = 8;  // of 255
  constexpr double kFull = 0.9;
  const std::uint64_t brightest = statistics_of(image, 'r').greatest;
  if (brightest * 255 > image.full() * kBlack) return;
  const json::Document& document = phase.context.document;
  const double strength =
      model::number_member(document, slot.use->texture_info, "strength").value_or(1);
  if (strength < kFull) return;
  report_slot(
      phase.context, phase.sink, slot, Code::OCCLUSION_BLACK,
      fmt::format("The red channel of {} is {}in every texel, so no ambient light reaches {}.",
                  image_label(phase.context, slot.images.front()),
                  brightest == 0 ? "0 " : fmt::format("at most {} of {} ", brightest, image.full()),
                  object_label(phase.context, model::RootArray::materials, slot.material_index)));
}

// --- Normal maps ---

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return fmt::format("{:.0f} %", 100.0 * static_cast<double>(part) /
                                     static_cast<double>(std::max<std::uint64_t>(whole, 1)));
}

// Whether the squares agree on `side`: nearly all of a few, or most of many and nearly none with
// the other convention.
bool is_clear(std::uint64_t side, std::uint64_t other, const SlopeStudy& study) {
  constexpr std::uint64_t kFew = 8;
  constexpr std::uint64_t kMany = 40;
  if (side < kFew || side < 19 * other) return false;
  return side >= 9 * (study.rough + other) || (side >= kMany && side >= study.rough);
}

bool is_normal_map(const SlopeStudy& study) {
  constexpr double kUnit = 0.9;
  constexpr double kTilted = 0.15;
  return static_cast<double>(study.unit) >= kUnit * static_cast<double>(study.seen) &&
         std::abs(study.mean_x) < kTilted && std::abs(study.mean_y) < kTilted &&
         (is_clear(study.up, study.down, study) || is_clear(study.down, study.up, study));
}

// One corner of a surface with what tangents are made for.
struct TangentCorner {
  Vector3 position{}, normal{};
  std::array<double, 4> tangent{};
  std::array<double, 2> uv{};
};

// The vertices of triangles of one primitive, read one by one.
class TangentReader {
 public:
  TangentReader(DataPhase& phase, const Primitive& primitive, std::uint64_t set)
      : tangents_(open(phase, primitive.find(SemanticKind::tangent))),
        positions_(open(phase, primitive.find(SemanticKind::position))),
        normals_(open(phase, primitive.find(SemanticKind::normal))),
        uvs_(open_uvs(phase, primitive, set)) {
    if (primitive.indices) indices_ = phase.open(*primitive.indices);
    is_list_ = primitive.mode == model::Mode::triangles &&
               (primitive.indices_node == json::kNoNode || indices_);
  }
  explicit operator bool() const { return is_list_ && tangents_ && positions_ && normals_ && uvs_; }
  std::uint64_t triangles() const { return (indices_ ? indices_->count() : uvs_->count()) / 3; }

  TangentCorner corner(std::uint64_t at) const {
    if (indices_) at = model::index_at(*indices_, at).value_or(0);
    TangentCorner corner;
    fill(*positions_, at, corner.position);
    fill(*normals_, at, corner.normal);
    fill(*tangents_, at, corner.tangent);
    fill(*uvs_, at, corner.uv);
    return corner;
  }

 private:
  static std::optional<AccessorData> open(DataPhase& phase, const model::Attribute* attribute) {
    if (attribute == nullptr || !attribute->accessor) return std::nullopt;
    auto data = phase.open(*attribute->accessor);
    if (!data || data->implied()) return std::nullopt;
    return data;
  }
  template <std::size_t N>
  static void fill(const AccessorData& data, std::uint64_t at, std::array<double, N>& to) {
    const std::vector<float> element = model::element_at(data, at);
    for (std::size_t k = 0; k < std::min(N, element.size()); ++k) {
      to[k] = static_cast<double>(element[k]);
    }
  }

  std::optional<AccessorData> tangents_, positions_, normals_, uvs_, indices_;
  bool is_list_ = false;
};

// How the bitangent of a triangle's first corner points along v, down the image: negative where
// it is as glTF has it; 0: nobody can tell.
double bitangent_along_v(const TangentReader& reader, std::uint64_t triangle) {
  const TangentCorner a = reader.corner(3 * triangle);
  const TangentCorner b = reader.corner(3 * triangle + 1);
  const TangentCorner c = reader.corner(3 * triangle + 2);
  const double u1 = b.uv[0] - a.uv[0], v1 = b.uv[1] - a.uv[1];
  const double u2 = c.uv[0] - a.uv[0], v2 = c.uv[1] - a.uv[1];
  const double area = u1 * v2 - u2 * v1;
  Vector3 along{};
  for (std::size_t k = 0; k < 3; ++k) {
    along[k] = (c.position[k] - a.position[k]) * u1 - (b.position[k] - a.position[k]) * u2;
  }
  const Vector3 bitangent = model::cross(a.normal, {a.tangent[0], a.tangent[1], a.tangent[2]});
  const double along_v = model::dot(bitangent, along) * a.tangent[3];
  return area > 0 ? along_v : area < 0 ? -along_v : 0;
}

// Whether the tangents of a primitive turn green over, as made for maps of DirectX.
bool has_turned_tangents(DataPhase& phase, const Primitive& primitive, std::uint64_t set) {
  const TangentReader reader(phase, primitive, set);
  if (!reader) return false;
  constexpr std::uint64_t kFew = 16;
  const std::uint64_t count = reader.triangles();
  int turned = 0, right = 0;
  for (std::uint64_t n = 0; n < std::min(count, kFew); ++n) {
    const double along = bitangent_along_v(reader, count <= kFew ? n : count / kFew * n);
    turned += along > 0 ? 1 : 0;
    right += along < 0 ? 1 : 0;
  }
  return turned > right;
}

bool is_turned_over(DataPhase& phase, const TextureSlot& slot,
                    const std::vector<PlacedPrimitive>& users) {
  const UvMapping mapping = read_uv_mapping(phase.context.document, slot.use->texture_info);
  if (mapping.rotation != 0 || mapping.scale[0] * mapping.scale[1] <= 0) return true;
  return std::any_of(users.begin(), users.end(), [&](const PlacedPrimitive& user) {
    return has_turned_tangents(phase, *user.primitive, set_of(mapping));
  });
}

void check_relief(DataPhase& phase, const TextureSlot& slot, const SlopeStudy& study,
                  const std::vector<PlacedPrimitive>& users) {
  if (!is_clear(study.down, study.up, study) || is_turned_over(phase, slot, users)) return;
  report_slot(
      phase.context, phase.sink, slot, Code::NORMAL_MAP_DIRECTX,
      fmt::format("The green channel of {} points down, as in DirectX: in {} of the {} squares of "
                  "the image with relief, the slopes fit together only if green is turned over.",
                  image_label(phase.context, slot.images.front()),
                  percent(study.down, study.down + study.up + study.rough),
                  study.down + study.up + study.rough));
}

void check_color(DataPhase& phase, const TextureSlot& slot, const SlopeStudy& study) {
  if (!is_normal_map(study)) return;
  const std::string label = image_label(phase.context, slot.images.front());
  report_slot(phase.context, phase.sink, slot, Code::NORMAL_MAP_AS_COLOR,
              fmt::format("{} reads colors, but {} is a normal map: {} of its texels are vectors "
                          "of unit length.",
                          slot.property, label, percent(study.unit, study.seen)));
}

// Images in slots for normals: with another slot they have a finding of their own.
std::set<std::uint32_t> normal_images(const std::vector<TextureSlot>& slots) {
  std::set<std::uint32_t> images;
  for (const TextureSlot& slot : slots) {
    if (slot.normal_map) images.insert(slot.images.begin(), slot.images.end());
  }
  return images;
}

}  // namespace

void check_texture_contents(DataPhase& phase) {
  if (!phase.textures) return;
  const PixelSource& pixels = phase.textures->pixels;
  const std::set<std::uint32_t> normals = normal_images(phase.textures->slots);
  const auto users = primitives_of_materials(phase.context);
  std::set<std::uint32_t> reported;
  for (const TextureSlot& slot : phase.textures->slots) {
    const std::uint32_t index = slot.images.front();
    const codec::Image* image = pixels.of(index);
    if (image == nullptr || slot.material == json::kNoNode || slot.effective.empty()) continue;
    const bool lit = slot.property == "occlusionTexture" || slot.normal_map;
    if (lit && model::read_material(phase.context.asset, slot.material_index).unlit) continue;
    check_occlusion(phase, slot, *image);
    const SlopeStudy* study = pixels.slopes(index);
    if (study == nullptr || !reported.insert(index).second) continue;
    if (slot.normal_map) {
      check_relief(phase, slot, *study, users[slot.material_index]);
    } else if (slot.srgb && slot.effective.colors() == 3 && normals.count(index) == 0) {
      check_color(phase, slot, *study);
    }
  }
}

}  // namespace gltfx::validate
