// SPDX-License-Identifier: Apache-2.0
// Limits on measures. Nothing is measured without limits.
#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "measure/limit.hpp"
#include "measure/limit_texts.hpp"
#include "measure/source.hpp"
#include "measure/take.hpp"
#include "rules/collector.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"
#include "rules/phases.hpp"
#include "rules/targets/limit_places.hpp"
#include "rules/targets/limit_words.hpp"

namespace gltfx::validate {
namespace {

// Rows of one report, and findings of one limit that carry it: what an asset of a million meshes
// breaks fits into memory.
constexpr std::size_t kMostRequirements = 4096;
// Of one limit, so that the rows of others have room.
constexpr std::size_t kMostOfOneLimit = 256;
// A list with more words counts as several rows.
constexpr std::size_t kWordsOfARow = 64;

Code code_of_limit(const Limit& limit) {
  return static_cast<Code>(find_rule(limit.measure->code) - rules().data());
}

// Of findings of the limit.
Severity severity_of(const ValidateOptions& options, const Limit& limit) {
  const auto level = options.severity.find(limit.measure->code);
  return level == options.severity.end() ? limit.severity : level->second;
}

bool is_asked(const ValidateOptions& options, const Limit& limit) {
  return options.select.contains(code_name(Code::BUDGET_NOT_MEASURED)) ||
         accepts(options, code_of_limit(limit), severity_of(options, limit));
}

// Limits whose measures are taken in the same way, by position.
struct Group {
  std::vector<std::size_t> limits;
  measure::Request request;
};

std::vector<Group> groups_of(const std::vector<Limit>& limits, const ValidateOptions& options) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (!is_asked(options, limits[i])) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return group.request.parameters == limits[i].parameters;
    });
    Group& group = same != groups.end() ? *same : groups.emplace_back();
    if (group.limits.empty()) {
      group.request.parameters = limits[i].parameters;
      group.request.wanted.emplace();
      // A limit on pixels decodes them, unless `--pixels headers` is given.
      group.request.pixels = options.pixels != PixelLevel::headers;
    }
    group.limits.push_back(i);
    const auto name = static_cast<measure::Name>(limits[i].measure - measures().data());
    group.request.wanted->push_back({limits[i].on, name});
  }
  return groups;
}

CheckedValue checked_value(const MeasureValue& value) {
  return std::visit(
      [](const auto& one) -> CheckedValue {
        if constexpr (std::is_same_v<std::decay_t<decltype(one)>, NotMeasured>) {
          return std::monostate();
        } else {
          return one;
        }
      },
      value);
}

CheckedValue limit_value(const Limit& limit) {
  switch (limit.op) {
    case LimitOp::match:
    case LimitOp::deny_match:
      return limit.texts.empty() ? std::string() : limit.texts.front();
    case LimitOp::allow:
    case LimitOp::deny:
      return limit.texts;
    default:
      if (limit.measure->type == MeasureType::number) return limit.number;
  }
  return limit.flag;
}

// Compares the values of one limit.
class LimitCheck {
 public:
  LimitCheck(const LimitPlaces& places, const Limit& limit, Severity severity, FileReport& report,
             Sink& sink)
      : places_(places),
        limit_(limit),
        severity_(severity),
        parameters_(measure::parameter_words(limit.parameters)),
        texts_(limit),
        report_(report),
        sink_(sink) {}

  void run(const Measurements& taken) {
    const MeasureColumn* column = taken.find(limit_.on, limit_.measure->name);
    if (column == nullptr) return;
    for (std::size_t i = 0; i < column->values.size(); ++i) {
      const MeasureValue& value = column->values[i];
      if (const auto* missing = std::get_if<NotMeasured>(&value)) {
        const MeasureReason& reason = taken.reasons[missing->reason];
        if (reason.fault) report_unchecked(i, reason.text);
      } else {
        compare(i, value);
      }
    }
    if (listed_ > 0) return;
    // One row for all elements: the one that is nearest to the limit.
    const bool any = nearest_.has_value();
    add_row(any ? Verdict::pass : Verdict::not_applicable, nearest_.value_or(0),
            any ? column->values[*nearest_] : MeasureValue(), any);
  }

