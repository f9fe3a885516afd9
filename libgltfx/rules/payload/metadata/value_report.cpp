// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/value_scan.hpp"
#include "rules/payload/metadata/values.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataComponent;
using model::MetadataProperty;

std::vector<double> numbers_of(const json::Document& document, json::NodeId object,
                               std::string_view member, const MetadataProperty& property) {
  return metadata_numbers(document, document.find(object, member), property)
      .value_or(std::vector<double>());
}

// The values that readers compute from stored numbers (3D Metadata, "Normalized Values", "Offset
// and Scale").
class Transform {
 public:
  Transform(const MetadataProperty& property, const ValueLimits& limits)
      : property_(property), limits_(limits), most_(metadata_range(property.component).most) {}

  // Both ends of a component, in order.
  std::pair<double, double> of(double least, double most, std::size_t component) const {
    if (!property_.normalized) return {least, most};
    const double one = value(least, component);
    const double other = value(most, component);
    return {std::min(one, other), std::max(one, other)};
  }

 private:
  double value(double stored, std::size_t component) const {
    const double scale = component < limits_.scale.size() ? limits_.scale[component] : 1;
    const double offset = component < limits_.offset.size() ? limits_.offset[component] : 0;
    return offset + scale * std::max(stored / most_, -1.0);
  }

  const MetadataProperty& property_;
  const ValueLimits& limits_;
  double most_;
};

// The allowed difference between a written and a stored number.
double slack_of(const MetadataProperty& property, double bound, double value) {
  const double greatest = std::max(std::fabs(bound), std::fabs(value));
  if (property.normalized || property.component == MetadataComponent::float32) {
    return greatest * 1e-6;
  }
  const bool wide = property.component == MetadataComponent::float64 ||
                    property.component == MetadataComponent::int64 ||
                    property.component == MetadataComponent::uint64;
  return wide ? greatest * 1e-14 : 0;
}

std::string component_text(const MetadataProperty& property, std::size_t component) {
  return property.width() == 1 ? std::string() : fmt::format(" of component {}", component);
}

class LimitCheck {
 public:
  LimitCheck(const MetadataProperty& property, const ValueLimits& limits,
             const ValueFindings& found, std::vector<StoredFinding>& findings)
      : property_(property), limits_(limits), found_(found), findings_(findings) {}

  void run() {
    outside(limits_.class_min, "", "the class property", false);
    outside(limits_.class_max, "", "the class property", true);
    outside(limits_.min, "min", "itself", false);
    outside(limits_.max, "max", "itself", true);
  }

 private:
  // `own`: a bound of the object that stores the values, which must be reached.
  void outside(const std::vector<double>& bounds, std::string_view member, std::string_view whose,
               bool upper) {
    const bool own = !member.empty();
    const Transform transform(property_, limits_);
    for (std::size_t i = 0; i < bounds.size() && i < found_.least.size(); ++i) {
      const auto [least, most] = transform.of(found_.least[i], found_.most[i], i);
      const double value = upper ? most : least;
      const double slack = slack_of(property_, bounds[i], value);
      const double beyond = upper ? value - bounds[i] : bounds[i] - value;
      if (beyond > slack) return report_outside(bounds[i], value, i, upper, own ? "" : whose);
      if (own && -beyond > slack) return report_mismatch(bounds[i], value, i, upper, member);
    }
  }

  void report_outside(double bound, double value, std::size_t component, bool upper,
                      std::string_view whose) {
    const std::string_view name = upper ? "max" : "min";
    findings_.push_back(
        {"",
         Finding(Code::METADATA_VALUE_BEYOND_LIMIT,
                 fmt::format("The {} value{} is {}; {}{}{} is {}.", upper ? "greatest" : "smallest",
                             component_text(property_, component), number_text(value), name,
                             whose.empty() ? "" : " of ", whose, number_text(bound)))});
  }

  void report_mismatch(double bound, double value, std::size_t component, bool upper,
                       std::string_view member) {
    findings_.push_back(
        {member, Finding(Code::METADATA_LIMIT_NOT_REACHED,
                         fmt::format("{}{} is {}, but the {} value is {}.", member,
                                     component_text(property_, component), number_text(bound),
                                     upper ? "greatest" : "smallest", number_text(value)))});
  }

