// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_rounds.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "edit/rewrite.hpp"
#include "validate/context.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::FixEntry;
using validate::Fixing;
using validate::FixStage;
using validate::Site;
using validate::Sites;
using validate::ValidatedAsset;
using CountsByCode = std::map<std::string_view, std::uint64_t>;

constexpr unsigned kMostRounds = 32;
constexpr std::size_t kMostPointers = 10;

CountsByCode counts_of(const FileReport& report) {
  CountsByCode counts;
  for (const Diagnostic& finding : report.diagnostics) counts[finding.code] += finding.count;
  return counts;
}

/// Actions by code.
class Tally {
 public:
  void add(Code code, std::uint64_t count, std::vector<std::string> pointers) {
    FixAction& action = actions_[code_name(code)];
    action.code = code_name(code);
    action.kind = validate::description(code).fix;
    action.count += count;
    for (std::string& pointer : pointers) {
      if (action.pointers.size() < kMostPointers) action.pointers.push_back(std::move(pointer));
    }
  }
  bool wants_pointer(Code code) const {
    const auto found = actions_.find(code_name(code));
    return found == actions_.end() || found->second.pointers.size() < kMostPointers;
  }
  std::vector<FixAction> take() {
    std::vector<FixAction> list;
    for (auto& [code, action] : actions_) list.push_back(std::move(action));
    return list;
  }

 private:
  std::map<std::string_view, FixAction> actions_;
};

std::string pointer_at(const Fixing& fixing, Span place) {
  const json::NodeId node = fixing.node_at(place);
  return node == json::kNoNode ? std::string() : fixing.document().pointer_of(node);
}

// The first stage with a fix that does something.
std::optional<FixStage> first_stage(const Sites& sites, const std::function<bool(Code)>& wants,
                                    FixStage from) {
  std::optional<FixStage> first;
  for (const Site& site : sites) {
    const FixStage stage = validate::find_fix(site.code)->stage;
    if (stage < from || (first && stage >= *first) || !wants(site.code)) continue;
    first = stage;
  }
  return first;
}

// What is written anew with other lengths is opened anew.
Result<container::Container> changed_container(const OpenedAsset& asset,
                                               const Fixing::Changes& changes,
                                               const SharedText& text) {
  const container::Container& old = asset.container();
  if (!changes.container) return edit::rewritten(old, text, changes.buffers.bin, asset.name());
  const auto pieces = edit::rewrite_sound(old, *text, changes.buffers.bin);
  if (!pieces) return pieces.error();
  return container::open_bytes(container::Bytes::from_string(container::join(*pieces)),
                               asset.name());
}

/// One asset on its way through the rounds.
class Rounds {
 public:
  Rounds(ValidatedAsset before, const FixOptions& options,
         const std::shared_ptr<const schema::Set>& schemas, bool keeps_edits)
      : asset_(std::move(before)),
        options_(options),
        schemas_(schemas),
        keeps_edits_(keeps_edits),
        text_(asset_.asset().container().json) {}

  FixedAsset run() {
    unsigned rounds = 0;
    while (rounds < kMostRounds && advance()) ++rounds;
    FixedAsset fixed{std::move(asset_), done_.take(), std::move(edits_), std::move(files_),
                     changes_};
    for (FixAction& action : fixed.actions) action.done = true;
    for (FixAction& action : left_) {
      const auto why = dropped_.find(action.code);
      if (why != dropped_.end()) action.why_not = why->second;
      fixed.actions.push_back(std::move(action));
    }
    return fixed;
  }

 private:
  bool is_asked_for(Code code) const {
    const RuleDescription& rule = validate::description(code);
    if (options_.skip.contains(rule.code)) return false;
    if (rule.fix == Fix::safe) return options_.only.empty() || options_.only.contains(rule.code);
    return options_.unsafe && options_.only.contains(rule.code);
  }

  std::optional<PlannedFixes> plan(const std::function<bool(Code)>& wants) const {
    return plan_fixes(asset_.asset(), asset_.sites(), *schemas_, wants);
  }

  // One more round; whether there may be another one.
  bool advance() {
    auto planned = plan([this](Code code) { return is_asked_for(code) && !is_dropped(code); });
    if (!planned) return false;
    if (planned->done.empty() && retries_) {
      // What stood against a fix may be gone by another one.
      retries_ = false;
      dropped_.clear();
      return true;
    }
    if (planned->done.empty()) {
      left_ = everything_left();
      return false;
    }
    std::vector<std::string_view> codes;
    for (const FixAction& action : planned->done) codes.push_back(action.code);
    if (auto why = try_out(*std::move(planned)); !why.empty()) find_culprits(codes, why);
    return true;
  }

  bool is_dropped(Code code) const { return dropped_.contains(code_name(code)); }

  // What stays of all that was asked for, with the reason.
  std::vector<FixAction> everything_left() const {
    Tally tally;
    const auto planned = plan([this](Code code) { return is_asked_for(code); });
    if (!planned) return {};
    std::vector<FixAction> left = planned->left;
    for (const FixAction& action : planned->done) left.push_back(action);
    std::sort(left.begin(), left.end(),
              [](const FixAction& a, const FixAction& b) { return a.code < b.code; });
    return left;
  }

  // Takes the changes over and gives nothing, or says why they are none to take.
  std::string try_out(PlannedFixes planned) {
    const OpenedAsset& old = asset_.asset();
    auto changed = with_changes(old, planned.changes);
    if (!changed) return changed.error().message;
    const bool was_readable = !old.document().empty();
    ValidatedAsset next(*std::move(changed), fix_judgement(schemas_));
    const auto worse = worse_codes(asset_.report(), next.report());
    const bool readable = !next.asset().document().empty();
    if (!worse.empty() && (was_readable || !readable)) {
      return fmt::format("the new file would have the new finding {}", worse.front());
    }
    accept(std::move(planned), std::move(next));
    return {};
  }