 private:
  void compare(std::size_t element, const MeasureValue& value) {
    std::optional<std::size_t> same_as;
    if (limit_.op == LimitOp::unique) {
      const auto* text = std::get_if<std::string>(&value);
      const auto [first, fresh] = seen_.emplace(text == nullptr ? "" : *text, element);
      if (!fresh) same_as = first->second;
    }
    const bool good =
        limit_.op == LimitOp::unique ? !same_as : measure::holds(limit_, texts_, value);
    if (!good) return report_broken(element, value, same_as);
    const auto* number = std::get_if<double>(&value);
    if (nearest_ && number == nullptr) return;
    const double distance = number == nullptr ? 0 : limit_.op == LimitOp::min ? *number : -*number;
    if (nearest_ && distance >= least_) return;
    nearest_ = element;
    least_ = distance;
  }

  void report_broken(std::size_t element, const MeasureValue& value,
                     std::optional<std::size_t> same_as) {
    Finding finding(code_of_limit(limit_));
    finding.message =
        broken_limit(limit_, texts_, places_.measured(limit_.on, element), value, same_as);
    finding.severity = severity_;
    report(element, value, std::move(finding));
    add_row(Verdict::fail, element, value, true);
  }

  void report_unchecked(std::size_t element, std::string_view why) {
    Finding finding(Code::BUDGET_NOT_MEASURED);
    finding.message = unchecked_limit(limit_, places_.measured(limit_.on, element), why);
    report(element, {}, std::move(finding));
    add_row(Verdict::not_measured, element, {}, true);
  }

  void report(std::size_t element, const MeasureValue& value, Finding finding) {
    // Findings about other limits of the same measure are no repeats.
    finding.about = fmt::format("{} {} {} {} {}", measure_scope_name(limit_.on),
                                limit_op_name(limit_.op), limit_.number, limit_.from, parameters_);
    if (listed_ < kMostRequirements / weight()) {
      finding.requirement = std::make_shared<const CheckedLimit>(row(value));
    }
    places_.report(limit_, element, std::move(finding), sink_);
  }

  // Each row has all words of the limit.
  std::size_t weight() const { return 1 + limit_.texts.size() / kWordsOfARow; }

  CheckedLimit row(const MeasureValue& value) const {
    return {std::string(limit_.measure->name),
            std::string(measure_scope_name(limit_.on)),
            checked_value(value),
            std::string(limit_op_name(limit_.op)),
            limit_value(limit_),
            std::string(limit_.measure->unit),
            limit_.from,
            parameters_};
  }

  void add_row(Verdict verdict, std::size_t element, const MeasureValue& value, bool placed) {
    ++listed_;
    if (listed_ > kMostOfOneLimit / weight() || report_.requirements.size() >= kMostRequirements) {
      ++report_.unlisted_requirements;
      return;
    }
    Requirement requirement{row(value), {}, {}, verdict, severity_};
    if (placed && limit_.on != MeasureScope::asset) {
      requirement.pointer = places_.pointer(limit_.on, element);
      requirement.object_name = places_.name(limit_.on, element);
    }
    report_.requirements.push_back(std::move(requirement));
  }

  const LimitPlaces& places_;
  const Limit& limit_;
  const Severity severity_;
  std::string parameters_;  // in words
  measure::LimitTexts texts_;
  FileReport& report_;
  Sink& sink_;
  std::map<std::string, std::size_t> seen_;  // the first element with a text
  std::optional<std::size_t> nearest_;       // of those that hold
  double least_ = 0;                         // its distance to the limit
  std::size_t listed_ = 0;                   // rows, also those that are only counted
};

}  // namespace

void check_limits(const Context& context, const measure::Source& source, FileReport& report,
                  Sink& sink) {
  const std::vector<Limit>& limits = context.options.limits;
  if (limits.empty() || context.deviations.no_additional_rules) return;
  std::vector<Group> groups = groups_of(limits, context.options);
  if (groups.empty()) return;
  std::vector<Measurements> taken;
  std::vector<std::optional<std::size_t>> group_of(limits.size());
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (context.options.products) {
      groups[group].request.parameters.product = context.options.products->find(report.path);
    }
    taken.push_back(measure::take(source, groups[group].request));
    for (const std::size_t limit : groups[group].limits) group_of[limit] = group;
  }
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (!group_of[i]) continue;
    const Measurements& values = taken[*group_of[i]];
    const LimitPlaces places(context, values, source.default_scene());
    LimitCheck(places, limits[i], severity_of(context.options, limits[i]), report, sink)
        .run(values);
  }
}

}  // namespace gltfx::validate
