// SPDX-License-Identifier: Apache-2.0
#include "resize.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "resample.hpp"
#include "transparency.hpp"

namespace gltfx::codec {
namespace {

// The transfer function of sRGB (IEC 61966-2-1).
float linear_of(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}
float srgb_of(float linear) {
  return linear <= 0.0031308F ? linear * 12.92F : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

// Below this alpha, the colour is unknown.
constexpr float kLeastAlpha = 1e-6F;
// Below this length, a mean of vectors has no direction.
constexpr float kLeastLength = 1e-3F;

class Resizer {
 public:
  Resizer(const Raster& raster, std::span<const std::byte> texels, const Size& size,
          const Resize& how)
      : from_(raster),
        texels_(texels),
        how_(how),
        to_{size.width, size.height, raster.channels, raster.bits},
        cutoff_(cutoff()) {
    if (raster.bits == 32) return;
    const std::size_t full = full_value();
    for (std::size_t i = 0; i <= full; ++i) {
      plain_.push_back(static_cast<float>(i) / static_cast<float>(full));
      light_.push_back(linear_of(plain_.back()));
    }
  }

  Texels run() {
    std::vector<float> values =
        resample({from_.width, to_.width, how_.wrap_u}, {from_.height, to_.height, how_.wrap_v},
                 from_.channels, [&](std::uint32_t row, std::span<float> to) { load(row, to); });
    if (vectors()) normalise(values);
    if (has_alpha()) finish_alpha(values);
    return write(values);
  }

 private:
  bool has_alpha() const { return from_.channels % 2 == 0; }
  unsigned colors() const { return from_.channels - (has_alpha() ? 1 : 0); }
  bool vectors() const { return how_.kind == TexelKind::normal && from_.channels >= 3; }
  bool lights() const { return how_.kind == TexelKind::color && from_.bits != 32; }
  bool weighs() const { return how_.weigh_alpha && has_alpha(); }
  std::size_t full_value() const { return from_.bits == 16 ? 65535 : 255; }

  // The numbers of a row, from 0 to 1, with colours as linear light.
  template <typename T>
  void load_integers(const std::byte* row, std::span<float> to) const {
    std::array<const float*, 4> tables{};
    for (unsigned c = 0; c < from_.channels; ++c) {
      tables[c] = (lights() && c < colors() ? light_ : plain_).data();
    }
    for (std::size_t i = 0; i < to.size(); i += from_.channels) {
      for (unsigned c = 0; c < from_.channels; ++c) {
        T value{};
        std::memcpy(&value, row + (i + c) * sizeof value, sizeof value);
        to[i + c] = tables[c][value];
      }
    }
  }

  void load(std::uint32_t row, std::span<float> to) {
    const std::byte* const at = texels_.data() + row * to.size() * (from_.bits / 8);
    if (from_.bits == 32) {
      std::memcpy(to.data(), at, to.size_bytes());
    } else if (from_.bits == 16) {
      load_integers<std::uint16_t>(at, to);
    } else {
      load_integers<std::uint8_t>(at, to);
    }
    if (vectors()) {
      for (std::size_t i = 0; i < to.size(); i += from_.channels) {
        for (std::size_t c = 0; c < 3; ++c) to[i + c] = to[i + c] * 2 - 1;
      }
    }
    if (!has_alpha()) return;
    for (std::size_t i = 0; i < to.size(); i += from_.channels) {
      float& alpha = to[i + from_.channels - 1];
      alpha = alpha > 0 ? std::min(alpha, 1.0F) : 0;  // a float may be no number
      if (alpha >= cutoff_.shows) ++shown_;
      if (!weighs()) continue;
      for (std::size_t c = 0; c < colors(); ++c) to[i + c] *= alpha;
    }
  }

  // A value exactly at the cutoff is visible, also after rounding to float.
  Cutoff cutoff() const {
    if (from_.bits == 32) {
      return {how_.alpha_cutoff, std::nextafter(how_.alpha_cutoff, 0.0F), how_.alpha_cutoff};
    }
    const auto full = static_cast<float>(full_value());
    const float step = std::ceil(how_.alpha_cutoff * full - 1e-3F);
    return {how_.alpha_cutoff, (step - 1) / full, step / full};
  }

  void normalise(std::vector<float>& values) const {
    for (std::size_t i = 0; i < values.size(); i += from_.channels) {
      const float length = std::sqrt(values[i] * values[i] + values[i + 1] * values[i + 1] +
                                     values[i + 2] * values[i + 2]);
      const float scale = length > kLeastLength ? 1 / length : 1;
      for (std::size_t c = 0; c < 3; ++c) values[i + c] = values[i + c] * scale / 2 + 0.5F;
    }
  }

  void finish_alpha(std::vector<float>& values) const {
    const AlphaTexels texels{values, to_.width, to_.height, to_.channels};
    std::vector<bool> unknown(weighs() ? texels.count() : 0);
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      const float alpha = texels.alpha(i);
      unknown[i] = !(alpha > kLeastAlpha);
      for (std::size_t c = 0; c < colors() && !unknown[i]; ++c) {
        values[i * to_.channels + c] /= alpha;
      }
    }
    const bool divides = how_.alpha_cutoff > 0 && cutoff_.shows > 0 && cutoff_.shows <= 1;
    if (divides) {
      const auto all = static_cast<double>(std::uint64_t{from_.width} * from_.height);
      keep_coverage(texels, static_cast<double>(shown_) / all, cutoff_);
    }
    if (!weighs()) return;
    const float least = from_.bits == 32 ? 0 : 0.5F / static_cast<float>(full_value());
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      if (texels.alpha(i) < least) unknown[i] = true;
    }
    fill_colors(texels, std::move(unknown), how_);
  }

