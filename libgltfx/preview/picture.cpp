// SPDX-License-Identifier: Apache-2.0
#include "preview/picture.hpp"

#include <algorithm>
#include <cmath>

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

Float3 over(Float3 front, float covered, const Float3& behind) {
  for (std::size_t c = 0; c < 3; ++c) front[c] = front[c] * covered + behind[c] * (1 - covered);
  return front;
}

// CIE L* of a pixel of the finished picture.
double lightness(const Float3& radiance, render::ToneCurve curve) {
  const double y = std::clamp(luminance(to_vec(render::tone_map(radiance, curve))), 0.0, 1.0);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27;
}

}  // namespace

Picture tone_mapped_picture(const render::Framebuffer& buffer, bool alpha, PixelType type,
                            const Finish& finish) {
  Picture picture = blank(buffer, alpha ? 4 : 3, type);
  for (std::size_t i = 0; i < buffer.size(); ++i) {
    const float covered = alpha || finish.color ? buffer.alpha[i] : 1;
    const float scale = covered > 0 ? 1 / covered : 1;
    const Float3& from = buffer.radiance[i];
    Float3 light{from[0] * scale, from[1] * scale, from[2] * scale};
    if (type == PixelType::bytes) light = render::tone_map(light, finish.curve);
    if (finish.color) light = over(light, covered, *finish.color);
    add_color(picture, light, false, type);
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

double edge_contrast(const render::Framebuffer& buffer, render::ToneCurve curve) {
  double sum = 0;
  std::size_t count = 0;
  // Pixels on the edge itself are mixed: their neighbours on either side are compared.
  const auto compare = [&](std::size_t i, std::size_t step) {
    const float before = buffer.alpha[i - step];
    const float after = buffer.alpha[i + step];
    if (std::min(before, after) > 0.01F || std::max(before, after) < 0.99F) return;
    sum += std::fabs(lightness(buffer.radiance[i - step], curve) -
                     lightness(buffer.radiance[i + step], curve));
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

}  // namespace gltfx::preview
