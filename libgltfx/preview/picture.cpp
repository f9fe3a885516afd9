// SPDX-License-Identifier: Apache-2.0
#include "preview/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/fork.hpp"
#include "base/packed.hpp"
#include "render/sampler.hpp"
#include "render/tonemap.hpp"

namespace gltfx::preview {
namespace {

Picture blank(const render::Framebuffer& buffer, std::uint32_t channels, PixelType type) {
  Picture picture;
  picture.width = buffer.width;
  picture.height = buffer.height;
  picture.channels = channels;
  const std::size_t count = buffer.size() * channels;
  if (type == PixelType::bytes) {
    picture.bytes.reserve(count);
  } else {
    picture.floats.reserve(count);
  }
  return picture;
}

// Adds a colour without tone mapping; `encoded`: without conversion to sRGB.
void add_color(Picture& picture, const Float3& color, bool encoded, PixelType type) {
  for (const float part : color) {
    if (type == PixelType::floats) {
      picture.floats.push_back(part);
    } else {
      picture.bytes.push_back(
          render::to_byte(encoded ? part : render::srgb_encode(std::clamp(part, 0.0F, 1.0F))));
    }
  }
}

Float3 material_color(std::uint32_t material) {
  const std::uint32_t bits = render::mix_bits(material + 1);
  return {static_cast<float>(bits & 0xFFU) / 255.0F,
          static_cast<float>((bits >> 8U) & 0xFFU) / 255.0F,
          static_cast<float>((bits >> 16U) & 0xFFU) / 255.0F};
}

// Nearest and farthest distance of visible surfaces.
std::pair<float, float> depth_range(const render::Framebuffer& buffer) {
  float nearest = 0;
  float farthest = 0;
  for (std::size_t i = 0; i < buffer.depth.size(); ++i) {
    const float z = buffer.depth[i];
    if (buffer.alpha[i] <= 0) continue;
    nearest = nearest == 0 ? z : std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  return {nearest, farthest};
}

Float3 grey(float value) { return {value, value, value}; }

Float3 layer_color(const render::Framebuffer& buffer, std::size_t i, Layer layer, PixelType type,
                   const std::pair<float, float>& range) {
  if (buffer.alpha[i] <= 0) return {0, 0, 0};
  switch (layer) {
    case Layer::albedo:
      return buffer.albedo[i];
    case Layer::normal: {
      const Float3& n = buffer.normal[i];
      if (type == PixelType::floats) return n;
      return {n[0] / 2 + 0.5F, n[1] / 2 + 0.5F, n[2] / 2 + 0.5F};
    }
    case Layer::depth: {
      const float z = buffer.depth[i];
      if (type == PixelType::floats) return grey(z);
      const float span = std::max(range.second - range.first, 1e-12F);
      return grey(1 - 0.9F * (z - range.first) / span);
    }
    case Layer::material:
      break;
  }
  const std::uint32_t material = buffer.material[i];
  return type == PixelType::floats ? grey(static_cast<float>(material)) : material_color(material);
}

// CIE L* of a pixel of the finished picture.
double lightness(const Float3& radiance) {
  const double y = std::clamp(luminance(to_vec(render::tone_map(radiance))), 0.0, 1.0);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27;
}

// Luma of each pixel, 0 to 255 (Rec. 709).
std::vector<float> luma_of(const Picture& picture) {
  std::vector<float> luma;
  luma.reserve(std::size_t{picture.width} * picture.height);
  for (std::size_t i = 0; i < picture.bytes.size(); i += picture.channels) {
    luma.push_back(0.2126F * static_cast<float>(picture.bytes[i]) +
                   0.7152F * static_cast<float>(picture.bytes[i + 1]) +
                   0.0722F * static_cast<float>(picture.bytes[i + 2]));
  }
  return luma;
}

// Equation 13 of the paper, in the window around a pixel.
double similarity_around(const std::vector<float>& a, const std::vector<float>& b,
                         std::size_t width, std::size_t height, std::size_t pixel) {
  constexpr std::size_t kReach = 5;
  constexpr double kDeviation = 1.5;  // this, kC1 and kC2: of the paper
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255;
  constexpr double kC2 = 0.03 * 255 * 0.03 * 255;
  static constinit MadeOnce<std::array<double, kReach + 1>> made;
  const auto& kernel = made.get([] {
    std::array<double, kReach + 1> weights{};
    for (std::size_t i = 0; i <= kReach; ++i) {
      const double away = static_cast<double>(i) / kDeviation;
      weights[i] = std::exp(-away * away / 2);
    }
    return weights;
  });
  const std::size_t x = pixel % width;
  const std::size_t y = pixel / width;
  const auto first = [](std::size_t at) { return at < kReach ? 0 : at - kReach; };
  const auto apart = [](std::size_t p, std::size_t q) { return p < q ? q - p : p - q; };
  double weights = 0, sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (std::size_t v = first(y); v < std::min(y + kReach + 1, height); ++v) {
    for (std::size_t u = first(x); u < std::min(x + kReach + 1, width); ++u) {
      const double weight = kernel[apart(u, x)] * kernel[apart(v, y)];
      const auto p = static_cast<double>(a[v * width + u]);
      const auto q = static_cast<double>(b[v * width + u]);
      weights += weight;
      sum_a += weight * p;
      sum_b += weight * q;
      sum_aa += weight * p * p;
      sum_bb += weight * q * q;
      sum_ab += weight * p * q;
    }
  }
  const double mean_a = sum_a / weights;
  const double mean_b = sum_b / weights;
  const double variance_a = sum_aa / weights - mean_a * mean_a;
  const double variance_b = sum_bb / weights - mean_b * mean_b;
  const double covariance = sum_ab / weights - mean_a * mean_b;
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (variance_a + variance_b + kC2));
}

}  // namespace

Picture tone_mapped_picture(const render::Framebuffer& buffer, bool alpha, PixelType type) {
  Picture picture = blank(buffer, alpha ? 4 : 3, type);
  for (std::size_t i = 0; i < buffer.size(); ++i) {
    const float covered = alpha ? buffer.alpha[i] : 1;
    const float scale = covered > 0 ? 1 / covered : 1;
    const Float3& from = buffer.radiance[i];
    const Float3 light{from[0] * scale, from[1] * scale, from[2] * scale};
    add_color(picture, type == PixelType::bytes ? render::tone_map(light) : light, false, type);
    if (!alpha) continue;
    if (type == PixelType::bytes) {
      picture.bytes.push_back(render::to_byte(covered));
    } else {
      picture.floats.push_back(covered);
    }
  }
  return picture;
}

Picture layer_picture(const render::Framebuffer& buffer, Layer layer, PixelType type) {
  Picture picture = blank(buffer, 3, type);
  const auto range = depth_range(buffer);
  for (std::size_t i = 0; i < buffer.size(); ++i) {
    const Float3 color = layer_color(buffer, i, layer, type, range);
    add_color(picture, color, layer != Layer::albedo, type);
  }
  return picture;
}

double edge_contrast(const render::Framebuffer& buffer) {
  double sum = 0;
  std::size_t count = 0;
  // Pixels on the edge itself are mixed: their neighbours on either side are compared.
  const auto compare = [&](std::size_t i, std::size_t step) {
    const float before = buffer.alpha[i - step];
    const float after = buffer.alpha[i + step];
    if (std::min(before, after) > 0.01F || std::max(before, after) < 0.99F) return;
    sum += std::fabs(lightness(buffer.radiance[i - step]) - lightness(buffer.radiance[i + step]));
    ++count;
  };
  for (std::size_t y = 0; y < buffer.height; ++y) {
    for (std::size_t x = 0; x < buffer.width; ++x) {
      const std::size_t i = y * buffer.width + x;
      if (x > 0 && x + 1 < buffer.width) compare(i, 1);
      if (y > 0 && y + 1 < buffer.height) compare(i, buffer.width);
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 100.0;
}

double mean_square_difference(const Picture& a, const Picture& b,
                              const render::Framebuffer& buffer_a,
                              const render::Framebuffer& buffer_b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < buffer_a.size(); ++i) {
    if (buffer_a.alpha[i] <= 0 && buffer_b.alpha[i] <= 0) continue;
    for (std::size_t c = i * a.channels; c < (i + 1) * a.channels; ++c) {
      const double apart = static_cast<double>(a.bytes[c]) - static_cast<double>(b.bytes[c]);
      sum += apart * apart;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double structural_similarity(const Picture& a, const Picture& b,
                             const render::Framebuffer& buffer_a,
                             const render::Framebuffer& buffer_b) {
  const std::vector<float> first = luma_of(a);
  const std::vector<float> second = luma_of(b);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (buffer_a.alpha[i] <= 0 && buffer_b.alpha[i] <= 0) continue;
    sum += similarity_around(first, second, a.width, a.height, i);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

Picture difference(const Picture& a, const Picture& b) {
  Picture result;
  result.width = a.width;
  result.height = a.height;
  for (std::size_t i = 0; i < std::size_t{a.width} * a.height; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int apart = static_cast<int>(a.bytes[i * a.channels + c]) -
                        static_cast<int>(b.bytes[i * b.channels + c]);
      result.bytes.push_back(static_cast<std::uint8_t>(std::clamp(128 + 4 * apart, 0, 255)));
    }
  }
  return result;
}

}  // namespace gltfx::preview
