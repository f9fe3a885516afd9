// SPDX-License-Identifier: Apache-2.0
/// Shares of numbers with weights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "measure/radix_sort.hpp"

namespace gltfx::measure {

/// Exact for a million values; of more, those that differ by less than a thousandth are averaged.
class WeightedValues {
 public:
  /// Preconditions: the value is not negative, and the weight is positive; both are finite.
  void add(double value, double weight) {
    if (entries_.size() == kMostEntries) average_neighbours();
    entries_.push_back({value, weight});
  }

  /// The least value such that those up to it have the share of the weight. Precondition: there is
  /// a value.
  double value_at(double share) {
    sort();
    double total = 0;
    for (const Entry& entry : entries_) total += entry.weight;
    double sum = 0;
    for (const Entry& entry : entries_) {
      sum += entry.weight;
      if (sum >= share * total) return entry.value;
    }
    return entries_.back().value;
  }

 private:
  struct Entry {
    double value, weight;
  };
  static constexpr std::size_t kMostEntries = std::size_t{1} << 20U;
  static constexpr unsigned kCoarse = 13;  // bits of a float; the others have less than 2^19 values

  static std::uint32_t key_of(const Entry& entry) {
    return sortable_bits(static_cast<float>(entry.value));
  }

  void sort() {
    std::vector<Keyed<std::uint32_t>> order(entries_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {key_of(entries_[i]), i};
    radix_sort(order);
    std::vector<Entry> sorted;
    sorted.reserve(entries_.size());
    for (const auto& each : order) sorted.push_back(entries_[each.item]);
    entries_ = std::move(sorted);
  }

  void average_neighbours() {
    sort();
    std::size_t last = 0;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      Entry& to = entries_[last];
      const Entry& from = entries_[i];
      if (key_of(to) >> kCoarse != key_of(from) >> kCoarse) {
        entries_[++last] = from;
        continue;
      }
      const double weight = to.weight + from.weight;
      to.value += (from.value - to.value) * (from.weight / weight);
      to.weight = weight;
    }
    entries_.resize(last + 1);
  }

  std::vector<Entry> entries_;
};

}  // namespace gltfx::measure
