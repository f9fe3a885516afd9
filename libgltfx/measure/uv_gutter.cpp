// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "measure/box_tree.hpp"
#include "measure/uv_islands.hpp"

namespace gltfx::measure {
namespace {

constexpr std::uint32_t kSeveralIslands = UINT32_MAX;

using Texels = std::array<double, 2>;

double square_of(const Texels& a) { return a[0] * a[0] + a[1] * a[1]; }
Texels minus(const Texels& a, const Texels& b) { return {a[0] - b[0], a[1] - b[1]}; }
double turn_of(const Texels& a, const Texels& b) { return a[0] * b[1] - a[1] * b[0]; }

// The square of the distance of a point from a segment.
double square_from(const Texels& at, const Texels& from, const Texels& to) {
  const Texels along = minus(to, from);
  const Texels offset = minus(at, from);
  const double length = square_of(along);
  const double t =
      length > 0 ? std::clamp((offset[0] * along[0] + offset[1] * along[1]) / length, 0.0, 1.0) : 0;
  return square_of(minus(offset, {t * along[0], t * along[1]}));
}

struct TexelSegment {
  Texels from{}, to{};
};

bool cross(const TexelSegment& a, const TexelSegment& b) {
  const auto sides = [](const TexelSegment& of, const TexelSegment& ends) {
    const Texels along = minus(of.to, of.from);
    return turn_of(along, minus(ends.from, of.from)) * turn_of(along, minus(ends.to, of.from));
  };
  return sides(a, b) < 0 && sides(b, a) < 0;
}

double square_between(const TexelSegment& a, const TexelSegment& b) {
  if (cross(a, b)) return 0;
  return std::min({square_from(a.from, b.from, b.to), square_from(a.to, b.from, b.to),
                   square_from(b.from, a.from, a.to), square_from(b.to, a.from, a.to)});
}

UvBox box_around(const UvOutline& outline) {
  UvBox box;
  box.include(outline.from);
  box.include(outline.to);
  return box;
}

std::vector<UvBox> boxes_of(std::span<const UvOutline> outlines) {
  std::vector<UvBox> boxes;
  boxes.reserve(outlines.size());
  for (const UvOutline& outline : outlines) boxes.push_back(box_around(outline));
  return boxes;
}

// Pairs of leaves, nearer than the nearest pair so far.
class GutterSearch {
 public:
  GutterSearch(std::span<const UvOutline> outlines, const TexelGrid& texels)
      : texels_(texels), tree_(boxes_of(outlines)) {
    constexpr std::uint64_t kFewSteps = 1U << 18U;
    work_ = kFewSteps + 32 * std::uint64_t{outlines.size()};
    for (const std::uint32_t outline : tree_.order()) {
      outlines_.push_back(outlines[outline]);
      boxes_.push_back(box_around(outlines[outline]));
    }
    std::vector<std::uint32_t> below(outlines_.size());
    for (std::size_t i = 0; i < below.size(); ++i) below[i] = outlines_[i].island;
    for (std::size_t level = 0; level < tree_.height(); ++level) {
      std::vector<std::uint32_t> islands(tree_.level(level).size());
      for (std::size_t i = 0; i < below.size(); ++i) {
        std::uint32_t& island = islands[i / BoxTree::kFanout];
        if (i % BoxTree::kFanout == 0) island = below[i];
        if (island != below[i]) island = kSeveralIslands;
      }
      below = islands;
      islands_.push_back(std::move(islands));
    }
  }

  std::optional<double> run() {
    search(0, 0);
    if (texels_.repeats_u) search(1, 0);
    if (texels_.repeats_v) search(0, 1);
    if (texels_.repeats_u && texels_.repeats_v) {
      search(1, 1);
      search(1, -1);
    }
    if (work_ == 0) return std::nullopt;
    return std::sqrt(best_);
  }

 private:
  // Of the outlines and copies of them that many tiles away.
  void search(double u, double v) {
    for (std::size_t leaf = 0; leaf < tree_.leaves(); ++leaf) {
      const std::uint32_t island = islands_[0][leaf];
      tree_.walk([&](std::uint32_t level, std::size_t node) {
        if (best_ == 0 || work_ == 0) return false;
        --work_;
        const bool copies = u != 0 || v != 0;
        if (!copies && ((node + 1) << 3U * level) <= leaf) return false;  // has been compared
        if (island != kSeveralIslands && islands_[level][node] == island) return false;
        if (square_apart(tree_.level(0)[leaf], tree_.level(level)[node], u, v) >= best_)
          return false;
        if (level == 0) compare(leaf, node, u, v);
        return true;
      });
    }
  }

  // A lower limit of the square of the distance.
  double square_apart(const UvBox& one, const UvBox& other, double u, double v) const {
    const auto gap = [](double least, double most, double other_least, double other_most) {
      return std::max({0.0, other_least - most, least - other_most});
    };
    return square_of(
        {gap(one.least_u, one.most_u, other.least_u + u, other.most_u + u) * texels_.width,
         gap(one.least_v, one.most_v, other.least_v + v, other.most_v + v) * texels_.height});
  }

  void compare(std::size_t one, std::size_t other, double u, double v) {
    const auto end_of = [&](std::size_t leaf) {
      return std::min((leaf + 1) * BoxTree::kFanout, outlines_.size());
    };
    for (std::size_t i = one * BoxTree::kFanout; i < end_of(one); ++i) {
      for (std::size_t j = other * BoxTree::kFanout; j < end_of(other); ++j) {
        if (outlines_[i].island == outlines_[j].island || work_ == 0) continue;
        if (square_apart(boxes_[i], boxes_[j], u, v) >= best_) continue;
        --work_;
        const TexelSegment segment = segment_of(outlines_[i], 0, 0);
        best_ = std::min(best_, square_between(segment, segment_of(outlines_[j], u, v)));
      }
    }
  }

  TexelSegment segment_of(const UvOutline& outline, double u, double v) const {
    const auto point = [&](const UvPoint& at) {
      return Texels{(at[0] + u) * texels_.width, (at[1] + v) * texels_.height};
    };
    return {point(outline.from), point(outline.to)};
  }

  const TexelGrid texels_;
  const BoxTree tree_;
  std::vector<UvOutline> outlines_;                  // in the order of the tree
  std::vector<UvBox> boxes_;                         // as outlines_
  std::vector<std::vector<std::uint32_t>> islands_;  // by level and node; kSeveralIslands
  double best_ = kMostGutter * kMostGutter;
  std::uint64_t work_ = 0;
};

}  // namespace

std::optional<double> find_gutter(std::span<const UvOutline> outlines, const TexelGrid& texels) {
  return GutterSearch(outlines, texels).run();
}

}  // namespace gltfx::measure
