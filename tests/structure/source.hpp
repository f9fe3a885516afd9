// SPDX-License-Identifier: Apache-2.0
/// Source files as text, and a minimal C++ lexer.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx::structure {

/// A file of the repository; `path` is relative to its root, with forward slashes.
struct Source {
  std::string path;
  std::string text;
};

/// The problems of a check, one line each: "path:line: why".
using Problems = std::vector<std::string>;

/// Root of the repository.
std::string repository();

/// All files below the folders (or the files themselves), sorted; build output is left out.
std::vector<Source> files_below(const std::vector<std::string>& roots);
/// Of those, the C++ files.
std::vector<Source> cpp_below(const std::vector<std::string>& roots);

/// One `#include` line.
struct Include {
  std::size_t line = 0;  ///< from 1
  std::string name;      ///< without brackets or quotes
  bool angled = false;
};
std::vector<Include> includes_of(std::string_view text);

/// A string literal; of adjoining literals each is one.
struct Literal {
  std::size_t line = 0;
  std::string text;  ///< as written, without quotes
  bool raw = false;
};

/// C++ text taken apart. `code` has the line breaks and columns of the original, but comments and
/// the content of literals are blanks.
struct Lexed {
  std::string code;
  std::vector<Literal> literals;
};
/// Each text is taken apart once, and kept.
const Lexed& lex(std::string_view text);

/// Whether an identifier may have the character.
bool is_part_of_name(char c);

/// A function definition with a body.
struct Function {
  std::size_t line = 0;   ///< from 1, where its declaration begins
  std::size_t lines = 0;  ///< to its closing brace
};
/// Functions of clang-formatted code, found by their braces; lambdas belong to the enclosing
/// function.
std::vector<Function> functions_of(std::string_view text);

/// Line of a position in a text, from 1.
std::size_t line_of(std::string_view text, std::size_t at);
std::size_t line_count(std::string_view text);

/// "path:line: why".
std::string problem(const Source& source, std::size_t line, std::string_view why);

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& starts);

}  // namespace gltfx::structure
