// SPDX-License-Identifier: Apache-2.0
/// Collects the results of the parts of a comparison.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "prove/meaning.hpp"

namespace gltfx::prove {

/// Keeps the requested number of differences, and counts the others.
class Differences {
 public:
  explicit Differences(std::size_t most) : most_(most) {}

  void add(std::string pointer, std::string what, double amount = 0);
  /// Records the distance of two values of a quantity; of equal greatest ones, the first is kept.
  void measure(std::string_view quantity, double distance, const std::string& pointer);
  /// Records that a part of `before` could not be read.
  void leave_out(std::string pointer, std::string_view why);

  Meaning take();

 private:
  std::size_t most_;
  Meaning meaning_;
  std::map<std::string, Measured, std::less<>> measured_;
};

}  // namespace gltfx::prove
