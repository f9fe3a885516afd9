// SPDX-License-Identifier: Apache-2.0
#include "terminal.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

std::string_view color_code(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "1;31";
    case Severity::warning:
      return "1;33";
    case Severity::info:
      return "1;36";
    case Severity::hint:
      break;
  }
  return "1;32";
}

}  // namespace

bool colors_on_stdout(ColorMode mode) {
  if (mode != ColorMode::automatic) return mode == ColorMode::always;
  // NO_COLOR (no-color.org) counts when it is not empty. Nothing else runs yet: getenv is safe.
  const char* no_color = std::getenv("NO_COLOR");  // NOLINT(concurrency-mt-unsafe)
  if (no_color != nullptr && *no_color != '\0') return false;
  return ::isatty(STDOUT_FILENO) == 1;
}

std::string Style::wrap(std::string_view code, std::string_view text) const {
  if (!color_) return std::string(text);
  std::string styled = "\x1b[";
  return styled.append(code).append("m").append(text).append("\x1b[0m");
}

std::string Style::severity(Severity severity, std::string_view text) const {
  return wrap(color_code(severity), text);
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  std::string out;
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    const std::size_t length = count_code_points(word);
    if (column > 0 && column + 1 + length > width) column = 0;
    if (column == 0) {
      out.append(out.empty() ? "" : "\n").append(indent, ' ');
      column = indent;
    } else {
      out += ' ';
      ++column;
    }
    out += word;
    column += length;
  }
  return out.append("\n");
}

std::string indented(std::string_view text, std::size_t indent) {
  std::string out;
  while (text.ends_with('\n')) text.remove_suffix(1);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) out.append(indent, ' ').append(text.substr(at, end - at));
    out += '\n';
    at = end + 1;
  }
  return out;
}

std::string padded(std::string_view text, std::size_t width) {
  std::string out(text);
  const std::size_t length = count_code_points(text);
  if (length < width) out.append(width - length, ' ');
  return out;
}

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
