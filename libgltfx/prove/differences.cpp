// SPDX-License-Identifier: Apache-2.0
#include "prove/differences.hpp"

#include <fmt/format.h>

namespace gltfx::prove {

void Differences::add(std::string pointer, std::string what, double amount) {
  // With an empty list the assets would count as equal.
  if (!meaning_.differences.empty() && meaning_.differences.size() >= most_) {
    ++meaning_.more;
  } else {
    meaning_.differences.push_back({std::move(pointer), std::move(what), amount});
  }
}

void Differences::measure(std::string_view quantity, double distance, const std::string& pointer) {
  if (!(distance > 0)) return;
  const auto known = measured_.find(quantity);
  if (known == measured_.end()) {
    measured_.emplace(quantity, Measured{std::string(quantity), distance, pointer});
  } else if (distance > known->second.greatest) {
    known->second.greatest = distance;
    known->second.pointer = pointer;
  }
}

void Differences::leave_out(std::string pointer, std::string_view why) {
  if (meaning_.unread.size() >= most_) return;
  meaning_.unread.push_back(fmt::format("{} {}.", pointer, why));
}

Meaning Differences::take() {
  for (auto& [quantity, measured] : measured_) meaning_.measured.push_back(std::move(measured));
  return std::move(meaning_);
}

}  // namespace gltfx::prove
