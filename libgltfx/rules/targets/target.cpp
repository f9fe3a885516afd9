// SPDX-License-Identifier: Apache-2.0
// The treatment of features of the asset by the engines that the user names. No findings without
// targets.
#include <gltfx/targets.hpp>

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/finding.hpp"
#include "rules/phases.hpp"
#include "rules/targets/features.hpp"

namespace gltfx::validate {
namespace {

bool is_extension(std::string_view feature) {
  return feature.front() < 'a' && feature.find('_') != std::string_view::npos;
}

// If a use was not measured, the outcome without a fallback is the same for an engine that does not
// read the extension.
const TargetRange* find_outcome(const TargetChoice& choice, std::string_view name, FeatureUse use) {
  const auto found = choice.target->features.find(name);
  if (found == choice.target->features.end()) return nullptr;
  const TargetFeature& feature = found->second;
  if (use == FeatureUse::used) return outcome_of(feature.used, choice.version);
  if (use == FeatureUse::required_with_fallback) {
    const TargetRange* range = outcome_of(feature.required_with_fallback, choice.version);
    if (range != nullptr) return range;
  }
  return outcome_of(feature.required, choice.version);
}

class TargetCheck {
 public:
  TargetCheck(const Context& context, Sink& sink) : context_(context), sink_(sink) {}

  void check(const TargetChoice& choice, std::string_view name, const FeaturePlace& place) const {
    const TargetRange* range = find_outcome(choice, name, place.use);
    if (range == nullptr || range->outcome > TargetOutcome::ignored) return;
    const auto known = target_features().find(name);
    if (known == target_features().end()) return;
    const Feature& feature = known->second;
    const std::string subject = is_extension(name) ? std::string(name) : feature.title;
    if (range->outcome == TargetOutcome::refused) {
      const std::string_view how =
          is_extension(name) && place.use != FeatureUse::used ? "that require" : "with";
      return report(place, name, Code::TARGET_REFUSES, {},
                    fmt::format("{} refuses assets {} {}.", choice.label(), how, subject), feature);
    }
    if (feature.effect == FeatureEffect::none) return;
    std::string message = fmt::format("{} ignores {}: {}.", choice.label(), subject, feature.lost);
    if (name.find("-over-") != std::string_view::npos) {
      return report(place, name, Code::TARGET_LIMIT, {}, std::move(message), feature);
    }
    const bool harmless = place.fallback || feature.effect == FeatureEffect::data;
    report(place, name, Code::TARGET_IGNORES,
           harmless ? std::optional(Severity::info) : std::nullopt, std::move(message), feature);
  }

 private:
  void report(const FeaturePlace& place, std::string_view name, Code code,
              std::optional<Severity> severity, std::string message, const Feature& feature) const {
    Finding finding = finding_on(context_, place.node, code, std::move(message), feature.help);
    finding.severity = severity;
    finding.about = name;  // findings about other features and targets are not repeats
    finding.about += finding.message;
    const bool is_file = place.node == json::kNoNode;
    report_at(sink_, is_file ? std::string() : context_.document.pointer_of(place.node),
              std::move(finding));
  }

  const Context& context_;
  Sink& sink_;
};

}  // namespace

void check_targets(const Context& context, const model::ResourceData& resources, Sink& sink) {
  const auto& targets = context.options.targets;
  if (targets.empty() || context.deviations.no_additional_rules) return;
  const Features features = find_features(context, resources);
  const TargetCheck check(context, sink);
  for (const TargetChoice& choice : targets) {
    for (const auto& [name, place] : features.all()) check.check(choice, name, place);
  }
}

}  // namespace gltfx::validate
