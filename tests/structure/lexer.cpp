// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <string>
#include <unordered_map>

#include "source.hpp"

namespace gltfx::structure {
namespace {

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  Lexed run() {
    while (at_ < text_.size()) step();
    return std::move(lexed_);
  }

 private:
  void step() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("//")) return blank(std::min(text_.find('\n', at_), text_.size()));
    if (rest.starts_with("/*")) return blank(after(text_.find("*/", at_ + 2), 2));
    if (rest.starts_with("R\"") && (at_ == 0 || !is_part_of_name(text_[at_ - 1])))
      return raw_literal();
    if (rest.front() == '"') return quoted('"', true);
    const bool separator = at_ > 0 && is_part_of_name(text_[at_ - 1]);
    if (rest.front() == '\'' && !separator) return quoted('\'', false);
    lexed_.code += text_[at_++];
  }

  std::size_t after(std::size_t found, std::size_t length) const {
    return found == std::string_view::npos ? text_.size() : found + length;
  }

  // Copies line breaks, and blanks for skipped text.
  void blank(std::size_t end) {
    for (; at_ < end; ++at_) lexed_.code += text_[at_] == '\n' ? '\n' : ' ';
  }

  void raw_literal() {
    const std::size_t open = std::min(text_.find('(', at_), text_.size());
    std::string close(1, ')');
    close.append(text_.substr(at_ + 2, open - at_ - 2)).append(1, '"');
    const std::size_t end = std::min(text_.find(close, open), text_.size());
    lexed_.literals.push_back(
        {line_of(text_, at_), std::string(text_.substr(open + 1, end - open - 1)), true});
    blank(std::min(end + close.size(), text_.size()));
  }

  void quoted(char quote, bool keep) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote && text_[end] != '\n') {
      end += text_[end] == '\\' ? 2 : 1;
    }
    if (keep) {
      lexed_.literals.push_back(
          {line_of(text_, at_), std::string(text_.substr(at_ + 1, end - at_ - 1)), false});
    }
    blank(std::min(end + 1, text_.size()));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Lexed lexed_;
};

bool has_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !is_part_of_name(text[at - 1]);
    const bool ends = at + word.size() >= text.size() || !is_part_of_name(text[at + word.size()]);
    if (begins && ends) return true;
  }
  return false;
}

enum class Scope { outer, function, inner };

// The kind of a brace, from the text between the last ';', '{' or '}' and it.
Scope scope_of(std::string_view header, bool in_function) {
  if (in_function) return Scope::inner;
  if (has_word(header, "namespace")) return Scope::outer;
  const std::size_t last = header.find_last_not_of(" \n");
  if (last != std::string_view::npos && header[last] == '=') return Scope::inner;
  // An initialiser list of a constructor: `: value_{0}`; clang-format puts a space before bodies.
  if (!header.empty() && header.back() != ' ' && header.back() != '\n') return Scope::inner;
  if (header.find('(') != std::string_view::npos) return Scope::function;
  return Scope::outer;
}

class FunctionFinder {
 public:
  explicit FunctionFinder(std::string_view code) : code_(code) {}

  std::vector<Function> run() {
    for (at_ = 0; at_ < code_.size(); ++at_) {
      if (code_[at_] == '{') open();
      if (code_[at_] == '}') close();
      const bool ends = code_[at_] == ';' || (code_[at_] == ':' && after_access_word());
      if (ends && !in_function()) begin_ = at_ + 1;
    }
    return std::move(functions_);
  }

 private:
  struct Open {
    Scope scope;
    std::size_t begin;  ///< where the header began
  };

  bool in_function() const {
    return std::any_of(open_.begin(), open_.end(),
                       [](const Open& open) { return open.scope != Scope::outer; });
  }

  bool after_access_word() const {
    const std::string_view before = code_.substr(0, at_);
    return before.ends_with("public") || before.ends_with("private") ||
           before.ends_with("protected");
  }

  void open() {
    const Scope scope = scope_of(code_.substr(begin_, at_ - begin_), in_function());
    open_.push_back({scope, begin_});
    if (scope == Scope::outer) begin_ = at_ + 1;
  }

  void close() {
    if (open_.empty()) return;
    const Open opened = open_.back();
    open_.pop_back();
    if (opened.scope == Scope::inner) return;
    if (opened.scope == Scope::function) {
      const std::size_t first = code_.find_first_not_of(" \n", opened.begin);
      const std::size_t line = line_of(code_, first);
      functions_.push_back({line, line_of(code_, at_) - line + 1});
    }
    begin_ = at_ + 1;
  }

  std::string_view code_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;
  std::vector<Open> open_;
  std::vector<Function> functions_;
};

// Preprocessor lines would run into the headers of what follows.
void blank_directives(std::string& code) {
  bool at_line_start = true;
  bool directive = false;
  for (char& c : code) {
    if (at_line_start && c == '#') directive = true;
    at_line_start = c == '\n';
    if (at_line_start) directive = false;
    if (directive) c = ' ';
  }
}

}  // namespace

bool is_part_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

const Lexed& lex(std::string_view text) {
  static std::unordered_map<std::string, Lexed> known;
  const auto [place, is_new] = known.try_emplace(std::string(text));
  if (is_new) place->second = Lexer(text).run();
  return place->second;
}

std::vector<Function> functions_of(std::string_view text) {
  Lexed lexed = lex(text);
  blank_directives(lexed.code);
  return FunctionFinder(lexed.code).run();
}

}  // namespace gltfx::structure
