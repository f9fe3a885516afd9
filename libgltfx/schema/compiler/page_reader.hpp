// SPDX-License-Identifier: Apache-2.0
/// Reads pages: front matter, headings, paragraphs, fenced blocks.
#pragma once

#include <string>
#include <string_view>

namespace gltfx::schema {

/// After the first mistake, everything that it reads is empty.
class PageReader {
 public:
  PageReader(std::string_view text, std::string& mistake) : rest_(text), mistake_(mistake) {}

  bool failed() const { return !mistake_.empty(); }
  bool at_end() const { return rest_.empty(); }

  void fail(const std::string& what) {
    if (!failed()) mistake_ = std::to_string(line_) + ": " + what;
  }
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return text;
  }
  void expect(std::string_view wanted) {
    if (!failed() && line() != wanted) fail("expected '" + std::string(wanted) + "'");
  }
  void skip_blank_lines() {
    while (!rest_.empty() && rest_.front() == '\n') line();
  }
  /// The text up to the next heading, with its lines joined.
  std::string paragraph() {
    std::string text;
    skip_blank_lines();
    while (!failed() && !at_end() && rest_.front() != '#') {
      const std::string_view next = line();
      if (!text.empty() && !next.empty()) text += ' ';
      text += next;
    }
    if (text.empty() || text.back() != '.') fail("expected a paragraph that ends with a full stop");
    return text;
  }
  /// A fenced block, without the fences.
  std::string block() {
    skip_blank_lines();
    const std::string_view open = line();
    const std::size_t ticks = open.find_first_not_of('`');
    if (ticks == std::string_view::npos || ticks < 3) fail("expected ``` and a language");
    if (failed()) return {};
    const std::string_view fence = open.substr(0, ticks);
    std::string text;
    for (std::string_view next = line(); next != fence; next = line()) {
      if (at_end()) fail("expected the end of the fenced block");
      if (failed()) return {};
      if (!text.empty()) text += '\n';
      text += next;
    }
    if (text.empty()) fail("expected an example");
    return text;
  }

  /// Calls `use(key, value)` for each line "key: value" between the two lines "---".
  template <class Use>
  void front_matter(const Use& use) {
    expect("---");
    for (std::string_view next = line(); next != "---" && !failed(); next = line()) {
      const std::size_t colon = next.find(": ");
      if (colon == std::string_view::npos) return fail("expected 'key: value' or '---'");
      use(next.substr(0, colon), next.substr(colon + 2));
    }
  }
  /// One sentence, without its full stop.
  std::string summary_below(const std::string& heading) {
    std::string text = paragraph_below(heading);
    if (text.find(". ") != std::string::npos) fail("expected one sentence");
    if (!text.empty()) text.pop_back();
    return text;
  }
  std::string paragraph_below(const std::string& heading) {
    skip_blank_lines();
    expect(heading);
    return paragraph();
  }
  std::string block_below(const std::string& heading) {
    skip_blank_lines();
    expect(heading);
    return block();
  }
  void expect_end() {
    skip_blank_lines();
    if (!failed() && !at_end()) fail("expected nothing after the examples");
  }

 private:
  std::string_view rest_;
  std::string& mistake_;
  int line_ = 0;
};

}  // namespace gltfx::schema
