// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_rounds.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/pages.hpp"
#include "change/apply.hpp"
#include "json/parse.hpp"
#include "pipeline/fix_trials.hpp"
#include "prove/findings.hpp"
#include "rules/collector.hpp"
#include "rules/context.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::Site;
using validate::Sites;
using validate::ValidatedAsset;
using Positions = SitePositions;

constexpr unsigned kMostRounds = 32;
constexpr std::size_t kMostPointers = 10;

/// A code and where it is found in the text; UINT32_MAX: the file as a whole.
using SitePlace = std::pair<Code, std::uint32_t>;

SitePlace place_of(const Site& site) {
  return {site.code, site.span.end == 0 ? UINT32_MAX : site.span.begin};
}

/// Actions by code; those that were planned and left out stand apart from those without a plan.
class Tally {
 public:
  Tally(bool done, const FixOptions& options) : is_done_(done), options_(options) {}
  void add(const json::Document& document, const Site& site, Severity severity,
           const std::string& why_not = {}) {
    FixAction& action = actions_[{code_name(site.code), why_not.empty()}];
    action.code = code_name(site.code);
    const bool more = validate::find_fix(site.code)->unsafe != nullptr;
    action.kind = more && allows_unsafe(options_, site.code) ? Fix::unsafe
                                                             : validate::description(site.code).fix;
    action.severity = std::min(action.severity, severity);
    action.done = is_done_;
    if (action.why_not.empty()) action.why_not = why_not;
    ++action.count;
    if (action.pointers.size() < kMostPointers)
      action.pointers.push_back(pointer_to(document, site));
  }
  void move_to(std::vector<FixAction>& list) {
    for (auto& [code, action] : actions_) list.push_back(std::move(action));
  }

 private:
  std::map<std::pair<std::string_view, bool>, FixAction> actions_;
  bool is_done_;
  const FixOptions& options_;
};

using Names = std::set<std::string, std::less<>>;

// The extensions whose objects have errors.
Names unsound_extensions(const FileReport& report) {
  constexpr std::string_view kHolder = "/extensions/";
  Names names;
  for (const Diagnostic& finding : report.diagnostics) {
    if (finding.severity != Severity::error) continue;
    const std::string_view pointer = finding.pointer;
    for (std::size_t at = pointer.find(kHolder); at != pointer.npos;) {
      const std::size_t begin = at + kHolder.size();
      const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
      names.emplace(pointer.substr(begin, end - begin));
      at = pointer.find(kHolder, begin);
    }
  }
  return names;
}

/// What some fixes make of the asset.
struct Trial {
  PlannedFixes planned;
  ValidatedAsset after;
};

/// One asset on its way through the rounds.
class Rounds {
 public:
  Rounds(ValidatedAsset before, const FixOptions& options,
         const std::shared_ptr<const schema::Set>& schemas, const FileGuard& guard)
      : asset_(std::move(before)),
        options_(options),
        asked_(asked_of(asset_.asset(), options)),
        schemas_(schemas),
        guard_(guard),
        first_{asset_.asset().container().json, asset_.sites()},
        dropped_(first_.sites.size()),
        trials_(affordable_trials(asset_.asset())) {}

  FixedAsset run() {
    for (unsigned rounds = 0; rounds < kMostRounds && advance();) ++rounds;
    std::vector<FixAction> actions;
    if (changes_.any) {
      // One of the two documents at a time.
      forget_document();
      done().move_to(actions);
    }
    left_over().move_to(actions);
    return {std::move(asset_),
            std::move(actions),
            std::move(changes_.edits),
            std::move(changes_.files),
            std::move(changes_.new_files),
            changes_.any,
            std::move(trouble_)};
  }

 private:
  // Until it is asked for again.
  void forget_document() {
    if (!asset_.asset().is_large()) return;
    asset_.forget_large_document();
    give_back_memory();
  }

  Severity severity_of(const Site& site) const {
    const auto wanted = asked_.severity.find(validate::description(site.code).code);
    return wanted == asked_.severity.end() ? site.severity : wanted->second;
  }

  bool is_asked_for(const Site& site) const {
    const RuleDescription& rule = validate::description(site.code);
    if (options_.skip.contains(rule.code)) return false;
    if (rule.fix != Fix::safe) return allows_unsafe(options_, site.code);
    if (!options_.only.empty()) return options_.only.contains(rule.code);
    return validate::accepts(asked_, site.code, severity_of(site));
  }

  Tally done() const {
    Tally done(true, options_);
    const json::Parsed first = json::parse(first_.text);
    const std::vector<bool> gone =
        sites_gone(first_.sites, asset_.sites(), changes_.edits, changes_.fixed);
    for (std::size_t i = 0; i < gone.size(); ++i) {
      const Site& site = first_.sites[i];
      if (gone[i] && is_asked_for(site)) done.add(first.document, site, severity_of(site));
    }
    return done;
  }

