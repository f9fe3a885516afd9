// SPDX-License-Identifier: Apache-2.0
#include "roff.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace gltfx::tool {
namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Escapes characters that roff would interpret or replace.
std::string_view escape(char c) {
  switch (c) {
    case '\\':
      return "\\e";
    case '\'':
      return "\\(aq";
    case '"':
      return "\\(dq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return {};
  }
}

std::string escaped(std::string_view text, std::string_view hyphen) {
  std::string out;
  for (const char c : text) {
    if (c == '-') {
      out.append(hyphen);
    } else if (const std::string_view other = escape(c); !other.empty()) {
      out.append(other);
    } else {
      out.push_back(c);
    }
  }
  return out;
}

// Without hyphenation, if it is one word.
std::string italic(std::string_view text) {
  return fmt::format("\\%\\fI{}\\fR", roff_literal(text));
}

// A line that begins like a request gets a zero-width mark.
std::string safe_line(std::string line) {
  const bool request = line.starts_with('.') || line.starts_with("\\(aq");
  return request ? fmt::format("\\&{}", line) : line;
}

bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && (word[1] == '-' || is_letter(word[1]));
}

// The length of the page name in "gltfx-upgrade(1)".
std::size_t page_name(std::string_view word) {
  const std::size_t open = word.find('(');
  const bool page = word.starts_with("gltfx") && open != std::string_view::npos &&
                    open + 2 < word.size() && word[open + 2] == ')';
  return page ? open : 0;
}

bool is_name(std::string_view word, std::string_view names) {
  if (!std::all_of(word.begin(), word.end(), is_upper)) return false;
  for (std::size_t at = names.find(word); at != std::string_view::npos;
       at = names.find(word, at + 1)) {
    const bool begins = at == 0 || !is_letter(names[at - 1]);
    const std::size_t end = at + word.size();
    if (begins && (end == names.size() || !is_letter(names[end]))) return true;
  }
  return false;
}

// One word without a blank, with the punctuation around it.
std::string prose_word(std::string_view word, std::string_view names) {
  const auto is_inner = [](char c) { return is_word(c) || c == '-'; };
  const auto first =
      static_cast<std::size_t>(std::find_if(word.begin(), word.end(), is_inner) - word.begin());
  const auto behind =
      static_cast<std::size_t>(word.rend() - std::find_if(word.rbegin(), word.rend(), is_inner));
  if (first >= behind) return escaped(word, "-");
  const std::string_view inner = word.substr(first, behind - first);
  const std::string before = escaped(word.substr(0, first), "-");
  const std::string after = escaped(word.substr(behind), "-");
  if (is_option(inner)) return before + roff_bold(inner) + after;
  if (const std::size_t length = page_name(word.substr(first)); length > 0) {
    return before + roff_bold(inner.substr(0, length)) + escaped(word.substr(first + length), "-");
  }
  if (is_name(inner, names)) return before + italic(inner) + after;
  return escaped(word, "-");
}

std::string prose_words(std::string_view text, std::string_view names) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    out.append(prose_word(text.substr(at, end - at), names));
    if (end < text.size()) out.push_back(text[end]);
    at = end + 1;
  }
  return out;
}

// Words on lines of at most 80 columns, one sentence per line.
std::string filled(std::string_view text) {
  constexpr std::size_t kColumns = 80;
  std::string out, line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    if (line.ends_with('.') || line.size() + 1 + word.size() > kColumns) {
      out.append(safe_line(std::exchange(line, {}))).push_back('\n');
    }
    if (!line.empty()) line.push_back(' ');
    line.append(word);
  }
  return out.append(safe_line(line));
}

}  // namespace

std::string roff_literal(std::string_view text) { return escaped(text, "\\-"); }

std::string roff_bold(std::string_view text) {
  return fmt::format("\\%\\fB{}\\fR", roff_literal(text));
}

std::string roff_prose(std::string_view text, std::string_view names) {
  std::string out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t open = std::min(text.find('`', at), text.size());
    out.append(prose_words(text.substr(at, open - at), names));
    if (open == text.size()) break;
    const std::size_t close = std::min(text.find('`', open + 1), text.size());
    out.append(roff_bold(text.substr(open + 1, close - open - 1)));
    at = close + 1;
  }
  return out;
}

std::string roff_value(std::string_view type) {
  std::string out;
  for (std::size_t at = 0; at < type.size();) {
    const bool word = is_word(type[at]);
    std::size_t end = at;
    while (end < type.size() && is_word(type[end]) == word) ++end;
    const std::string_view part = type.substr(at, end - at);
    const bool name = std::any_of(part.begin(), part.end(), is_upper);
    out.append(!word ? roff_literal(part) : name ? italic(part) : roff_bold(part));
    at = end;
  }
  return out;
}

RoffPage::RoffPage(std::string_view name, int section, std::string_view date,
                   std::string_view version) {
  std::string title(name);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  fmt::format_to(std::back_inserter(text_),
                 ".TH {} {} {} \"gltfx {}\" \"gltfx manual\"\n.nh\n.ad l\n", roff_literal(title),
                 section, date, version);
}

void RoffPage::name(std::string_view name, std::string_view summary) {
  section("NAME");
  line(fmt::format("{} \\- {}", roff_literal(name), roff_prose(summary)));
}

void RoffPage::section(std::string_view title) {
  line(fmt::format(".SH {}", title));
  after_title_ = true;
}

void RoffPage::line(std::string_view roff) {
  text_.append(roff).push_back('\n');
  after_title_ = false;
}

void RoffPage::paragraph() {
  if (!after_title_) text_.append(".PP\n");
  after_title_ = false;
}

void RoffPage::prose(std::string_view text, std::string_view names) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find("\n\n"), text.size());
    paragraph();
    line(filled(roff_prose(text.substr(0, end), names)));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
}

void RoffPage::item(std::string_view tag, std::string_view text, std::string_view names) {
  line(".TP");
  line(safe_line(std::string(tag)));
  line(filled(roff_prose(text, names)));
}

void RoffPage::command(std::string_view command, std::string_view text) {
  if (!text.empty()) {
    item(fmt::format("\\fB{}\\fR", roff_literal(command)), text);
    return;
  }
  paragraph();
  line(fmt::format("\\fB{}\\fR", roff_literal(command)));
}

void RoffPage::example(std::string_view text) {
  paragraph();
  line(".EX");
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    line(safe_line(roff_literal(text.substr(0, end))));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  line(".EE");
}

}  // namespace gltfx::tool
