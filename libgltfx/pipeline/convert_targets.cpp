// SPDX-License-Identifier: Apache-2.0
#include "pipeline/convert_targets.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/apply.hpp"
#include "model/draco.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx {
namespace {

using target::Repair;
using validate::Shortfall;

// Whether the picture suffers.
bool matters(const Shortfall& found) { return found.refused || !found.harmless; }

// Elements in bitstreams must be decoded before these.
constexpr std::initializer_list<Repair> kOfElements{
    Repair::float_attributes, Repair::float_texcoords, Repair::float_colors, Repair::float_weights,
    Repair::wide_indices,     Repair::write_indices,   Repair::lists};

bool packs_elements(const model::OpenedAsset& asset) {
  return asset.document().key_id(model::kDracoExtension) != json::kNoKey;
}

}  // namespace

ConvertTargets::ConvertTargets(model::OpenedAsset& before,
                               std::shared_ptr<const schema::Set> schemas, ConvertOptions& options)
    : options_(options), schemas_(std::move(schemas)) {
  if (options.targets.empty()) return;
  before_ = validate::find_shortfalls(before, options.targets, schemas_, options.jobs);
  for (const Shortfall& found : before_) {
    if (!matters(found)) continue;
    if (const auto repair = target::repair_of(found.feature)) {
      repairs_.add(*repair, found.feature, found.only_required);
    }
  }
  if (packs_elements(before) && repairs_.has_any(kOfElements)) {
    repairs_.add(Repair::decode_draco, model::kDracoExtension, false);
  }
  if (repairs_.has(Repair::decode_draco)) add_zeros();
  choose_container(before, options);
  if (options.shrink) choose_encoding(options);
}

bool ConvertTargets::need(const steps::StepDescription& step) const {
  return std::any_of(step.repairs.begin(), step.repairs.end(),
                     [this](Repair repair) { return repairs_.has(repair); });
}

// An attribute that a bitstream does not have, and that has no data, is zero afterwards.
void ConvertTargets::add_zeros() {
  constexpr std::string_view kZeros = "accessor.zeros";
  for (const TargetChoice& choice : options_.targets) {
    const auto found = choice.target->features.find(kZeros);
    if (found == choice.target->features.end()) continue;
    const TargetRange* range = outcome_of(found->second.used, choice.version);
    if (range == nullptr || range->outcome > TargetOutcome::ignored) continue;
    repairs_.add(Repair::plain_accessors, kZeros, false);
  }
}

void ConvertTargets::choose_container(const model::OpenedAsset& before,
                                      ConvertOptions& options) const {
  if (options.to) return;
  const bool one_file = repairs_.has(Repair::one_file);
  const bool no_data_uris = repairs_.has(Repair::no_data_uris);
  if (!one_file && !no_data_uris) return;
  if (before.container().format == container::Format::glb) {
    options.to = StoredAs::glb;
  } else {
    options.to = no_data_uris ? StoredAs::gltf : StoredAs::embedded;
  }
}

bool ConvertTargets::all_read(std::string_view extension) const {
  return std::all_of(
      options_.targets.begin(), options_.targets.end(), [&](const TargetChoice& choice) {
        const auto found = choice.target->features.find(extension);
        if (found == choice.target->features.end()) return false;
        const TargetRange* range = outcome_of(found->second.required, choice.version);
        return range != nullptr && range->outcome >= TargetOutcome::read;
      });
}

// The first that all read is the smallest.
void ConvertTargets::choose_encoding(ConvertOptions& options) const {
  if (!options.compress) {
    if (all_read(model::kMeshoptExtensions.front())) {
      options.compress = Compression::meshopt;
    } else if (all_read(model::kDracoExtension)) {
      options.compress = Compression::draco;
    }
  }
  if (!options.images.empty()) return;
  for (const schema::Extension& extension : schemas_->extensions()) {
    const auto& types = extension.image_mime_types;
    const bool webp = std::find(types.begin(), types.end(), "image/webp") != types.end();
    if (webp && all_read(extension.name)) return options.images.push_back({ImageTarget::webp, {}});
  }
}

bool ConvertTargets::is_new(const Shortfall& found) const {
  return std::none_of(before_.begin(), before_.end(), [&](const Shortfall& old) {
    return old.target == found.target && old.feature == found.feature && matters(old);
  });
}

std::optional<std::string> ConvertTargets::check(const model::OpenedAsset& before,
                                                 const change::Change& change,
                                                 ConvertReport& report) const {
  if (options_.targets.empty()) return std::nullopt;
  std::vector<Shortfall> lacks = before_;
  if (!change.empty()) {
    auto after = change::apply(before, change);
    if (!after) return after.error().message;
    lacks = validate::find_shortfalls(*after, options_.targets, schemas_, options_.jobs);
  }
  std::optional<std::string> why;
  for (Shortfall& found : lacks) {
    if (!matters(found)) continue;
    const bool bad = found.refused || is_new(found);
    if (bad && !why) {
      why = fmt::format("{} (--partial writes the rest)", half_sentence(found.message));
    }
    report.remaining.push_back({options_.targets[found.target].label(), std::move(found.feature),
                                std::move(found.pointer), std::move(found.message),
                                std::move(found.help), found.refused});
  }
  return options_.partial ? std::nullopt : why;
}

}  // namespace gltfx
