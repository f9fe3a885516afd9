// SPDX-License-Identifier: Apache-2.0
#include "prove/soup_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "prove/column.hpp"
#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;

constexpr double kEndless = std::numeric_limits<double>::infinity();

double angle_of(const double* a, const double* b) {
  const model::Vector3 p{a[0], a[1], a[2]};
  const model::Vector3 q{b[0], b[1], b[2]};
  const bool turns = model::dot(p, p) > 0;
  if (turns != (model::dot(q, q) > 0)) return kEndless;
  const model::Vector3 across = model::cross(p, q);
  const double degrees =
      std::atan2(std::sqrt(model::dot(across, across)), model::dot(p, q)) * 180 / std::numbers::pi;
  if (std::isnan(degrees)) return kEndless;
  // If only the lengths differ, the vectors are not equal.
  return degrees > 0 ? degrees : std::numeric_limits<double>::min();
}

// Pairs (joint, weight), sorted by joint; padding has weight 0.
double influence_distance(const double* a, const double* b, unsigned width) {
  double greatest = 0;
  unsigned i = 0;
  unsigned k = 0;
  const auto ends = [width](const double* list, unsigned at) {
    return at >= width || list[at + 1] == 0;
  };
  while (!ends(a, i) || !ends(b, k)) {
    const bool only_a = ends(b, k) || (!ends(a, i) && a[i] < b[k]);
    const bool only_b = ends(a, i) || (!ends(b, k) && b[k] < a[i]);
    const double weight = only_a   ? apart(a[i + 1], 0)
                          : only_b ? apart(b[k + 1], 0)
                                   : apart(a[i + 1], b[k + 1]);
    greatest = std::max(greatest, weight);
    if (!only_b) i += 2;
    if (!only_a) k += 2;
  }
  return greatest;
}

}  // namespace

double stream_distance(const SoupStream& stream, const double* a, const double* b,
                       const SoupScale& scale) {
  a += stream.offset;
  b += stream.offset;
  double greatest = 0;
  for (unsigned i = 0; i < stream.width; ++i) greatest = std::max(greatest, apart(a[i], b[i]));
  if (greatest == 0) return 0;
  const bool direction =
      stream.kind == SemanticKind::normal || stream.kind == SemanticKind::tangent;
  if (stream.kind == SemanticKind::weights) {
    return stream.joints == json::kNoNode ? greatest : influence_distance(a, b, stream.width);
  }
  if (stream.width >= 3 && direction && !stream.of_target) {
    if (stream.width > 3 && apart(a[3], b[3]) > 0) return kEndless;
    return angle_of(a, b);
  }
  if (stream.width == 3 && (direction || stream.kind == SemanticKind::position)) {
    double square = 0;
    for (unsigned i = 0; i < 3; ++i) square += std::pow(apart(a[i], b[i]), 2);
    const double length = std::sqrt(square);
    return direction ? length * 180 / std::numbers::pi : length;
  }
  return stream.kind == SemanticKind::texcoord ? greatest * scale.texels : greatest;
}

namespace {

/// An element of each soup, and how far the corners of the second one are turned.
struct ElementPair {
  std::uint32_t ours = 0, theirs = 0;
  std::uint8_t turn = 0;
};

class SoupComparison {
 public:
  SoupComparison(const Soup& ours, const Soup& theirs, const SoupScale& scale)
      : a_(ours), b_(theirs), scale_(scale) {}

  SoupDifference run() {
    const std::vector<Hash128> here = hash_elements(a_);
    const std::vector<Hash128> there = hash_elements(b_);
    find_leftovers(here, there, left_, their_left_);
    if (left_.empty() && their_left_.empty()) {
      const auto unseen = [](const Hash128& each) { return each == Hash128{}; };
      result_.unseen = std::all_of(here.begin(), here.end(), unseen);
      return result_;
    }
    if (is_reversed()) {
      result_.reversed = true;
      return result_;
    }
    if (a_.elements() == b_.elements() && pairs_in_order(here, there)) {
      result_.distances = measure(pairs_);
      return std::move(result_);
    }
    pair_by_other_streams();
    const std::size_t placed = pairs_.size();
    pair_by_place();
    result_.fewer = left_.size();
    result_.more = their_left_.size();
    result_.distances = measure(pairs_);
    set_apart(placed);
    result_.near = measure(pairs_);
    return std::move(result_);
  }

 private:
  // Elements of each soup that the other one does not have, in order.
  static void find_leftovers(const std::vector<Hash128>& here, const std::vector<Hash128>& there,
                             std::vector<std::uint32_t>& ours, std::vector<std::uint32_t>& theirs) {
    std::unordered_map<Hash128, std::int64_t, HashHasher> counts;
    for (const Hash128& each : here) ++counts[each];
    for (std::uint32_t i = 0; i < there.size(); ++i) {
      if (there[i] != Hash128{} && --counts[there[i]] < 0) theirs.push_back(i);
    }
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      if (here[i] == Hash128{}) continue;
      std::int64_t& left = counts[here[i]];
      if (left <= 0) continue;
      --left;
      ours.push_back(i);
    }
  }

