// SPDX-License-Identifier: Apache-2.0
#include "config_limits.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

using measure::Literal;

constexpr std::size_t kMostChanges = 10'000;  // an asset is compared with each
constexpr std::size_t kMostTiers = 16;
constexpr std::size_t kMostParameters = 16;  // measures are taken once for each set of them
constexpr std::string_view kSeverity = "severity";
constexpr std::string_view kNote = "note";
constexpr std::size_t kLongestNote = 200;

std::uint32_t line_of(const toml::node& node) { return node.source().begin.line; }

std::optional<Literal> literal_of(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* number = node.as_integer()) return static_cast<double>(number->get());
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) return text->get();
  const toml::array* list = node.as_array();
  if (list == nullptr) return std::nullopt;
  std::vector<std::string> texts;
  for (const toml::node& item : *list) {
    if (!item.is_string()) return std::nullopt;
    texts.push_back(item.as_string()->get());
  }
  return texts;
}

bool is_false(const toml::node& node) { return node.is_boolean() && !node.as_boolean()->get(); }

bool has_op(const toml::table& table) {
  return std::any_of(table.begin(), table.end(), [](const auto& member) {
    return limit_op_from_name(member.first.str()).has_value();
  });
}

}  // namespace

struct LimitTables::Table {
  MeasureScope on = MeasureScope::asset;
  std::vector<std::pair<std::string, Literal>> parameters = {};
};

struct LimitTables::Place {
  const MeasureDescription& measure;
  MeasureScope on;
  MeasureParameters parameters;
  Severity severity = Severity::error;
  std::string note = {};
};

bool LimitTables::complain(const toml::node& node, const std::string& text) {
  stopped_ = stopped_ || !complain_(line_of(node), "budgets: " + text);
  return false;
}

void LimitTables::read(const toml::node& node, std::vector<measure::LimitChange>& changes) {
  const toml::table* table = node.as_table();
  changes_ = &changes;
  if (table == nullptr) {
    complain(node, "a table of MEASURE = LIMIT is expected");
  } else {
    read_scope(*table, MeasureScope::asset);
  }
}

void LimitTables::read_scope(const toml::table& table, MeasureScope on) {
  Table own{on};
  if (!read_parameters(table, own)) return;
  for (const auto& [key, node] : table) {
    if (stopped_) return;
    const auto scope = measure_scope_from_name(key.str());
    if (on == MeasureScope::asset && scope && node.is_table()) {
      read_scope(*node.as_table(), *scope);
    } else if (!measure::is_parameter(key.str())) {
      read_measure(key, node, own);
    }
  }
}

bool LimitTables::read_parameters(const toml::table& table, Table& to) {
  for (const auto& [key, node] : table) {
    if (!measure::is_parameter(key.str())) continue;
    const auto literal = literal_of(node);
    MeasureParameters scratch;
    const auto problem = measure::set_parameter(scratch, key.str(), literal.value_or(false));
    if (problem) return complain(node, problem->message);
    to.parameters.emplace_back(key.str(), *literal);
  }
  return true;
}

void LimitTables::read_measure(const toml::key& key, const toml::node& node, const Table& table) {
  const auto measure = measure::measure_of(table.on, key.str());
  if (!measure) {
    const bool scope = table.on == MeasureScope::asset && node.is_table() &&
                       !has_op(*node.as_table()) && find_measure(key.str()) == nullptr;
    const auto wrong_scope = measure::scope_of(key.str());
    complain(node, scope && !wrong_scope ? wrong_scope.error().message : measure.error().message);
    return;
  }
  Place place{**measure, table.on, {}};
  for (const auto& [name, literal] : table.parameters) {
    if (!measure::has_parameter(place.measure, name)) continue;
    measure::set_parameter(place.parameters, name, literal);
  }
  if (is_false(node)) {
    changes_->push_back({&place.measure, place.on, {}, {}});
    return;
  }
  std::vector<Limit> limits;
  if (read_value(place, node, limits)) keep(place, node, std::move(limits));
}

