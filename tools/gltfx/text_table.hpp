// SPDX-License-Identifier: Apache-2.0
/// Columns of text, and numbers as people read them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "terminal.hpp"

namespace gltfx::tool {

/// "1,234,567".
std::string grouped(std::uint64_t number);
/// "512 B", "1.23 MB": three digits, thousands of thousands.
std::string size_text(std::uint64_t bytes);

/// Rows of cells in columns that are as wide as their widest cell.
class TextTable {
 public:
  /// `kinds`: a letter a column, 'l' for text and 'r' for numbers, which end at the right.
  TextTable(std::string kinds, std::vector<std::string> head)
      : kinds_(std::move(kinds)), head_(std::move(head)) {}

  /// As many cells as columns; printable.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// One line a row, indented, the head dim; columns that are empty in all rows are left out.
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
