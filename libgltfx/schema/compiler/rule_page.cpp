// SPDX-License-Identifier: Apache-2.0
#include "schema/compiler/rule_page.hpp"

#include <array>
#include <optional>
#include <utility>

namespace gltfx::schema {
namespace {

class Reader {
 public:
  Reader(std::string_view text, std::string& mistake) : rest_(text), mistake_(mistake) {}

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
  // The text up to the next heading, with its lines joined.
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
  // A fenced block, without the fences.
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

 private:
  std::string_view rest_;
  std::string& mistake_;
  int line_ = 0;
};

std::optional<bool> yes_or_no(std::string_view word) {
  if (word == "yes") return true;
  return word == "no" ? std::optional(false) : std::nullopt;
}

std::optional<Fix> fix_from_name(std::string_view word) {
  if (word == "none") return Fix::none;
  if (word == "safe") return Fix::safe;
  if (word == "upgrade") return Fix::upgrade;
  return word == "unsafe" ? std::optional(Fix::unsafe) : std::nullopt;
}

std::optional<Severity> severity_from_word(std::string_view word) {
  constexpr std::array<std::string_view, 4> kNames{"error", "warning", "info", "hint"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (word == kNames[i]) return static_cast<Severity>(i);
  }
  return std::nullopt;
}

template <typename T>
void set(T& member, const std::optional<T>& value, const char* allowed, Reader& reader) {
  if (!value) return reader.fail(std::string("expected one of ") + allowed);
  member = *value;
}

void read_key(RulePage& page, std::string_view key, std::string_view value, Reader& reader) {
  if (key == "severity") {
    set(page.severity, severity_from_word(value), "error, warning, info, hint", reader);
  } else if (key == "khronos") {
    page.khronos_severity = severity_from_word(value);
    const auto khronos = page.khronos_severity ? std::optional(true) : yes_or_no(value);
    set(page.khronos, khronos, "yes, no, or that validator's severity", reader);
  } else if (key == "strict") {
    page.strict_severity = severity_from_word(value);
    if (!page.strict_severity) reader.fail("expected one of error, warning, info, hint");
  } else if (key == "pixels") {
    set(page.pixels, yes_or_no(value), "yes, no", reader);
  } else if (key == "picture") {
    set(page.picture, yes_or_no(value), "yes, no", reader);
  } else if (key == "fix") {
    set(page.fix, fix_from_name(value), "none, safe, unsafe, upgrade", reader);
  } else if (key == "section") {
    page.section = value;
  } else if (key == "link") {
    page.link = value;
  } else {
    reader.fail("expected one of severity, khronos, strict, pixels, picture, fix, section, link");
  }
}

void read_front_matter(RulePage& page, Reader& reader) {
  reader.expect("---");
  for (std::string_view line = reader.line(); line != "---" && !reader.failed();
       line = reader.line()) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string_view::npos) return reader.fail("expected 'key: value' or '---'");
    read_key(page, line.substr(0, colon), line.substr(colon + 2), reader);
  }
  if (page.section.empty() != page.link.empty()) {
    reader.fail("expected section and link, or neither");
  }
}

}  // namespace

RulePage read_rule_page(std::string code, std::string_view text, std::string& mistake) {
  RulePage page;
  page.code = std::move(code);
  Reader reader(text, mistake);
  read_front_matter(page, reader);
  reader.skip_blank_lines();
  reader.expect("# " + page.code);
  reader.skip_blank_lines();
  page.summary = reader.paragraph();
  if (page.summary.find(". ") != std::string::npos) reader.fail("expected one sentence");
  if (!page.summary.empty()) page.summary.pop_back();
  const std::pair<const char*, std::string*> paragraphs[] = {{"## Why it matters", &page.why},
                                                             {"## How to fix it", &page.help}};
  for (const auto& [heading, paragraph] : paragraphs) {
    reader.skip_blank_lines();
    reader.expect(heading);
    *paragraph = reader.paragraph();
  }
  const bool fixes = page.fix == Fix::safe || page.fix == Fix::unsafe;
  if (fixes) {
    reader.skip_blank_lines();
    reader.expect("## What the fix does");
    page.fix_does = reader.paragraph();
  }
  const std::pair<const char*, std::string*> blocks[] = {
      {"## Bad", &page.bad}, {"## Good", &page.good}, {"## Fixed", &page.fixed}};
  for (const auto& [heading, block] : blocks) {
    if (block == &page.fixed && !fixes) break;
    reader.skip_blank_lines();
    reader.expect(heading);
    *block = reader.block();
  }
  reader.skip_blank_lines();
  if (!reader.failed() && !reader.at_end()) reader.fail("expected nothing after the examples");
  return page;
}

}  // namespace gltfx::schema
