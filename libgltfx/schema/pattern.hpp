// SPDX-License-Identifier: Apache-2.0
/// Regular expressions of schema files (the ECMA-262 subset that JSON Schema recommends) that are
/// safe on any text: matching is linear in the text, does not recurse and never throws. (std::regex
/// backtracks on the call stack.)
///
/// Understood: literals, `.`, classes, `\d \w \s` and their complements, escapes, groups, `|`, `* +
/// ?`,
/// `{n}`, `{n,}`, `{n,m}` (lazy forms too: they match the same texts), `^`, `$`. Not understood:
/// look-around, back references, `\b`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"

namespace gltfx::schema {

/// A compiled expression; immutable, so any number of threads may match with it.
class Pattern {
 public:
  /// The program of an expression, or an Error.
  static Result<Pattern> compile(std::string_view expression);

  /// Whether some part of a UTF-8 text matches (expressions are not anchored implicitly). Time is
  /// the length of the text times that of the expression.
  bool matches(std::string_view text) const;

  const std::string& text() const { return text_; }
  /// Number of instructions.
  std::size_t size() const { return program_.size(); }

  enum class Op : std::uint8_t { character, any, set, split, jump, begin, end, match };
  /// Jumps are relative, so that a fragment can be repeated by copying it.
  struct Instruction {
    Op op = Op::match;
    std::int32_t first = 0;   ///< code point, index of a set, or the preferred jump
    std::int32_t second = 0;  ///< split: the other jump
  };
  struct CharacterSet {
    bool negated = false;
    std::vector<std::pair<char32_t, char32_t>> ranges;
    bool contains(char32_t c) const;
  };

 private:
  friend class PatternParser;
  std::string text_;
  std::vector<Instruction> program_;
  std::vector<CharacterSet> sets_;
};

}  // namespace gltfx::schema
