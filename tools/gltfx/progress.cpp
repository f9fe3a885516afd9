// SPDX-License-Identifier: Apache-2.0
#include "progress.hpp"

#include <atomic>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "output.hpp"

namespace gltfx::tool {
namespace {

std::atomic<bool> line_is_open = false;  // on the terminal

}  // namespace

ProgressLine::ProgressLine(bool wanted, bool lines)
    : terminal_(::isatty(STDERR_FILENO) == 1), visible_(wanted && (terminal_ || lines)) {}

bool ProgressLine::is_due() {
  const std::chrono::milliseconds pause(terminal_ ? 200 : 10'000);
  const Clock::time_point now = Clock::now();
  if (!visible_ || now - last_ < pause) return false;
  last_ = now;
  return true;
}

double ProgressLine::passed() const {
  return std::chrono::duration<double>(last_ - begin_).count();
}

void ProgressLine::write(double part, std::string_view more) {
  shown_ = terminal_;
  const auto left = static_cast<long>(std::ceil(part > 0 ? passed() / part - passed() : 0));
  const std::string text =
      fmt::format("{:3.0f} %{}, {}:{:02} left", part * 100, more, left / 60, left % 60);
  const std::string line = terminal_ ? "\r" + text + "\x1b[K" : "gltfx: " + text + "\n";
  line_is_open = terminal_;
  static_cast<void>(write_all(STDERR_FILENO, line));
}

void ProgressLine::show(double part) {
  if (is_due()) write(part, {});
}

void ProgressLine::show(std::uint64_t files, std::uint64_t all) {
  if (!is_due() || all == 0) return;
  const auto done = static_cast<double>(files);
  write(done / static_cast<double>(all),
        fmt::format(", {} of {} files, {:.0f} a second", files, all, done / passed()));
}

void ProgressLine::clear() {
  if (!shown_) return;
  shown_ = false;
  static_cast<void>(write_all(STDERR_FILENO, "\r\x1b[K"));
  line_is_open = false;
}

void end_progress_line() {
  if (line_is_open) static_cast<void>(write_all(STDERR_FILENO, "\n"));
}

}  // namespace gltfx::tool
