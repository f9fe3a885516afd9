// SPDX-License-Identifier: Apache-2.0
// Measures of pixels: each image is decoded once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "codec/client.hpp"
#include "measure/shape.hpp"
#include "measure/take.hpp"
#include "measure/texel_mask.hpp"
#include "measure/texture_uses.hpp"
#include "measure/uv_surface.hpp"
#include "model/image_codec.hpp"
#include "model/image_decoding.hpp"

namespace gltfx::measure {
namespace {

constexpr double kWhite = 255;  // as an 8-bit code

double linear_of(double code) {
  const double encoded = code / kWhite;
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
double code_of(double linear) {
  if (linear >= 1) return kWhite;
  return kWhite *
         (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

// The least and the greatest value of the largest color channel of texels.
struct ValueRange {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  bool empty() const { return least > most; }
  void include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

// The values of an image, of 8 or 16 bits, as 8-bit codes.
template <class T>
class ImageValues {
 public:
  explicit ImageValues(const codec::Image& image)
      : values_(reinterpret_cast<const T*>(image.pixels.data())),
        channels_(image.channels),
        colors_(image.channels < 3 ? 1 : 3),
        scale_(kWhite / image.full()) {}

  // Whether alpha is not 0.
  bool is_visible(std::uint64_t texel) const {
    return channels_ % 2 == 1 || values_[(texel + 1) * channels_ - 1] != 0;
  }
  double largest(std::uint64_t texel) const {
    const T* first = values_ + texel * channels_;
    return scale_ * *std::max_element(first, first + colors_);
  }
  // `codes`: of each value, by color channel.
  double largest(std::uint64_t texel, const std::array<std::vector<double>, 3>& codes) const {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const T value = values_[texel * channels_ + (colors_ == 3 ? k : 0)];
      largest = std::max(largest, codes[k][value]);
    }
    return largest;
  }

 private:
  const T* values_;
  std::size_t channels_;
  std::ptrdiff_t colors_;
  double scale_;
};

template <class Use>
auto with_values(const codec::Image& image, const Use& use) {
  if (image.bits == 16) return use(ImageValues<std::uint16_t>(image));
  return use(ImageValues<std::uint8_t>(image));
}

ValueRange range_of(const codec::Image& image) {
  return with_values(image, [&](const auto& values) {
    ValueRange range;
    for (std::uint64_t texel = 0; texel < image.texels(); ++texel) {
      if (values.is_visible(texel)) range.include(values.largest(texel));
    }
    return range;
  });
}

bool is_constant(const codec::Image& image) {
  return std::all_of(image.statistics.begin(), image.statistics.begin() + image.channels,
                     [](const codec::ChannelStatistics& each) { return each.constant(); });
}

// The base color under the mask.
ValueRange range_under(const codec::Image& image, const TexelMask& mask,
                       const std::array<float, 4>& factor) {
  std::array<std::vector<double>, 3> codes;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::uint32_t value = 0; value <= image.full(); ++value) {
      const double code = value * kWhite / image.full();
      codes[k].push_back(factor[k] == 1 ? code : code_of(linear_of(code) * double{factor[k]}));
    }
  }
  ValueRange range;
  if (factor[3] == 0) return range;
  with_values(image, [&](const auto& values) {
    mask.for_each([&](std::uint64_t texel) {
      if (values.is_visible(texel)) range.include(values.largest(texel, codes));
    });
    return true;
  });
  return range;
}

// An image, and what is measured of it.
struct ImageTask {
  std::uint32_t image = 0;
  std::vector<std::size_t> materials;  // whose base color it is
  ValueRange range;
  bool decoded = false;  // or failed to be
};

class PixelTaker {
 public:
  explicit PixelTaker(Taking& taking)
      : taking_(taking),
        darkest_(taking.column(MeasureScope::material, Name::albedo_min)),
        brightest_(taking.column(MeasureScope::material, Name::albedo_max)),
        least_(taking.column(MeasureScope::image, Name::value_min)),
        most_(taking.column(MeasureScope::image, Name::value_max)),
        constant_(taking.column(MeasureScope::image, Name::constant)) {}

  void run() {
    plan_materials();
    std::vector<ImageTask> tasks;
    for (std::uint32_t i = 0; i < by_image_.size(); ++i) {
      const bool wanted = least_ != nullptr || most_ != nullptr || constant_ != nullptr;
      if (wanted || !by_image_[i].empty()) tasks.push_back({i, by_image_[i], {}, false});
    }
    if (!taking_.pixels()) {
      for (const ImageTask& task : tasks)
        miss(task, "The pixels were not decoded; use --pixels needed.");
      return;
    }
    using Decoding = model::ImageDecoding;
    std::vector<Decoding::Request> requests;
    for (const ImageTask& task : tasks) requests.push_back({task.image, false, true});
    Decoding(source().resources())
        .decode(
            requests, source().jobs(),
            [&](std::size_t i, codec::ImageResult& result) {
              if (least_ != nullptr || most_ != nullptr)
                tasks[i].range = range_of(std::get<codec::Image>(result));
            },
            [&](std::size_t i, codec::ImageResult& result) {
              tasks[i].decoded = true;
              take(tasks[i], result);
            });
    for (const ImageTask& task : tasks) {
      if (!task.decoded) miss(task, "The image has no data that can be decoded.");
    }
  }

 private:
  const Source& source() const { return taking_.source(); }

  void plan_materials() {
    by_image_.resize(taking_.count(MeasureScope::image));
    if (darkest_ == nullptr && brightest_ == nullptr) return;
    textures_ = material_textures(source());
    primitives_ = primitives_by_material(taking_);
    textures_.resize(primitives_.size());  // with that of primitives without a material
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      const auto& texture = textures_[i].base_color.texture;
      if (!texture) {
        set_factor(i);
      } else if (const auto image = image_of(*texture)) {
        by_image_[*image].push_back(i);
      } else {
        miss_material(i, "No image of the texture can be decoded.", true);
      }
    }
  }

  std::optional<std::uint32_t> image_of(std::uint32_t texture) const {
    const model::Asset& asset = source().asset();
    const auto& textures = asset.elements(model::RootArray::textures);
    for (const std::uint32_t image : model::read_texture(asset, textures[texture]).images) {
      if (model::is_decodable(source().resources().images[image])) return image;
    }
    return std::nullopt;
  }

  void set_factor(std::size_t material) {
    const auto& factor = textures_[material].base_color_factor;
    if (factor[3] == 0) return miss_material(material, kTransparent, false);
    const double code = code_of(double{*std::max_element(factor.begin(), factor.begin() + 3)});
    set_material(material, {code, code});
  }

  // A decoder's own words stay inside.
  static std::string_view reason_of(const codec::DecodeError& error) {
    using Decoding = model::ImageDecoding;
    for (const std::string_view limit : {Decoding::kTooManyTexels, Decoding::kStopped}) {
      if (error.message == limit) return limit;
    }
    return "The image could not be decoded.";
  }

  void take(const ImageTask& task, const codec::ImageResult& result) {
    const auto* image = std::get_if<codec::Image>(&result);
    if (image == nullptr) return miss(task, reason_of(std::get<codec::DecodeError>(result)));
    if (constant_ != nullptr) constant_->set(task.image, MeasureValue(is_constant(*image)));
    set(least_, task.image, task.range, task.range.least);
    set(most_, task.image, task.range, task.range.most);
    for (const std::size_t material : task.materials) take_material(material, *image);
  }

  void take_material(std::size_t material, const codec::Image& image) {
    if (texels_left_ == 0) return miss_material(material, "Materials cover too many texels.", true);
    const MaterialTextures& textures = textures_[material];
    UvSurface surface;
    const UvProblem problem = read_uv_surface(source(), primitives_[material],
                                              textures.base_color.tex_coord, budget_, surface);
    if (!problem.text.empty()) return miss_material(material, problem.text, problem.fault);
    const model::Asset& asset = source().asset();
    const auto& objects = asset.elements(model::RootArray::textures);
    const model::Texture texture =
        model::read_texture(asset, objects[*textures.base_color.texture]);
    TexelMask mask(image.width, image.height, texture.sampler);
    bool covered = true;
    for (std::size_t i = 0; covered && i < surface.triangles.size(); ++i) {
      const UvTriangle corners = surface.corners(i);
      if (!is_finite(corners)) continue;
      covered = mask.cover(in_texels(corners, textures.base_color, image));
    }
    texels_left_ -= std::min(texels_left_, mask.cost());
    if (!covered) {
      return miss_material(material, "The triangles cover too many copies of the texture.", true);
    }
    const ValueRange range = range_under(image, mask, textures.base_color_factor);
    if (range.empty()) return miss_material(material, kTransparent, false);
    set_material(material, range);
  }

  // KHR_texture_transform: scaled, rotated, moved.
  static std::array<TexelPoint, 3> in_texels(const UvTriangle& corners,
                                             const model::TextureSlot& slot,
                                             const codec::Image& image) {
    const double cosine = std::cos(double{slot.rotation});
    const double sine = std::sin(double{slot.rotation});
    std::array<TexelPoint, 3> texels{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = double{corners[i][0]} * double{slot.scale[0]};
      const double v = double{corners[i][1]} * double{slot.scale[1]};
      texels[i] = {(cosine * u + sine * v + double{slot.offset[0]}) * image.width,
                   (cosine * v - sine * u + double{slot.offset[1]}) * image.height};
    }
    return texels;
  }

  static void set(Column* to, std::size_t image, const ValueRange& range, double value) {
    if (to == nullptr) return;
    if (range.empty()) return to->does_not_apply(image, kTransparent);
    to->set(image, MeasureValue(value));
  }
  void set_material(std::size_t material, const ValueRange& range) {
    set(darkest_, material, range, range.least);
    set(brightest_, material, range, range.most);
  }

  void miss_material(std::size_t material, std::string_view why, bool fault) {
    for (Column* column : {darkest_, brightest_}) {
      if (column == nullptr) continue;
      fault ? column->could_not_be_taken(material, why) : column->does_not_apply(material, why);
    }
  }
  void miss(const ImageTask& task, std::string_view why) {
    for (Column* column : {least_, most_, constant_}) {
      if (column != nullptr) column->could_not_be_taken(task.image, why);
    }
    for (const std::size_t material : task.materials) miss_material(material, why, true);
  }

  static constexpr std::string_view kTransparent = "All texels are transparent.";

  Taking& taking_;
  Column *darkest_, *brightest_, *least_, *most_, *constant_;  // null: not wanted
  std::vector<MaterialTextures> textures_;
  std::vector<std::vector<MeasuredPrimitive>> primitives_;
  std::vector<std::vector<std::size_t>> by_image_;  // materials
  model::MemoryBudget budget_{geometry_bytes(taking_.source())};
  std::uint64_t texels_left_ = std::uint64_t{1} << 30U;  // that all materials may cover
};

}  // namespace

void take_pixels(Taking& taking) { PixelTaker(taking).run(); }

}  // namespace gltfx::measure