bool LimitTables::read_value(const Place& place, const toml::node& node,
                             std::vector<Limit>& limits) {
  if (const toml::table* table = node.as_table()) return read_ops(place, *table, limits);
  const toml::array* list = node.as_array();
  if (list != nullptr && place.measure.type == MeasureType::number) {
    if (list->size() > kMostTiers) {
      return complain(node, fmt::format("a limit has at most {} tiers", kMostTiers));
    }
    return std::all_of(list->begin(), list->end(), [&](const toml::node& item) {
      if (item.is_array()) return complain(item, "a tier must be a number or a table");
      return read_value(place, item, limits);
    });
  }
  Limit limit;
  const auto op =
      measure::op_of(place.measure, literal_of(node).value_or(std::vector<std::string>()));
  if (!op) return complain(node, op.error().message);
  limit.op = *op;
  return add(place, node, std::move(limit), limits);
}

bool LimitTables::read_ops(const Place& outer, const toml::table& table,
                           std::vector<Limit>& limits) {
  Place place = outer;
  for (const auto& [key, node] : table) {
    if (key.str() == kSeverity) {
      const auto level = severity_from_name(node.value_or(std::string_view()));
      if (!level)
        return complain(node, "severity must be \"error\", \"warning\", \"info\" or \"hint\"");
      place.severity = *level;
    } else if (key.str() == kNote) {
      const auto* note = node.as_string();
      if (note == nullptr || note->get().size() > kLongestNote) {
        return complain(node, fmt::format("note must be a text of at most {} bytes", kLongestNote));
      }
      place.note = note->get();
    } else if (measure::is_parameter(key.str())) {
      if (!measure::has_parameter(place.measure, key.str())) {
        return complain(node,
                        fmt::format("{} does not depend on {}", place.measure.name, key.str()));
      }
      const auto problem =
          measure::set_parameter(place.parameters, key.str(), literal_of(node).value_or(false));
      if (problem) return complain(node, problem->message);
    }
  }
  bool fine = true;
  for (const auto& [key, node] : table) {
    const bool is_op =
        key.str() != kSeverity && key.str() != kNote && !measure::is_parameter(key.str());
    if (!is_op) continue;
    const auto op = measure::op_of(place.measure, place.on, key.str());
    if (!op) {
      fine = complain(node, op.error().message);
    } else if (is_false(node) &&
               !(*op == LimitOp::equal && place.measure.type == MeasureType::flag)) {
      changes_->push_back({&place.measure, place.on, *op, {}});
    } else {
      Limit limit;
      limit.op = *op;
      fine = add(place, node, std::move(limit), limits) && fine;
    }
  }
  return fine;
}

bool LimitTables::add(const Place& place, const toml::node& node, Limit limit,
                      std::vector<Limit>& limits) {
  limit.measure = &place.measure;
  limit.on = place.on;
  limit.severity = place.severity;
  limit.parameters = place.parameters;
  limit.note = place.note;
  limit.from = from_(line_of(node));
  const auto literal = literal_of(node);
  if (!literal) return complain(node, "a number, true, a text or a list of texts is expected");
  if (const auto problem = measure::set_value(limit, *literal)) {
    return complain(node, problem->message);
  }
  const bool known =
      std::find(parameters_.begin(), parameters_.end(), limit.parameters) != parameters_.end();
  if (!known) parameters_.push_back(limit.parameters);
  if (parameters_.size() > kMostParameters) {
    return complain(node, fmt::format("there are more than {} combinations of weld, angle, at and "
                                      "slot",
                                      kMostParameters));
  }
  limits.push_back(std::move(limit));
  return true;
}

void LimitTables::keep(const Place& place, const toml::node& node, std::vector<Limit> limits) {
  std::stable_sort(limits.begin(), limits.end(),
                   [](const Limit& a, const Limit& b) { return a.op < b.op; });
  for (auto begin = limits.begin(); begin != limits.end();) {
    const LimitOp op = begin->op;
    const auto end =
        std::find_if(begin, limits.end(), [&](const Limit& limit) { return limit.op != op; });
    changes_->push_back({&place.measure, place.on, op, {begin, end}});
    begin = end;
  }
  if (++count_ > kMostChanges && !stopped_) {
    complain(node, fmt::format("there are more than {} limits", kMostChanges));
    stopped_ = true;
  }
}

}  // namespace gltfx::tool
