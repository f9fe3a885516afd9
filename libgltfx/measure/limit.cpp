// SPDX-License-Identifier: Apache-2.0
#include "measure/limit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "measure/quantity.hpp"
#include "measure/take.hpp"
#include "schema/pattern.hpp"

namespace gltfx {
namespace {

constexpr std::array<std::string_view, 8> kLimitOps{"min",        "max",    "equal", "match",
                                                    "deny-match", "unique", "allow", "deny"};

}  // namespace

std::string_view limit_op_name(LimitOp op) { return kLimitOps[static_cast<std::size_t>(op)]; }

std::optional<LimitOp> limit_op_from_name(std::string_view name) {
  const auto at = std::find(kLimitOps.begin(), kLimitOps.end(), name);
  if (at == kLimitOps.end()) return std::nullopt;
  return static_cast<LimitOp>(at - kLimitOps.begin());
}

namespace measure {
namespace {

using LimitNames = std::vector<std::string_view>;

LimitNames scope_names() {
  LimitNames names;
  for (std::size_t i = 0; i < kMeasureScopeCount; ++i) {
    names.push_back(measure_scope_name(static_cast<MeasureScope>(i)));
  }
  return names;
}

bool is_taken_of(const MeasureDescription& measure, MeasureScope on) {
  return on == MeasureScope::asset ? measure.is_of_asset() : measure.is_on(on);
}

std::string_view phrase_of(MeasureScope scope) {
  return scope == MeasureScope::asset ? "the asset" : measure_scope_name(scope);
}

std::string_view a_type(MeasureType type) {
  constexpr std::array<std::string_view, 4> kNames{"a number", "a flag", "a text", "a set"};
  return kNames[static_cast<std::size_t>(type)];
}

// Whoever limits such a measure by a number alone usually means a minimum, not a maximum.
bool is_a_minimum(const MeasureDescription& measure) {
  return measure.total == MeasureTotal::min || measure.name.starts_with("min-") ||
         measure.name.ends_with("-min");
}

Error wrong_value(const Limit& limit, std::string_view what) {
  return {fmt::format("{} of {} must be {}", limit_op_name(limit.op), limit.measure->name, what)};
}

std::optional<Error> set_number(Limit& limit, const Literal& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    if (!std::isfinite(*number)) return wrong_value(limit, "a finite number");
    limit.number = *number;
    return {};
  }
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return wrong_value(limit, "a number");
  const auto number = read_quantity(*text, limit.measure->unit);
  if (!number) return number.error();
  limit.number = *number;
  return {};
}

std::optional<Error> set_pattern(Limit& limit, const Literal& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return wrong_value(limit, "a pattern");
  const auto pattern = schema::Pattern::compile(*text);
  if (!pattern) {
    return Error{fmt::format("{} is not a pattern: {}", gltfx::quoted(*text),
                             half_sentence(pattern.error().message))};
  }
  limit.texts = {*text};
  return {};
}

constexpr std::size_t kMostLimitWords = 1000;

std::optional<Error> set_words(Limit& limit, const Literal& value) {
  if (const auto* one = std::get_if<std::string>(&value)) {
    limit.texts = {*one};
  } else if (const auto* list = std::get_if<std::vector<std::string>>(&value)) {
    limit.texts = *list;
  } else {
    return wrong_value(limit, "a list of texts");
  }
  if (limit.texts.size() > kMostLimitWords) {
    return wrong_value(limit, fmt::format("a list of at most {} texts", kMostLimitWords));
  }
  for (const std::string& word : limit.texts) {
    const std::size_t star = word.find('*');
    if (star == std::string::npos || star + 1 == word.size()) continue;
    return Error{fmt::format("{}: '*' is only understood at the end", gltfx::quoted(word))};
  }
  return {};
}

using LimitKey = std::tuple<MeasureScope, std::string_view, LimitOp>;

LimitKey limit_key(const Limit& limit) { return {limit.on, limit.measure->name, limit.op}; }

}  // namespace

Result<MeasureScope> scope_of(std::string_view name) {
  if (const auto scope = measure_scope_from_name(name)) return *scope;
  const LimitNames names = scope_names();
  return Error{fmt::format("{} is not one of {}{}", gltfx::quoted(name), fmt::join(names, ", "),
                           did_you_mean(name, names))};
}

Result<const MeasureDescription*> measure_of(MeasureScope on, std::string_view name) {
  if (const MeasureDescription* found = find_measure(on, name)) return found;
  LimitNames names;
  std::vector<std::string> scopes;
  for (const MeasureDescription& measure : measures()) {
    if (is_taken_of(measure, on)) names.push_back(measure.name);
    if (measure.name != name) continue;
    for (std::size_t i = 0; i < kMeasureScopeCount; ++i) {
      const auto scope = static_cast<MeasureScope>(i);
      if (is_taken_of(measure, scope)) scopes.emplace_back(phrase_of(scope));
    }
  }
  if (!scopes.empty()) {
    return Error{fmt::format("{} is not a measure of {}; it is one of {}", gltfx::quoted(name),
                             phrase_of(on), join_and(scopes))};
  }
  return Error{
      fmt::format("there is no measure {}{}", gltfx::quoted(name), did_you_mean(name, names))};
}

std::vector<std::string_view> ops_of(const MeasureDescription& measure, MeasureScope on) {
  switch (measure.type) {
    case MeasureType::number:
      return {"min", "max", "equal"};
    case MeasureType::flag:
      return {"equal"};
    case MeasureType::text:
      if (on == MeasureScope::asset) return {"match", "deny-match", "allow", "deny"};
      return {"match", "deny-match", "unique", "allow", "deny"};
    case MeasureType::set:
      break;
  }
  return {"allow", "deny"};
}

Result<LimitOp> op_of(const MeasureDescription& measure, MeasureScope on, std::string_view name) {
  const LimitNames names = ops_of(measure, on);
  if (std::find(names.begin(), names.end(), name) != names.end()) return *limit_op_from_name(name);
  const std::vector<std::string> all(names.begin(), names.end());
  return Error{fmt::format(
      "{} is not an operator of {}, which is {}; {}{}", gltfx::quoted(name), measure.name,
      a_type(measure.type),
      all.size() == 1 ? "its operator is " + all.front() : "its operators are " + join_and(all),
      did_you_mean(name, names))};
}

Result<LimitOp> op_of(const MeasureDescription& measure, const Literal& value) {
  const bool flag = std::holds_alternative<bool>(value);
  const bool number =
      std::holds_alternative<double>(value) || std::holds_alternative<std::string>(value);
  if (measure.type == MeasureType::number && number) {
    if (!is_a_minimum(measure)) return LimitOp::max;
    return Error{fmt::format(
        "{0} is the least of several values: write {0} = {{ min = 10 }} or {0} = {{ max = 10 }}",
        measure.name)};
  }
  if (measure.type == MeasureType::flag && flag) return LimitOp::equal;
  const char* const example = measure.type == MeasureType::number ? "10"
                              : measure.type == MeasureType::flag ? "true"
                              : measure.type == MeasureType::text ? "{ match = \"^A\" }"
                                                                  : "{ allow = [\"A\"] }";
  return Error{fmt::format("{} is {}: write {} = {}", measure.name, a_type(measure.type),
                           measure.name, example)};
}

std::optional<Error> set_value(Limit& limit, const Literal& value) {
  switch (limit.op) {
    case LimitOp::match:
    case LimitOp::deny_match:
      return set_pattern(limit, value);
    case LimitOp::allow:
    case LimitOp::deny:
      return set_words(limit, value);
    case LimitOp::unique:
      break;
    default:
      if (limit.measure->type == MeasureType::number) return set_number(limit, value);
  }
  const auto* flag = std::get_if<bool>(&value);
  if (flag == nullptr) return wrong_value(limit, "true or false");
  limit.flag = *flag;
  return {};
}

bool is_parameter(std::string_view name) {
  return name == "weld" || name == "angle" || name == "at" || name == "slot";
}

bool is_of_topology(const MeasureDescription& measure) {
  const auto entries = take_entries();
  const auto topology = std::find_if(entries.begin(), entries.end(), [](const TakeEntry& entry) {
    return entry.take == take_topology;
  });
  const auto at = static_cast<Name>(&measure - measures().data());
  return topology != entries.end() &&
         std::find(topology->measures.begin(), topology->measures.end(), at) !=
             topology->measures.end();
}

bool has_parameter(const MeasureDescription& measure, std::string_view name) {
  if (name == "angle") return measure.name == "hard-edges";
  if (name == "at") return measure.name == "uv-gutter";
  if (name == "slot") return measure.name.starts_with("texel-density");
  return name == "weld" && is_of_topology(measure);
}

namespace {

std::string_view unit_of_parameter(std::string_view name) {
  return name == "weld" ? "m" : name == "angle" ? "deg" : "px";
}

}  // namespace

std::optional<Error> set_parameter(MeasureParameters& parameters, std::string_view name,
                                   const Literal& value) {
  if (name == "slot") {
    const auto* slot = std::get_if<std::string>(&value);
    if (slot == nullptr)
      return Error{"slot must be the name of a texture, such as \"normalTexture\""};
    parameters.density_slot = *slot;
    return {};
  }
  const std::string_view unit = unit_of_parameter(name);
  const double most = name == "weld" ? 1 : name == "angle" ? 180 : 65536;
  Result<double> number = Error{};
  if (const auto* plain = std::get_if<double>(&value)) number = *plain;
  if (const auto* text = std::get_if<std::string>(&value)) number = read_quantity(*text, unit);
  if (!number || !(*number >= 0) || !(*number <= most)) {
    return Error{fmt::format("{} must be a number from 0 to {}", name, quantity_words(most, unit))};
  }
  if (name == "at" && std::trunc(*number) != *number) {
    return Error{"at must be a whole number of pixels"};
  }
  if (name == "weld") parameters.weld = *number;
  if (name == "angle") parameters.hard_angle = *number;
  if (name == "at") parameters.gutter_at = static_cast<std::uint32_t>(*number);
  return {};
}

std::string parameter_words(const MeasureParameters& parameters) {
  const MeasureParameters plain;
  std::vector<std::string> words;
  const auto add = [&](std::string_view name, double value, double usual) {
    if (value == usual) return;
    words.push_back(fmt::format("{} {} {}", name, number_text(value), unit_of_parameter(name)));
  };
  add("weld", parameters.weld, plain.weld);
  add("angle", parameters.hard_angle, plain.hard_angle);
  add("at", parameters.gutter_at, plain.gutter_at);
  const std::string& slot = parameters.density_slot;
  if (slot != plain.density_slot) words.push_back(fmt::format("slot {}", printable(slot)));
  return fmt::format("{}", fmt::join(words, ", "));
}

void apply(std::vector<Limit>& limits, const LimitChange& change) {
  const std::string_view name = change.measure->name;
  const auto before = [](const Limit& limit, const LimitKey& key) {
    return limit_key(limit) < key;
  };
  const auto after = [](const LimitKey& key, const Limit& limit) { return key < limit_key(limit); };
  const LimitKey first{change.on, name, change.op.value_or(LimitOp::min)};
  const LimitKey last{change.on, name, change.op.value_or(LimitOp::deny)};
  const auto begin = std::lower_bound(limits.begin(), limits.end(), first, before);
  const auto end = std::upper_bound(begin, limits.end(), last, after);
  const auto at = limits.erase(begin, end);
  limits.insert(at, change.limits.begin(), change.limits.end());
}

std::string value_words(const Limit& limit) {
  switch (limit.op) {
    case LimitOp::match:
    case LimitOp::deny_match:
    case LimitOp::allow:
    case LimitOp::deny:
      return printable(fmt::format("{}", fmt::join(limit.texts, ", ")));
    case LimitOp::unique:
      break;
    default:
      if (limit.measure->type == MeasureType::number) {
        return quantity_words(limit.number, limit.measure->unit);
      }
  }
  return limit.flag ? "true" : "false";
}

}  // namespace measure
}  // namespace gltfx
