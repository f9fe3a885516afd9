// SPDX-License-Identifier: Apache-2.0
#include "terminal.hpp"

#include <algorithm>
#include <cstdlib>

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

}  // namespace gltfx::tool
