// SPDX-License-Identifier: Apache-2.0
/// Colours and line breaks for people.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "options.hpp"

namespace gltfx::tool {

/// Whether text to standard output is coloured: as told, else on a terminal without NO_COLOR.
bool colors_on_stdout(ColorMode mode);

/// Wraps words in ANSI styles, or leaves them alone.
class Style {
 public:
  explicit Style(bool color) : color_(color) {}
  std::string bold(std::string_view text) const { return wrap("1", text); }
  std::string dim(std::string_view text) const { return wrap("2", text); }
  std::string severity(Severity severity, std::string_view text) const;

 private:
  std::string wrap(std::string_view code, std::string_view text) const;
  bool color_;
};

/// `text` broken between words into lines of at most `width` code points, each indented.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width = 92);

/// Every line of `text` indented; ends in one line break.
std::string indented(std::string_view text, std::size_t indent);

/// `text` followed by spaces up to `width` code points.
std::string padded(std::string_view text, std::size_t width);

}  // namespace gltfx::tool
