// SPDX-License-Identifier: Apache-2.0
#include "measure/limit_texts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gltfx::measure {
namespace {

bool is_whole_number(double value) { return std::trunc(value) == value; }

constexpr double kLimitTolerance = 1e-6;  // of the larger number: rounding is no violation

bool holds(const Limit& limit, double value) {
  const bool exact = is_whole_number(value) && is_whole_number(limit.number);
  const double room =
      exact ? 0 : kLimitTolerance * std::max(std::fabs(value), std::fabs(limit.number));
  if (limit.op == LimitOp::max) return value <= limit.number + room;
  if (limit.op == LimitOp::min) return value >= limit.number - room;
  return std::fabs(value - limit.number) <= room;
}

}  // namespace

LimitTexts::LimitTexts(const Limit& limit) : limit_(limit) {
  const bool pattern = limit.op == LimitOp::match || limit.op == LimitOp::deny_match;
  if (pattern && !limit.texts.empty()) {
    auto compiled = schema::Pattern::compile(limit.texts.front());
    if (compiled) pattern_ = *std::move(compiled);
    return;
  }
  for (const std::string& word : limit.texts) {
    if (word.ends_with('*')) {
      prefixes_.push_back(std::string_view(word).substr(0, word.size() - 1));
    } else {
      words_.push_back(word);
    }
  }
  std::sort(words_.begin(), words_.end());
}

bool LimitTexts::is_listed(std::string_view text) const {
  return std::binary_search(words_.begin(), words_.end(), text) ||
         std::any_of(prefixes_.begin(), prefixes_.end(),
                     [&](std::string_view prefix) { return text.starts_with(prefix); });
}

bool LimitTexts::accepts(std::string_view text) const {
  switch (limit_.op) {
    case LimitOp::match:
      return pattern_ && pattern_->matches(text);
    case LimitOp::deny_match:
      return pattern_ && !pattern_->matches(text);
    case LimitOp::deny:
      return !is_listed(text);
    default:
      return is_listed(text);
  }
}

bool holds(const Limit& limit, const LimitTexts& texts, const MeasureValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return holds(limit, *number);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag == limit.flag;
  if (const auto* text = std::get_if<std::string>(&value)) return texts.accepts(*text);
  const auto* set = std::get_if<std::vector<std::string>>(&value);
  return set == nullptr || std::all_of(set->begin(), set->end(),
                                       [&](const std::string& one) { return texts.accepts(one); });
}

}  // namespace gltfx::measure
