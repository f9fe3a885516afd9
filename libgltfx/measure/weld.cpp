// SPDX-License-Identifier: Apache-2.0
#include "measure/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/bit_cast.hpp"
#include "base/disjoint_sets.hpp"
#include "base/fork.hpp"
#include "base/random_bytes.hpp"

namespace gltfx::measure {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

bool is_finite(const Float3& place) {
  return std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
}

using Factors = std::array<std::uint64_t, 4>;

const Factors& random_factors() {
  static constinit MadeOnce<Factors> made;
  return made.get([] {
    Factors factors{};
    fill_with_random({reinterpret_cast<unsigned char*>(factors.data()), sizeof(factors)});
    return factors;
  });
}

/// Distinct places, found by a hash table with open addresses. The hash multiplies by random
/// numbers, so that nobody can prepare places which collide (M. Dietzfelbinger, 1996).
class Places {
 public:
  explicit Places(std::size_t most) : table_(std::bit_ceil(most * 2 + 2), kNone) {
    shift_ = 64 - std::countr_zero(table_.size());
    places_.reserve(most);
  }

  /// Tells the processor which place comes soon: the table is larger than its caches.
  void prepare(const Float3& place) const { __builtin_prefetch(&table_[hash(place)]); }

  /// The number of a place, which is new if there is none that is equal.
  std::uint32_t number(const Float3& stored) {
    const Float3 place = positive(stored);
    std::size_t slot = hash(stored);
    while (table_[slot] != kNone) {
      if (places_[table_[slot]] == place) return table_[slot];
      slot = (slot + 1) & (table_.size() - 1);
    }
    table_[slot] = static_cast<std::uint32_t>(places_.size());
    places_.push_back(place);
    return table_[slot];
  }

  std::vector<Float3> take() { return std::move(places_); }

 private:
  // -0 becomes 0.
  static Float3 positive(Float3 place) {
    for (float& each : place) each += 0.0F;
    return place;
  }

  std::size_t hash(const Float3& stored) const {
    const Float3 place = positive(stored);
    std::uint64_t sum = factors_[3];
    for (std::size_t k = 0; k < 3; ++k) sum += factors_[k] * bit_cast<std::uint32_t>(place[k]);
    return static_cast<std::size_t>(sum >> shift_);
  }

  const Factors& factors_ = random_factors();
  int shift_ = 0;
  std::vector<std::uint32_t> table_;  // numbers of places
  std::vector<Float3> places_;
};

void weld_equal(std::vector<Float3>& positions, std::vector<model::Triangle>& triangles) {
  std::erase_if(triangles, [&](const model::Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t vertex) { return !is_finite(positions[vertex]); });
  });
  std::vector<std::uint32_t> numbers(positions.size(), kNone);
  std::vector<std::uint32_t> used;  // vertices in the order of their first use
  for (const model::Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (numbers[vertex] == kNone) used.push_back(vertex);
      numbers[vertex] = 0;
    }
  }
  Places places(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    constexpr std::size_t kAhead = 16;
    if (i + kAhead < used.size()) places.prepare(positions[used[i + kAhead]]);
    numbers[used[i]] = places.number(positions[used[i]]);
  }
  for (model::Triangle& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) vertex = numbers[vertex];
  }
  positions = places.take();
}

/// Joins places that are no farther apart than a distance: those in the same cell of a grid, or in
/// neighboring ones. Cells are sorted, so that each column of cells that follows the own one has
/// its own position in the list, which only moves on.
class NearPlaces {
 public:
  NearPlaces(const std::vector<Float3>& places, double distance)
      : places_(places), square_(distance * distance), sets_(places.size()) {
    // Somewhat larger: rounding moves no place beyond the next cell.
    const double size = distance * (1 + 1e-9);
    cells_.reserve(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      Cell cell{{}, i};
      for (std::size_t k = 0; k < 3; ++k) {
        cell.at[k] = std::floor(static_cast<double>(places[i][k]) / size);
      }
      cells_.push_back(cell);
    }
    std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) {
      return a.at != b.at ? a.at < b.at : a.place < b.place;
    });
  }

  /// False: too many pairs.
  bool join() {
    constexpr std::array<std::array<double, 2>, 4> kColumns{{{0, 1}, {1, -1}, {1, 0}, {1, 1}}};
    std::array<std::size_t, kColumns.size()> begins{};
    std::uint64_t left = kPairsEach * std::uint64_t{places_.size()};
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto& [x, y, z] = cells_[i].at;
      if (!join_from(i, i + 1, {x, y, z + 1}, left)) return false;
      for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const std::array<double, 3> first{x + kColumns[k][0], y + kColumns[k][1], z - 1};
        std::size_t& begin = begins[k];
        while (begin < cells_.size() && cells_[begin].at < first) ++begin;
        if (!join_from(i, begin, {first[0], first[1], z + 1}, left)) return false;
      }
    }
    return true;
  }

  DisjointSets& sets() { return sets_; }

 private:
  static constexpr std::uint64_t kPairsEach = 64;

  struct Cell {
    std::array<double, 3> at{};
    std::uint32_t place = 0;
  };

  // Compares a place with those from `begin` to the last one in the cell `last`.
  bool join_from(std::size_t i, std::size_t begin, const std::array<double, 3>& last,
                 std::uint64_t& left) {
    for (std::size_t j = begin; j < cells_.size() && cells_[j].at <= last; ++j) {
      if (left-- == 0) return false;
      if (is_near(cells_[i].place, cells_[j].place)) sets_.join(cells_[i].place, cells_[j].place);
    }
    return true;
  }
  bool is_near(std::uint32_t a, std::uint32_t b) const {
    const Vec3d between = to_vec(places_[a]) - to_vec(places_[b]);
    return dot(between, between) <= square_;
  }

  const std::vector<Float3>& places_;
  double square_;
  DisjointSets sets_;
  std::vector<Cell> cells_;
};

bool weld_near(std::vector<Float3>& places, std::vector<model::Triangle>& triangles,
               double distance) {
  NearPlaces near(places, distance);
  if (!near.join()) return false;
  // The least of a group comes first, so it is numbered before the others.
  std::vector<std::uint32_t> numbers(places.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const std::uint32_t first = near.sets().find(i);
    numbers[i] = first == i ? count : numbers[first];
    if (first == i) places[count++] = places[i];
  }
  places.resize(count);
  for (model::Triangle& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) vertex = numbers[vertex];
  }
  return true;
}

}  // namespace

bool weld(std::vector<Float3>& positions, std::vector<model::Triangle>& triangles,
          double distance) {
  weld_equal(positions, triangles);
  return !(distance > 0) || weld_near(positions, triangles, distance);
}

}  // namespace gltfx::measure
