// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/fork.hpp"
#include "model/accessor.hpp"
#include "model/fields.hpp"
#include "model/mesh.hpp"
#include "rules/extensions/materials_variants.hpp"
#include "rules/phases.hpp"
#include "rules/rules_of_types.hpp"
#include "schema/check.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

// The rules on members of a type.
struct MemberRules {
  std::vector<MemberRuleEntry> before;
  std::vector<ObjectRuleEntry> behind;
};

struct Rules {
  RulesByName<MemberRules> members;
  std::vector<MapRule> entries;
};

const Rules& rules() {
  static constinit MadeOnce<Rules> table;
  return table.get([] {
    Rules all;
    for (const RuleGroup& group : rule_groups()) {
      for (const MemberRuleEntry& entry : group.member_rules) {
        all.members.to(entry.type).before.push_back(entry);
      }
      for (const ObjectRuleEntry& entry : group.object_rules) {
        if (entry.runs != Runs::otherwise && !entry.behind.empty())
          all.members.to(entry.type).behind.push_back(entry);
      }
      all.entries.insert(all.entries.end(), group.map_rules.begin(), group.map_rules.end());
    }
    return all;
  });
}

class Reader final : public schema::MemberVisitor {
 public:
  explicit Reader(const Context& context) : context_(context) {}

  Calls calls(const schema::ObjectType& type) override { return known(type).calls; }

  schema::Reading before(const schema::ObjectType& type, std::string_view member,
                         json::NodeId object, json::NodeId value, const Path& path) override {
    for (const MemberRuleEntry& entry : known(type).rules->before) {
      if (entry.member == member) return entry.rule(context_, object, value, path);
    }
    return schema::Reading::check;
  }

  void behind(const schema::ObjectType& type, std::string_view member, json::NodeId object,
              const Path& path) override {
    for (const ObjectRuleEntry& entry : known(type).rules->behind) {
      if (entry.behind == member) entry.rule(context_, object, path);
    }
  }

  void entry(std::string_view name, json::NodeId value, const Path& map) override {
    for (const MapRule rule : rules().entries) rule(context_, name, value, map);
  }

 private:
  struct Known {
    const MemberRules* rules = nullptr;
    Calls calls;
  };

  const Known& known(const schema::ObjectType& type) { return known_.of(type, find); }

  static Known find(const schema::ObjectType& type) {
    Known known;
    known.rules = &rules().members.of(type.name);
    known.calls.before = !known.rules->before.empty();
    const std::vector<ObjectRuleEntry>& entries = known.rules->behind;
    if (entries.empty()) return known;
    for (std::uint32_t i = 0; i < type.properties.size(); ++i) {
      const bool any = std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
        return entry.behind == type.properties[i].name;
      });
      if (any) known.calls.behind |= std::uint64_t{1} << std::min(i, Calls::kLast);
    }
    return known;
  }

  const Context& context_;
  TypeCache<Known> known_;
};

// --- Objects that are not linked ---

class Unlinking {
 public:
  Unlinking(const Context& context, json::Document& document)
      : asset_(context.asset), document_(document) {}

  /// Whether anything was hidden.
  bool run() {
    for (const json::NodeId accessor : asset_.elements(RootArray::accessors)) cut_sparse(accessor);
    for (const json::NodeId animation : asset_.elements(RootArray::animations)) {
      // Extensions of its channels are linked nevertheless.
      if (!has(animation, {"channels", "samplers"})) hide(animation, {"samplers"});
    }
    const json::NodeId variants =
        model::extension_object(document_, document_.root(), kVariantsExtension);
    if (variants != json::kNoNode) return hidden_;
    for (const json::NodeId mesh : asset_.elements(RootArray::meshes)) {
      for (const json::NodeId primitive : model::primitives(document_, mesh))
        cut_variants(primitive);
    }
    return hidden_;
  }

 private:
  using Names = std::initializer_list<std::string_view>;

  bool has(json::NodeId object, Names names) const {
    for (const std::string_view name : names) {
      if (document_.find(object, name) == json::kNoNode) return false;
    }
    return true;
  }

  void hide(json::NodeId object, Names names) {
    for (const std::string_view name : names) {
      const json::NodeId value = document_.find(object, name);
      if (value == json::kNoNode) continue;
      document_.hide(value);
      hidden_ = true;
    }
  }

  void cut_sparse(json::NodeId accessor) {
    const json::NodeId sparse = document_.find(accessor, "sparse");
    const bool whole = has(accessor, {"componentType", "count", "type"}) &&
                       has(sparse, {"count", "indices", "values"});
    if (!whole) hide(accessor, {"sparse"});
  }

  void cut_variants(json::NodeId primitive) {
    const json::NodeId object = model::extension_object(document_, primitive, kVariantsExtension);
    const json::NodeId mappings = document_.find(object, "mappings");
    if (mappings == json::kNoNode) return;
    for (const json::NodeId mapping : document_.elements(mappings)) {
      hide(mapping, {"material", "variants"});
    }
  }

  const model::Asset& asset_;
  json::Document& document_;
  bool hidden_ = false;
};

}  // namespace

schema::CheckResult check_as_khronos(Context& context, json::Document& document, LinkOrder& order,
                                     const schema::ObjectVisitor& visitor) {
  Reader reader(context);
  schema::NoFindings none;
  schema::CheckOptions form;
  form.deviations = context.deviations;
  form.part = schema::Part::form;
  form.shown = &document;
  form.members = &reader;
  schema::CheckResult result =
      schema::check(document, context.schemas, form, context.schema_sink, none, visitor);
  if (result.stopped_at_asset || !document.is_object(document.root())) return result;
  const bool hidden = Unlinking(context, document).run();
  if (!hidden && !result.has_open_references) return result;
  schema::CheckOptions references;
  references.deviations = context.deviations;
  references.part = schema::Part::references;
  return schema::check(document, context.schemas, references, none, order.held());
}

}  // namespace gltfx::validate
