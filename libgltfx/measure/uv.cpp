// SPDX-License-Identifier: Apache-2.0
// Measures of texture coordinates, by material.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/shape.hpp"
#include "measure/take.hpp"
#include "measure/texture_uses.hpp"
#include "measure/uv_islands.hpp"
#include "measure/uv_overlap.hpp"
#include "measure/uv_surface.hpp"

namespace gltfx::measure {
namespace {

constexpr std::array kUvNames{Name::uv_outside,  Name::uv_overlap,    Name::uv_overlap_area,
                              Name::uv_inverted, Name::uv_degenerate, Name::uv_islands,
                              Name::uv_gutter,   Name::uv_border,     Name::uv_coverage};

constexpr std::string_view kNoWorkLeft =
    "The rectangles around the triangles overlap so often that the search was given up.";

bool is_outside(const UvTriangle& triangle) {
  const auto beyond = [](float value) {
    return !(double{value} >= -kUvNoise && double{value} <= 1 + kUvNoise);
  };
  return std::any_of(triangle.begin(), triangle.end(),
                     [&](const UvPoint& at) { return beyond(at[0]) || beyond(at[1]); });
}

// The largest texture that reads the set.
struct LargestTexture {
  std::optional<TextureSize> size;
  bool unread = false;  // a header could not be read

  TexelGrid grid(std::uint32_t at) const {
    const model::Sampler sampler = size ? size->sampler : model::Sampler();
    TexelGrid grid{static_cast<double>(at), static_cast<double>(at),
                   sampler.wrap_s == model::Wrap::repeat, sampler.wrap_t == model::Wrap::repeat};
    if (at == 0) {
      grid.width = size->width;
      grid.height = size->height;
    }
    return grid;
  }
};

LargestTexture largest_texture(const Source& source, const MaterialTextures& textures,
                               std::uint32_t set) {
  LargestTexture largest;
  const auto texels = [](const TextureSize& size) {
    return std::uint64_t{size.width} * size.height;
  };
  for (const TextureUse& use : textures.uses) {
    if (use.read.tex_coord != set) continue;
    const auto size = size_of_texture(source, *use.read.texture);
    if (!size) largest.unread = true;
    if (size && (!largest.size || texels(*size) > texels(*largest.size))) largest.size = size;
  }
  return largest;
}

// The values of one material.
class UvMeasurer {
 public:
  UvMeasurer(Taking& taking, std::size_t material, UvSurface surface)
      : taking_(taking), material_(material) {
    std::uint64_t outside = 0, degenerate = 0, inverted = 0;
    sound_.triangles.reserve(surface.triangles.size());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      const UvTriangle corners = surface.corners(i);
      if (is_outside(corners)) ++outside;
      if (!is_finite(corners)) continue;
      if (is_degenerate(corners)) {
        ++degenerate;
        continue;
      }
      sound_.triangles.push_back(surface.triangles[i]);
      if (signed_area(corners) > 0) ++inverted;
      box_.include(box_of(corners));
    }
    sound_.points = std::move(surface.points);
    set(Name::uv_outside, outside);
    set(Name::uv_degenerate, degenerate);
    set(Name::uv_inverted, inverted);
  }

  void take_overlap() {
    Column* count = column(Name::uv_overlap);
    Column* shared = column(Name::uv_overlap_area);
    Column* covered = column(Name::uv_coverage);
    if (count == nullptr && shared == nullptr && covered == nullptr) return;
    UvOverlap overlap(sound_);
    const bool found = overlap.find();
    if (count != nullptr)
      set_found(*count, found, [&] { return static_cast<double>(overlap.count()); });
    if (shared == nullptr && covered == nullptr) return;
    const std::optional<UvCover> cover = found ? overlap.cover() : std::nullopt;
    const auto set_area = [&](Column* to, double (*area)(const UvCover&)) {
      if (to == nullptr) return;
      set_found(*to, cover.has_value(), [&] { return area(*cover); });
    };
    set_area(shared, [](const UvCover& of) { return of.once > 0 ? of.twice / of.once : 0; });
    set_area(covered, [](const UvCover& of) { return std::min(1.0, of.in_square); });
  }

  void take_islands(const LargestTexture& texture) {
    Column* gutter = column(Name::uv_gutter);
    if (column(Name::uv_islands) == nullptr && gutter == nullptr) return;
    const UvIslands islands = find_islands(sound_);
    set(Name::uv_islands, islands.count);
    if (gutter == nullptr) return;
    if (islands.count < 2) return gutter->does_not_apply(material_, "There are no two islands.");
    const std::uint32_t at = taking_.parameters().gutter_at;
    if (at == 0 && !has_texels(*gutter, texture)) return;
    set_found(*gutter, true, [&] { return find_gutter(islands.outlines, texture.grid(at)); });
  }

  void take_border(const LargestTexture& texture) {
    Column* border = column(Name::uv_border);
    if (border == nullptr) return;
    if (sound_.triangles.empty()) {
      return border->does_not_apply(material_, "No triangle has an area in the texture.");
    }
    if (!has_texels(*border, texture)) return;
    const double u = std::min(double{box_.least_u}, 1 - double{box_.most_u});
    const double v = std::min(double{box_.least_v}, 1 - double{box_.most_v});
    border->set(material_, MeasureValue(std::max(
                               0.0, std::min(u * texture.size->width, v * texture.size->height))));
  }

 private:
  Column* column(Name name) { return taking_.column(MeasureScope::material, name); }
  void set(Name name, std::uint64_t value) {
    if (Column* to = column(name)) to->set(material_, value);
  }

  // `value` gives nothing when it is out of work.
  template <class Value>
  void set_found(Column& to, bool found, const Value& value) {
    const std::optional<double> number = found ? std::optional<double>(value()) : std::nullopt;
    if (!number) return to.could_not_be_taken(material_, kNoWorkLeft);
    to.set(material_, MeasureValue(*number));
  }

  bool has_texels(Column& to, const LargestTexture& texture) {
    if (texture.unread) {
      to.could_not_be_taken(material_, "The header of an image could not be read.");
    } else if (!texture.size) {
      to.does_not_apply(material_, "The material has no texture that reads these coordinates.");
    }
    return texture.size && !texture.unread;
  }

  Taking& taking_;
  std::size_t material_;
  UvSurface sound_;  // triangles with an area
  UvBox box_;        // of sound_
};

}  // namespace

void take_uv(Taking& taking) {
  const Source& source = taking.source();
  const auto uses = primitives_by_material(taking);
  const auto textures = material_textures(source);
  model::MemoryBudget budget(geometry_bytes(source));
  for (std::size_t material = 0; material < uses.size(); ++material) {
    const MaterialTextures own =
        material < textures.size() ? textures[material] : MaterialTextures();
    const std::uint32_t set = own.uv_set();
    UvSurface surface;
    const UvProblem problem = read_uv_surface(source, uses[material], set, budget, surface);
    if (!problem.text.empty()) {
      for (const Name name : kUvNames) {
        if (Column* column = taking.column(MeasureScope::material, name)) {
          problem.fault ? column->could_not_be_taken(material, problem.text)
                        : column->does_not_apply(material, problem.text);
        }
      }
      continue;
    }
    UvMeasurer measurer(taking, material, std::move(surface));
    const LargestTexture largest = largest_texture(source, own, set);
    measurer.take_overlap();
    measurer.take_islands(largest);
    measurer.take_border(largest);
  }
}

}  // namespace gltfx::measure
