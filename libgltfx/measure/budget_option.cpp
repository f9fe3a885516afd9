// SPDX-License-Identifier: Apache-2.0
// Limits as the option --budget takes them.
#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "measure/limit.hpp"

namespace gltfx::measure {
namespace {

std::vector<std::string> split_words(std::string_view text, char at) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find(at);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// The value of an option in the form that a limit of the operator takes.
Literal literal_of(std::string_view text, const MeasureDescription& measure, LimitOp op) {
  if (op == LimitOp::allow || op == LimitOp::deny) return split_words(text, ',');
  const bool flag = op == LimitOp::unique || measure.type == MeasureType::flag;
  if (flag && (text == "true" || text == "false")) return text == "true";
  return std::string(text);
}

// "mesh.triangles.min": the scope and the operator may be missing.
struct BudgetKey {
  const MeasureDescription* measure = nullptr;
  MeasureScope on = MeasureScope::asset;
  std::optional<LimitOp> op;
};

Result<BudgetKey> read_key(std::string_view text) {
  const std::vector<std::string> parts = split_words(text, '.');
  BudgetKey key;
  std::size_t at = 0;
  const bool scoped = measure_scope_from_name(parts[0]).has_value() ||
                      (parts.size() > 1 && find_measure(parts[0]) == nullptr);
  if (scoped) {
    const auto scope = scope_of(parts[at++]);
    if (!scope) return scope.error();
    key.on = *scope;
  }
  if (at == parts.size() || parts.size() > at + 2) {
    return Error{fmt::format("{} is not SCOPE.MEASURE", gltfx::quoted(text))};
  }
  const auto measure = measure_of(key.on, parts[at]);
  if (!measure) return measure.error();
  key.measure = *measure;
  if (++at == parts.size()) return key;
  const auto op = op_of(*key.measure, key.on, parts[at]);
  if (!op) return op.error();
  key.op = *op;
  return key;
}

Result<LimitChange> change_of(const BudgetKey& key, std::string_view value, std::string_view from) {
  Limit limit;
  limit.measure = key.measure;
  limit.on = key.on;
  limit.op = *key.op;
  limit.from = from;
  if (auto problem = set_value(limit, literal_of(value, *key.measure, limit.op))) return *problem;
  return LimitChange{key.measure, key.on, limit.op, {std::move(limit)}};
}

}  // namespace

Result<std::vector<LimitChange>> read_budget(std::string_view text, std::string_view from) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    return Error{fmt::format("{} is not MEASURE=LIMIT", gltfx::quoted(text))};
  }
  auto key = read_key(text.substr(0, equals));
  if (!key) return key.error();
  const std::string_view value = text.substr(equals + 1);
  const bool lifts = value == "false" && (!key->op || *key->op == LimitOp::unique);
  if (lifts) return std::vector{LimitChange{key->measure, key->on, key->op, {}}};
  std::vector<std::pair<LimitOp, std::string_view>> parts;
  const std::size_t dots = value.find("..");
  const bool number = key->measure->type == MeasureType::number;
  if (key->op) {
    parts.emplace_back(*key->op, value);
  } else if (number && dots != std::string_view::npos) {
    if (dots > 0) parts.emplace_back(LimitOp::min, value.substr(0, dots));
    if (dots + 2 < value.size()) parts.emplace_back(LimitOp::max, value.substr(dots + 2));
    if (parts.empty()) return Error{fmt::format("{} has neither end", gltfx::quoted(value))};
  } else {
    const Literal literal = number ? Literal(std::string(value)) : Literal(value == "true");
    const auto op = op_of(*key->measure, literal);
    if (!op)
      return Error{fmt::format("{}: name an operator, as in {}.{}=...", key->measure->name,
                               key->measure->name, ops_of(*key->measure, key->on).front())};
    parts.emplace_back(*op, value);
  }
  std::vector<LimitChange> changes;
  for (const auto& [op, part] : parts) {
    key->op = op;
    auto change = change_of(*key, part, from);
    if (!change) return change.error();
    changes.push_back(*std::move(change));
  }
  return changes;
}

}  // namespace gltfx::measure
