// SPDX-License-Identifier: Apache-2.0
#include "pipeline/example_limit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/shared_text.hpp"
#include "json/document.hpp"
#include "json/parse.hpp"

namespace gltfx {
namespace {

using json::Document;
using json::NodeId;

/// The values of a page: {"asset": {NAME: VALUE}, "mesh": {"0": {NAME: VALUE}}}.
class PageValues {
 public:
  explicit PageValues(const MeasureDescription& measure)
      : measure_(measure),
        parsed_(json::parse(share_text(std::string(measure.values)))),
        document_(parsed_.document) {}

  /// A limit with the scope and the value of the first one that is not null.
  std::optional<Limit> first() const {
    if (!parsed_.ok() || !document_.is_object(document_.root())) return std::nullopt;
    for (const auto member : document_.members(document_.root())) {
      const auto scope = measure_scope_from_name(document_.key(member.key_id));
      if (!scope || !document_.is_object(member.value)) continue;
      if (*scope == MeasureScope::asset) {
        if (auto limit = limit_on(*scope, member.value)) return limit;
        continue;
      }
      for (const auto element : document_.members(member.value)) {
        if (auto limit = limit_on(*scope, element.value)) return limit;
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<Limit> limit_on(MeasureScope on, NodeId values) const {
    const NodeId value = document_.find(values, measure_.name);
    if (value == json::kNoNode) return std::nullopt;
    Limit limit;
    limit.measure = &measure_;
    limit.on = on;
    if (document_.is_number(value)) {
      limit.number = document_.number(value).value;
    } else if (document_.is_boolean(value)) {
      limit.flag = document_.raw(value) == "true";
    } else if (document_.is_string(value)) {
      limit.texts = {document_.string(value)};
    } else if (document_.kind(value) == json::Kind::array) {
      for (const NodeId text : document_.elements(value)) {
        limit.texts.push_back(document_.string(text));
      }
    } else {
      return std::nullopt;
    }
    return limit;
  }

  const MeasureDescription& measure_;
  json::Parsed parsed_;
  const Document& document_;
};

// Changes a limit at a value into one that the value breaks.
void break_number(Limit& limit) {
  const double value = limit.number;
  if (value <= 0) {
    limit.op = LimitOp::min;
    limit.number = value + 1;
  } else {
    limit.number = std::trunc(value) == value ? value - 1 : value / 2;
  }
}

void choose_op(Limit& limit, bool broken) {
  switch (limit.measure->type) {
    case MeasureType::number:
      if (broken) break_number(limit);
      return;
    case MeasureType::flag:
      limit.op = LimitOp::equal;
      if (broken) limit.flag = !limit.flag;
      return;
    default:
      limit.op = broken ? LimitOp::deny : LimitOp::allow;
      if (broken && limit.texts.size() > 1) limit.texts.resize(1);
  }
}

std::string option_of(const Limit& limit) {
  const std::string value = limit.measure->type == MeasureType::number ? number_text(limit.number)
                            : limit.measure->type == MeasureType::flag
                                ? (limit.flag ? "true" : "false")
                                : fmt::format("{}", fmt::join(limit.texts, ","));
  return fmt::format("--budget {}.{}.{}={}", measure_scope_name(limit.on), limit.measure->name,
                     limit_op_name(limit.op), value);
}

}  // namespace

std::vector<Limit> example_limits(const RuleDescription& rule, bool broken) {
  if (rule.code == "BUDGET_NOT_MEASURED") {
    Limit limit;
    limit.measure = find_measure(MeasureScope::asset, "file-size");
    limit.number = 1e6;
    limit.from = "--budget file-size=1MB";
    return {limit};
  }
  const auto all = measures();
  const auto measure = std::find_if(
      all.begin(), all.end(), [&](const MeasureDescription& one) { return one.code == rule.code; });
  if (measure == all.end()) return {};
  auto limit = PageValues(*measure).first();
  if (!limit) return {};
  choose_op(*limit, broken);
  limit->parameters.product = {1, 1, 1};
  limit->from = option_of(*limit);
  return {*std::move(limit)};
}

}  // namespace gltfx
