// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "codec/client.hpp"
#include "model/image_codec.hpp"
#include "model/node.hpp"
#include "pipeline/scene_images.hpp"
#include "render/environment.hpp"
#include "render/texture.hpp"

namespace gltfx {
namespace {

using model::EnvironmentLight;
using model::Vector3;
using render::EnvironmentImage;

constexpr std::uint32_t kWidestEnvironment = 4096;
constexpr std::size_t kFaces = 6;

// --- Cube maps ---

// Linear radiance of one face: rows from the top.
struct Face {
  std::uint32_t size = 0;
  std::vector<Float3> texels;

  const Float3& texel(std::int64_t x, std::int64_t y) const {
    const std::int64_t most = std::int64_t{size} - 1;
    return texels[static_cast<std::size_t>(std::clamp<std::int64_t>(y, 0, most) * size +
                                           std::clamp<std::int64_t>(x, 0, most))];
  }

  // Between the four texels around a point, from 0 to 1.
  Float3 at(double u, double v) const {
    const double x = u * size - 0.5, y = v * size - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto column = static_cast<std::int64_t>(left), row = static_cast<std::int64_t>(top);
    const double right = x - left, low = y - top;
    Float3 sum{};
    for (std::int64_t i = 0; i < 4; ++i) {
      const bool second = i % 2 == 1, lower = i >= 2;
      const auto weight =
          static_cast<float>((second ? right : 1 - right) * (lower ? low : 1 - low));
      const Float3& from = texel(column + i % 2, row + i / 2);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * from[c];
    }
    return sum;
  }
};
using Cube = std::array<Face, kFaces>;

// How a face is seen from the middle of the cube: what lies ahead, to the right and down. The
// extension mirrors the faces of other cube maps, whose space is left-handed.
struct Facing {
  Vector3 ahead, right, down;
};
constexpr std::array<Facing, kFaces> kFacings{{
    {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
}};

Float3 radiance_from(const Cube& cube, const Vector3& direction) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
  }
  const std::size_t face = 2 * axis + (direction[axis] < 0 ? 1 : 0);
  const Facing& facing = kFacings[face];
  const double ahead = model::dot(direction, facing.ahead);
  return cube[face].at((model::dot(direction, facing.right) / ahead + 1) / 2,
                       (model::dot(direction, facing.down) / ahead + 1) / 2);
}

// RGB by sRGB; where there is alpha, divided by it, which stores values above 1 ("RGBD").
Face face_of(const codec::Image& image) {
  render::Texture texture;
  texture.width = image.width;
  texture.height = image.height;
  texture.channels = image.channels;
  texture.bits = image.bits;
  texture.pixels = image.pixels;
  texture.filter = render::Filter::nearest;
  Face face{image.width, {}};
  face.texels.reserve(static_cast<std::size_t>(image.texels()));
  const auto size = static_cast<float>(image.width);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / size;
      const float v = (static_cast<float>(y) + 0.5F) / size;
      const auto [r, g, b, a] = render::sample_texture(texture, u, v, true);
      const float divisor = std::max(a, 1.0F / 255);
      face.texels.push_back({r / divisor, g / divisor, b / divisor});
    }
  }
  return face;
}

// A face, or half a sentence on why there is none.
std::variant<Face, std::string> read_face(const model::ResourceData& resources, std::uint32_t index,
                                          model::MemoryBudget& budget) {
  const model::ImageData& data = resources.images[index];
  if (!model::is_decodable(data)) return fmt::format("image {} cannot be read", index);
  const image::Header& header = *data.header;
  if (header.width != header.height) return fmt::format("image {} is not square", index);
  const Checked bytes = checked_mul(image::texels_of(header), sizeof(Float3) + 8);
  if (!budget.take(bytes)) return fmt::format("image {} needs too much memory", index);
  codec::ImageRequest request = model::image_request(resources, index);
  request.pixels = true;
  const codec::ImageResult result = SceneImages::shared().decode(codec::Client::shared(), request);
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
    return fmt::format("image {} cannot be decoded ({})", index, printable(error->message));
  }
  const auto& image = std::get<codec::Image>(result);
  if (image.width != image.height || image.pixels.empty()) {
    return fmt::format("image {} is not square", index);
  }
  return face_of(image);
}

std::variant<Cube, std::string> read_cube(const EnvironmentLight& light,
                                          const model::ResourceData& resources,
                                          model::MemoryBudget& budget) {
  Cube cube;
  for (std::size_t i = 0; i < kFaces; ++i) {
    auto face = read_face(resources, light.faces[i], budget);
    if (auto* why = std::get_if<std::string>(&face)) return std::move(*why);
    cube[i] = std::get<Face>(std::move(face));
  }
  return cube;
}

