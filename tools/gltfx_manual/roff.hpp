// SPDX-License-Identifier: Apache-2.0
/// Manual pages in the macros of man(7), which groff and mandoc read.
#pragma once

#include <string>
#include <string_view>

namespace gltfx::tool {

/// `text` literally: without requests and escapes, and with hyphens that can be copied.
std::string roff_literal(std::string_view text);

/// The same in bold.
std::string roff_bold(std::string_view text);

/// Prose: words that begin with '-', words in backquotes and names of pages as "gltfx(1)" are bold,
/// words of capitals that are in `names` ("FILE", "NAME[=FILE]") are italic.
std::string roff_prose(std::string_view text, std::string_view names = {});

/// The value of an option, "NAME[=FILE]": names are italic, literal words bold.
std::string roff_value(std::string_view type);

/// A page, from top to bottom.
class RoffPage {
 public:
  /// `name` as in "gltfx-upgrade", `date` as in "2026-11-22".
  RoffPage(std::string_view name, int section, std::string_view date, std::string_view version);

  /// The section "NAME", with one line.
  void name(std::string_view name, std::string_view summary);
  void section(std::string_view title);
  /// Paragraphs of prose, separated by blank lines.
  void prose(std::string_view text, std::string_view names = {});
  /// A line of roff instead of prose.
  void line(std::string_view roff);
  /// A tag in roff, with prose beside it.
  void item(std::string_view tag, std::string_view text, std::string_view names = {});
  /// A command line with its effect, which may be empty.
  void command(std::string_view command, std::string_view text);
  /// Literal lines, in a fixed-width font if there is one.
  void example(std::string_view text);

  const std::string& text() const { return text_; }

 private:
  /// Begins a paragraph, unless a title does.
  void paragraph();

  std::string text_;
  bool after_title_ = false;
};

}  // namespace gltfx::tool
