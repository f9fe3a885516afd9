// SPDX-License-Identifier: Apache-2.0
#include "progress.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "output.hpp"

namespace gltfx::tool {

ProgressLine::ProgressLine(bool wanted) : visible_(wanted && ::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(double part) {
  constexpr std::chrono::milliseconds kPause{200};
  const Clock::time_point now = Clock::now();
  if (!visible_ || now - last_ < kPause) return;
  last_ = now;
  shown_ = true;
  const double passed = std::chrono::duration<double>(now - begin_).count();
  const auto left = static_cast<long>(std::ceil(part > 0 ? passed / part - passed : 0));
  const std::string line =
      fmt::format("\r{:3.0f} %, {}:{:02} left\x1b[K", part * 100, left / 60, left % 60);
  static_cast<void>(write_all(STDERR_FILENO, line));
}

void ProgressLine::clear() {
  if (!shown_) return;
  shown_ = false;
  static_cast<void>(write_all(STDERR_FILENO, "\r\x1b[K"));
}

}  // namespace gltfx::tool
