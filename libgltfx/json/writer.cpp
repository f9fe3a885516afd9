// SPDX-License-Identifier: Apache-2.0
#include "json/writer.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "json/scan.hpp"

namespace gltfx::json {
namespace {

constexpr std::string_view kIndent = "  ";

// Characters that need no escape: the others are checked one by one.
bool is_plain(char c) { return c >= 0x20 && c < 0x7F && c != '"' && c != '\\'; }

// High bit of each byte that is not plain; reliable up to and including the first one.
std::uint64_t special_bytes(const char* eight) {
  const std::uint64_t bytes = load8(eight);
  const std::uint64_t beyond_ascii = ((bytes + kOnes) | bytes) & kHighs;  // and DEL
  return string_ends(bytes) | beyond_ascii;
}

// The first byte from `from` on that is not plain.
std::size_t skip_plain(std::string_view text, std::size_t from) {
  std::size_t at = from;
  for (; text.size() - at >= 8; at += 8) {
    const std::uint64_t marks = special_bytes(text.data() + at);
    if (marks != 0) return at + static_cast<std::size_t>(first_marked(marks));
  }
  if (at > from) {  // the last eight bytes, of which the first are plain
    const std::size_t last = text.size() - 8;
    const std::uint64_t marks = special_bytes(text.data() + last);
    return marks != 0 ? last + static_cast<std::size_t>(first_marked(marks)) : text.size();
  }
  while (at < text.size() && is_plain(text[at])) ++at;
  return at;
}

std::string_view short_escape(std::uint32_t c) {
  switch (c) {
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    case '\b':
      return "\\b";
    case '\f':
      return "\\f";
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return {};
  }
}

void append_special(std::string& out, CodePoint point) {
  const std::uint32_t c = point.value;
  if (!point.valid) {
    append_utf8(out, 0xFFFD);
  } else if (const std::string_view escape = short_escape(c); !escape.empty()) {
    out += escape;
  } else if (c < 0xA0 || c == 0x2028 || c == 0x2029) {  // of those that are not plain
    fmt::format_to(std::back_inserter(out), "\\u{:04x}", c);
  } else {
    append_utf8(out, c);
  }
}

std::string_view text_of(const fmt::format_int& digits) { return {digits.data(), digits.size()}; }

}  // namespace

void append_string(std::string& out, std::string_view text) {
  if (skip_plain(text, 0) == text.size()) {  // mostly
    const std::size_t begin = out.size();
    out.resize(begin + text.size() + 2, '"');
    text.copy(out.data() + begin + 1, text.size());
    return;
  }
  out += '"';
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t plain = skip_plain(text, at);
    out += text.substr(at, plain - at);
    at = plain;
    if (at == text.size()) break;
    const CodePoint point = decode_utf8(text, at);
    append_special(out, point);
    at += point.size;
  }
  out += '"';
}

std::string string_value(std::string_view text) {
  std::string json;
  append_string(json, text);
  return json;
}

void Writer::begin_object() { open('{'); }
void Writer::end_object() { close('}'); }
void Writer::begin_array() { open('['); }
void Writer::end_array() { close(']'); }

void Writer::open(char bracket) {
  before_value();
  out_ += bracket;
  has_items_.push_back(0);
  if (pretty_) separator_ += kIndent;
}

void Writer::close(char bracket) {
  const bool had_items = has_items_.back() != 0;
  has_items_.pop_back();
  if (pretty_) separator_.resize(separator_.size() - kIndent.size());
  if (had_items) line_break();
  out_ += bracket;
}

void Writer::line_break() { out_.append(separator_, 1); }

// Writes what precedes a value: nothing after a key, else a comma unless it is the first.
void Writer::before_value() {
  if (after_key_ || has_items_.empty()) {
    after_key_ = false;
    return;
  }
  out_.append(separator_, has_items_.back() != 0 ? 0 : 1);
  has_items_.back() = 1;
}

void Writer::key(std::string_view name) {
  before_value();
  append_string(out_, name);
  out_ += pretty_ ? ": " : ":";
  after_key_ = true;
}

void Writer::string(std::string_view value) {
  before_value();
  append_string(out_, value);
}

void Writer::number(double value) {
  // JSON cannot express NaN and infinities.
  raw(std::isfinite(value) ? number_text(value) : "null");
}

void Writer::integer(std::int64_t value) { raw(text_of(fmt::format_int(value))); }
void Writer::unsigned_integer(std::uint64_t value) { raw(text_of(fmt::format_int(value))); }
void Writer::boolean(bool value) { raw(value ? "true" : "false"); }
void Writer::null() { raw("null"); }

void Writer::raw(std::string_view json) {
  before_value();
  out_ += json;
}

void Writer::member(std::string_view name, std::string_view value) {
  key(name);
  string(value);
}

void Writer::member(std::string_view name, std::uint64_t value) {
  key(name);
  unsigned_integer(value);
}

void Writer::member(std::string_view name, bool value) {
  key(name);
  boolean(value);
}

}  // namespace gltfx::json
