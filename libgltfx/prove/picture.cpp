// SPDX-License-Identifier: Apache-2.0
#include "prove/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "base/fork.hpp"

namespace gltfx::prove {
namespace {

constexpr std::uint32_t kSquare = 8;  // pixels
// For 150 pairs of seeds on the legacy fixtures, the greatest difference was 2.1 times that of the
// first pair. One step is the limit of rounding.
constexpr double kNoiseFactor = 3;
constexpr double kStep = 1;

// The mean difference of one channel over a square.
double mean_difference(const preview::Picture& a, const preview::Picture& b, std::size_t first) {
  double sum = 0;
  for (std::uint32_t y = 0; y < kSquare; ++y) {
    for (std::uint32_t x = 0; x < kSquare; ++x) {
      const std::size_t at = first + (std::size_t{y} * a.width + x) * a.channels;
      sum += static_cast<double>(a.bytes[at]) - static_cast<double>(b.bytes[at]);
    }
  }
  return std::fabs(sum) / (kSquare * kSquare);
}

// For each pixel, 0 to 255 (Rec. 709).
std::vector<float> luma_of(const preview::Picture& picture) {
  std::vector<float> luma;
  luma.reserve(std::size_t{picture.width} * picture.height);
  for (std::size_t i = 0; i < picture.bytes.size(); i += picture.channels) {
    luma.push_back(0.2126F * static_cast<float>(picture.bytes[i]) +
                   0.7152F * static_cast<float>(picture.bytes[i + 1]) +
                   0.0722F * static_cast<float>(picture.bytes[i + 2]));
  }
  return luma;
}

// Equation 13 of the paper, for the window around a pixel.
double similarity_around(const std::vector<float>& a, const std::vector<float>& b,
                         std::size_t width, std::size_t height, std::size_t pixel) {
  constexpr std::size_t kReach = 5;
  constexpr double kDeviation = 1.5;  // this, kC1 and kC2: from the paper
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

double square_difference(const preview::Picture& a, const preview::Picture& b) {
  double greatest = 0;
  for (std::uint32_t y = 0; y + kSquare <= a.height; y += kSquare) {
    for (std::uint32_t x = 0; x + kSquare <= a.width; x += kSquare) {
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        const std::size_t first = (std::size_t{y} * a.width + x) * a.channels + channel;
        greatest = std::max(greatest, mean_difference(a, b, first));
      }
    }
  }
  return greatest;
}

double noise_limit(double noise) { return kStep + kNoiseFactor * noise; }

void PictureProof::add(preview::Picture drawn, const preview::Picture& again) {
  noise_ = std::max(noise_, square_difference(drawn, again));
  pictures_.push_back(std::move(drawn));
}

std::string PictureProof::find_difference(const std::vector<preview::Picture>& now) const {
  double difference = 0;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    difference = std::max(difference, square_difference(pictures_[i], now[i]));
  }
  const double limit = noise_limit(noise_);
  if (difference <= limit) return {};
  return fmt::format(
      "the picture would change by {:.1f} of 255 steps; noise explains at most {:.1f}", difference,
      limit);
}

double mean_square_difference(const preview::Picture& a, const preview::Picture& b,
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

double structural_similarity(const preview::Picture& a, const preview::Picture& b,
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

preview::Picture difference(const preview::Picture& a, const preview::Picture& b) {
  preview::Picture result;
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

preview::Picture marked_difference(const preview::Picture& a, const preview::Picture& b) {
  constexpr float kUnseen = 3;  // steps, about as much as the noise of a pixel
  constexpr float kFull = 40;   // steps that are as orange as any
  constexpr float kPaleness = 0.6F;
  constexpr std::array<float, 3> kMark{226, 74, 0};
  preview::Picture result;
  result.width = a.width;
  result.height = a.height;
  const std::vector<float> luma = luma_of(b);
  for (std::size_t i = 0; i < luma.size(); ++i) {
    int apart = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      apart = std::max(apart, std::abs(static_cast<int>(a.bytes[i * a.channels + c]) -
                                       static_cast<int>(b.bytes[i * b.channels + c])));
    }
    const float part = std::clamp((static_cast<float>(apart) - kUnseen) / kFull, 0.0F, 1.0F);
    const float pale = luma[i] + (255 - luma[i]) * kPaleness;
    for (const float mark : kMark) {
      result.bytes.push_back(static_cast<std::uint8_t>(pale + (mark - pale) * part));
    }
  }
  return result;
}

}  // namespace gltfx::prove
