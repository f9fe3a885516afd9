// SPDX-License-Identifier: Apache-2.0
#include "prove/soup_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "prove/surface_patch.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;
using model::Vector3;

constexpr double kNever = std::numeric_limits<double>::infinity();

Vector3 less(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double length_of(const Vector3& a) { return std::sqrt(model::dot(a, a)); }

/// A convex part of a triangle, by the weights of its corners.
using Piece = std::vector<Vector3>;

/// Covers each triangle of one patch with those of the other one.
class SurfaceMatch {
 public:
  /// `work`: pieces that may be looked at.
  SurfaceMatch(const Patch& from, const Patch& to, const Interpolation& values,
               const SoupScale& scale, std::uint64_t& work, SurfaceCloseness& found)
      : from_(from),
        to_(to),
        values_(values),
        scale_(scale),
        work_(work),
        found_(found),
        least_cosine_(std::cos(scale.facing * std::numbers::pi / 180)) {
    for (std::size_t s = 0; s < values.streams().size(); ++s) {
      const SoupStream& stream = values.streams()[s];
      if (stream.kind == SemanticKind::position && !stream.of_target && stream.set == 0) place_ = s;
      if (stream.kind == SemanticKind::normal && !stream.of_target) least_cosine_ = 1e-9;
    }
  }

  bool run() {
    for (std::size_t i = 0; i < from_.size(); ++i) {
      if (!match_triangle(i)) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t kMostNear = 64;  ///< triangles that are tried for a point

  /// A triangle that is near a point, and the distances of all streams there.
  struct Near {
    double worst = kNever;  ///< the greatest part of a limit
    bool is_over = false;   ///< the point lies over the triangle, not beside it
    std::uint32_t triangle = 0;
    std::vector<double> distances;
  };

  bool match_triangle(std::size_t triangle) {
    std::vector<Piece> open{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    while (!open.empty()) {
      Piece piece = std::move(open.back());
      open.pop_back();
      if (work_ == 0) return false;
      --work_;
      if (!match_piece(triangle, std::move(piece), open)) return false;
    }
    return true;
  }

  // Takes the part that lies over the triangle below the middle; what is left is opened.
  bool match_piece(std::size_t triangle, Piece piece, std::vector<Piece>& open) {
    const Vector3 middle = middle_of(piece);
    const Near near = nearest_to(triangle, middle);
    if (!(near.worst <= 1)) return false;
    if (!near.is_over) return match_beside(triangle, piece, near, open);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      Piece inside, outside;
      cut(triangle, piece, near.triangle, edge, inside, outside);
      if (outside.size() >= 3) open.push_back(std::move(outside));
      piece = std::move(inside);
    }
    for (const Vector3& corner : piece) {
      const Near there = try_point(triangle, corner, near.triangle);
      if (!(there.worst <= 1)) return false;
      if (!take(there.distances, position_of(triangle, corner), 0)) return false;
    }
    return true;
  }

  // Beside all triangles, but near: at a gap. Halved until it is small.
  bool match_beside(std::size_t triangle, const Piece& piece, const Near& near,
                    std::vector<Piece>& open) {
    const Vector3 at = position_of(triangle, middle_of(piece));
    double radius = 0;
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const double away = length_of(less(position_of(triangle, piece[i]), at));
      if (away > radius) farthest = i;
      radius = std::max(radius, away);
    }
    if (2 * radius <= scale_.position / 2) return take(near.distances, at, radius);
    // Fans from the middle of the edge after the farthest corner.
    const std::size_t count = piece.size();
    const Vector3& a = piece[farthest];
    const Vector3& b = piece[(farthest + 1) % count];
    const Vector3 between{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    for (std::size_t i = 1; i < count; ++i) {
      open.push_back({between, piece[(farthest + i) % count], piece[(farthest + i + 1) % count]});
    }
    return true;
  }

  static Vector3 middle_of(const Piece& piece) {
    Vector3 sum{};
    for (const Vector3& corner : piece) {
      for (std::size_t i = 0; i < 3; ++i) sum[i] += corner[i] / static_cast<double>(piece.size());
    }
    return sum;
  }

  Vector3 position_of(std::size_t triangle, const Vector3& weights) const {
    Vector3 sum{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 corner = from_.position(triangle, k);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += weights[k] * corner[i];
    }
    return sum;
  }

  // How far a point lies inside of an edge of a triangle of the other patch, along its face.
  double height_over(std::size_t triangle, std::size_t edge, const Vector3& point) const {
    const Vector3 begin = to_.position(triangle, edge);
    const Vector3 along = less(to_.position(triangle, (edge + 1) % 3), begin);
    const Vector3 inward = model::cross(to_.normal(triangle), along);
    return model::dot(inward, less(point, begin)) / length_of(along) + scale_.position / 100;
  }

  // At an edge of a triangle of the other patch, which is a little wider for rounding.
  void cut(std::size_t triangle, const Piece& piece, std::size_t other, std::size_t edge,
           Piece& inside, Piece& outside) const {
    std::vector<double> heights;
    for (const Vector3& corner : piece) {
      heights.push_back(height_over(other, edge, position_of(triangle, corner)));
    }
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const std::size_t next = (i + 1) % piece.size();
      if (heights[i] >= 0) inside.push_back(piece[i]);
      if (heights[i] <= 0) outside.push_back(piece[i]);
      if ((heights[i] > 0 && heights[next] < 0) || (heights[i] < 0 && heights[next] > 0)) {
        const double part = heights[i] / (heights[i] - heights[next]);
        Vector3 between{};
        for (std::size_t k = 0; k < 3; ++k)
          between[k] = piece[i][k] + part * (piece[next][k] - piece[i][k]);
        inside.push_back(between);
        outside.push_back(between);
      }
    }
    const bool any = std::any_of(heights.begin(), heights.end(), [](double h) { return h < 0; });
    if (!any) outside.clear();
  }

  // Of triangles that face the same way: the one with the most similar values.
  Near nearest_to(std::size_t triangle, const Vector3& weights) {
    const Vector3 at = position_of(triangle, weights);
    const Vector3 facing = from_.normal(triangle);
    near_.clear();
    to_.tree().each_near(at, scale_.position * 1.001, [&](std::uint32_t other) {
      if (model::dot(facing, to_.normal(other)) >= least_cosine_) near_.push_back(other);
      return near_.size() < kMostNear;
    });
    Near best;
    for (const std::uint32_t other : near_) {
      Near tried = try_point(triangle, weights, other);
      if (!(tried.worst <= 1) && best.worst <= 1) continue;
      tried.is_over = true;
      for (std::size_t edge = 0; edge < 3; ++edge) {
        tried.is_over = tried.is_over && height_over(other, edge, at) >= 0;
      }
      const bool is_better = tried.is_over == best.is_over || !(best.worst <= 1)
                                 ? tried.worst < best.worst
                                 : tried.is_over;
      if (is_better) best = std::move(tried);
    }
    return best;
  }

  Near try_point(std::size_t triangle, const Vector3& at, std::uint32_t other) {
    values_.at(from_, triangle, at, here_);
    const Vector3 weights =
        model::nearest_weights(position_of(triangle, at), to_.position(other, 0),
                               to_.position(other, 1), to_.position(other, 2));
    values_.at(to_, other, weights, there_);
    Near tried;
    tried.worst = 0;
    tried.triangle = other;
    for (std::size_t s = 0; s < values_.streams().size(); ++s) {
      const SoupStream& stream = values_.streams()[s];
      const double limit = scale_.limits[s];
      double distance = stream_distance(stream, here_.data(), there_.data(), scale_);
      if (is_rounding(stream, here_, distance)) distance = 0;
      tried.distances.push_back(distance);
      const double part = distance == 0 ? 0 : limit > 0 ? distance / limit : kNever;
      tried.worst = std::max(tried.worst, part);
    }
    return tried;
  }

  // Of values that interpolation makes.
  static bool is_rounding(const SoupStream& stream, const std::vector<double>& row,
                          double distance) {
    const bool plain = stream.kind == SemanticKind::application ||
                       stream.kind == SemanticKind::invalid || stream.kind == SemanticKind::color;
    double greatest = 0;
    for (unsigned k = 0; plain && k < stream.width; ++k)
      greatest = std::max(greatest, std::fabs(row[stream.offset + k]));
    constexpr double kRounding = 1e-9;
    return distance <= kRounding * greatest;
  }

  // `radius`: up to where the distance of positions is not known.
  bool take(const std::vector<double>& distances, const Vector3& at, double radius) {
    for (std::size_t s = 0; s < distances.size(); ++s) {
      const double distance = distances[s] + (s == place_ ? radius : 0);
      if (s == place_ && distance > scale_.limits[s]) return false;
      if (distance <= found_.greatest[s]) continue;
      found_.greatest[s] = distance;
      if (s == place_) found_.at = at;
    }
    return true;
  }

  const Patch& from_;
  const Patch& to_;
  const Interpolation& values_;
  const SoupScale& scale_;
  std::uint64_t& work_;
  SurfaceCloseness& found_;
  double least_cosine_;  ///< of the angle of two faces; without normals, they are shaded flat
  std::size_t place_ = 0;
  std::vector<double> here_, there_;
  std::vector<std::uint32_t> near_;
};

}  // namespace

std::optional<SurfaceCloseness> match_surfaces(const Soup& ours,
                                               const std::vector<std::uint32_t>& left,
                                               const Soup& theirs,
                                               const std::vector<std::uint32_t>& their_left,
                                               const SoupScale& scale) {
  const SoupStream* positions = ours.find(SemanticKind::position);
  const SoupStream* their_positions = theirs.find(SemanticKind::position);
  if (positions == nullptr || their_positions == nullptr || positions->width != 3) return {};
  if (!(scale.position > 0)) return {};
  const Patch here(ours, *positions, left);
  const Patch there(theirs, *their_positions, their_left);
  if (!here.is_finite() || !there.is_finite()) return {};
  const Interpolation values(ours.streams);
  SurfaceCloseness found;
  found.greatest.assign(ours.streams.size(), 0);
  // A few pieces for each triangle, and more at gaps.
  constexpr std::uint64_t kFree = std::uint64_t{1} << 18U;
  std::uint64_t work = kFree + 16 * (left.size() + their_left.size());
  const bool near = SurfaceMatch(here, there, values, scale, work, found).run() &&
                    SurfaceMatch(there, here, values, scale, work, found).run();
  return near ? std::optional(std::move(found)) : std::nullopt;
}

std::optional<model::SurfaceDistance> surface_distance_of(
    const Soup& ours, const std::vector<std::uint32_t>& left, const Soup& theirs,
    const std::vector<std::uint32_t>& their_left) {
  const SoupStream* positions = ours.find(SemanticKind::position);
  const SoupStream* their_positions = theirs.find(SemanticKind::position);
  if (positions == nullptr || their_positions == nullptr || positions->width != 3) return {};
  const Patch here(ours, *positions, left);
  const Patch there(theirs, *their_positions, their_left);
  if (!here.is_finite() || !there.is_finite() || here.size() == 0 || there.size() == 0) return {};
  const model::SurfaceDistance apart =
      model::surface_distance(here.tree(), there.tree(), kNever, 1);
  return std::isfinite(apart.distance) ? std::optional(apart) : std::nullopt;
}

}  // namespace gltfx::prove
