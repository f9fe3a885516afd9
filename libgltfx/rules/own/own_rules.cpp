// SPDX-License-Identifier: Apache-2.0
#include "rules/own/own_rules.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/parse.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/own/own_members.hpp"

namespace gltfx {
namespace {

bool by_code(const RuleDescription& a, const RuleDescription& b) { return a.code < b.code; }

}  // namespace

OwnRules::OwnRules(std::vector<std::unique_ptr<const validate::OwnPage>> pages)
    : pages_(std::move(pages)) {
  std::sort(pages_.begin(), pages_.end(),
            [](const auto& a, const auto& b) { return a->code < b->code; });
  for (const auto& page : pages_) own_.push_back(page->description());
  const auto ours = gltfx::rules();
  std::merge(ours.begin(), ours.end(), own_.begin(), own_.end(), std::back_inserter(table_),
             by_code);
}

OwnRulesRead read_own_rules(std::span<const OwnRulePage> pages) {
  OwnRulesRead read;
  std::vector<std::unique_ptr<const validate::OwnPage>> good;
  std::set<std::string_view> codes;
  HashParts sources;
  for (const OwnRulePage& page : pages.first(std::min(pages.size(), validate::kMostOwnPages))) {
    sources.add(page.file);
    sources.add(page.text);
    auto made = validate::read_own_page(page, read.mistakes);
    if (made == nullptr) continue;
    if (!codes.insert(made->code).second) {
      read.mistakes.push_back(
          fmt::format("{}:1: another page has the code {}", printable(page.file), made->code));
    }
    good.push_back(std::move(made));
  }
  if (pages.size() > validate::kMostOwnPages) {
    read.mistakes.push_back(fmt::format("{}:1: there are more than {} pages",
                                        printable(pages[validate::kMostOwnPages].file),
                                        validate::kMostOwnPages));
  }
  if (!read.mistakes.empty() || good.empty()) return read;
  const auto rules = std::make_shared<OwnRules>(std::move(good));
  rules->set_sources(sources.finish());
  read.rules = rules;
  return read;
}

std::span<const RuleDescription> rules(const OwnRules* own) {
  return own == nullptr ? rules() : own->table();
}

const RuleDescription* find_rule(std::string_view code, const OwnRules* own) {
  if (own == nullptr) return find_rule(code);
  const auto all = own->table();
  const auto at = std::lower_bound(
      all.begin(), all.end(), code,
      [](const RuleDescription& rule, std::string_view wanted) { return rule.code < wanted; });
  return at != all.end() && at->code == code ? &*at : nullptr;
}

namespace validate {
namespace {

/// One rule over the objects of its scope.
class OwnCheck {
 public:
  OwnCheck(const Context& context, const BrokenPlaces& broken, const OwnMembers& members,
           const OwnPage& page, Code code, Sink& sink)
      : context_(context),
        broken_(broken),
        members_(members),
        page_(page),
        code_(code),
        sink_(sink),
        work_(kLeastWork + kWorkOfAByte * context.document.text().size()) {}

  void run() {
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

 private:
  // A small asset is checked whatever it holds; a large one in a time that its size explains.
  static constexpr std::uint64_t kLeastWork = 4'000'000;
  static constexpr std::uint64_t kWorkOfAByte = 16;

  void check_elements(model::RootArray array, const Path& root) {
    const Path list(root, model::root_array_name(array));
    const auto& elements = context_.asset.elements(array);
    for (std::size_t i = 0; i < elements.size() && work_ > 0; ++i) {
      if (elements[i] != json::kNoNode) check_sound({elements[i], i, {}}, Path(list, i));
    }
  }

  void check_primitives(const Path& root) {
    const json::Document& document = context_.document;
    const Path list(root, "meshes");
    const auto& meshes = context_.asset.elements(model::RootArray::meshes);
    for (std::size_t i = 0; i < meshes.size() && work_ > 0; ++i) {
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
      if (!more) more = members_.document(*page_.scope, subject);
      return *more;
    };
    schema::SchemaFailure failure;
    const schema::CheckedObject object{context_.document, subject.object, kOwnMember, make_more};
    switch (page_.schema.check(object, work_, failure)) {
      case schema::SchemaVerdict::fits:
        return;
      case schema::SchemaVerdict::undecided:
        return report(subject, path, "The rule takes too many steps to be checked here.",
                      "simplify the schema of the rule");
      case schema::SchemaVerdict::fails:
        return report(subject, path, page_.message, help(path, failure));
    }
  }

  void report(const OwnSubject& subject, const Path& path, std::string message, std::string help) {
    sink_.report(path,
                 finding_on(context_, subject.object, code_, std::move(message), std::move(help)));
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
  Sink& sink_;
  std::uint64_t work_;
};

}  // namespace

Code own_code(std::size_t page) { return static_cast<Code>(gltfx::rules().size() + page); }

void check_own_rules(const Context& context, const BrokenPlaces& broken, const std::string& name,
                     const Measurements* measured, Sink& sink) {
  const OwnMembers members(context, name, measured);
  const auto& pages = context.options.own_rules->pages();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const Code code = own_code(i);
    if (!is_enabled(context.options, code)) continue;
    OwnCheck(context, broken, members, *pages[i], code, sink).run();
  }
}

}  // namespace validate
}  // namespace gltfx
