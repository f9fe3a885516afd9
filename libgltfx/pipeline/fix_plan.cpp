// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_plan.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/fix_images.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::Fixing;
using validate::FixStage;
using validate::Sites;

// The first stage, not before `from`, with a fix that is wanted.
std::optional<FixStage> first_stage(const Sites& sites, const std::vector<bool>& wanted,
                                    FixStage from) {
  std::optional<FixStage> first;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!wanted[i]) continue;
    const FixStage stage = validate::find_fix(sites[i].code)->stage;
    if (stage >= from && (!first || stage < *first)) first = stage;
  }
  return first;
}

/// Findings of an asset after a run, as they stand to those before it.
class Remains {
 public:
  Remains(const Sites& after, const std::vector<json::Edit>& edits) : relocation_(edits) {
    for (const validate::Site& site : after) {
      if (site.span.end == 0)
        ++places_[site.code].others;
      else
        places_[site.code].found.emplace_back(site.span.begin, false);
    }
    for (auto& [code, places] : places_) std::sort(places.found.begin(), places.found.end());
  }

  // Takes what is found where the site was. To be asked once for each site of a place.
  bool has(const validate::Site& site) {
    if (site.span.end == 0) return has_elsewhere(site.code);
    const auto places = places_.find(site.code);
    if (places == places_.end()) return false;
    auto& found = places->second.found;
    const Span now = relocation_.of(site.span.begin);
    auto at = std::lower_bound(found.begin(), found.end(), Found{now.begin, false});
    if (at == found.end() || at->first >= now.end) return false;
    // All that stands in what an edit put there is marked with the first.
    for (; at != found.end() && at->first < now.end && !at->second; ++at) at->second = true;
    return true;
  }

  // To be asked behind those: the same may be found at another place now, such as in the copy of a
  // member that stays when the other one is removed.
  void expect_no_more() {
    for (auto& [code, places] : places_) {
      places.others += static_cast<std::uint64_t>(std::count_if(
          places.found.begin(), places.found.end(), [](const Found& at) { return !at.second; }));
    }
  }
  bool has_elsewhere(Code code) {
    const auto places = places_.find(code);
    return places != places_.end() && places->second.others > 0 && places->second.others-- > 0;
  }

 private:
  using Found = std::pair<std::uint32_t, bool>;  ///< begin, and whether a site stood there before
  struct Places {
    std::vector<Found> found;
    std::uint64_t others = 0;  ///< of the file as a whole; in the end also without a counterpart
  };
  json::Relocation relocation_;
  std::map<Code, Places> places_;
};

// The change that converts the images of some sites.
Result<change::Change> convert_marked(const OpenedAsset& asset, const schema::Set& schemas,
                                      const std::map<std::size_t, std::uint32_t>& images,
                                      PlannedFixes& planned) {
  std::set<std::uint32_t> wanted;
  for (const auto& [site, image] : images) wanted.insert(image);
  LegalImages legal = make_images_legal(asset, schemas, wanted);
  planned.trouble = std::move(legal.trouble);
  for (const auto& [site, image] : images) {
    const auto reason = legal.left.find(image);
    if (reason == legal.left.end()) continue;
    planned.fixed[site] = false;
    planned.left.emplace(site, reason->second);
  }
  return std::move(legal.change);
}

}  // namespace

ValidateOptions asked_of(const OpenedAsset& asset, const FixOptions& options) {
  return options.validation ? options.validation(asset.name()) : ValidateOptions();
}

ValidateOptions fix_validation(const std::shared_ptr<const schema::Set>& schemas,
                               const ValidateOptions& asked) {
  ValidateOptions options;
  options.inline_suppressions = asked.inline_suppressions;
  options.profile = Profile::strict;
  options.pixels = PixelLevel::headers;
  options.jobs = 1;
  options.schemas = schemas;
  return options;
}

bool allows_unsafe(const FixOptions& options, Code code) {
  return options.unsafe && options.only.contains(code_name(code));
}

PlannedFixes plan_fixes(const OpenedAsset& asset, const Sites& sites, const schema::Set& schemas,
                        const std::vector<bool>& wanted, std::uint64_t content_bytes,
                        const FixOptions& options) {
  PlannedFixes planned;
  auto stage = first_stage(sites, wanted, FixStage::container);
  while (stage) {
    planned.fixed.assign(sites.size(), false);
    planned.shared.assign(sites.size(), json::kNoNode);
    Fixing fixing(asset, schemas, content_bytes);
    std::map<std::size_t, std::uint32_t> images;  // by site
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (!wanted[i]) continue;
      if (validate::find_fix(sites[i].code)->stage != *stage) continue;
      planned.fixed[i] = fixing.fix(sites[i], allows_unsafe(options, sites[i].code));
      planned.shared[i] = fixing.take_shared();
      if (const auto image = fixing.take_image()) images.emplace(i, *image);
    }
    auto change = *stage == FixStage::images ? convert_marked(asset, schemas, images, planned)
                                             : fixing.take();
    if (change) {
      planned.change = *std::move(change);
    } else {
      planned.obstacle = change.error().message;
    }
    if (!change || !planned.change.empty() || !planned.trouble.empty()) return planned;
    stage = first_stage(sites, wanted, static_cast<FixStage>(static_cast<int>(*stage) + 1));
  }
  planned.fixed.assign(sites.size(), false);
  return planned;
}

std::vector<bool> sites_gone(const Sites& sites, const Sites& after,
                             const std::vector<json::Edit>& edits, const std::vector<bool>& fixed) {
  Remains remains(after, edits);
  std::vector<bool> gone;
  for (const validate::Site& site : sites) gone.push_back(!remains.has(site));
  remains.expect_no_more();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (gone[i] && !fixed[i] && remains.has_elsewhere(sites[i].code)) gone[i] = false;
  }
  return gone;
}

void mark_fixed(const Sites& sites, const std::vector<json::Edit>& edits, const Sites& now,
                const std::vector<bool>& fixed, std::vector<bool>& marked) {
  marked.resize(sites.size());
  std::set<std::pair<Code, std::uint32_t>> places;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (fixed[i] && now[i].span.end != 0) places.emplace(now[i].code, now[i].span.begin);
  }
  const json::Relocation relocation(edits);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sites[i].span.end == 0) continue;
    const Span place = relocation.of(sites[i].span.begin);
    // What stands in new text is another finding.
    if (place.size() == 1 && places.contains({sites[i].code, place.begin})) marked[i] = true;
  }
}

std::string pointer_to(const json::Document& document, const validate::Site& site) {
  const json::NodeId node = validate::node_around(document, site.span);
  if (node == json::kNoNode) return "";
  std::string pointer = document.pointer_of(node);
  if (document.node(node).begin == site.span.begin) return pointer;
  if (document.kind(node) != json::Kind::number_array) return "";
  std::uint64_t index = 0;
  for (json::NumberCursor at(document, node); at.valid(); at.advance(), ++index) {
    if (at.number().span.begin == site.span.begin) return fmt::format("{}/{}", pointer, index);
  }
  return pointer;
}

}  // namespace gltfx
