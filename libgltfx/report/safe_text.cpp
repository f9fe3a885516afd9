// SPDX-License-Identifier: Apache-2.0
#include "report/safe_text.hpp"

#include <iterator>

#include <fmt/format.h>

namespace gltfx::report {
namespace {

constexpr std::string_view kEscapedHash = "\\u0023";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Position of the second '#', from `from` on, of the next "##word[".
std::size_t find_command(std::string_view text, std::size_t from) {
  std::size_t at = text.find("##", from > 0 ? from - 1 : 0);
  for (; at != std::string_view::npos; at = text.find("##", at + 1)) {
    std::size_t word_end = at + 2;
    while (word_end < text.size() && is_letter(text[word_end])) ++word_end;
    if (word_end < text.size() && text[word_end] == '[') return at + 1;
  }
  return std::string_view::npos;
}

void append_json_escape(std::string& out, std::uint32_t value) {
  if (value >= 0x10000) {
    append_json_escape(out, 0xD7C0 + (value >> 10U));
    value = 0xDC00 + (value & 0x3FFU);
  }
  fmt::format_to(std::back_inserter(out), "\\u{:04x}", value);
}

bool is_ascii(std::string_view text) {
  unsigned char all = 0;  // no early exit, so that compilers vectorize the loop
  for (const char c : text) all = static_cast<unsigned char>(all | static_cast<unsigned char>(c));
  return all < 0x80;
}

// Characters that reorder or hide text occur in strings only, where an escape has the same meaning.
std::string without_unprintable(std::string_view json) {
  std::string out;
  for (std::size_t at = 0; at < json.size();) {
    std::size_t other = at;
    while (other < json.size() && static_cast<unsigned char>(json[other]) < 0x80) ++other;
    out += json.substr(at, other - at);
    at = other;
    if (at == json.size()) break;
    const CodePoint point = decode_utf8(json, at);
    const std::string_view bytes = json.substr(at, point.size);
    if (point.valid && printable(bytes) != bytes) {
      append_json_escape(out, point.value);
    } else {
      out += bytes;
    }
    at += point.size;
  }
  return out;
}

}  // namespace

std::string safe(std::string_view text) { return safe_part(text, 0, text.size()); }

std::string safe_part(std::string_view whole, std::size_t begin, std::size_t end) {
  std::string out;
  std::size_t from = begin;
  for (std::size_t at = find_command(whole, begin); at < end; at = find_command(whole, at + 1)) {
    out += printable(whole.substr(from, at - from));
    out += kEscapedHash;
    from = at + 1;
  }
  return out += printable(whole.substr(from, end - from));
}

std::string safe_cut(std::string_view text, std::size_t limit) {
  const std::size_t count = count_code_points(text);
  if (count <= limit) return safe(text);
  const std::size_t head = bytes_of_code_points(text, limit / 2);
  const std::size_t tail = bytes_of_code_points(text, count - (limit - limit / 2));
  return safe_part(text, 0, head) + "…" + safe_part(text, tail, text.size());
}

void defuse_json(std::string& json, std::size_t from) {
  if (!is_ascii(std::string_view(json).substr(from))) {
    json.replace(from, std::string::npos, without_unprintable(std::string_view(json).substr(from)));
  }
  std::size_t at = find_command(json, from);
  if (at == std::string::npos) return;
  std::string out = json.substr(0, from);
  for (; at != std::string::npos; at = find_command(json, at + 1)) {
    out.append(json, from, at - from);
    out += kEscapedHash;
    from = at + 1;
  }
  out.append(json, from);
  json = std::move(out);
}

}  // namespace gltfx::report
