// SPDX-License-Identifier: Apache-2.0
// Thompson's simulation: all paths through the program advance together, one code point at a time.
#include "schema/pattern.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gltfx::schema {
namespace {

using Instruction = Pattern::Instruction;
using Op = Pattern::Op;

// Most programs are short: no allocation for each text.
constexpr std::size_t kShort = 64;
using Positions = fmt::basic_memory_buffer<std::int32_t, kShort>;

// The code point at `at`, which is advanced. A byte that is not UTF-8 counts as a code point.
char32_t next_code_point(std::string_view text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at++]);
  const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
  if (more == 0 || at + static_cast<std::size_t>(more) > text.size()) return lead;
  char32_t c = lead & (0x3Fu >> more);
  for (int i = 0; i < more; ++i) {
    c = (c << 6) | (static_cast<unsigned char>(text[at++]) & 0x3Fu);
  }
  return c;
}

// Positions in the program that are reached without input, each once.
class Threads {
 public:
  explicit Threads(std::size_t size) {
    seen_.resize(size);
    std::fill(seen_.begin(), seen_.end(), char{0});
  }

  void clear() {
    for (const std::int32_t at : visited_) seen_[static_cast<std::size_t>(at)] = 0;
    visited_.clear();
    waiting_.clear();
  }

  // Adds `start` and its closure; true when that includes the program's end.
  bool add(const std::vector<Instruction>& program, std::int32_t start, bool at_begin,
           bool at_end) {
    stack_.push_back(start);
    bool matched = false;
    while (stack_.size() > 0) {
      const std::int32_t at = stack_[stack_.size() - 1];
      stack_.resize(stack_.size() - 1);
      if (seen_[static_cast<std::size_t>(at)] != 0) continue;
      seen_[static_cast<std::size_t>(at)] = 1;
      visited_.push_back(at);
      matched |= follow(program[static_cast<std::size_t>(at)], at, at_begin, at_end);
    }
    return matched;
  }

  const Positions& waiting() const { return waiting_; }

 private:
  bool follow(const Instruction& step, std::int32_t at, bool at_begin, bool at_end) {
    switch (step.op) {
      case Op::match:
        return true;
      case Op::split:
        stack_.push_back(at + step.second);
        [[fallthrough]];
      case Op::jump:
        stack_.push_back(at + step.first);
        break;
      case Op::begin:
        if (at_begin) stack_.push_back(at + 1);
        break;
      case Op::end:
        if (at_end) stack_.push_back(at + 1);
        break;
      default:
        waiting_.push_back(at);
    }
    return false;
  }

  fmt::basic_memory_buffer<char, kShort> seen_;
  Positions visited_, waiting_, stack_;
};

bool is_line_end(char32_t c) { return c == '\n' || c == '\r' || c == 0x2028 || c == 0x2029; }

}  // namespace

bool Pattern::CharacterSet::contains(char32_t c) const {
  const bool inside = std::any_of(ranges.begin(), ranges.end(), [c](const auto& range) {
    return c >= range.first && c <= range.second;
  });
  return inside != negated;
}

bool Pattern::matches(std::string_view text) const {
  Threads threads[2]{Threads(program_.size()), Threads(program_.size())};
  Threads* now = &threads[0];
  Threads* then = &threads[1];
  if (now->add(program_, 0, true, text.empty())) return true;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = next_code_point(text, at);
    const bool at_end = at == text.size();
    then->clear();
    for (const std::int32_t place : now->waiting()) {
      const Instruction& step = program_[static_cast<std::size_t>(place)];
      const bool takes = step.op == Op::any ? !is_line_end(c)
                         : step.op == Op::set
                             ? sets_[static_cast<std::size_t>(step.first)].contains(c)
                             : c == static_cast<char32_t>(step.first);
      if (takes && then->add(program_, place + 1, false, at_end)) return true;
    }
    if (then->add(program_, 0, false, at_end)) return true;  // the match may start later
    std::swap(now, then);
  }
  return false;
}

}  // namespace gltfx::schema
