// SPDX-License-Identifier: Apache-2.0
#include "render/sky_samples.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "render/sampler.hpp"
#include "shader/directions.hpp"

namespace gltfx::render {
namespace {

// The number of directions for so many samples per pixel: up to 9 MB.
std::uint32_t direction_count(std::uint32_t samples) {
  constexpr std::uint32_t kForEachSample = 16;
  return kForEachSample * std::bit_ceil(std::clamp(samples, 256U, 16384U));
}

// Real spherical harmonics, with the constants of R. Ramamoorthi and P. Hanrahan, An Efficient
// Representation for Irradiance Environment Maps (2001).
std::array<double, 9> harmonics_at(const Vec3d& d) {
  return {0.282095,
          0.488603 * d.x,
          0.488603 * d.y,
          0.488603 * d.z,
          1.092548 * d.x * d.y,
          1.092548 * d.y * d.z,
          1.092548 * d.x * d.z,
          0.315392 * (3 * d.z * d.z - 1),
          0.546274 * (d.x * d.x - d.y * d.y)};
}

template <class T>
T at_normal(const std::array<T, 9>& coefficients, const Vec3d& normal) {
  const auto harmonics = harmonics_at(normal);
  T sum{};
  for (std::size_t h = 0; h < harmonics.size(); ++h) sum += coefficients[h] * harmonics[h];
  return sum;
}

// One of four lanes, in proportion to its weight; `rest`, below their sum, loses the weights before
// it. Branch-free, because the choice is unpredictable.
std::size_t choose_lane(const std::array<float, 4>& weights, float& rest) {
  const float two = weights[0] + weights[1];
  const std::array<float, 4> before{0, weights[0], two, two + weights[2]};
  const std::size_t chosen =
      (rest >= before[1] ? 1U : 0U) + (rest >= before[2] ? 1U : 0U) + (rest >= before[3] ? 1U : 0U);
  rest -= before[chosen];
  return chosen;
}

// The factor from a harmonic of radiance to that of irradiance.
double cosine_share(std::size_t harmonic) {
  return harmonic == 0 ? shader::pi : harmonic < 4 ? 2 * shader::pi / 3 : shader::pi / 4;
}

// The place of a point along Hilbert's curve through cells as fine as the curve's last level.
std::uint32_t place_along_curve(const Float2& point) {
  constexpr std::uint32_t kCells = 1U << 12U;  // of a side
  auto x = static_cast<std::uint32_t>(point[0] * kCells);
  auto y = static_cast<std::uint32_t>(point[1] * kCells);
  std::uint32_t place = 0;
  for (std::uint32_t side = kCells / 2; side > 0; side /= 2) {
    const bool right = (x & side) != 0;
    const bool upper = (y & side) != 0;
    place = 4 * place + (right ? (upper ? 2U : 3U) : (upper ? 1U : 0U));
    if (upper) continue;
    if (right) {
      x = ~x;
      y = ~y;
    }
    std::swap(x, y);
  }
  return place;
}

// Scrambled Sobol' points in the order of that curve, and their places.
std::vector<std::pair<std::uint32_t, Float2>> points_along_curve(std::uint32_t count) {
  constexpr std::uint32_t kSeed = 0x5bd1e995U;
  std::vector<std::pair<std::uint32_t, Float2>> points;
  points.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t second = scramble_reversed(second_sobol_reversed(i), mix_bits(kSeed));
    const Float2 point{unit_float(reverse_bits(scramble_reversed(i, kSeed))),
                       unit_float(reverse_bits(second))};
    points.emplace_back(place_along_curve(point), point);
  }
  std::sort(points.begin(), points.end());
  return points;
}

}  // namespace

SkySamples::SkySamples(const Environment& environment, std::uint32_t samples)
    : blocks_(direction_count(samples) / kBlock), lights_(blocks_.size() * kBlock) {
  const auto points = points_along_curve(direction_count(samples));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const EnvironmentSample sample = environment.sample(points[i].second);
    // Each block has a direction of each of so many parts of the curve.
    const std::size_t number = i % blocks_.size();
    const std::size_t part = i / blocks_.size();
    // choose() goes through the first lanes of all rows, then through the second, and so on.
    const std::size_t lane = part / kLanes + part % kLanes * kLanes;
    Block& block = blocks_[number];
    block.x[lane] = static_cast<float>(sample.direction.x);
    block.y[lane] = static_cast<float>(sample.direction.y);
    block.z[lane] = static_cast<float>(sample.direction.z);
    const double brightness = luminance(sample.radiance) * sample.scale;
    block.brightness[lane] = std::isfinite(brightness) ? static_cast<float>(brightness) : 0.0F;
    lights_[number * kBlock + lane] = {to_float3(sample.radiance), static_cast<float>(sample.pdf)};
    const auto harmonics = harmonics_at(sample.direction);
    for (std::size_t h = 0; h < harmonics.size(); ++h) {
      harmonics_[h] += sample.radiance * (sample.scale * harmonics[h] * cosine_share(h));
    }
  }
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    harmonics_[h] = harmonics_[h] / static_cast<double>(lights_.size());
    luminances_[h] = luminance(harmonics_[h]);
  }
}

EnvironmentSample SkySamples::choose(const Receiver& receiver, const Float2& random) const {
  const auto number = static_cast<std::size_t>(random[0] * static_cast<float>(blocks_.size()));
  const Block& block = blocks_[number];
  const Float3 n = to_float3(receiver.normal);
  const auto behind = static_cast<float>(-receiver.behind);
  const float front = 1 + behind;
  Numbers weights;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const float cosine = n[0] * block.x[i] + n[1] * block.y[i] + n[2] * block.z[i];
    weights[i] = cosine * (cosine > 0 ? front : behind) * block.brightness[i];
  }
  std::array<float, kLanes> sums{};
  for (std::size_t i = 0; i < kBlock; ++i) sums[i % kLanes] += weights[i];
  const float total = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  if (!(total > 0)) return {};

  float rest = random[1] * total;
  const std::size_t lane = choose_lane(sums, rest);
  const std::size_t row = choose_lane({weights[lane], weights[lane + kLanes],
                                       weights[lane + 2 * kLanes], weights[lane + 3 * kLanes]},
                                      rest);
  const std::size_t chosen = lane + row * kLanes;
  if (!(weights[chosen] > 0)) return {};

  const Light& light = lights_[number * kBlock + chosen];
  const Vec3d direction(block.x[chosen], block.y[chosen], block.z[chosen]);
  const double density = static_cast<double>(light.pdf) * static_cast<double>(weights[chosen]);
  return {direction, to_vec(light.radiance), static_cast<double>(light.pdf),
          static_cast<double>(total) / (density * kBlock)};
}

SkyPdf SkySamples::pdf(const Receiver& receiver, std::uint32_t count) const {
  const auto irradiance_of = [&](const Vec3d& normal) {
    return std::max(at_normal(luminances_, normal), 0.0);
  };
  const double behind = receiver.behind > 0 ? receiver.behind * irradiance_of(-receiver.normal) : 0;
  const double light = (1 - receiver.behind) * irradiance_of(receiver.normal) + behind;
  return {receiver, light > 0 ? count / light : 0};
}

Rgb SkySamples::irradiance(const Vec3d& normal) const {
  const Rgb sum = at_normal(harmonics_, normal);
  return {std::max(sum.x, 0.0), std::max(sum.y, 0.0), std::max(sum.z, 0.0)};
}

}  // namespace gltfx::render
