// SPDX-License-Identifier: Apache-2.0
/// Progress of a run, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace gltfx::tool {

/// Writes to standard error: one line that changes on a terminal, else a line every ten seconds if
/// `lines` is set. Not thread-safe.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted, bool lines = false);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether anything will be written, now or later.
  bool visible() const { return visible_; }
  /// `part` from 0 to 1; the line is updated a few times a second.
  void show(double part);
  /// `files` of `all` files are done.
  void show(std::uint64_t files, std::uint64_t all);
  /// Call it before other output.
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

/// Ends an open line on the terminal, so that further output begins on the next one. For signal
/// handlers.
void end_progress_line();

}  // namespace gltfx::tool
