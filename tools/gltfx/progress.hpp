// SPDX-License-Identifier: Apache-2.0
/// How far a run is, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace gltfx::tool {

/// Writes to standard error, and only when that is a terminal. Not thread-safe.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool visible() const { return visible_; }
  /// `part` from 0 to 1; the line changes some times a second.
  void show(double part);
  /// So many of `all` files are done.
  void show(std::uint64_t files, std::uint64_t all);
  /// Before something else is written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due();
  double passed() const;
  void write(double part, std::string_view more);

  bool visible_;
  bool shown_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

}  // namespace gltfx::tool
