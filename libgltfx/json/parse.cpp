// SPDX-License-Identifier: Apache-2.0
/// The entry point of the parser, and the code that texts without errors rarely reach.
#include "json/parse.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/work_count.hpp"
#include "json/literals.hpp"
#include "json/parser.hpp"
#include "json/scan.hpp"
#include "json/syntax_errors.hpp"

namespace gltfx::json {
namespace {

bool is_closing(char c) { return c == ']' || c == '}'; }

}  // namespace

bool is_recoverable(SyntaxError error) { return error >= SyntaxError::byte_order_mark; }

Parsed parse(SharedText text, const Limits& limits) {
  ++work_count.parsed;
  if (!text) text = share_text({});
  return Parser(std::move(text), limits).run();
}

Parsed parse(std::string_view text, const Limits& limits) {
  return Parser(share_text(std::string(text)), limits).run();
}

Parsed Parser::run() {
  const bool whole = read();
  Parsed parsed;
  if (!whole) nodes_.clear();
  // Reserved memory that was never written costs only addresses: only a large excess is released.
  if (nodes_.size() < nodes_.capacity() / 8) nodes_.shrink_to_fit();
  // Repeated names are found only when their object ends.
  std::stable_sort(errors_.begin(), errors_.end(), [](const ParseError& a, const ParseError& b) {
    return a.span.begin < b.span.begin;
  });
  document_.sort_large();
  parsed.document = std::move(document_);
  parsed.errors = std::move(errors_);
  parsed.unrecorded_errors = unrecorded_;
  return parsed;
}

bool Parser::read() {
  if (text().size() > limits_.bytes) {
    fail({SyntaxError::too_large, {limits_.bytes - 1, limits_.bytes}, "the text is too long", {}});
    return false;
  }
  if (!is_utf8(text())) {
    fail(explain_invalid_utf8(text()));
    return false;
  }
  // Typical assets have a node every 14 bytes (dense) to 30 (indented).
  nodes_.reserve(text().size() / 12 + 16);
  constexpr std::size_t kNames = 40;  // enough for a small asset
  stamps_.reserve(kNames);
  next_keys_.reserve(2 * kNames);
  next_keys_.assign(2, kNoKey);
  return root(byte_order_mark(begin_)) != nullptr;
}

void Parser::reserve_more(const char* p) {
  // Estimates the size of the rest from the part that was read, within limits.
  const std::uint64_t nodes = nodes_.size();
  const std::uint64_t expected = nodes * text().size() / (offset(p) + std::uint64_t{1});
  nodes_.reserve(std::clamp(expected + expected / 16, nodes + nodes / 4 + 16, 2 * nodes + 16));
}

const char* Parser::byte_order_mark(const char* p) {
  if (text().substr(0, 3) != "\xEF\xBB\xBF") return p;
  warn(SyntaxError::byte_order_mark, {0, 3},
       "the text starts with a byte order mark; it must be UTF-8 without one");
  return p + 3;
}

void Parser::warn_if_infinite(Span number) {
  if (!std::isinf(number_value(number.in(text())))) return;
  warn(SyntaxError::number_out_of_range, number, "the number is out of range of a double");
}

const char* Parser::string_with_escapes(const char* quote, const char* p) {
  while (*p == '\\') {
    const Escape escape = read_escape(text().substr(offset(p)));
    if (escape.size == 0) break;
    const char* const behind = p + escape.size;
    if (escape.lone_surrogate) {
      warn(SyntaxError::lone_surrogate, span(p, behind), "unpaired surrogate");
    }
    p = skip_plain_string(behind, end_);
  }
  return *p == '"' ? p + 1 : fail(explain_string(text(), offset(quote), offset(p)));
}

bool Parser::can_follow_without_comma(const char* p) const {
  const Span token = token_at(text(), offset(p));
  if (*p == '"') {
    if (token.size() < 2 || token.in(text()).back() != '"') return false;
    return !frames_.back().is_object || *skip_space(begin_ + token.end, end_) == ':';
  }
  if (frames_.back().is_object) return false;
  const std::string_view word = token.in(text());
  return *p == '{' || *p == '[' || starts_number(*p) || word == "true" || word == "false" ||
         word == "null";
}

// Finds repeats: every name is stamped with the object that has it; a name with the stamp of this
// object is a repeat and replaces the one before it.
void Parser::end_members(NodeId object) {
  const NodeId end = nodes_[object].next;
  std::uint32_t members = 0;
  for (NodeId key = object + 1; key != end; key = nodes_[key + 1].next) {
    ++members;
    Stamp& stamp = stamps_[nodes_[key].next];
    if (stamp.object != object) {
      stamp = {object, key};
      continue;
    }
    warn(SyntaxError::duplicate_key, document_.span(key), "duplicate key; the last value is used",
         document_.span(stamp.key));
    nodes_[stamp.key].hidden = true;
    stamp.key = key;
  }
  if (members >= Document::kManyMembers) document_.sort_members(object);
}

const char* Parser::bad_value(const char* p) {
  if (frames_.empty()) return unexpected(p, Expected::root);
  const bool first = !frames_.back().is_object && is_fresh();
  return unexpected(p, first ? Expected::value_or_bracket : Expected::value);
}

const char* Parser::unexpected(const char* p, Expected expected) {
  return fail(explain_unexpected(text(), offset(p), expected));
}

const char* Parser::too_deep(const char* bracket) {
  return fail(
      {SyntaxError::too_deep, span(bracket, bracket + 1), "the JSON is nested too deeply", {}});
}

const char* Parser::fail(ParseError error) {
  const bool wrong_bracket =
      error.error == SyntaxError::syntax && is_closing(text()[error.span.begin]);
  const bool unclosed = error.error == SyntaxError::unexpected_end && error.other.empty();
  if ((unclosed || wrong_bracket) && !frames_.empty()) {
    const std::uint32_t bracket = nodes_[frames_.back().node].begin;
    error.other = {bracket, bracket + 1};
  }
  errors_.push_back(std::move(error));
  return nullptr;
}

void Parser::warn(SyntaxError error, Span span, std::string_view detail, Span other) {
  if (errors_.size() < limits_.recorded_errors) {
    errors_.push_back({error, span, std::string(detail), other});
  } else {
    ++unrecorded_;
  }
}

}  // namespace gltfx::json
