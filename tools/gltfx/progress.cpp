// SPDX-License-Identifier: Apache-2.0
#include "progress.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "output.hpp"

namespace gltfx::tool {

ProgressLine::ProgressLine(bool wanted) : visible_(wanted && ::isatty(STDERR_FILENO) == 1) {}

bool ProgressLine::is_due() {
  constexpr std::chrono::milliseconds kPause{200};
  const Clock::time_point now = Clock::now();
  if (!visible_ || now - last_ < kPause) return false;
  last_ = now;
  return true;
}

double ProgressLine::passed() const {
  return std::chrono::duration<double>(last_ - begin_).count();
}

void ProgressLine::write(double part, std::string_view more) {
  shown_ = true;
  const auto left = static_cast<long>(std::ceil(part > 0 ? passed() / part - passed() : 0));
  const std::string line =
      fmt::format("\r{:3.0f} %{}, {}:{:02} left\x1b[K", part * 100, more, left / 60, left % 60);
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
}

}  // namespace gltfx::tool
