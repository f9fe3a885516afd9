// SPDX-License-Identifier: Apache-2.0
#include "schema/compiler/rule_page.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "schema/page_reader.hpp"

namespace gltfx::schema {
namespace {

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
void set(T& member, const std::optional<T>& value, const char* allowed, PageReader& reader) {
  if (!value) return reader.fail(std::string("expected one of ") + allowed);
  member = *value;
}

void read_key(RulePage& page, std::string_view key, std::string_view value, PageReader& reader) {
  if (key == "severity") {
    set(page.severity, severity_from_word(value), "error, warning, info, hint", reader);
  } else if (key == "khronos") {
    page.khronos_severity = severity_from_word(value);
    const auto khronos = page.khronos_severity ? std::optional(true) : yes_or_no(value);
    set(page.khronos, khronos, "yes, no, or that validator's severity", reader);
  } else if (key == "strict") {
    page.strict_severity = severity_from_word(value);
    if (!page.strict_severity) reader.fail("expected one of error, warning, info, hint");
  } else if (key == "later") {
    const std::size_t space = std::min(value.find(' '), value.size());
    page.later_version = value.substr(0, space);
    page.later_severity = value.substr(std::min(space + 1, value.size()));
    const bool known = page.later_severity == "none" || severity_from_word(page.later_severity);
    const bool version = std::count(page.later_version.begin(), page.later_version.end(), '.') == 1;
    if (!known || !version) reader.fail("expected a version and a severity or none: 2.1 warning");
  } else if (key == "pixels") {
    set(page.pixels, yes_or_no(value), "yes, no", reader);
  } else if (key == "picture") {
    set(page.picture, yes_or_no(value), "yes, no", reader);
  } else if (key == "fix") {
    set(page.fix, fix_from_name(value), "none, safe, unsafe, upgrade", reader);
  } else if (key == "group") {
    if (value != "shows") reader.fail("expected shows");
    page.group = value;
  } else if (key == "section") {
    page.section = value;
  } else if (key == "link") {
    page.link = value;
  } else {
    reader.fail(
        "expected one of severity, khronos, strict, later, pixels, picture, fix, group, section, "
        "link");
  }
}

void read_front_matter(RulePage& page, PageReader& reader) {
  reader.front_matter(
      [&](std::string_view key, std::string_view value) { read_key(page, key, value, reader); });
  if (page.section.empty() != page.link.empty()) {
    reader.fail("expected section and link, or neither");
  }
}

}  // namespace

RulePage read_rule_page(std::string code, std::string_view text, std::string& mistake) {
  RulePage page;
  page.code = std::move(code);
  PageReader reader(text, mistake);
  read_front_matter(page, reader);
  page.summary = reader.summary_below("# " + page.code);
  page.why = reader.sentences_below("## Why it matters");
  page.help = reader.sentences_below("## How to fix it");
  const bool fixes = page.fix == Fix::safe || page.fix == Fix::unsafe;
  if (fixes) page.fix_does = reader.sentences_below("## What the fix does");
  page.bad = reader.block_below("## Bad").text;
  page.good = reader.block_below("## Good").text;
  if (fixes) page.fixed = reader.block_below("## Fixed").text;
  reader.expect_end();
  return page;
}

}  // namespace gltfx::schema
