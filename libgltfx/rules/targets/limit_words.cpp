// SPDX-License-Identifier: Apache-2.0
#include "rules/targets/limit_words.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "measure/quantity.hpp"

namespace gltfx::validate {
namespace {

// What a measure counts, if its name does not say it.
struct Counted {
  std::string_view name, many, one;
};
constexpr std::array<Counted, 9> kCounted{{
    {"children", "children", "child"},
    {"double-sided-materials", "double-sided materials", "double-sided material"},
    {"non-manifold-edges", "non-manifold edges", "non-manifold edge"},
    {"non-manifold-vertices", "non-manifold vertices", "non-manifold vertex"},
    {"unnamed", "objects without a name", "object without a name"},
    {"uv-degenerate", "triangles without an area in the texture",
     "triangle without an area in the texture"},
    {"uv-inverted", "mirrored triangles", "mirrored triangle"},
    {"uv-outside", "triangles outside the texture", "triangle outside the texture"},
    {"uv-overlap", "triangles that overlap in the texture",
     "triangle that overlaps in the texture"},
}};

const Counted* find_counted(std::string_view name) {
  const auto found = std::find_if(kCounted.begin(), kCounted.end(),
                                  [&](const Counted& each) { return each.name == name; });
  return found == kCounted.end() ? nullptr : &*found;
}

// Names of counts, and of amounts such as "gpu-bytes", are plural.
bool is_plural(const MeasureDescription& measure) { return measure.name.ends_with('s'); }

// Whether a measure counts things, so that an element has so many of them.
bool is_count(const MeasureDescription& measure) {
  if (measure.type != MeasureType::number || !measure.unit.empty()) return false;
  const bool ratio = measure.name == "cache-misses";
  return (is_plural(measure) && !ratio) || find_counted(measure.name) != nullptr;
}

// "uv-sets": "UV sets", of one "UV set".
std::string things(std::string_view name, bool one) {
  if (const Counted* counted = find_counted(name)) {
    return std::string(one ? counted->one : counted->many);
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kSingular{
      {{"vertices", "vertex"}, {"meshes", "mesh"}}};
  std::string words(name);
  std::replace(words.begin(), words.end(), '-', ' ');
  if (words.starts_with("uv ")) words.replace(0, 2, "UV");
  if (!one) return words;
  for (const auto& [many, single] : kSingular) {
    if (!words.ends_with(many)) continue;
    return words.replace(words.size() - many.size(), many.size(), single);
  }
  words.pop_back();
  return words;
}

std::string source_of(const Limit& limit) {
  if (limit.from.empty() && limit.note.empty()) return {};
  const char* const between = limit.from.empty() || limit.note.empty() ? "" : ": ";
  return fmt::format(" ({}{}{})", printable(limit.from), between, printable(limit.note));
}

// Both numbers with as many digits as it takes to tell them apart.
std::pair<std::string, std::string> two_numbers(double value, double limit, std::string_view unit) {
  std::pair<std::string, std::string> words{measure::quantity_words(value, unit),
                                            measure::quantity_words(limit, unit)};
  if (words.first != words.second) return words;
  const std::string behind = unit.empty() ? std::string() : fmt::format(" {}", unit);
  return {number_text(value) + behind, number_text(limit) + behind};
}

// "The mesh has". Of the asset: where its value is that of one element, "A mesh of the asset has".
std::string holder(const Limit& limit, const Measured& of) {
  if (limit.on != MeasureScope::asset || limit.measure->total != MeasureTotal::max) {
    return fmt::format("The {} {}", of.noun, of.plural ? "have" : "has");
  }
  const std::string_view element = measure_scope_name(limit.measure->first);
  const bool vowel = std::string_view("ai").find(element.front()) != std::string_view::npos;
  return fmt::format("{} {} of the {} has", vowel ? "An" : "A", element, of.noun);
}

std::string broken_number(const Limit& limit, const Measured& of, double value) {
  const bool count = is_count(*limit.measure);
  const auto [found, wanted] =
      two_numbers(value, limit.number, count ? std::string_view() : limit.measure->unit);
  std::string text = count ? fmt::format("{} {} {}", holder(limit, of), found,
                                         things(limit.measure->name, value == 1))
                           : fmt::format("The {} of the {} {} {}", limit.measure->name, of.noun,
                                         is_plural(*limit.measure) ? "are" : "is", found);
  const std::string_view what = limit.op == LimitOp::max   ? "the limit is"
                                : limit.op == LimitOp::min ? "the minimum is"
                                                           : "it must be";
  if (count && limit.op == LimitOp::equal) {
    return text + fmt::format("; exactly {} {} required", wanted, limit.number == 1 ? "is" : "are");
  }
  return text + fmt::format("; {} {}", what, wanted);
}

constexpr std::size_t kMostListed = 8;

std::string broken_text(const Limit& limit, const Measured& of, const std::string& value,
                        std::optional<std::size_t> same_as) {
  const bool plural = is_plural(*limit.measure);
  const char* const is = plural ? "are" : "is";
  const char* const it = plural ? "they" : "it";
  const std::string text =
      fmt::format("The {} of the {} {} {}", limit.measure->name, of.noun, is, gltfx::quoted(value));
  switch (limit.op) {
    case LimitOp::match:
      return text + fmt::format("; {} must match {}", it, gltfx::quoted(limit.texts.front()));
    case LimitOp::deny_match:
      return text + fmt::format("; {} must not match {}", it, gltfx::quoted(limit.texts.front()));
    case LimitOp::unique:
      return text + fmt::format(", as {} {} of {} {}", is, plural ? "those" : "that", of.noun,
                                same_as.value_or(0));
    case LimitOp::allow:
      if (limit.texts.empty()) break;
      return text +
             fmt::format("; {} must be {}", it, printable(join_or(limit.texts, kMostListed)));
    default:
      break;
  }
  return text + fmt::format("; {} {} not allowed", it, is);
}

std::string broken_set(const Limit& limit, const measure::LimitTexts& texts, const Measured& of,
                       const std::vector<std::string>& value) {
  std::vector<std::string> wrong;
  std::size_t others = 0;
  for (const std::string& one : value) {
    if (texts.accepts(one)) continue;
    if (wrong.size() < kMostListed) {
      wrong.push_back(gltfx::quoted(one));
    } else {
      ++others;
    }
  }
  const bool single = wrong.size() == 1;
  std::string list = others == 0 ? join_and(wrong)
                                 : fmt::format("{} and {} others", fmt::join(wrong, ", "), others);
  return fmt::format("The {} of the {} include {}, which {} not allowed", limit.measure->name,
                     of.noun, list, single ? "is" : "are");
}

std::string broken_value(const Limit& limit, const measure::LimitTexts& texts, const Measured& of,
                         const MeasureValue& value, std::optional<std::size_t> same_as) {
  if (const auto* number = std::get_if<double>(&value)) return broken_number(limit, of, *number);
  if (const auto* text = std::get_if<std::string>(&value)) {
    return broken_text(limit, of, *text, same_as);
  }
  if (const auto* set = std::get_if<std::vector<std::string>>(&value)) {
    return broken_set(limit, texts, of, *set);
  }
  return fmt::format("For the {}, {} is {}; it must be {}", of.noun, limit.measure->name,
                     !limit.flag, limit.flag);
}

}  // namespace

std::string broken_limit(const Limit& limit, const measure::LimitTexts& texts, const Measured& of,
                         const MeasureValue& value, std::optional<std::size_t> same_as) {
  return broken_value(limit, texts, of, value, same_as) + source_of(limit) + '.';
}

std::string unchecked_limit(const Limit& limit, const Measured& of, std::string_view why) {
  std::string reason = half_sentence(why);
  if (reason.size() > 1 && ascii_lower(reason[1]) == reason[1]) reason[0] = ascii_lower(reason[0]);
  return fmt::format("The limit on {} of the {}{} is not checked: {}.", limit.measure->name,
                     of.noun, source_of(limit), reason);
}

}  // namespace gltfx::validate
