// SPDX-License-Identifier: Apache-2.0
/// Triangles of a soup as a surface with values at each of its points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "model/surface_tree.hpp"
#include "prove/soup.hpp"

namespace gltfx::prove {

/// Some triangles of a soup, with a tree.
class Patch {
 public:
  /// Triangles without area are left out.
  Patch(const Soup& soup, const SoupStream& positions, const std::vector<std::uint32_t>& elements)
      : soup_(soup), offset_(positions.offset) {
    // Triangles share the points of the soup if most of these are used.
    const bool shares = soup.vertices() <= 3 * elements.size();
    for (std::uint32_t i = 0; shares && i < soup.vertices(); ++i) add_point(soup.row(i) + offset_);
    elements_.reserve(elements.size());
    normals_.reserve(elements.size());
    corners_.reserve(3 * elements.size());
    for (const std::uint32_t element : elements) add(element, shares);
    if (!is_finite_) return;
    tree_.emplace(model::Surface{points_, corners_});
  }
  Patch(const Patch&) = delete;
  Patch& operator=(const Patch&) = delete;

  std::size_t size() const { return elements_.size(); }
  bool is_finite() const { return is_finite_; }
  /// Precondition: is_finite().
  const model::SurfaceTree& tree() const { return *tree_; }
  model::Vector3 normal(std::size_t triangle) const {
    const std::array<float, 3>& normal = normals_[triangle];
    return {double{normal[0]}, double{normal[1]}, double{normal[2]}};
  }
  const double* row(std::size_t triangle, std::size_t corner) const {
    return soup_.row(soup_.corners[std::size_t{3} * elements_[triangle] + corner]);
  }
  model::Vector3 position(std::size_t triangle, std::size_t corner) const {
    const double* at = row(triangle, corner) + offset_;
    return {at[0], at[1], at[2]};
  }

 private:
  static model::Vector3 between(const model::Vector3& from, const model::Vector3& to) {
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  }

  void add_point(const double* at) {
    points_.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
  }

  void add(std::uint32_t element, bool shares) {
    elements_.push_back(element);
    const std::size_t triangle = elements_.size() - 1;
    const model::Vector3 a = position(triangle, 0), b = position(triangle, 1),
                         c = position(triangle, 2);
    const model::Vector3 ab = between(a, b), ac = between(a, c);
    const model::Vector3 normal = model::cross(ab, ac);
    const double area = std::sqrt(model::dot(normal, normal));
    constexpr double kLargest = std::numeric_limits<float>::max();
    for (const model::Vector3& each : {a, b, c}) {
      for (const double number : each) is_finite_ = is_finite_ && std::fabs(number) <= kLargest;
    }
    constexpr double kFlat = 1e-12;
    if (!is_finite_ || !(area > kFlat * std::max(model::dot(ab, ab), model::dot(ac, ac)))) {
      elements_.pop_back();
      return;
    }
    normals_.push_back({static_cast<float>(normal[0] / area), static_cast<float>(normal[1] / area),
                        static_cast<float>(normal[2] / area)});
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (shares) {
        corners_.push_back(soup_.corners[std::size_t{3} * element + corner]);
      } else {
        corners_.push_back(static_cast<std::uint32_t>(points_.size()));
        add_point(row(triangle, corner) + offset_);
      }
    }
  }

  const Soup& soup_;
  const unsigned offset_;
  bool is_finite_ = true;
  std::vector<std::uint32_t> elements_;
  std::vector<std::array<float, 3>> normals_;
  std::vector<std::array<float, 3>> points_;
  std::vector<std::uint32_t> corners_;
  std::optional<model::SurfaceTree> tree_;
};

/// Rows of streams at any point of a triangle.
class Interpolation {
 public:
  explicit Interpolation(const std::vector<SoupStream>& streams) : streams_(streams) {
    for (const SoupStream& stream : streams) {
      SoupStream wide = stream;
      wide.offset = width_;
      // Each corner may have joints of its own.
      if (is_bound(stream)) wide.width *= 3;
      width_ += wide.width;
      wide_.push_back(std::move(wide));
    }
  }

  const std::vector<SoupStream>& streams() const { return wide_; }

  void at(const Patch& patch, std::size_t triangle, const model::Vector3& weights,
          std::vector<double>& row) const {
    const double* corners[] = {patch.row(triangle, 0), patch.row(triangle, 1),
                               patch.row(triangle, 2)};
    row.assign(width_, 0);
    for (std::size_t s = 0; s < streams_.size(); ++s) {
      const SoupStream& from = streams_[s];
      double* to = row.data() + wide_[s].offset;
      if (is_bound(from)) {
        join(from, corners, weights, to);
        continue;
      }
      for (unsigned k = 0; k < from.width; ++k) {
        const double a = corners[0][from.offset + k], b = corners[1][from.offset + k],
                     c = corners[2][from.offset + k];
        to[k] = a == b && b == c ? a : weights[0] * a + weights[1] * b + weights[2] * c;
      }
      if (from.kind == model::SemanticKind::tangent && from.width == 4) to[3] = to[3] < 0 ? -1 : 1;
    }
  }

 private:
  static bool is_bound(const SoupStream& stream) {
    return stream.joints != json::kNoNode && !stream.of_target;
  }

  // Pairs (joint, weight) of all corners, sorted by joint.
  static void join(const SoupStream& from, const double* const* corners,
                   const model::Vector3& weights, double* to) {
    std::vector<std::pair<double, double>> all;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double* pairs = corners[corner] + from.offset;
      for (unsigned k = 0; k + 1 < from.width; k += 2) {
        if (pairs[k + 1] != 0) all.emplace_back(pairs[k], weights[corner] * pairs[k + 1]);
      }
    }
    std::sort(all.begin(), all.end());
    const double* const begin = to;
    for (const auto& [joint, weight] : all) {
      if (to != begin && *(to - 2) == joint) {
        *(to - 1) += weight;
      } else if (weight != 0) {
        *to++ = joint;
        *to++ = weight;
      }
    }
  }

  const std::vector<SoupStream>& streams_;
  std::vector<SoupStream> wide_;
  unsigned width_ = 0;
};

}  // namespace gltfx::prove
