// SPDX-License-Identifier: Apache-2.0
// The options of `gltfx compare`.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "configuration.hpp"
#include "option_parts.hpp"
#include "option_values.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {
namespace {

/// A bound with its unit.
struct BoundRow {
  std::string_view name;
  std::string_view unit;  ///< empty: a plain number or a fraction
  double factor;          ///< from the unit to the stored value
  std::string_view example;
  double CompareBounds::*member;
};

constexpr double kPercent = 0.01;
constexpr std::array<BoundRow, 8> kBounds{{
    {"position", "%", kPercent, "0.01%", &CompareBounds::position},
    {"normal", "deg", 1, "0.5deg", &CompareBounds::normal},
    {"texcoord", "texel", 1, "0.25texel", &CompareBounds::texcoord},
    {"color", "", 1, "0.5/255", &CompareBounds::color},
    {"weight", "%", kPercent, "0.05%", &CompareBounds::weight},
    {"animation", "%", kPercent, "0.01%", &CompareBounds::animation},
    {"factor", "", 1, "0.5/255", &CompareBounds::factor},
    {"image", "", 1, "1/255", &CompareBounds::image},
}};

std::optional<double> read_positive(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = read_double(text.data(), end, value);
  const bool whole = read.ec == std::errc() && read.ptr == end;
  return whole && std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

std::optional<double> read_bound(const BoundRow& row, std::string_view text) {
  if (!row.unit.empty()) {
    if (!text.ends_with(row.unit)) return std::nullopt;
    text.remove_suffix(row.unit.size());
    const auto value = read_positive(text);
    return value ? std::optional(*value * row.factor) : std::nullopt;
  }
  const std::size_t slash = text.find('/');
  const auto above = read_positive(text.substr(0, slash));
  if (!above || slash == std::string_view::npos) return above;
  const auto below = read_positive(text.substr(slash + 1));
  return below ? std::optional(*above / *below) : std::nullopt;
}

std::optional<Error> read_item(std::string_view option, std::string_view item,
                               CompareBounds& bounds) {
  const std::size_t equals = std::min(item.find('='), item.size());
  const std::string_view name = item.substr(0, equals);
  std::vector<std::string_view> names;
  for (const BoundRow& row : kBounds) {
    names.push_back(row.name);
    if (row.name != name) continue;
    const auto value =
        equals < item.size() ? read_bound(row, item.substr(equals + 1)) : std::optional<double>();
    if (!value) {
      return Error{fmt::format("{}: {} is no bound of {}; write {}={}.", option,
                               gltfx::quoted(item), name, name, row.example)};
    }
    bounds.*row.member = *value;
    return std::nullopt;
  }
  return unknown_word(option, name, names);
}

// "position=0.1%,normal=2deg". The others keep their defaults.
Result<CompareBounds> parse_compare_bounds(std::string_view option, std::string_view text) {
  CompareBounds bounds;
  if (text == kNoValue) return bounds;
  while (true) {
    const std::size_t comma = text.find(',');
    if (auto mistake = read_item(option, text.substr(0, comma), bounds)) return *std::move(mistake);
    if (comma == std::string_view::npos) return bounds;
    text.remove_prefix(comma + 1);
  }
}

using Kinds = std::set<std::string, std::less<>>;

Result<Kinds> parse_kinds(std::string_view option, const Words& words) {
  Kinds kinds;
  for (const std::string& word : words) {
    if (find_change_kind(word) == nullptr) {
      std::vector<std::string_view> names;
      for (const ChangeKind& kind : change_kinds()) names.push_back(kind.name);
      return unknown_word(option, word, names);
    }
    kinds.insert(word);
  }
  return kinds;
}

Values kind_values() {
  Values values;
  for (const ChangeKind& kind : change_kinds()) values.words.words.emplace_back(kind.name);
  values.words.name = "kinds";
  return values;
}

}  // namespace

void declare_compare(Options& options, CompareRequest& request) {
  CompareOptions& compare = request.compare;
  options.positional("OLD NEW", "Two files, or two folders, paired by path",
                     list(request.paths, values::assets));
  options.add("--allow", "LEVEL", "Exit 0 up to identical, storage, bounds or differs",
              one_of(request.allow, {{"identical", CompareLevel::identical},
                                     {"storage", CompareLevel::storage},
                                     {"bounds", CompareLevel::bounds},
                                     {"differs", CompareLevel::differs}}));
  options.add("--bounds", "[LIST]", "Allow bounds; change some: position=0.1%,normal=2deg",
              parsed(compare.bounds, parse_compare_bounds));
  options.add("--drawn", "", "Count only what is drawn: no names, no extras", flag(compare.drawn));
  options.add("--ignore", "KIND", "Do not count this kind of change (repeatable)",
              parsed_list(compare.ignore, parse_kinds, kind_values));
  options.add("--count", "KIND", "Count this kind, such as generator (repeatable)",
              parsed_list(compare.count, parse_kinds, kind_values));
  options.add("--format", "NAME", "text (default), json, markdown",
              one_of(request.format, {{"text", CompareFormat::text},
                                      {"json", CompareFormat::json},
                                      {"markdown", CompareFormat::markdown}}));
  options.add("--all", "", "List all changes, not only the first 40", flag(request.all));
  add_root(options, compare.root);
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_configuration(options);
  add_decoders(options, request.common);
  add_common(options, request.common);
}

void read_compare(Reading& reading, CompareRequest& request) {
  reading.require(reading.options().arguments().words.size() == 2,
                  "compare: name two assets, or two folders: OLD NEW.");
  reading.require_files("compare");
  reading.read();
  request.has_bounds = reading.options().given("--bounds");
}

}  // namespace gltfx::tool