  // Whether the lists of both have the same order, as far as their elements are equal.
  bool pairs_in_order(const std::vector<Hash128>& here, const std::vector<Hash128>& there) {
    std::vector<ElementPair> pairs;
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      if (here[i] != there[i]) pairs.push_back({i, i, 0});
    }
    const std::size_t left = std::max(left_.size(), their_left_.size());
    if (pairs.size() > left + left / 4) return false;
    // Noise leaves no element equal: then the order is right if all are near.
    if (pairs.size() == here.size() && !order_is_plausible(pairs)) return false;
    pairs_ = std::move(pairs);
    left_.clear();
    their_left_.clear();
    return true;
  }

  // Of equal positions, or near ones, in most places; or without positions.
  bool order_is_plausible(const std::vector<ElementPair>& pairs) const {
    std::size_t near = 0;
    std::size_t others_equal = 0;
    for (const ElementPair& pair : pairs) {
      double place = 0;
      std::size_t differing = 0;
      for (const SoupStream& stream : a_.streams) {
        const double distance = element_distance(stream, pair);
        if (stream.kind == SemanticKind::position && !stream.of_target) {
          place = std::max(place, distance);
        }
        differing += distance > 0 ? 1U : 0U;
      }
      near += place <= scale_.position ? 1U : 0U;
      others_equal += differing <= 1 ? 1U : 0U;
    }
    return 2 * std::max(near, others_equal) > pairs.size();
  }

  bool is_reversed() const {
    if (a_.arity != 3 || left_.size() != their_left_.size()) return false;
    const std::vector<Hash128> turned = hash_elements(a_, nullptr, true);
    const std::vector<Hash128> there = hash_elements(b_);
    Hash128 one, other;
    for (const std::uint32_t i : left_) add_to_sum(one, turned[i]);
    for (const std::uint32_t i : their_left_) add_to_sum(other, there[i]);
    return one == other;
  }

  const double* corner(const Soup& soup, std::uint32_t element, std::size_t k) const {
    return soup.row(soup.corners[std::size_t{element} * soup.arity + k % soup.arity]);
  }
  double element_distance(const SoupStream& stream, const ElementPair& pair) const {
    double greatest = 0;
    for (std::size_t k = 0; k < a_.arity; ++k) {
      greatest =
          std::max(greatest, stream_distance(stream, corner(a_, pair.ours, k),
                                             corner(b_, pair.theirs, k + pair.turn), scale_));
    }
    return greatest;
  }

  // The turn for which corners are nearest, by the sum of all components.
  std::uint8_t best_turn(std::uint32_t ours, std::uint32_t theirs, double& least) const {
    std::uint8_t best = 0;
    least = kEndless;
    for (std::uint8_t turn = 0; turn < a_.arity; ++turn) {
      double sum = 0;
      for (std::size_t k = 0; k < a_.arity; ++k) {
        const double* p = corner(a_, ours, k);
        const double* q = corner(b_, theirs, k + turn);
        for (unsigned i = 0; i < a_.width; ++i) sum += std::min(apart(p[i], q[i]), 1e30);
      }
      if (sum < least) {
        least = sum;
        best = turn;
      }
    }
    return best;
  }

  // An edit of one attribute leaves the others as they are.
  void pair_by_other_streams() {
    for (const SoupStream& stream : a_.streams) {
      if (left_.empty() || their_left_.empty()) return;
      const std::vector<Hash128> here = hash_elements(a_, &stream);
      const std::vector<Hash128> there = hash_elements(b_, &stream);
      std::unordered_map<Hash128, std::pair<std::vector<std::uint32_t>, std::size_t>, HashHasher>
          waiting;
      for (const std::uint32_t i : their_left_) waiting[there[i]].first.push_back(i);
      take_pairs([&](std::uint32_t i) -> std::optional<std::uint32_t> {
        const auto found = waiting.find(here[i]);
        if (found == waiting.end()) return std::nullopt;
        auto& [all, next] = found->second;
        return next < all.size() ? std::optional(all[next++]) : std::nullopt;
      });
    }
  }

  // Pairs elements that are left with those that `find` gives.
  template <class Find>
  void take_pairs(const Find& find) {
    std::vector<std::uint32_t> left;
    std::vector<bool> taken(b_.elements());
    for (const std::uint32_t i : left_) {
      const std::optional<std::uint32_t> other = find(i);
      if (!other) {
        left.push_back(i);
        continue;
      }
      taken[*other] = true;
      double least = 0;
      pairs_.push_back({i, *other, best_turn(i, *other, least)});
    }
    left_ = std::move(left);
    std::erase_if(their_left_, [&](std::uint32_t i) { return taken[i]; });
  }

  using Cell = std::array<std::int64_t, 3>;
  struct CellHasher {
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(hash_of_all(cell[0], cell[1], cell[2]).low);
    }
  };

  model::Vector3 center(const Soup& soup, const SoupStream& positions,
                        std::uint32_t element) const {
    model::Vector3 sum{};
    for (std::size_t k = 0; k < soup.arity; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        sum[i] += corner(soup, element, k)[positions.offset + i] / static_cast<double>(soup.arity);
      }
    }
    return sum;
  }

  // Elements whose centres are within the bound of positions, nearest first among a few.
  void pair_by_place() {
    const SoupStream* positions = a_.find(SemanticKind::position);
    if (positions == nullptr || positions->width != 3 || !(scale_.position > 0)) return;
    const double size = 2 * scale_.position;
    const auto cell_of = [&](const model::Vector3& at, const Cell& shift) -> std::optional<Cell> {
      Cell cell{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double number = std::floor(at[i] / size + 0.5 * static_cast<double>(shift[i]));
        if (!(std::fabs(number) < 1e15)) return std::nullopt;
        cell[i] = static_cast<std::int64_t>(number);
      }
      return cell;
    };
    // Grids that are shifted by half a cell: two centres within the bound share a cell of one.
    for (unsigned grid = 0; grid < 8 && !left_.empty() && !their_left_.empty(); ++grid) {
      const Cell shift{grid & 1U, (grid >> 1U) & 1U, (grid >> 2U) & 1U};
      std::unordered_map<Cell, std::vector<std::uint32_t>, CellHasher> cells;
      for (const std::uint32_t i : their_left_) {
        if (const auto cell = cell_of(center(b_, *positions, i), shift)) cells[*cell].push_back(i);
      }
      take_pairs([&](std::uint32_t i) -> std::optional<std::uint32_t> {
        const auto cell = cell_of(center(a_, *positions, i), shift);
        const auto found = cell ? cells.find(*cell) : cells.end();
        if (found == cells.end()) return std::nullopt;
        return nearest_of(i, found->second);
      });
    }
  }

  std::optional<std::uint32_t> nearest_of(std::uint32_t ours,
                                          std::vector<std::uint32_t>& waiting) const {
    constexpr std::size_t kMost = 32;
    std::size_t best = waiting.size();
    double nearest = kEndless;
    for (std::size_t i = 0; i < std::min(waiting.size(), kMost); ++i) {
      double sum = 0;
      best_turn(ours, waiting[i], sum);
      if (sum < nearest) {
        nearest = sum;
        best = i;
      }
    }
    if (best == waiting.size()) return std::nullopt;
    const std::uint32_t found = waiting[best];
    waiting[best] = waiting.back();
    waiting.pop_back();
    return found;
  }

  bool is_mirrored(const SoupStream& stream) const {
    if (stream.kind != SemanticKind::texcoord || stream.width != 2) return false;
    constexpr double kNear = 1e-5;
    return std::all_of(pairs_.begin(), pairs_.end(), [&](const ElementPair& pair) {
      for (std::size_t k = 0; k < a_.arity; ++k) {
        const double* p = corner(a_, pair.ours, k) + stream.offset;
        const double* q = corner(b_, pair.theirs, k + pair.turn) + stream.offset;
        if (apart(p[0], q[0]) > kNear || apart(1 - p[1], q[1]) > kNear) return false;
      }
      return true;
    });
  }

  // Pairs by place, from `first` on, that are not within limits are no pairs.
  void set_apart(std::size_t first) {
    std::vector<ElementPair> kept;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (i < first || is_within(pairs_[i])) {
        kept.push_back(pairs_[i]);
        continue;
      }
      left_.push_back(pairs_[i].ours);
      their_left_.push_back(pairs_[i].theirs);
    }
    pairs_ = std::move(kept);
    std::sort(left_.begin(), left_.end());
    std::sort(their_left_.begin(), their_left_.end());
    result_.left = std::move(left_);
    result_.their_left = std::move(their_left_);
  }

  bool is_within(const ElementPair& pair) const {
    for (std::size_t s = 0; s < std::min(a_.streams.size(), scale_.limits.size()); ++s) {
      if (element_distance(a_.streams[s], pair) > scale_.limits[s]) return false;
    }
    return true;
  }

  std::vector<StreamDistance> measure(const std::vector<ElementPair>& pairs) const {
    std::vector<StreamDistance> distances;
    for (const SoupStream& stream : a_.streams) {
      StreamDistance distance;
      distance.stream = &stream;
      for (const ElementPair& pair : pairs) {
        const double apart = element_distance(stream, pair);
        if (apart == 0) continue;
        if (distance.elements++ == 0) distance.first = pair.ours;
        distance.greatest = std::max(distance.greatest, apart);
      }
      if (distance.elements == 0) continue;
      distance.mirrored = is_mirrored(stream);
      distances.push_back(distance);
    }
    return distances;
  }

  const Soup& a_;
  const Soup& b_;
  const SoupScale scale_;
  std::vector<std::uint32_t> left_, their_left_;
  std::vector<ElementPair> pairs_;
  SoupDifference result_;
};

}  // namespace

SoupDifference compare_soups(const Soup& ours, const Soup& theirs, const SoupScale& scale) {
  return SoupComparison(ours, theirs, scale).run();
}

}  // namespace gltfx::prove
