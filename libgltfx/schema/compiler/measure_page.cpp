// SPDX-License-Identifier: Apache-2.0
#include "schema/compiler/measure_page.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "schema/page_reader.hpp"

namespace gltfx::schema {
namespace {

template <std::size_t N>
std::size_t position(const std::array<std::string_view, N>& names, std::string_view word,
                     PageReader& reader) {
  const auto at = std::find(names.begin(), names.end(), word);
  if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  std::string allowed;
  for (const std::string_view name : names) {
    allowed += (allowed.empty() ? "" : ", ") + std::string(name);
  }
  reader.fail("expected one of " + allowed);
  return 0;
}

constexpr std::array<std::string_view, kMeasureScopeCount> kScopes{
    "asset", "scene", "node", "mesh", "primitive", "material", "image", "skin", "animation"};
constexpr std::array<std::string_view, 4> kTypes{"number", "flag", "text", "set"};
constexpr std::array<std::string_view, 5> kTotals{"none", "sum", "max", "min", "all"};
constexpr std::array<std::string_view, 3> kNeeds{"json", "bytes", "pixels"};

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
    const std::size_t scope = position(kScopes, name, reader);
    if (page.on == 0) page.first = static_cast<MeasureScope>(scope);
    page.on = static_cast<std::uint16_t>(page.on | 1U << scope);
  });
}

void read_key(MeasurePage& page, std::string_view key, std::string_view value, PageReader& reader) {
  if (key == "on") return read_scopes(page, value, reader);
  if (key == "type") {
    page.type = static_cast<MeasureType>(position(kTypes, value, reader));
  } else if (key == "total") {
    page.total = static_cast<MeasureTotal>(position(kTotals, value, reader));
  } else if (key == "needs") {
    page.needs = static_cast<MeasureNeeds>(position(kNeeds, value, reader));
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
