// SPDX-License-Identifier: Apache-2.0
/// Manual pages in the macros of man(7), which groff and mandoc read.
#pragma once

#include <string>
#include <string_view>

namespace gltfx::tool {

/// `text` as it stands: nothing of it is taken for a request or an escape, hyphens can be copied.
std::string roff_literal(std::string_view text);

/// The same in bold.
std::string roff_bold(std::string_view text);

/// Prose: words that begin with '-', words in backquotes and names of pages as "gltfx(1)" are bold,
/// words of capitals that stand in `names` ("FILE", "NAME[=FILE]") are italic.
std::string roff_prose(std::string_view text, std::string_view names = {});

/// The value of an option, "NAME[=FILE]": names are italic, words to be typed bold.
std::string roff_value(std::string_view type);

/// A page, from top to bottom.
class RoffPage {
 public:
  /// `name` as in "gltfx-upgrade", `date` as in "2026-11-22".
  RoffPage(std::string_view name, int section, std::string_view date, std::string_view version);

  /// What the page is about: "NAME", with one line.
  void name(std::string_view name, std::string_view summary);
  void section(std::string_view title);
  /// Paragraphs of prose with blank lines between.
  void prose(std::string_view text, std::string_view names = {});
  /// A line in place of prose, which is roff already.
  void line(std::string_view roff);
  /// A tag, which is roff already, with prose beside it.
  void item(std::string_view tag, std::string_view text, std::string_view names = {});
  /// A command line with what it does, which may be empty.
  void command(std::string_view command, std::string_view text);
  /// Lines as they stand, in a type of constant width where there is one.
  void example(std::string_view text);

  const std::string& text() const { return text_; }

 private:
  /// Begins one, unless a title does.
  void paragraph();

  std::string text_;
  bool after_title_ = false;
};

}  // namespace gltfx::tool
