// SPDX-License-Identifier: Apache-2.0
#include "render/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/tonemap.hpp"
#include "shader/sin_cos.hpp"

namespace gltfx::render {
namespace {

// The two texels around a coordinate, and its position between them.
struct Footprint {
  std::uint32_t first = 0, second = 0;
  float share = 0;  // of the second
};

// Repeated ones are at most one image away.
std::uint32_t wrapped(std::int64_t texel, std::int64_t size, Wrap wrap) {
  if (texel >= 0 && texel < size) return static_cast<std::uint32_t>(texel);
  switch (wrap) {
    case Wrap::clamp_to_edge:
      return static_cast<std::uint32_t>(std::clamp<std::int64_t>(texel, 0, size - 1));
    case Wrap::mirrored_repeat: {
      const std::int64_t period = ((texel % (2 * size)) + 2 * size) % (2 * size);
      return static_cast<std::uint32_t>(period < size ? period : 2 * size - 1 - period);
    }
    case Wrap::repeat:
      break;
  }
  return static_cast<std::uint32_t>(texel < 0 ? texel + size : texel - size);
}

Footprint footprint(float coordinate, std::uint32_t size, Wrap wrap, Filter filter) {
  // Beyond that a float cannot distinguish texels.
  constexpr float kFar = 1e9F;
  const auto width = static_cast<float>(size);
  if (!(std::fabs(coordinate * width) < kFar)) return {};
  if (wrap == Wrap::repeat) {  // reduced first, so that less must be wrapped
    coordinate -= static_cast<float>(shader::floor_of(static_cast<double>(coordinate)));
  }
  const float scaled = coordinate * width;
  if (filter == Filter::nearest) {
    const std::uint32_t texel = wrapped(shader::floor_of(static_cast<double>(scaled)), size, wrap);
    return {texel, texel, 0};
  }
  const std::int64_t texel = shader::floor_of(static_cast<double>(scaled - 0.5F));
  return {wrapped(texel, size, wrap), wrapped(texel + 1, size, wrap),
          scaled - 0.5F - static_cast<float>(texel)};
}

float component(const Texture& texture, std::size_t texel, std::uint32_t channel, bool srgb) {
  const std::size_t at = texel * texture.channels + channel;
  if (texture.bits == 8) {
    const auto byte = std::to_integer<std::uint8_t>(texture.pixels[at]);
    return srgb ? srgb_decode_byte(byte) : static_cast<float>(byte) * (1.0F / 255.0F);
  }
  std::uint16_t word = 0;
  std::memcpy(&word, texture.pixels.data() + at * sizeof word, sizeof word);
  const float value = static_cast<float>(word) * (1.0F / 65535.0F);
  return srgb ? srgb_decode(value) : value;
}

// Position of the channels R, G, B, A in a texel; kNone: missing, and the value is 1.
std::uint32_t stored_channel(const Texture& texture, std::uint32_t channel) {
  const bool grey = texture.channels < 3;
  if (channel < 3) return grey ? 0 : channel;
  if (texture.channels == 2) return 1;
  return texture.channels == 4 ? 3 : kNone;
}

float blend(const Texture& texture, const TexelPatch& patch, std::uint32_t channel, bool srgb) {
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (patch.weights[i] > 0) {
      sum += patch.weights[i] * component(texture, patch.texels[i], channel, srgb);
    }
  }
  return sum;
}

// Sixteen fields along each side, magenta and nearly black.
Float4 marked_checker(float u, float v) {
  const auto column = static_cast<std::int64_t>(std::floor(std::fmod(u, 1.0F) * 8.0F));
  const auto row = static_cast<std::int64_t>(std::floor(std::fmod(v, 1.0F) * 8.0F));
  const bool marked = ((column + row) & 1) == 0;
  return marked ? Float4{0.9F, 0.0F, 0.7F, 1.0F} : Float4{0.02F, 0.02F, 0.02F, 1.0F};
}

// Fast path for usual images: RGB or RGBA of 8 bits.
Float4 sample_bytes(const Texture& texture, const TexelPatch& patch, bool srgb) {
  Float4 sum{0, 0, 0, 0};
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(texture.pixels.data());
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint8_t* texel = bytes + patch.texels[i] * texture.channels;
    const float weight = patch.weights[i];
    const float linear = weight * (1.0F / 255.0F);
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += srgb ? weight * srgb_decode_byte(texel[c]) : linear * static_cast<float>(texel[c]);
    }
    sum[3] += texture.channels == 4 ? linear * static_cast<float>(texel[3]) : weight;
  }
  return sum;
}

}  // namespace

TexelPatch patch_at(const Texture& texture, const Float2& uv) {
  const Footprint x = footprint(uv[0], texture.width, texture.wrap_s, texture.filter);
  const Footprint y = footprint(uv[1], texture.height, texture.wrap_t, texture.filter);
  const std::size_t top = std::size_t{y.first} * texture.width;
  const std::size_t low = std::size_t{y.second} * texture.width;
  return {{top + x.first, top + x.second, low + x.first, low + x.second},
          {(1 - x.share) * (1 - y.share), x.share * (1 - y.share), (1 - x.share) * y.share,
           x.share * y.share}};
}

Float4 sample_texture(const Texture& texture, const TexelPatch& patch, bool srgb) {
  if (texture.bits == 8 && texture.channels >= 3) return sample_bytes(texture, patch, srgb);
  Float4 value{1, 1, 1, 1};
  for (std::uint32_t c = 0; c < 4; ++c) {
    const std::uint32_t stored = stored_channel(texture, c);
    if (stored != kNone) value[c] = blend(texture, patch, stored, srgb && c < 3);
  }
  return value;
}

float sample_channel(const Texture& texture, const TexelPatch& patch, std::uint32_t channel) {
  const std::uint32_t stored = stored_channel(texture, channel);
  return stored == kNone ? 1 : blend(texture, patch, stored, false);
}

Float4 sample_texture(const Texture& texture, float u, float v, bool srgb) {
  if (texture.missing) return srgb ? marked_checker(u, v) : Float4{1, 1, 1, 1};
  return sample_texture(texture, patch_at(texture, {u, v}), srgb);
}

float sample_channel(const Texture& texture, float u, float v, std::uint32_t channel) {
  return texture.missing ? 1 : sample_channel(texture, patch_at(texture, {u, v}), channel);
}

}  // namespace gltfx::render