  template <typename T>
  void write_integers(const std::vector<float>& values, std::byte* to) const {
    const auto full = static_cast<float>(full_value());
    for (std::size_t i = 0; i < values.size(); ++i) {
      float value = std::clamp(values[i], 0.0F, 1.0F);
      if (lights() && i % from_.channels < colors()) value = srgb_of(value);
      const T rounded = static_cast<T>(value * full + 0.5F);
      std::memcpy(to + i * sizeof rounded, &rounded, sizeof rounded);
    }
  }

  Texels write(const std::vector<float>& values) const {
    Texels result{to_, std::vector<std::byte>(values.size() * (to_.bits / 8))};
    if (to_.bits == 32) {
      std::memcpy(result.bytes.data(), values.data(), result.bytes.size());
    } else if (to_.bits == 16) {
      write_integers<std::uint16_t>(values, result.bytes.data());
    } else {
      write_integers<std::uint8_t>(values, result.bytes.data());
    }
    return result;
  }

  Raster from_;
  std::span<const std::byte> texels_;
  Resize how_;
  Raster to_;
  Cutoff cutoff_;
  std::vector<float> plain_, light_;  ///< of each integer: its number, and that of its light
  std::uint64_t shown_ = 0;           ///< texels of the input that are not below the cutoff
};

}  // namespace

Size limited_size(const Raster& raster, const Resize& how) {
  if (!how.needed(raster.width, raster.height)) return {raster.width, raster.height};
  const std::uint32_t longest = std::max(raster.width, raster.height);
  const auto part = [&](std::uint32_t side) {
    const std::uint64_t doubled = std::uint64_t{side} * how.max_side * 2;
    const std::uint64_t rounded = (doubled + longest) / (longest * 2ULL);
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(rounded, 1));
  };
  return {part(raster.width), part(raster.height)};
}

Texels resize(const Raster& raster, std::span<const std::byte> texels, const Size& size,
              const Resize& how) {
  return Resizer(raster, texels, size, how).run();
}

}  // namespace gltfx::codec