  const MetadataProperty& property_;
  const ValueLimits& limits_;
  const ValueFindings& found_;
  std::vector<StoredFinding>& findings_;
};

std::string first_of_many(std::string sentence, std::uint64_t count) {
  return count > 1 ? fmt::format("{} It is the first of {}.", sentence, count) : sentence;
}

}  // namespace

ValueLimits value_limits(const MetadataPhase& phase, const PropertyUse& use) {
  const MetadataProperty& property = use.property;
  const json::Document& classes = phase.schema.document();
  const json::Document& asset = phase.document();
  ValueLimits limits;
  limits.class_min = numbers_of(classes, property.node, "min", property);
  limits.class_max = numbers_of(classes, property.node, "max", property);
  limits.min = numbers_of(asset, use.value, "min", property);
  limits.max = numbers_of(asset, use.value, "max", property);
  const auto in_force = [&](std::string_view member) {
    std::vector<double> own = numbers_of(asset, use.value, member, property);
    return own.empty() ? numbers_of(classes, property.node, member, property) : own;
  };
  limits.offset = in_force("offset");
  limits.scale = in_force("scale");
  limits.no_data = numbers_of(classes, property.node, "noData", property);
  const model::MetadataRange range = metadata_range(property.component);
  const bool storable = std::all_of(limits.no_data.begin(), limits.no_data.end(), [&](double each) {
    return each >= range.least && each <= range.most;
  });
  if (!storable) limits.no_data.clear();
  return limits;
}

std::vector<StoredFinding> describe_values(const MetadataProperty& property,
                                           const ValueLimits& limits, const ValueFindings& found,
                                           std::string_view what) {
  std::vector<StoredFinding> findings;
  if (found.infinite.count != 0) {
    findings.push_back(
        {"", Finding(Code::METADATA_VALUE_NOT_FINITE,
                     first_of_many(fmt::format("The value of {} {} is {}; it must be finite.", what,
                                               found.infinite.row, found.infinite.value),
                                   found.infinite.count))});
  }
  if (found.unlisted.count != 0) {
    findings.push_back(
        {"", Finding(Code::METADATA_ENUM_VALUE_UNKNOWN,
                     first_of_many(
                         fmt::format("The value of {} {} is {}, which is not a value of enum {}.",
                                     what, found.unlisted.row, found.unlisted.value,
                                     gltfx::quoted(property.enumeration->id)),
                         found.unlisted.count))});
  }
  LimitCheck(property, limits, found, findings).run();
  return findings;
}

void report_stored(MetadataPhase& phase, const Path& path, json::NodeId node,
                   std::vector<StoredFinding> findings) {
  for (StoredFinding& each : findings) {
    if (each.member.empty()) {
      each.finding.span = first_character(phase.document(), node);
      phase.sink().report(path, std::move(each.finding));
    } else {
      each.finding.span = member_span(phase.document(), node, each.member);
      phase.sink().report(Path(path, each.member), std::move(each.finding));
    }
  }
}

void check_json_bounds(MetadataPhase& phase, const PropertyUse& use) {
  const auto numbers = metadata_numbers(phase.document(), use.value, use.property);
  if (!numbers) return;
  const auto of_class = [&](std::string_view member) {
    return numbers_of(phase.schema.document(), use.property.node, member, use.property);
  };
  if (of_class("noData") == *numbers) return;
  for (const std::string_view member : {"min", "max"}) {
    const std::vector<double> bounds = of_class(member);
    for (std::size_t i = 0; i < bounds.size() && i < numbers->size(); ++i) {
      const double value = (*numbers)[i];
      if (member == "min" ? value >= bounds[i] : value <= bounds[i]) continue;
      report_in(phase.sink(), use.path, phase.document(), use.value,
                Code::METADATA_VALUE_BEYOND_LIMIT,
                fmt::format("The value{} is {}; {} is {}.", component_text(use.property, i),
                            number_text(value), member, number_text(bounds[i])));
      return;
    }
  }
}

}  // namespace gltfx::validate