  Tally left_over() const {
    Tally left(false, options_);
    for (std::size_t i = 0; i < dropped_.size(); ++i) {
      const Site& site = asset_.sites()[i];
      if (!is_asked_for(site)) continue;
      left.add(asset_.asset().document(), site, severity_of(site), reasons_[dropped_[i]]);
    }
    return left;
  }

  PlannedFixes plan(const std::vector<bool>& wanted) const {
    return plan_fixes(asset_.asset(), asset_.sites(), *schemas_, wanted, UINT64_MAX, options_);
  }

  // One more round; whether there may be another one.
  bool advance() {
    std::vector<bool> wanted;
    for (std::size_t i = 0; i < dropped_.size(); ++i) {
      wanted.push_back(dropped_[i] == 0 && is_asked_for(asset_.sites()[i]));
    }
    PlannedFixes planned = plan(wanted);
    if (!planned.trouble.empty()) {
      trouble_ = std::move(planned.trouble);
      return false;
    }
    for (const auto& [site, why] : planned.left) drop({site}, why);
    if (planned.change.empty() && planned.obstacle.empty()) {
      if (!planned.left.empty()) return true;
      // What stood against a fix may be gone by another one.
      if (!std::exchange(retries_, false)) return false;
      dropped_.assign(dropped_.size(), 0);
      return true;
    }
    Positions made;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (planned.fixed[i]) made.push_back(i);
    }
    const std::vector<json::NodeId> shared = std::move(planned.shared);
    auto trial = judge(std::move(planned));
    if (trial) {
      accept(*std::move(trial));
    } else if (!made.empty()) {
      resolve(made, shared, trial.error().message);
    }
    return trial || !made.empty();
  }

  // The extensions that the plan declares.
  Names declared(const PlannedFixes& planned) const {
    const json::Document& document = asset_.asset().document();
    Names names;
    for (std::size_t i = 0; i < planned.fixed.size(); ++i) {
      const Site& site = asset_.sites()[i];
      if (!planned.fixed[i] || site.code != Code::UNDECLARED_EXTENSION) continue;
      const json::NodeId key = validate::node_at(document, site.span);
      if (key != json::kNoNode) names.emplace(document.key(document.node(key).next));
    }
    return names;
  }

  // Why one of the files is not to be changed so, or nothing.
  std::optional<std::string> find_guarded(const std::vector<change::ReplacedFile>& files) const {
    if (!guard_) return std::nullopt;
    for (change::ReplacedFile file : files) {
      const auto known = changes_.files.find(file.path);
      if (known != changes_.files.end()) file.before = known->second.before;
      if (auto why = guard_(file)) return why;
    }
    return std::nullopt;
  }

  // Whether all fixes of the plan are of some codes.
  template <class Is>
  bool fixes_only(const PlannedFixes& planned, const Is& is) const {
    for (std::size_t i = 0; i < planned.fixed.size(); ++i) {
      if (planned.fixed[i] && !is(asset_.sites()[i].code)) return false;
    }
    return true;
  }

  // What is wrong with a file that could not be opened is no fault of the name that leads to it;
  // but a file with errors may not be the one that is meant, unless it has the name that was asked
  // for. Likewise, what is found in a converted image is no fault of the conversion.
  Severity least_that_counts(const PlannedFixes& planned) const {
    const bool files = fixes_only(planned, [](Code code) {
      const validate::FixStage stage = validate::find_fix(code)->stage;
      return stage == validate::FixStage::files || stage == validate::FixStage::images;
    });
    return files ? Severity::error : Severity::info;
  }
  bool names_the_same_files(const PlannedFixes& planned) const {
    return fixes_only(planned, [](Code code) { return code == Code::NON_RELATIVE_URI; });
  }

  // What the changes make of the asset, or why it is not to be taken.
  Result<Trial> judge(PlannedFixes planned) {
    if (!planned.obstacle.empty()) return Error{planned.obstacle};
    if (auto why = find_guarded(planned.change.replaced)) return Error{*std::move(why)};
    auto changed = change::apply(asset_.asset(), planned.change);
    if (!changed) return changed.error();
    const bool was_read = !asset_.asset().document().empty() && !names_the_same_files(planned);
    const Names names = declared(planned);
    forget_document();
    ValidatedAsset next(*std::move(changed), fix_validation(schemas_, asked_));
    const auto worse = prove::more_findings(prove::CodeCounts(asset_.report()), next.report(),
                                            least_that_counts(planned));
    // What could not be read could not be found.
    if (!worse.empty() && (was_read || next.asset().document().empty())) {
      return Error{fmt::format("the new file would have the new finding {}", worse.front().code)};
    }
    if (!names.empty()) {
      // A reader that passed over the extension would look into it.
      const Names unsound = unsound_extensions(next.report());
      for (const std::string& name : names) {
        if (unsound.contains(name)) return Error{fmt::format("objects of {} have errors", name)};
      }
    }
    return Trial{std::move(planned), std::move(next)};
  }

  // Takes over as many of the fixes as bring nothing new, and drops the others.
  void resolve(const Positions& made, const std::vector<json::NodeId>& shared,
               const std::string& why) {
    std::vector<Positions> groups = parts_of(made, asset_.sites(), shared);
    if (groups.size() == 1) return drop(made, why);
    std::vector<bool> good(asset_.sites().size());
    std::optional<Trial> best;
    while (!groups.empty()) {
      const Positions group = std::move(groups.back());
      groups.pop_back();
      if (trials_ == 0) {
        drop(group, why);
        continue;
      }
      --trials_;
      std::vector<bool> wanted = good;
      for (const std::size_t i : group) wanted[i] = true;
      auto trial = judge(plan(wanted));
      if (trial) {
        good = std::move(wanted);
        best.emplace(*std::move(trial));
      } else if (auto parts = parts_of(group, asset_.sites(), shared); parts.size() == 1) {
        drop(group, trial.error().message);
      } else {
        std::move(parts.begin(), parts.end(), std::back_inserter(groups));
      }
    }
    if (best && !best->planned.change.empty()) accept(*std::move(best));
  }

  void drop(const Positions& group, const std::string& why) {
    if (reasons_.back() != why) reasons_.push_back(why);
    for (const std::size_t i : group) dropped_[i] = static_cast<std::uint32_t>(reasons_.size() - 1);
  }

  void accept(Trial trial) {
    mark_fixed(first_.sites, changes_.edits, asset_.sites(), trial.planned.fixed, changes_.fixed);
    move_dropped(trial.planned.change.edits, trial.after.sites());
    if (first_.text)
      changes_.edits = json::chain_edits(*first_.text, changes_.edits, trial.planned.change.edits);
    for (change::ReplacedFile& file : trial.planned.change.replaced) {
      const auto [known, is_new] = changes_.files.try_emplace(file.path, file);
      if (!is_new) known->second.after = file.after;
    }
    std::move(trial.planned.change.files.begin(), trial.planned.change.files.end(),
              std::back_inserter(changes_.new_files));
    asset_ = std::move(trial.after);
    changes_.any = true;
  }

  // What stood in a text that is gone is judged anew.
  void move_dropped(const std::vector<json::Edit>& edits, const Sites& sites) {
    const json::Relocation relocation(edits);
    std::vector<std::pair<SitePlace, std::uint32_t>> moved;
    for (std::size_t i = 0; i < dropped_.size(); ++i) {
      if (dropped_[i] == 0) continue;
      const SitePlace place = place_of(asset_.sites()[i]);
      const bool whole = place.second == UINT32_MAX;
      const Span now = whole ? Span{place.second, place.second} : relocation.of(place.second);
      if (whole || now.size() == 1)
        moved.emplace_back(SitePlace{place.first, now.begin}, dropped_[i]);
    }
    retries_ = !moved.empty();
    std::sort(moved.begin(), moved.end());
    dropped_.assign(sites.size(), 0);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const SitePlace place = place_of(sites[i]);
      const auto at = std::lower_bound(moved.begin(), moved.end(), std::pair(place, 0U));
      if (at != moved.end() && at->first == place) dropped_[i] = at->second;
    }
  }

  ValidatedAsset asset_;
  const FixOptions& options_;
  const ValidateOptions asked_;
  const std::shared_ptr<const schema::Set>& schemas_;
  const FileGuard& guard_;
  const struct {
    SharedText text;
    Sites sites;
  } first_;
  // What all rounds so far come to.
  struct {
    std::vector<json::Edit> edits;
    std::map<std::string, change::ReplacedFile> files;
    std::vector<change::NewFile> new_files;
    std::vector<bool> fixed;  ///< by site of `first_`
    bool any = false;
  } changes_;
  std::string trouble_;  // as in FixedAsset
  // Sites, by position, that are left out: the number of the reason; 0 for others.
  std::vector<std::uint32_t> dropped_;
  std::vector<std::string> reasons_{""};
  bool retries_ = false;  // something was accepted after something was dropped
  std::uint64_t trials_;  // left, for what stands against others
};

}  // namespace

FixedAsset fix_in_rounds(ValidatedAsset before, const FixOptions& options,
                         const std::shared_ptr<const schema::Set>& schemas,
                         const FileGuard& guard) {
  return Rounds(std::move(before), options, schemas, guard).run();
}

}  // namespace gltfx
