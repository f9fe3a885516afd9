// SPDX-License-Identifier: Apache-2.0
#include "prove/soup_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "prove/column.hpp"
#include "prove/hash_sum.hpp"
#include "prove/soup_leftovers.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;

constexpr double kEndless = std::numeric_limits<double>::infinity();

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
    const Order order = find_order();
    if (order == Order::told) return std::move(result_);
    // Elements in about the same place with all of their attributes are the same ones. Those that
    // only have equal normals may be anywhere.
    pair_by_place(1);
    if (order == Order::of_lists && !(left_.empty() && their_left_.empty())) return of_lists();
    pair_by_other_streams();
    const std::size_t placed = pairs_.size();
    pair_by_place(kEndless);
    result_.fewer = left_.size();
    result_.more = their_left_.size();
    result_.distances = measure(pairs_);
    set_apart(placed);
    result_.left = std::move(left_);
    result_.their_left = std::move(their_left_);
    result_.near = measure(pairs_);
    return std::move(result_);
  }

 private:
  enum class Order : std::uint8_t { told, of_lists, other };

  // What is told without pairing elements of other places in the lists. `of_lists`: elements that
  // have the same place in both lists are in pairs, but not all are within limits.
  Order find_order() {
    const std::vector<Hash128> here = hash_elements(a_);
    const std::vector<Hash128> there = hash_elements(b_);
    Leftovers left = find_leftovers(here, there);
    left_ = std::move(left.ours);
    their_left_ = std::move(left.theirs);
    if (left_.empty() && their_left_.empty()) {
      const auto unseen = [](const Hash128& each) { return each == Hash128{}; };
      result_.unseen = std::all_of(here.begin(), here.end(), unseen);
      return Order::told;
    }
    if (is_reversed(there)) {
      result_.reversed = true;
      return Order::told;
    }
    if (a_.elements() != b_.elements() || !pairs_in_order(here, there)) return Order::other;
    if (!std::all_of(in_order_.begin(), in_order_.end(),
                     [&](const ElementPair& pair) { return is_within(pair); })) {
      return Order::of_lists;
    }
    result_.distances = measure(in_order_);
    return Order::told;
  }

  SoupDifference of_lists() {
    result_.distances = measure(in_order_);
    return std::move(result_);
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
    in_order_ = std::move(pairs);
    return true;
  }

  // Most positions are equal or near, or there are none.
  bool order_is_plausible(const std::vector<ElementPair>& pairs) const {
    const SoupStream* positions = a_.find(SemanticKind::position);
    if (positions == nullptr) return true;
    const auto near = std::count_if(pairs.begin(), pairs.end(), [&](const ElementPair& pair) {
      return element_distance(*positions, pair) <= scale_.position;
    });
    return 2 * static_cast<std::size_t>(near) > pairs.size();
  }

  bool is_reversed(const std::vector<Hash128>& there) const {
    if (a_.arity != 3 || left_.size() != their_left_.size()) return false;
    const std::vector<Hash128> turned = hash_elements(a_, nullptr, true);
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
      std::vector<std::uint32_t> waiting = their_left_;
      sort_by_hash(waiting, there);
      std::vector<std::uint32_t> taken(waiting.size());  // by the first of each hash
      take_pairs([&](std::uint32_t i) -> std::optional<std::uint32_t> {
        const auto first = std::lower_bound(
            waiting.begin(), waiting.end(), here[i],
            [&](std::uint32_t k, const Hash128& hash) { return hash_less(there[k], hash); });
        const auto place = static_cast<std::size_t>(first - waiting.begin());
        if (first == waiting.end()) return std::nullopt;
        const std::size_t next = place + taken[place];
        if (next >= waiting.size() || there[waiting[next]] != here[i]) return std::nullopt;
        ++taken[place];
        return waiting[next];
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

  using Cell = std::uint64_t;  // a hash
  struct InCell {
    Cell cell = 0;
    std::uint32_t element = 0;
    std::uint32_t taken = 0;  ///< of a cell, at its first element: they are moved to the front
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

  // Elements whose centres are within the bound of positions, nearest first among a few, and no
  // distance greater than `most` of its limit.
  void pair_by_place(double most) {
    const SoupStream* positions = a_.find(SemanticKind::position);
    if (positions == nullptr || positions->width != 3 || !(scale_.position > 0)) return;
    const double size = 2 * scale_.position;
    const auto cell_of = [&](const model::Vector3& at, unsigned grid) -> std::optional<Cell> {
      std::array<std::int64_t, 3> cell{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double number = std::floor(at[i] / size + 0.5 * ((grid >> i) & 1U));
        if (!(std::fabs(number) < 1e15)) return std::nullopt;
        cell[i] = static_cast<std::int64_t>(number);
      }
      return hash_of_all(cell).low;
    };
    // Grids that are shifted by half a cell: two centres within the bound share a cell of one.
    for (unsigned grid = 0; grid < 8 && !left_.empty() && !their_left_.empty(); ++grid) {
      std::vector<InCell> cells;
      cells.reserve(their_left_.size());
      for (const std::uint32_t i : their_left_) {
        if (const auto cell = cell_of(center(b_, *positions, i), grid)) {
          cells.push_back({*cell, i, 0});
        }
      }
      std::sort(cells.begin(), cells.end(), [](const InCell& a, const InCell& b) {
        return a.cell == b.cell ? a.element < b.element : a.cell < b.cell;
      });
      take_pairs([&](std::uint32_t i) -> std::optional<std::uint32_t> {
        const auto cell = cell_of(center(a_, *positions, i), grid);
        if (!cell) return std::nullopt;
        const auto first =
            std::lower_bound(cells.begin(), cells.end(), *cell,
                             [](const InCell& each, Cell wanted) { return each.cell < wanted; });
        const bool any = first != cells.end() && first->cell == *cell;
        return any ? nearest_of(i, first, cells.end(), most) : std::nullopt;
      });
    }
  }

  /// How near two elements are: the greatest part of a limit, then the sum of all distances.
  using Nearness = std::pair<double, double>;

  Nearness nearness(std::uint32_t ours, std::uint32_t theirs, double least) const {
    Nearness near{0, kEndless};
    const ElementPair pair{ours, theirs, best_turn(ours, theirs, near.second)};
    for (std::size_t s = 0; s < std::min(a_.streams.size(), scale_.limits.size()); ++s) {
      const double distance = element_distance(a_.streams[s], pair);
      const double part = distance == 0          ? 0
                          : scale_.limits[s] > 0 ? distance / scale_.limits[s]
                                                 : kEndless;
      near.first = std::max(near.first, part);
      if (near.first > least) break;
    }
    return near;
  }

  // Of the elements of a cell that are left; takes it.
  std::optional<std::uint32_t> nearest_of(std::uint32_t ours, std::vector<InCell>::iterator first,
                                          std::vector<InCell>::iterator end, double most) {
    // More where many small ones share a cell, as long as there is time.
    constexpr std::uint32_t kMost = 32;
    auto best = end;
    Nearness nearest{most, kEndless};
    const auto begin = first + static_cast<std::ptrdiff_t>(
                                   std::min<std::size_t>(first->taken, std::size_t(end - first)));
    std::uint32_t tried = 0;
    for (auto at = begin; at != end && at->cell == first->cell; ++at, ++tried) {
      if (tried >= kMost) {
        if (more_tries_ == 0) break;
        --more_tries_;
      }
      const Nearness near = nearness(ours, at->element, nearest.first);
      if (near < nearest) {
        nearest = near;
        best = at;
      }
    }
    if (best == end) return std::nullopt;
    const std::uint32_t found = best->element;
    std::swap(best->element, begin->element);
    ++first->taken;
    return found;
  }

  bool is_mirrored(const SoupStream& stream, const std::vector<ElementPair>& pairs) const {
    if (stream.kind != SemanticKind::texcoord || stream.width != 2) return false;
    constexpr double kNear = 1e-5;
    return std::all_of(pairs.begin(), pairs.end(), [&](const ElementPair& pair) {
      for (std::size_t k = 0; k < a_.arity; ++k) {
        const double* p = corner(a_, pair.ours, k) + stream.offset;
        const double* q = corner(b_, pair.theirs, k + pair.turn) + stream.offset;
        if (apart(p[0], q[0]) > kNear || apart(1 - p[1], q[1]) > kNear) return false;
      }
      return true;
    });
  }

  // Pairs from `first` on that are not within limits are no pairs.
  void set_apart(std::size_t first) {
    const auto from = pairs_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = std::stable_partition(
        from, pairs_.end(), [&](const ElementPair& pair) { return is_within(pair); });
    for (auto at = end; at != pairs_.end(); ++at) {
      left_.push_back(at->ours);
      their_left_.push_back(at->theirs);
    }
    pairs_.erase(end, pairs_.end());
    std::sort(left_.begin(), left_.end());
    std::sort(their_left_.begin(), their_left_.end());
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
      distance.mirrored = is_mirrored(stream, pairs);
      distances.push_back(distance);
    }
    return distances;
  }

  const Soup& a_;
  const Soup& b_;
  const SoupScale scale_;
  std::vector<std::uint32_t> left_, their_left_;
  std::vector<ElementPair> pairs_;
  std::uint64_t more_tries_ = std::uint64_t{1} << 22U;  ///< of nearest_of()
  std::vector<ElementPair> in_order_;                   ///< by their places in both lists
  SoupDifference result_;
};

}  // namespace

SoupDifference compare_soups(const Soup& ours, const Soup& theirs, const SoupScale& scale) {
  return SoupComparison(ours, theirs, scale).run();
}

}  // namespace gltfx::prove
