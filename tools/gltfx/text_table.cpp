// SPDX-License-Identifier: Apache-2.0
#include "text_table.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::tool {

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
  return digits;
}

std::string size_text(std::uint64_t bytes) {
  static constexpr std::array<std::string_view, 7> kUnits{"B", "kB", "MB", "GB", "TB", "PB", "EB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (size >= 999.5 && unit + 1 < kUnits.size()) {
    size /= 1000;
    ++unit;
  }
  const int decimals = unit == 0 || size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f} {}", size, decimals, kUnits[unit]);
}

std::size_t TextTable::width_of(std::size_t column) const {
  std::size_t width = 0;
  for (const auto& row : rows_) width = std::max(width, count_code_points(row[column]));
  return width == 0 ? 0 : std::max(width, count_code_points(head_[column]));
}

std::string TextTable::line(const std::vector<std::string>& row,
                            const std::vector<std::size_t>& widths, std::size_t indent) const {
  std::string text(indent, ' ');
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (widths[i] == 0) continue;
    if (text.size() > indent) text += "  ";
    const std::size_t blank = widths[i] - count_code_points(row[i]);
    if (kinds_[i] == 'r') text.append(blank, ' ');
    text += row[i];
    if (kinds_[i] != 'r') text.append(blank, ' ');
  }
  return text.erase(text.find_last_not_of(' ') + 1);
}

std::string TextTable::text(std::size_t indent, const Style& style) const {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < head_.size(); ++i) widths.push_back(width_of(i));
  std::string text = style.dim(line(head_, widths, indent)) + "\n";
  for (const auto& row : rows_) text += line(row, widths, indent) + "\n";
  return text;
}

}  // namespace gltfx::tool
