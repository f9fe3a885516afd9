// SPDX-License-Identifier: Apache-2.0
#include "rules/own/own_rules.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "json/parse.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/own/own_measures.hpp"
#include "rules/own/own_members.hpp"

namespace gltfx {
namespace {

bool by_code(const RuleDescription& a, const RuleDescription& b) { return a.code < b.code; }

}  // namespace

OwnRules::OwnRules(Pages pages) : pages_(std::move(pages)) {
  std::sort(pages_.begin(), pages_.end(),
            [](const auto& a, const auto& b) { return a->code < b->code; });
  HashParts sources;
  for (const auto& page : pages_) {
    own_.push_back(page->description());
    sources.add(page->source);
  }
  sources_ = sources.finish();
  const auto ours = gltfx::rules();
  std::merge(ours.begin(), ours.end(), own_.begin(), own_.end(), std::back_inserter(table_),
             by_code);
}

std::shared_ptr<const OwnRules> OwnRules::of(const std::set<std::string>& files) const {
  Pages some;
  std::copy_if(pages_.begin(), pages_.end(), std::back_inserter(some),
               [&](const auto& page) { return files.contains(page->file); });
  return some.empty() ? nullptr : std::make_shared<const OwnRules>(std::move(some));
}

OwnRulesRead read_own_rules(std::span<const OwnRulePage> pages, const OwnRules* known) {
  OwnRulesRead read;
  OwnRules::Pages all;
  std::set<std::string_view> codes;
  if (known != nullptr) all = known->pages();
  for (const auto& page : all) codes.insert(page->code);
  for (const OwnRulePage& page : pages) {
    if (all.size() == validate::kMostOwnPages) {
      read.mistakes.push_back(fmt::format("{}:1: there are more than {} pages",
                                          printable(page.file), validate::kMostOwnPages));
      break;
    }
    auto made = validate::read_own_page(page, read.mistakes);
    if (made == nullptr) continue;
    if (!codes.insert(made->code).second) {
      read.mistakes.push_back(
          fmt::format("{}:1: another page has the code {}", printable(page.file), made->code));
    }
    all.push_back(std::move(made));
  }
  if (read.mistakes.empty() && !all.empty()) {
    read.rules = std::make_shared<const OwnRules>(std::move(all));
  }
  return read;
}

OwnRulesRead read_own_rules(std::span<const OwnRulePage> pages) {
  return read_own_rules(pages, nullptr);
}

std::span<const RuleDescription> rules(const OwnRules* own) {
  return own == nullptr ? rules() : own->table();
}

const RuleDescription* find_rule(std::string_view code, const OwnRules* own) {
  return find_rule(code, rules(own));
}

namespace validate {
namespace {

/// One rule over the objects of its scope.
class OwnCheck {
 public:
  OwnCheck(const Context& context, const BrokenPlaces& broken, const OwnMembers& members,
           const OwnPage& page, Code code, Collector& collector)
      : context_(context),
        broken_(broken),
        members_(members),
        page_(page),
        code_(code),
        collector_(collector),
        measures_(named_measures(page)),
        work_(kLeastWork + kWorkOfAByte * context.document.text().size()) {}

  void run() {
    check_scope();
    if (unchecked_.count > 0) report_unchecked();
    if (unmeasured_.count > 0) report_unmeasured();
  }

 private:
  // A small asset is checked whatever it holds; a large one in a time that its size explains.
  static constexpr std::uint64_t kLeastWork = 4'000'000;
  static constexpr std::uint64_t kWorkOfAByte = 16;
  // Bytes of the member `gltfx` that are made in the time of a step.
  static constexpr std::uint64_t kBytesOfAStep = 16;

  void check_scope() {
    const json::Document& document = context_.document;
    const Path root;
    switch (page_.scope->place) {
      case OwnScope::Place::root:
        if (!broken_.in_root()) check({document.root(), {}, {}}, root);
        return;
      case OwnScope::Place::asset: {
        const json::NodeId asset = document.find(document.root(), "asset");
        if (asset == json::kNoNode || !document.is_object(asset)) return;
        return check_sound({asset, {}, {}}, Path(root, "asset"));
      }
      case OwnScope::Place::element:
        return check_elements(page_.scope->array, root);
      case OwnScope::Place::primitive:
        return check_primitives(root);
    }
  }

  void check_elements(model::RootArray array, const Path& root) {
    const Path list(root, model::root_array_name(array));
    const auto& elements = context_.asset.elements(array);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (elements[i] != json::kNoNode) check_sound({elements[i], i, {}}, Path(list, i));
    }
  }

