// SPDX-License-Identifier: Apache-2.0
#include "schema/compiler/measure_page.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "schema/page_reader.hpp"

namespace gltfx::schema {
namespace {

// The value with that name.
template <class Enum>
Enum value_of(std::string_view (*name_of)(Enum), std::string_view word, PageReader& reader) {
  std::string allowed;
  for (int i = 0;; ++i) {
    const auto value = static_cast<Enum>(i);
    const std::string_view name = name_of(value);
    if (name.empty()) break;
    if (name == word) return value;
    allowed += (allowed.empty() ? "" : ", ") + std::string(name);
  }
  reader.fail("expected one of " + allowed);
  return {};
}

// Calls `use` for each part of "mesh, primitive".
template <class Use>
void each_part(std::string_view list, const Use& use) {
  while (!list.empty()) {
    const std::size_t comma = list.find(", ");
    use(list.substr(0, comma));
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 2);
  }
}

void read_scopes(MeasurePage& page, std::string_view list, PageReader& reader) {
  each_part(list, [&](std::string_view name) {
    const MeasureScope scope = value_of(measure_scope_name, name, reader);
    if (page.on == 0) page.first = scope;
    page.on = static_cast<std::uint16_t>(page.on | 1U << static_cast<unsigned>(scope));
  });
}

void read_key(MeasurePage& page, std::string_view key, std::string_view value, PageReader& reader) {
  if (key == "on") return read_scopes(page, value, reader);
  if (key == "type") {
    page.type = value_of(measure_type_name, value, reader);
  } else if (key == "total") {
    page.total = value_of(measure_total_name, value, reader);
  } else if (key == "needs") {
    page.needs = value_of(measure_needs_name, value, reader);
  } else if (key == "unit") {
    page.unit = value;
  } else if (key == "by") {
    each_part(value, [&](std::string_view name) { page.by.emplace_back(name); });
  } else {
    reader.fail("expected one of on, type, total, needs, unit, by");
  }
}

bool total_fits(const MeasurePage& page) {
  if (page.total == MeasureTotal::none) return true;
  const bool number = page.type == MeasureType::number;
  const bool all = page.total == MeasureTotal::all;
  return all ? page.type == MeasureType::flag : number;
}

}  // namespace

std::string MeasurePage::identifier() const {
  std::string name = stem;
  std::replace(name.begin(), name.end(), '-', '_');
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

std::string MeasurePage::code() const {
  std::string code = "BUDGET_" + identifier();
  std::transform(code.begin(), code.end(), code.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return code;
}

RulePage MeasurePage::rule() const {
  RulePage rule;
  rule.code = code();
  rule.pixels = needs == MeasureNeeds::pixels;
  rule.summary = name() + " is beyond a limit";
  rule.why = definition;
  rule.help = help;
  rule.bad = example;
  rule.good = example;
  return rule;
}

MeasurePage read_measure_page(std::string stem, std::string_view text, std::string& mistake) {
  MeasurePage page;
  page.stem = std::move(stem);
  PageReader reader(text, mistake);
  reader.front_matter(
      [&](std::string_view key, std::string_view value) { read_key(page, key, value, reader); });
  if (page.on == 0 || page.by.empty()) reader.fail("expected 'on' and 'by'");
  if (!total_fits(page)) reader.fail("expected a total that fits the type");
  page.summary = reader.summary_below("# " + page.name());
  page.definition = reader.sentences_below("## Definition");
  page.help = reader.sentences_below("## How to meet a limit");
  page.example = reader.block_below("## Example").text;
  page.values = reader.block_below("## Values").text;
  reader.expect_end();
  return page;
}

}  // namespace gltfx::schema
