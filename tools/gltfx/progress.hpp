// SPDX-License-Identifier: Apache-2.0
/// How far a run is, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace gltfx::tool {

/// Writes to standard error: one line that changes on a terminal, else a line every ten seconds
/// where `lines` asks for them. Not thread-safe.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted, bool lines = false);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether anything will be written, now or later.
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

  bool terminal_;
  bool visible_;
  bool shown_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

/// Leaves a line that is on the terminal as it is, so that what comes next begins on another one.
/// For handlers of signals.
void end_progress_line();

}  // namespace gltfx::tool
