// SPDX-License-Identifier: Apache-2.0
/// Colours of the text format, by what they mean.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx::report {

/// The first four are in the order of Severity.
enum class Ink : std::uint8_t { error, warning, info, hint, strong, frame, help, good };

inline Ink ink_of(Severity severity) { return static_cast<Ink>(severity); }

/// Wraps words in ANSI escapes, or leaves them alone.
class Style {
 public:
  explicit Style(bool color) : color_(color) {}

  std::string paint(Ink ink, std::string_view text) const {
    if (!color_ || text.empty()) return std::string(text);
    // Bold red, yellow, blue and green; bold alone; bold blue; bold cyan; bold green.
    constexpr std::array<std::string_view, 8> kCodes{"1;31", "1;33", "1;34", "1;32",
                                                     "1",    "1;34", "1;36", "1;32"};
    std::string out = "\x1b[";
    out.append(kCodes[static_cast<std::size_t>(ink)]).append("m").append(text);
    return out.append("\x1b[0m");
  }

 private:
  bool color_;
};

}  // namespace gltfx::report