// --- Spherical harmonics ---

std::array<double, 9> harmonics(const Vector3& d) {
  const auto [x, y, z] = d;
  return {0.282095,
          0.488603 * y,
          0.488603 * z,
          0.488603 * x,
          1.092548 * x * y,
          1.092548 * y * z,
          0.315392 * (3 * z * z - 1),
          1.092548 * x * z,
          0.546274 * (x * x - y * y)};
}

// The radiance whose irradiance the coefficients are: that is radiance blurred by a cosine, which
// multiplies each band by a number ("An Efficient Representation for Irradiance Environment Maps").
Float3 radiance_from(const model::Harmonics& irradiance, const Vector3& direction) {
  constexpr double kPi = std::numbers::pi;
  constexpr std::array<double, 9> kBlur{kPi,     2 * kPi / 3, 2 * kPi / 3, 2 * kPi / 3, kPi / 4,
                                        kPi / 4, kPi / 4,     kPi / 4,     kPi / 4};
  const std::array<double, 9> basis = harmonics(direction);
  Float3 sum{};
  for (std::size_t i = 0; i < basis.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += static_cast<float>(basis[i] / kBlur[i]) * irradiance[i][c];
    }
  }
  for (float& value : sum) value = std::max(value, 0.0F);
  return sum;
}

// --- The environment ---

// `radiance`: from a direction, before the rotation of the light.
template <typename Radiance>
EnvironmentImage unrolled(const EnvironmentLight& light, std::uint32_t width,
                          const Radiance& radiance) {
  // The turn back, from the world to the light.
  const auto [x, y, z, w] = light.rotation;
  const model::Affine to_light = model::Affine::from_parts({}, {-x, -y, -z, w}, {1, 1, 1});
  EnvironmentImage image{width, width / 2, {}};
  image.radiance.reserve(std::size_t{image.width} * image.height);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const Vec3d world = render::direction_of(
          {(static_cast<float>(column) + 0.5F) / static_cast<float>(image.width),
           (static_cast<float>(row) + 0.5F) / static_cast<float>(image.height)});
      Float3 texel = radiance(to_light.vector({world.x, world.y, world.z}));
      for (float& value : texel) value = std::min(value * light.intensity, 1e8F);
      image.radiance.push_back(texel);
    }
  }
  return image;
}

// The mean of all channels over the sphere.
double mean_radiance(const EnvironmentImage& image) {
  double sum = 0, weights = 0;
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const double weight = std::sin(std::numbers::pi * (row + 0.5) / image.height);
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const Float3& texel = image.radiance[std::size_t{row} * image.width + column];
      sum += weight * (double{texel[0]} + texel[1] + texel[2]) / 3;
      weights += weight;
    }
  }
  return sum / weights;
}

// One is made from the other, or should be: images of 8 bits without alpha clip the sun.
void note_disagreement(const EnvironmentLight& light, const EnvironmentImage& image,
                       SceneNotes& notes) {
  const auto& [r, g, b] = light.irradiance[0];
  const double stated = (double{r} + g + b) / 3 * 0.282095 / std::numbers::pi * light.intensity;
  const double drawn = mean_radiance(image);
  if (drawn <= 0 || (stated > drawn * 0.8 && stated < drawn * 1.25)) return;
  notes.add(
      fmt::format("The irradiance of the image-based light is {:.2f} times that of its images, "
                  "which are drawn.",
                  stated / drawn));
}

}  // namespace

EnvironmentImage environment_of(const EnvironmentLight& light, const model::ResourceData& resources,
                                model::MemoryBudget& budget, SceneNotes& notes) {
  const auto cube = read_cube(light, resources, budget);
  if (const auto* why = std::get_if<std::string>(&cube)) {
    notes.add(fmt::format("The image-based light is drawn by its irradiance alone: {}.", *why));
    constexpr std::uint32_t kSmooth = 64;
    return unrolled(light, kSmooth,
                    [&](const Vector3& d) { return radiance_from(light.irradiance, d); });
  }
  const Cube& faces = std::get<Cube>(cube);
  const std::uint32_t width =
      std::clamp<std::uint32_t>(faces.front().size, 8, kWidestEnvironment / 4) * 4;
  EnvironmentImage image =
      unrolled(light, width, [&](const Vector3& d) { return radiance_from(faces, d); });
  note_disagreement(light, image, notes);
  return image;
}

}  // namespace gltfx
