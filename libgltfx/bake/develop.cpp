// SPDX-License-Identifier: Apache-2.0
#include "bake/develop.hpp"

#include <algorithm>
#include <cmath>

#include "bake/sampler.hpp"
#include "bake/storage.hpp"
#include "bake/tonemap.hpp"

namespace gltfx::bake {
namespace {

Picture blank(const Canvas& canvas, std::uint32_t channels, Numbers numbers) {
  Picture picture;
  picture.width = canvas.width;
  picture.height = canvas.height;
  picture.channels = channels;
  const std::size_t count = canvas.size() * channels;
  if (numbers == Numbers::bytes) {
    picture.bytes.reserve(count);
  } else {
    picture.floats.reserve(count);
  }
  return picture;
}

// Colours that are no light: their bytes are those of a display too, but for the curve of bright
// ones.
void add_color(Picture& picture, const Float3& color, bool encoded, Numbers numbers) {
  for (const float part : color) {
    if (numbers == Numbers::floats) {
      picture.floats.push_back(part);
    } else {
      picture.bytes.push_back(to_byte(encoded ? part : srgb_encode(std::clamp(part, 0.0F, 1.0F))));
    }
  }
}

Float3 material_color(std::uint32_t material) {
  const std::uint32_t bits = mix_bits(material + 1);
  return {static_cast<float>(bits & 0xFFU) / 255.0F,
          static_cast<float>((bits >> 8U) & 0xFFU) / 255.0F,
          static_cast<float>((bits >> 16U) & 0xFFU) / 255.0F};
}

// Nearest and farthest distance of what is seen.
std::pair<float, float> depth_range(const Canvas& canvas) {
  float nearest = 0;
  float farthest = 0;
  for (std::size_t i = 0; i < canvas.depth.size(); ++i) {
    const float z = canvas.depth[i];
    if (canvas.alpha[i] <= 0) continue;
    nearest = nearest == 0 ? z : std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  return {nearest, farthest};
}

Float3 grey(float value) { return {value, value, value}; }

Float3 layer_color(const Canvas& canvas, std::size_t i, Layer layer, Numbers numbers,
                   const std::pair<float, float>& range) {
  if (canvas.alpha[i] <= 0) return {0, 0, 0};
  switch (layer) {
    case Layer::albedo:
      return canvas.albedo[i];
    case Layer::normal: {
      const Float3& n = canvas.normal[i];
      if (numbers == Numbers::floats) return n;
      return {n[0] / 2 + 0.5F, n[1] / 2 + 0.5F, n[2] / 2 + 0.5F};
    }
    case Layer::depth: {
      const float z = canvas.depth[i];
      if (numbers == Numbers::floats) return grey(z);
      const float span = std::max(range.second - range.first, 1e-12F);
      return grey(1 - 0.9F * (z - range.first) / span);
    }
    case Layer::material:
      break;
  }
  const std::uint32_t material = canvas.material[i];
  return numbers == Numbers::floats ? grey(static_cast<float>(material)) : material_color(material);
}

}  // namespace

Picture develop(const Canvas& canvas, bool alpha, Numbers numbers) {
  Picture picture = blank(canvas, alpha ? 4 : 3, numbers);
  for (std::size_t i = 0; i < canvas.size(); ++i) {
    const float covered = alpha ? canvas.alpha[i] : 1;
    const float scale = covered > 0 ? 1 / covered : 1;
    const Float3& from = canvas.radiance[i];
    const Float3 light{from[0] * scale, from[1] * scale, from[2] * scale};
    add_color(picture, numbers == Numbers::bytes ? tone_map(light) : light, false, numbers);
    if (!alpha) continue;
    if (numbers == Numbers::bytes) {
      picture.bytes.push_back(to_byte(covered));
    } else {
      picture.floats.push_back(covered);
    }
  }
  return picture;
}

Picture develop_layer(const Canvas& canvas, Layer layer, Numbers numbers) {
  Picture picture = blank(canvas, 3, numbers);
  const auto range = depth_range(canvas);
  for (std::size_t i = 0; i < canvas.size(); ++i) {
    const Float3 color = layer_color(canvas, i, layer, numbers, range);
    add_color(picture, color, layer != Layer::albedo, numbers);
  }
  return picture;
}

double mean_square_difference(const Picture& a, const Picture& b, const Canvas& canvas_a,
                              const Canvas& canvas_b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < canvas_a.size(); ++i) {
    if (canvas_a.alpha[i] <= 0 && canvas_b.alpha[i] <= 0) continue;
    for (std::size_t c = i * a.channels; c < (i + 1) * a.channels; ++c) {
      const double apart = static_cast<double>(a.bytes[c]) - static_cast<double>(b.bytes[c]);
      sum += apart * apart;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
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

}  // namespace gltfx::bake