  void check_primitives(const Path& root) {
    const json::Document& document = context_.document;
    const Path list(root, "meshes");
    const auto& meshes = context_.asset.elements(model::RootArray::meshes);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const json::NodeId primitives = document.find(meshes[i], "primitives");
      if (primitives == json::kNoNode || document.kind(primitives) != json::Kind::array) continue;
      const Path mesh(list, i);
      const Path inner(mesh, "primitives");
      std::size_t index = 0;
      for (const json::NodeId one : document.elements(primitives)) {
        const Path path(inner, index);
        if (document.is_object(one)) check_sound({one, index, i}, path);
        ++index;
      }
    }
  }

  void check_sound(const OwnSubject& subject, const Path& path) {
    if (!broken_.inside(context_.document.span(subject.object))) check(subject, path);
  }

  void check(const OwnSubject& subject, const Path& path) {
    std::optional<json::Document> more;
    const auto make_more = [&]() -> const json::Document& {
      if (!more) {
        more = members_.document(*page_.scope, subject);
        work_ -= std::min(work_, std::uint64_t{more->text().size() / kBytesOfAStep});
      }
      return *more;
    };
    schema::SchemaFailure failure;
    const schema::CheckedObject object{context_.document, subject.object, kOwnMember, make_more};
    const schema::SchemaVerdict verdict =
        work_ == 0 ? schema::SchemaVerdict::undecided : page_.schema.check(object, work_, failure);
    if (verdict == schema::SchemaVerdict::fails) {
      return report(subject.object, path, failure);
    }
    if (verdict == schema::SchemaVerdict::undecided) return add(unchecked_, subject.object, path);
    // A keyword such as `maximum` accepts null.
    const OwnMembers::Fault fault = members_.fault(*page_.scope, subject, measures_);
    if (fault.measure == nullptr) return;
    if (unmeasured_.count == 0) fault_ = fault;
    add(unmeasured_, subject.object, path);
  }

  // Objects without a verdict, for one reason.
  struct Unchecked {
    std::uint64_t count = 0;
    json::NodeId first = json::kNoNode;
    std::string pointer;  // to the first

    std::string these() const {
      return count == 1 ? "this object is" : fmt::format("this object and {} more are", count - 1);
    }
  };
  static void add(Unchecked& unchecked, json::NodeId object, const Path& path) {
    if (unchecked.count == 0) {
      unchecked.first = object;
      unchecked.pointer = path.pointer();
    }
    ++unchecked.count;
  }

  // Marks the value that does not fit. A change of the object may have caused that; where the value
  // is not in the text of the object, any change may.
  void report(json::NodeId object, const Path& path, const schema::SchemaFailure& failure) {
    const bool inside = failure.node != json::kNoNode;
    Finding finding = finding_on(context_, inside ? failure.node : object, code_, page_.message,
                                 help(path, failure));
    collector_.report(Phase::own_rules, path, std::move(finding),
                      inside ? context_.document.span(object) : Span());
  }

  void report_unchecked() {
    Finding finding = finding_on(
        context_, unchecked_.first, code_,
        fmt::format("The rule takes too many steps: {} not checked.", unchecked_.these()),
        "simplify the schema of the rule");
    report_at(collector_.sink(Phase::own_rules), unchecked_.pointer, std::move(finding));
  }

  void report_unmeasured() {
    Finding finding =
        finding_on(context_, unmeasured_.first, Code::BUDGET_NOT_MEASURED,
                   fmt::format("The rule {} needs {}: {} not checked. {}", page_.code,
                               fault_.measure->name, unmeasured_.these(), fault_.why));
    finding.about = page_.code;
    report_at(collector_.sink(Phase::own_rules), unmeasured_.pointer, std::move(finding));
  }

  std::string help(const Path& path, const schema::SchemaFailure& failure) const {
    const std::string place = path.pointer() + failure.pointer;
    const std::string reason =
        fmt::format("{}{}{}", printable(place), place.empty() ? "" : ": ", failure.reason);
    return page_.advice.empty() ? reason : fmt::format("{} ({})", page_.advice, reason);
  }

  const Context& context_;
  const BrokenPlaces& broken_;
  const OwnMembers& members_;
  const OwnPage& page_;
  const Code code_;
  Collector& collector_;
  const std::vector<const MeasureDescription*> measures_;  // that the page names
  std::uint64_t work_;
  Unchecked unchecked_, unmeasured_;  // for lack of steps, for lack of a measure
  OwnMembers::Fault fault_;           // of the first one without a measure
};

}  // namespace

Code own_code(std::size_t page) { return static_cast<Code>(gltfx::rules().size() + page); }

void check_own_rules(const Context& context, const BrokenPlaces& broken, const std::string& name,
                     const Measurements* measured, Collector& collector) {
  const OwnMembers members(context, name, measured);
  const auto& pages = context.options.own_rules->pages();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const Code code = own_code(i);
    if (!is_enabled(context.options, code)) continue;
    OwnCheck(context, broken, members, *pages[i], code, collector).run();
  }
}

}  // namespace validate
}  // namespace gltfx
