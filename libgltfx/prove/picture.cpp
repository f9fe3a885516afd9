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

double noise_limit(double noise) { return kStep + kNoiseFactor * noise; }

// The greatest difference of a channel.
int pixel_difference(const preview::Picture& a, const preview::Picture& b, std::size_t pixel) {
  int apart = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    apart = std::max(apart, std::abs(static_cast<int>(a.bytes[pixel * a.channels + c]) -
                                     static_cast<int>(b.bytes[pixel * b.channels + c])));
  }
  return apart;
}

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

namespace {

/// A value for each whole square of a picture.
class SquareGrid {
 public:
  explicit SquareGrid(const preview::Picture& picture)
      : width_(picture.width / kSquare),
        height_(picture.height / kSquare),
        values_(std::size_t{width_} * height_) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  double& at(std::uint32_t x, std::uint32_t y) { return values_[std::size_t{y} * width_ + x]; }

  /// Calls `use(value)` for the squares at most `reach` away.
  template <class F>
  void around(std::uint32_t x, std::uint32_t y, std::uint32_t reach, F use) const {
    for (std::uint32_t v = y - std::min(y, reach); v <= y + reach && v < height_; ++v) {
      for (std::uint32_t u = x - std::min(x, reach); u <= x + reach && u < width_; ++u) {
        use(values_[std::size_t{v} * width_ + u]);
      }
    }
  }
  double sum_around(std::uint32_t x, std::uint32_t y, std::uint32_t reach) const {
    double sum = 0;
    around(x, y, reach, [&](double value) { sum += value; });
    return sum;
  }

 private:
  std::uint32_t width_, height_;
  std::vector<double> values_;
};

// Of the means of squares, the greatest difference of a channel.
SquareGrid differences_of(const preview::Picture& a, const preview::Picture& b) {
  SquareGrid grid(a);
  for (std::uint32_t y = 0; y < grid.height(); ++y) {
    for (std::uint32_t x = 0; x < grid.width(); ++x) {
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        const std::size_t first =
            (std::size_t{y} * kSquare * a.width + std::size_t{x} * kSquare) * a.channels + channel;
        grid.at(x, y) = std::max(grid.at(x, y), mean_difference(a, b, first));
      }
    }
  }
  return grid;
}

/// How many pixels of each square are noisy, and how many of these are nevertheless equal.
struct NoisyPixels {
  SquareGrid all, equal;

  NoisyPixels(const preview::Picture& before, const preview::Picture& after,
              const preview::Picture& again)
      : all(before), equal(before) {
    constexpr int kNoisy = 3;  // steps
    for (std::uint32_t y = 0; y < all.height() * kSquare; ++y) {
      for (std::uint32_t x = 0; x < all.width() * kSquare; ++x) {
        const std::size_t pixel = std::size_t{y} * before.width + x;
        if (pixel_difference(before, again, pixel) < kNoisy) continue;
        ++all.at(x / kSquare, y / kSquare);
        if (pixel_difference(before, after, pixel) <= 1) ++equal.at(x / kSquare, y / kSquare);
      }
    }
  }
};

// The square that exceeds its limit most. `limit(x, y)`: of a square that differs by more than a
// step.
template <class F>
SquareDifference greatest_beyond(SquareGrid differences, const F& limit) {
  SquareDifference greatest;
  for (std::uint32_t y = 0; y < differences.height(); ++y) {
    for (std::uint32_t x = 0; x < differences.width(); ++x) {
      SquareDifference each{differences.at(x, y), kStep};
      if (each.visible()) each.limit = limit(x, y);
      if (each.distance - each.limit > greatest.distance - greatest.limit) greatest = each;
    }
  }
  return greatest;
}

}  // namespace

double square_difference(const preview::Picture& a, const preview::Picture& b) {
  return greatest_difference(a, b).distance;
}

SquareDifference greatest_difference(const preview::Picture& before,
                                     const preview::Picture& after) {
  return greatest_beyond(differences_of(before, after), [](auto, auto) { return kStep; });
}

SquareDifference greatest_difference(const preview::Picture& before, const preview::Picture& after,
                                     const preview::Picture& again) {
  constexpr std::uint32_t kReach = 2;  // squares
  constexpr double kFew = 8;           // noisy pixels, too few to tell
  const SquareGrid noise = differences_of(before, again);
  const NoisyPixels noisy(before, after, again);
  return greatest_beyond(differences_of(before, after), [&](std::uint32_t x, std::uint32_t y) {
    const double all = noisy.all.sum_around(x, y, kReach);
    const bool same_numbers = all >= kFew && noisy.equal.sum_around(x, y, kReach) >= all / 2;
    if (same_numbers) return kStep;
    double most = 0;
    noise.around(x, y, 1, [&](double value) { most = std::max(most, value); });
    return noise_limit(most);
  });
}

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
  constexpr float kUnseen = 2;  // steps: rounding, and what is lit a little otherwise
  constexpr float kFull = 32;   // steps that are as orange as any
  constexpr float kPaleness = 0.6F;
  constexpr std::array<float, 3> kMark{226, 74, 0};
  preview::Picture result;
  result.width = a.width;
  result.height = a.height;
  const std::vector<float> luma = luma_of(b);
  for (std::size_t i = 0; i < luma.size(); ++i) {
    const int apart = pixel_difference(a, b, i);
    const float part = std::clamp((static_cast<float>(apart) - kUnseen) / kFull, 0.0F, 1.0F);
    const float pale = luma[i] + (255 - luma[i]) * kPaleness;
    for (const float mark : kMark) {
      result.bytes.push_back(static_cast<std::uint8_t>(pale + (mark - pale) * part));
    }
  }
  return result;
}

}  // namespace gltfx::prove
