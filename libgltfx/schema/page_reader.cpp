// SPDX-License-Identifier: Apache-2.0
#include "schema/page_reader.hpp"

namespace gltfx::schema {

void PageReader::fail(const std::string& what) {
  if (!failed()) mistake_ = std::to_string(line_) + ": " + what;
}

std::string_view PageReader::line() {
  const std::size_t end = rest_.find('\n');
  const std::string_view text = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++line_;
  return text;
}

void PageReader::expect(std::string_view wanted) {
  if (!failed() && line() != wanted) fail("expected '" + std::string(wanted) + "'");
}

void PageReader::skip_blank_lines() {
  while (!rest_.empty() && rest_.front() == '\n') line();
}

std::string PageReader::paragraph() {
  std::string text;
  skip_blank_lines();
  while (!failed() && !at_end() && rest_.front() != '#') {
    const std::string_view next = line();
    if (!text.empty() && !next.empty()) text += ' ';
    text += next;
  }
  return text;
}

PageBlock PageReader::block() {
  PageBlock block;
  skip_blank_lines();
  const std::string_view open = line();
  const std::size_t ticks = open.find_first_not_of('`');
  if (ticks == std::string_view::npos || ticks < 3) fail("expected ``` and a language");
  if (failed()) return block;
  const std::string_view fence = open.substr(0, ticks);
  block.words = open.substr(ticks);
  block.line = line_ + 1;
  for (std::string_view next = line(); next != fence; next = line()) {
    if (at_end()) fail("expected the end of the fenced block");
    if (failed()) return block;
    if (!block.text.empty()) block.text += '\n';
    block.text += next;
  }
  if (block.text.empty()) fail("expected an example");
  return block;
}

std::string PageReader::section(std::string_view heading) {
  skip_blank_lines();
  expect(heading);
  return paragraph();
}

std::string PageReader::sentences_below(std::string_view heading) {
  std::string text = section(heading);
  if (text.empty() || text.back() != '.') fail("expected a paragraph that ends with a full stop");
  return text;
}

std::string PageReader::summary_below(std::string_view heading) {
  std::string text = sentences_below(heading);
  if (text.find(". ") != std::string::npos) fail("expected one sentence");
  if (!text.empty()) text.pop_back();
  return text;
}

void PageReader::expect_end() {
  skip_blank_lines();
  if (!failed() && !at_end()) fail("expected nothing after the examples");
}

PageBlock PageReader::block_below(std::string_view heading) {
  skip_blank_lines();
  expect(heading);
  return block();
}

}  // namespace gltfx::schema
