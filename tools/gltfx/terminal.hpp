// SPDX-License-Identifier: Apache-2.0
/// Colours, line breaks, columns and numbers for people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "options.hpp"

namespace gltfx::tool {

/// Whether text on standard output is coloured: as the mode says, by default on a terminal without
/// NO_COLOR.
bool colors_on_stdout(ColorMode mode);

/// Wraps words in ANSI styles, or returns them unchanged.
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

/// "1,234,567".
std::string grouped(std::uint64_t number);
/// "512 B", "1.23 MB": three digits, thousands of thousands.
std::string size_text(std::uint64_t bytes);

/// Rows of cells in columns that are as wide as their widest cell.
class TextTable {
 public:
  /// `kinds`: a letter per column, 'l' for text and 'r' for right-aligned numbers.
  TextTable(std::string kinds, std::vector<std::string> head)
      : kinds_(std::move(kinds)), head_(std::move(head)) {}

  /// As many cells as columns; printable.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// One line per row, indented, with a dim heading; columns that are empty in all rows are left
  /// out.
  std::string text(std::size_t indent, const Style& style) const;

 private:
  std::size_t width_of(std::size_t column) const;
  std::string line(const std::vector<std::string>& row, const std::vector<std::size_t>& widths,
                   std::size_t indent) const;

  std::string kinds_;
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gltfx::tool