  void accept(PlannedFixes planned, ValidatedAsset next) {
    for (const FixAction& action : planned.done) {
      done_.add(code_of(action.code), action.count, action.pointers);
    }
    if (keeps_edits_ && text_) {
      edits_ = json::chain_edits(*text_, edits_, planned.changes.edits);
    }
    for (edit::ReplacedFile& file : planned.changes.buffers.files) {
      const auto [known, is_new] = files_.try_emplace(file.path, file);
      if (!is_new) known->second.after = file.after;
    }
    asset_ = std::move(next);
    changes_ = true;
    retries_ = !dropped_.empty();
  }

  static Code code_of(std::string_view name) {
    return static_cast<Code>(find_rule(name) - rules().data());
  }

  // Of several fixes those that bring something new by themselves; where none does, all of them.
  void find_culprits(const std::vector<std::string_view>& codes, const std::string& why) {
    bool found = false;
    for (const std::string_view code : codes) {
      if (codes.size() == 1) break;
      auto alone = plan([code](Code each) { return code_name(each) == code; });
      if (!alone || alone->done.empty()) continue;
      std::string reason = try_out(*std::move(alone));
      if (reason.empty()) continue;
      dropped_.emplace(code, std::move(reason));
      found = true;
    }
    if (found) return;
    for (const std::string_view code : codes) dropped_.emplace(code, why);
  }

  ValidatedAsset asset_;
  const FixOptions& options_;
  const std::shared_ptr<const schema::Set>& schemas_;
  const bool keeps_edits_;
  const SharedText text_;  // the old one
  std::vector<json::Edit> edits_;
  std::map<std::string, edit::ReplacedFile> files_;
  Tally done_;
  std::vector<FixAction> left_;
  std::map<std::string_view, std::string> dropped_;  // why, by code
  bool changes_ = false;
  bool retries_ = false;  // something was accepted after something was dropped
};

}  // namespace

std::vector<std::string_view> worse_codes(const FileReport& before, const FileReport& after) {
  const CountsByCode known = counts_of(before);
  std::vector<std::string_view> worse;
  for (const auto& [code, count] : counts_of(after)) {
    const auto was = known.find(code);
    if (count > (was == known.end() ? 0 : was->second)) worse.push_back(code);
  }
  return worse;
}

ValidateOptions fix_judgement(const std::shared_ptr<const schema::Set>& schemas) {
  ValidateOptions options;
  options.profile = Profile::strict;
  options.pixels = PixelLevel::headers;
  options.jobs = 1;
  options.schemas = schemas;
  return options;
}

std::optional<PlannedFixes> plan_fixes(const OpenedAsset& asset, const Sites& sites,
                                       const schema::Set& schemas,
                                       const std::function<bool(Code)>& wants) {
  auto stage = first_stage(sites, wants, FixStage::container);
  PlannedFixes planned;
  planned.fixed.resize(sites.size());
  Tally done, left;
  while (stage) {
    Fixing fixing(asset, schemas);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const FixEntry& entry = *validate::find_fix(sites[i].code);
      if (entry.stage != *stage || !wants(entry.code)) continue;
      planned.fixed[i] = entry.fix(fixing, sites[i].span);
      Tally& tally = planned.fixed[i] ? done : left;
      std::vector<std::string> pointers;
      if (tally.wants_pointer(entry.code)) pointers.push_back(pointer_at(fixing, sites[i].span));
      tally.add(entry.code, 1, std::move(pointers));
    }
    auto changes = fixing.take();
    if (!changes) return std::nullopt;
    planned.changes = *std::move(changes);
    if (!planned.changes.empty()) break;
    stage = first_stage(sites, wants, static_cast<FixStage>(static_cast<int>(*stage) + 1));
  }
  if (!planned.changes.empty()) planned.done = done.take();
  planned.left = left.take();
  return planned;
}

std::vector<bool> fixable_sites(const OpenedAsset& asset, const Sites& sites,
                                const schema::Set& schemas) {
  std::vector<bool> fixable(sites.size());
  if (!asset.container().json || edit::find_glb_obstacle(asset.container())) return fixable;
  Fixing fixing(asset, schemas);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Code code = sites[i].code;
    if (validate::description(code).fix != Fix::safe) continue;
    fixable[i] = validate::find_fix(code)->fix(fixing, sites[i].span);
  }
  return fixable;
}

Result<OpenedAsset> with_changes(const OpenedAsset& asset, const Fixing::Changes& changes) {
  const container::Container& old = asset.container();
  if (!old.json) return Error{"it has no JSON"};
  const auto obstacle = edit::find_glb_obstacle(old);
  if (obstacle) return Error{"it cannot be written anew: " + *obstacle};
  const SharedText text = share_text(json::apply_edits(*old.json, changes.edits));
  auto container = changed_container(asset, changes, text);
  if (!container) return container.error();
  container::Resolver resolver = asset.resolver();
  for (const edit::ReplacedFile& file : changes.buffers.files) resolver.add(file.path, file.after);
  return OpenedAsset(asset.name(), *std::move(container), std::move(resolver));
}

FixedAsset fix_in_rounds(ValidatedAsset before, const FixOptions& options,
                         const std::shared_ptr<const schema::Set>& schemas, bool keeps_edits) {
  return Rounds(std::move(before), options, schemas, keeps_edits).run();
}

}  // namespace gltfx
