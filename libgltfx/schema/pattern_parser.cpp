// SPDX-License-Identifier: Apache-2.0
// Parses an expression into a program.
#include <algorithm>

#include "base/hex.hpp"
#include "base/text.hpp"
#include "schema/pattern.hpp"

namespace gltfx::schema {
namespace {

using Instruction = Pattern::Instruction;
using Op = Pattern::Op;
using Fragment = std::vector<Instruction>;

constexpr std::size_t kMaxProgram = 5000;  // bounds the size of {n,m} inside {n,m}
constexpr int kMaxNesting = 64;
constexpr std::uint32_t kMaxRepeat = 1000;

std::int32_t length(const Fragment& fragment) { return static_cast<std::int32_t>(fragment.size()); }

void append(Fragment& to, const Fragment& fragment) {
  to.insert(to.end(), fragment.begin(), fragment.end());
}

Fragment either(const Fragment& a, const Fragment& b) {
  Fragment both{{Op::split, 1, length(a) + 2}};
  append(both, a);
  both.push_back({Op::jump, length(b) + 1, 0});
  append(both, b);
  return both;
}

Fragment any_number(const Fragment& a) {
  Fragment loop{{Op::split, 1, length(a) + 2}};
  append(loop, a);
  loop.push_back({Op::jump, -(length(a) + 1), 0});
  return loop;
}

void add_class(Pattern::CharacterSet& set, char name) {
  switch (name) {
    case 'd':
      set.ranges.insert(set.ranges.end(), {{'0', '9'}});
      break;
    case 'w':
      set.ranges.insert(set.ranges.end(), {{'0', '9'}, {'A', 'Z'}, {'_', '_'}, {'a', 'z'}});
      break;
    default:
      set.ranges.insert(set.ranges.end(), {{'\t', '\r'},
                                           {' ', ' '},
                                           {0xA0, 0xA0},
                                           {0x1680, 0x1680},
                                           {0x2000, 0x200A},
                                           {0x2028, 0x2029},
                                           {0x202F, 0x202F},
                                           {0x205F, 0x205F},
                                           {0x3000, 0x3000},
                                           {0xFEFF, 0xFEFF}});
  }
}

// The code points that are not in a set, as ranges.
void add_complement(Pattern::CharacterSet& set, char name) {
  Pattern::CharacterSet positive;
  add_class(positive, name);
  char32_t from = 0;
  for (const auto& [first, last] : positive.ranges) {
    if (first > from) set.ranges.emplace_back(from, first - 1);
    from = last + 1;
  }
  set.ranges.emplace_back(from, 0x10FFFF);
}

bool is_class_name(char c) { return std::string_view("dwsDWS").find(c) != std::string_view::npos; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

/// Recursive descent with a bounded depth.
class PatternParser {
 public:
  explicit PatternParser(std::string_view expression) { pattern_.text_ = expression; }

  Result<Pattern> run() {
    text_ = pattern_.text_;
    pattern_.program_ = alternatives(0);
    if (error_.empty() && at_ < text_.size()) fail("')' without '('");
    if (!error_.empty()) return Error{error_};
    pattern_.program_.push_back({Op::match, 0, 0});
    return std::move(pattern_);
  }

 private:
  bool done() const { return !error_.empty() || at_ >= text_.size(); }
  char peek() const { return text_[at_]; }
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void fail(std::string message) {
    if (error_.empty()) error_ = std::move(message);
  }

  Fragment alternatives(int depth) {
    if (depth > kMaxNesting) {
      fail("groups are nested too deeply");
      return {};
    }
    Fragment all = sequence(depth);
    while (!done() && take('|')) all = checked(either(all, sequence(depth)));
    return all;
  }

  Fragment sequence(int depth) {
    Fragment all;
    while (!done() && peek() != '|' && peek() != ')') append(all, repeated(depth));
    return checked(std::move(all));
  }

  Fragment repeated(int depth) {
    const std::size_t start = at_;
    Fragment one = atom(depth);
    if (done()) return one;
    std::uint32_t least = 1;
    std::uint32_t most = 1;
    if (!quantifier(least, most)) return one;
    take('?');
    if (!done() && std::string_view("*+?").find(peek()) != std::string_view::npos) {
      fail("nothing to repeat");
    }
    if (text_[start] == '^' || text_[start] == '$') fail("nothing to repeat");
    return repeat(one, least, most);
  }

  Fragment repeat(const Fragment& one, std::uint32_t least, std::uint32_t most) {
    const bool endless = most == UINT32_MAX;
    if (one.size() * (endless ? least + 1 : most) > kMaxProgram) {
      fail("the expression has too many repetitions");
      return {};
    }
    Fragment all;
    for (std::uint32_t i = 0; i < least; ++i) append(all, one);
    if (endless) append(all, any_number(one));
    // Each further repeat may jump over itself and all after it.
    const std::int32_t step = length(one) + 1;
    for (std::uint32_t i = least; !endless && i < most; ++i) {
      all.push_back({Op::split, 1, static_cast<std::int32_t>(most - i) * step});
      append(all, one);
    }
    return checked(std::move(all));
  }

  // Reads * + ? {n} {n,} {n,m}; any other brace is a literal.
  bool quantifier(std::uint32_t& least, std::uint32_t& most) {
    if (take('*')) return least = 0, most = UINT32_MAX, true;
    if (take('+')) return most = UINT32_MAX, true;
    if (take('?')) return least = 0, true;
    const std::size_t start = at_;
    if (!take('{')) return false;
    if (count(least)) {
      most = least;
      bool closed = take('}');
      if (!closed && take(','))
        closed = take('}') ? (most = UINT32_MAX, true) : count(most) && take('}');
      if (closed) {
        if (most < least) fail("numbers out of order in {}");
        if (least > kMaxRepeat || (most != UINT32_MAX && most > kMaxRepeat)) {
          fail("the expression has too many repetitions");
        }
        return error_.empty();
      }
    }
    at_ = start;
    least = most = 1;
    return false;
  }

  bool count(std::uint32_t& value) {
    if (done() || !is_digit(peek())) return false;
    value = 0;
    while (!done() && is_digit(peek())) {
      value = std::min(value * 10 + static_cast<std::uint32_t>(text_[at_++] - '0'), kMaxRepeat + 1);
    }
    return true;
  }

  Fragment atom(int depth) {
    const char c = text_[at_];
    switch (c) {
      case '(':
        return group(depth);
      case '[':
        return set();
      case '.':
        return ++at_, Fragment{{Op::any, 0, 0}};
      case '^':
        return ++at_, Fragment{{Op::begin, 0, 0}};
      case '$':
        return ++at_, Fragment{{Op::end, 0, 0}};
      case '\\':
        return ++at_, escape();
      case '*':
      case '+':
      case '?':
        return fail("nothing to repeat"), Fragment{};
      default:
        return literal(code_point());
    }
  }

  Fragment group(int depth) {
    ++at_;
    if (take('?') && !take(':')) {
      fail("look-around and named groups are not supported");
      return {};
    }
    Fragment inside = alternatives(depth + 1);
    if (!take(')')) fail("'(' without ')'");
    return inside;
  }

  static Fragment literal(char32_t c) { return {{Op::character, static_cast<std::int32_t>(c), 0}}; }

  Fragment use_set(Pattern::CharacterSet set) {
    pattern_.sets_.push_back(std::move(set));
    return {{Op::set, static_cast<std::int32_t>(pattern_.sets_.size() - 1), 0}};
  }

  Fragment escape() {
    if (at_ < text_.size() && is_class_name(peek())) {
      Pattern::CharacterSet set;
      add_named(set, text_[at_++]);
      return use_set(std::move(set));
    }
    return literal(escaped_character());
  }

  static void add_named(Pattern::CharacterSet& set, char name) {
    if (name >= 'a') {
      add_class(set, name);
    } else {
      add_complement(set, static_cast<char>(name - 'A' + 'a'));
    }
  }

  char32_t escaped_character() {
    if (at_ >= text_.size()) return fail("'\\' at the end"), 0;
    const char c = text_[at_++];
    constexpr std::string_view kNames = "tnvfr";
    constexpr std::string_view kValues = "\t\n\v\f\r";
    const std::size_t named = kNames.find(c);
    if (named != std::string_view::npos) return static_cast<char32_t>(kValues[named]);
    if (c == 'x' || c == 'u') return hex(c == 'x' ? 2 : 4);
    const bool alphanumeric = is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (alphanumeric) fail(std::string("unknown escape '\\") + c + "'");
    --at_;
    return code_point();
  }

  char32_t hex(int digits) {
    char32_t value = 0;
    for (int i = 0; i < digits; ++i) {
      const int digit = at_ < text_.size() ? hex_value(text_[at_]) : -1;
      if (digit < 0) return fail("too few hexadecimal digits"), 0;
      value = value * 16 + static_cast<char32_t>(digit);
      ++at_;
    }
    return value;
  }

  char32_t code_point() {
    const std::string_view rest = std::string_view(text_).substr(at_);
    const std::size_t bytes = std::max<std::size_t>(1, bytes_of_code_points(rest, 1));
    const auto lead = static_cast<unsigned char>(rest[0]);
    char32_t c = bytes == 1 ? lead : lead & (0x7Fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
      c = (c << 6) | (static_cast<unsigned char>(rest[i]) & 0x3Fu);
    }
    at_ += bytes;
    return c;
  }

  Fragment set() {
    ++at_;
    Pattern::CharacterSet set;
    set.negated = take('^');
    while (!done() && peek() != ']') set_item(set);
    if (!take(']')) fail("'[' without ']'");
    return use_set(std::move(set));
  }

  void set_item(Pattern::CharacterSet& set) {
    if (peek() == '\\' && at_ + 1 < text_.size() && is_class_name(text_[at_ + 1])) {
      add_named(set, text_[at_ + 1]);
      at_ += 2;
      return;
    }
    const char32_t first = set_character();
    char32_t last = first;
    if (at_ + 1 < text_.size() && peek() == '-' && text_[at_ + 1] != ']') {
      ++at_;
      last = set_character();
    }
    if (last < first) fail("range out of order in []");
    set.ranges.emplace_back(first, last);
  }

  char32_t set_character() {
    if (!take('\\')) return code_point();
    if (take('b')) return '\b';
    return escaped_character();
  }

  Fragment checked(const Fragment& fragment) {
    if (fragment.size() > kMaxProgram) fail("the expression is too large");
    return error_.empty() ? fragment : Fragment{};
  }

  Pattern pattern_;
  std::string text_;
  std::size_t at_ = 0;
  std::string error_;
};

Result<Pattern> Pattern::compile(std::string_view expression) {
  return PatternParser(expression).run();
}

}  // namespace gltfx::schema
