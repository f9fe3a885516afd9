// SPDX-License-Identifier: Apache-2.0
// The treatment of features of the asset by the engines that the user names. No findings without
// targets.
#include <gltfx/targets.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/finding.hpp"
#include "rules/phases.hpp"
#include "rules/targets/features.hpp"
#include "rules/validator.hpp"
#include "target/repair.hpp"

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

// Whether the target loads an asset with the extension if it is not required.
bool reads_used(const TargetChoice& choice, std::string_view name) {
  const auto found = choice.target->features.find(name);
  if (!is_extension(name) || found == choice.target->features.end()) return false;
  const TargetRange* range = outcome_of(found->second.used, choice.version);
  return range != nullptr && range->outcome != TargetOutcome::refused;
}

class TargetCheck {
 public:
  TargetCheck(const Context& context, Sink& sink, std::vector<Shortfall>* shortfalls)
      : context_(context), sink_(sink), shortfalls_(shortfalls) {}

  void check(std::size_t target, std::string_view name, const FeaturePlace& place) {
    const TargetChoice& choice = context_.options.targets[target];
    const TargetRange* range = find_outcome(choice, name, place.use);
    if (range == nullptr || range->outcome > TargetOutcome::ignored) return;
    const auto known = target_features().find(name);
    if (known == target_features().end()) return;
    const Feature& feature = known->second;
    const std::string subject = is_extension(name) ? std::string(name) : feature.title;
    Shortfall found;
    found.target = target;
    found.feature = name;
    found.help = feature.help;
    found.refused = range->outcome == TargetOutcome::refused;
    found.only_required = reads_used(choice, name);
    if (found.refused) {
      const std::string_view how =
          is_extension(name) && place.use != FeatureUse::used ? "that require" : "with";
      found.message = fmt::format("{} refuses assets {} {}.", choice.label(), how, subject);
      return report(place, Code::TARGET_REFUSES, std::move(found));
    }
    if (feature.effect == FeatureEffect::none) return;
    found.message = fmt::format("{} ignores {}: {}.", choice.label(), subject, feature.lost);
    found.harmless = place.fallback || feature.effect == FeatureEffect::data;
    const bool limit = name.find("-over-") != std::string_view::npos;
    report(place, limit ? Code::TARGET_LIMIT : Code::TARGET_IGNORES, std::move(found));
  }

 private:
  void report(const FeaturePlace& place, Code code, Shortfall found) {
    Finding finding = finding_on(context_, place.node, code, found.message, help_of(found));
    if (code == Code::TARGET_IGNORES && found.harmless) finding.severity = Severity::info;
    finding.about = found.feature;  // findings about other features and targets are not repeats
    finding.about += finding.message;
    if (place.node != json::kNoNode) found.pointer = context_.document.pointer_of(place.node);
    report_at(sink_, found.pointer, std::move(finding));
    if (shortfalls_ != nullptr) shortfalls_->push_back(std::move(found));
  }

  // The help of the feature, and the command that does it.
  std::string help_of(const Shortfall& found) const {
    const bool repairable = target::repair_of(found.feature) && (found.refused || !found.harmless);
    if (!repairable) return found.help;
    const TargetChoice& choice = context_.options.targets[found.target];
    const auto& versions = choice.target->versions;
    const bool newest = choice.version + 1 == versions.size();
    const std::string command =
        fmt::format("`gltfx convert FILE -o OUTPUT --target {}{}`", choice.target->name,
                    newest ? std::string() : "@" + versions[choice.version].version);
    return found.help.empty() ? "convert the asset with " + command
                              : fmt::format("{}, as {} does", found.help, command);
  }

  const Context& context_;
  Sink& sink_;
  std::vector<Shortfall>* shortfalls_;
};

}  // namespace

void check_targets(const Context& context, const model::ResourceData& resources, Sink& sink,
                   std::vector<Shortfall>* shortfalls) {
  const auto& targets = context.options.targets;
  if (targets.empty() || context.deviations.no_additional_rules) return;
  const Features features = find_features(context, resources);
  TargetCheck check(context, sink, shortfalls);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (const auto& [name, place] : features.all()) check.check(i, name, place);
  }
}

std::vector<Shortfall> find_shortfalls(model::OpenedAsset& asset,
                                       const std::vector<TargetChoice>& targets,
                                       const std::shared_ptr<const schema::Set>& schemas,
                                       unsigned jobs) {
  ValidateOptions options;
  options.targets = targets;
  options.schemas = schemas;
  options.jobs = jobs;
  std::vector<Shortfall> shortfalls;
  validate(asset, options, nullptr, &shortfalls);
  return shortfalls;
}

}  // namespace gltfx::validate
