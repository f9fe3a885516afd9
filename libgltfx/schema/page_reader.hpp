// SPDX-License-Identifier: Apache-2.0
/// Pages of schema/ and of users: front matter, headings, paragraphs and fenced blocks.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace gltfx::schema {

/// A fenced block.
struct PageBlock {
  std::string text;   ///< without the fences
  std::string words;  ///< after the opening fence: "json"
  int line = 0;       ///< of the first line of `text`, from 1
};

/// Reads a page from its start. After the first mistake, nothing more is read.
class PageReader {
 public:
  /// `mistake`: empty, or "line: mistake" with the expectation.
  PageReader(std::string_view text, std::string& mistake) : rest_(text), mistake_(mistake) {}

  bool failed() const { return !mistake_.empty(); }
  bool at_end() const { return rest_.empty(); }
  /// The line that was read last, from 1.
  int line_number() const { return line_; }

  /// A mistake in the line that was read last.
  void fail(const std::string& what);
  std::string_view line();
  void expect(std::string_view wanted);
  void skip_blank_lines();
  /// The text up to the next heading, with its lines joined.
  std::string paragraph();
  PageBlock block();
  /// A heading and its paragraph.
  std::string section(std::string_view heading);
  /// The same, which ends with a full stop.
  std::string sentences_below(std::string_view heading);
  /// The same with one sentence, without its full stop.
  std::string summary_below(std::string_view heading);
  /// A mistake if there is more text.
  void expect_end();
  /// A heading and its block.
  PageBlock block_below(std::string_view heading);
  /// Calls `use` with key and value of each line between "---" and "---".
  template <class Use>
  void front_matter(const Use& use) {
    expect("---");
    for (std::string_view next = line(); next != "---" && !failed(); next = line()) {
      const std::size_t colon = next.find(": ");
      if (colon == std::string_view::npos) return fail("expected 'key: value' or '---'");
      use(next.substr(0, colon), next.substr(colon + 2));
    }
  }

 private:
  std::string_view rest_;
  std::string& mistake_;
  int line_ = 0;
};

}  // namespace gltfx::schema
