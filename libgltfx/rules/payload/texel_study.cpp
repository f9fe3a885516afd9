// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/texel_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gltfx::validate {
namespace {

constexpr std::uint32_t kSide = 8;  // of a square, in cells
// Widths of a cell in texels: small ones see fine relief, large ones what noise and lossy coding
// leave of it.
constexpr std::array<std::uint32_t, 3> kCells{1, 2, 4};

// The first three channels of texels as vectors.
template <class T>
class TexelVectors {
 public:
  explicit TexelVectors(const codec::Image& image)
      : values_(reinterpret_cast<const T*>(image.pixels.data())),
        width_(image.width),
        channels_(image.channels) {}

  std::array<float, 3> at(std::uint32_t x, std::uint32_t y) const {
    constexpr float kScale = 2.0F / static_cast<float>(std::numeric_limits<T>::max());
    const T* texel = values_ + (std::size_t{y} * width_ + x) * channels_;
    return {static_cast<float>(texel[0]) * kScale - 1, static_cast<float>(texel[1]) * kScale - 1,
            static_cast<float>(texel[2]) * kScale - 1};
  }

 private:
  const T* values_;
  std::size_t width_, channels_;
};

// Slopes to the right, and, if green points up, down the image.
struct SquareSlopes {
  std::array<std::array<float, kSide>, kSide> right{}, down{};  // by row
};

// How the changes of the slopes across agree: -1 to 1, and 0 if the square is flat or has edges
// along its sides only.
double agreement(const SquareSlopes& slopes, double texels) {
  // Of the squares: 8 bits have an error of a fortieth of it.
  constexpr double kNoise = 4e-4;
  double both = 0, of_right = 0, of_down = 0;
  for (std::size_t y = 1; y + 1 < kSide; ++y) {
    for (std::size_t x = 1; x + 1 < kSide; ++x) {
      const double a = static_cast<double>(slopes.right[y + 1][x] - slopes.right[y - 1][x]);
      const double b = static_cast<double>(slopes.down[y][x + 1] - slopes.down[y][x - 1]);
      both += a * b;
      of_right += a * a;
      of_down += b * b;
    }
  }
  // Slopes are sums over the texels of a cell.
  constexpr double kCount = (kSide - 2) * (kSide - 2);
  const double least = kNoise * kCount * texels * texels;
  if (of_right < least || of_down < least) return 0;
  return both / std::sqrt(of_right * of_down);
}

constexpr float kSteepest = 0.1F;  // of Z: slopes beyond are rounded too coarsely

// Adds a vector to the slopes of a cell, if it has any.
void add_slopes(const std::array<float, 3>& vector, SlopeStudy& study, float& right, float& down,
                bool& steep) {
  const auto [x, y, z] = vector;
  const float length = std::sqrt(x * x + y * y + z * z);
  constexpr float kNotUnit = 0.1F;
  ++study.seen;
  study.unit += z > 0 && std::abs(length - 1) < kNotUnit ? 1 : 0;
  study.mean_x += static_cast<double>(x);
  study.mean_y += static_cast<double>(y);
  steep = steep || z < kSteepest;
  right -= x / std::max(z, kSteepest);
  down += y / std::max(z, kSteepest);
}

// `cell`: the width of what is averaged, in texels.
template <class T>
void study_square(const TexelVectors<T>& vectors, std::uint32_t left, std::uint32_t top,
                  std::uint32_t cell, SlopeStudy& study) {
  SquareSlopes slopes;
  bool steep = false;
  for (std::uint32_t y = 0; y < kSide * cell; ++y) {
    for (std::uint32_t x = 0; x < kSide * cell; ++x) {
      add_slopes(vectors.at(left + x, top + y), study, slopes.right[y / cell][x / cell],
                 slopes.down[y / cell][x / cell], steep);
    }
  }
  const double agrees = steep ? 0 : agreement(slopes, cell * cell);
  constexpr double kClear = 0.5;
  study.up += agrees > kClear ? 1 : 0;
  study.down += agrees < -kClear ? 1 : 0;
  study.rough += agrees != 0 && std::abs(agrees) <= kClear ? 1 : 0;
}

template <class T>
SlopeStudy slopes_of(const codec::Image& image) {
  SlopeStudy study;
  const TexelVectors<T> vectors(image);
  constexpr std::uint32_t kMostSquares = 128;  // in a row, and in a column
  for (const std::uint32_t cell : kCells) {
    const std::uint32_t side = kSide * cell;
    const std::uint32_t columns = image.width / side;
    const std::uint32_t rows = image.height / side;
    const std::uint32_t step = (std::max(columns, rows) + kMostSquares - 1) / kMostSquares;
    for (std::uint32_t y = 0; y < rows; y += step) {
      for (std::uint32_t x = 0; x < columns; x += step) {
        study_square(vectors, x * side, y * side, cell, study);
      }
    }
  }
  const auto seen = static_cast<double>(std::max<std::uint64_t>(study.seen, 1));
  study.mean_x /= seen;
  study.mean_y /= seen;
  return study;
}

template <class T>
AlphaStudy alpha_of(const codec::Image& image) {
  const std::uint64_t full = std::numeric_limits<T>::max();
  const T* alpha = reinterpret_cast<const T*>(image.pixels.data()) + (image.channels - 1);
  const auto words = static_cast<std::size_t>((image.texels() + 63) / 64);
  AlphaStudy study{std::vector<std::uint64_t>(words), std::vector<std::uint64_t>(words)};
  for (std::uint64_t i = 0; i < image.texels(); ++i, alpha += image.channels) {
    const std::uint64_t value = *alpha * std::uint64_t{255};
    const std::uint64_t bit = std::uint64_t{1} << i % 64;
    const auto word = static_cast<std::size_t>(i / 64);
    if (value < full * 250) study.not_opaque[word] |= bit;
    if (value >= full * 16 && value < full * 240) study.between[word] |= bit;
  }
  return study;
}

}  // namespace

SlopeStudy study_slopes(const codec::Image& image) {
  return image.bits == 16 ? slopes_of<std::uint16_t>(image) : slopes_of<std::uint8_t>(image);
}

AlphaStudy study_alpha(const codec::Image& image) {
  return image.bits == 16 ? alpha_of<std::uint16_t>(image) : alpha_of<std::uint8_t>(image);
}

}  // namespace gltfx::validate
