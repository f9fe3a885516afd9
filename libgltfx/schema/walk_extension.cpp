// SPDX-License-Identifier: Apache-2.0
// Checks the objects inside `extensions`: declarations, hosts, relations.
#include <algorithm>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "schema/extension_names.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {
namespace {

// Whether an extension is a fallback for readers without the other one.
bool is_fallback(const std::string& name, const Extension& other) {
  const auto& fallbacks = other.fallback_extensions;
  return std::find(fallbacks.begin(), fallbacks.end(), name) != fallbacks.end();
}

}  // namespace

bool Walker::push_extensions(Frame& host) {
  const json::NodeId node = host.extensions;
  host.extensions = json::kNoNode;
  if (node == json::kNoNode || host.further) return false;
  const Path path(host.path, "extensions");
  if (!document_.is_object(node)) {
    report(path, Code::TYPE_MISMATCH, document_.span(node),
           "'extensions' is " + shown(values_, {node}) + "; it must be an object.",
           document_.is_array(node) ? "write { \"KHR_…\": { … } }" : "");
    drop(node);
    return false;
  }
  push(kNone, node, path, Mode::extensions, false);
  top_->type = host.type;
  return true;
}

void Walker::extensions_step(Frame& frame) {
  const json::NodeId end = document_.next(frame.node);
  if (frame.stage == Stage::enter) {
    frame.stage = Stage::properties;
    frame.siblings.clear();
    for (json::NodeId at = frame.node + 1; at < end; at = document_.next(at + 1)) {
      if (document_.node(at).hidden) continue;
      const ExtensionId id = names_.extension(document_.node(at).next);
      const auto& known = frame.siblings;
      if (id != kNone && std::find(known.begin(), known.end(), id) == known.end())
        frame.siblings.push_back(id);
    }
    frame.checked.assign(frame.siblings.size(), false);
  }
  while (frame.at < end) {
    const json::KeyId key = document_.node(frame.at).next;
    const json::NodeId node = frame.at + 1;
    frame.at = document_.next(node);
    if (is_hidden(node)) continue;
    if (extension_member(frame, key, node)) return;
  }
  pop();
}

// Whether an extension's content is checked.
bool Walker::looks_into(ExtensionId id, std::string_view name) const {
  if (id == kNone) return false;
  return !deviations().unsupported_extensions_are_skipped ||
         (set_.extensions()[id].khronos_validator && is_declared(name));
}

std::string Walker::undeclared_help(ExtensionId id, std::string_view name) {
  std::string_view meant;
  const std::size_t comparisons = set_.extensions().size();
  if (id == kNone && comparisons <= comparisons_left_) {
    comparisons_left_ -= comparisons;
    meant = misspelt_extension(set_, name);
  }
  if (!meant.empty()) return "did you mean " + quoted(meant) + "?";
  return "add \"" + printable(name) + "\" to \"extensionsUsed\"";
}

bool Walker::extension_member(Frame& frame, json::KeyId key, json::NodeId node) {
  const std::string_view name = document_.key(key);
  const Path path(frame.path, name);
  if (!seen_[key]) {
    seen_[key] = true;
    result_.extensions_seen.emplace_back(name);
  }
  if (!document_.is_object(node)) {
    report(path, Code::TYPE_MISMATCH, document_.span(node),
           quoted(name) + " is " + shown(values_, {node}) + "; an extension must be an object.",
           "write { }");
    // For the Khronos validator it has no members, which may be another error.
    if (options_.shown == nullptr) return false;
    options_.shown->strip(node);
    result_.has_open_references = true;
  }
  const ExtensionId id = names_.extension(key);
  if (!is_declared(key)) {
    report(path, Code::UNDECLARED_EXTENSION, document_.span(node - 1),
           quoted(name) + " is used, but not declared.", undeclared_help(id, name));
  }
  if (!looks_into(id, name)) return false;
  const ShapeId shape = shape_on(frame, id, path, node);
  if (shape == kNone) {
    drop(node);
    return false;
  }
  neighbours(frame, id, path, node);
  if (!tables_.shapes[shape].members) return false;
  push(shape, node, path, Mode::object, false);
  return true;
}

// The shape of the extension's object on its host, or kNone with a finding.
ShapeId Walker::shape_on(const Frame& frame, ExtensionId id, const Path& path, json::NodeId node) {
  const TypeId host = set_.type(frame.type).origin;
  for (const auto& [type, shape] : tables_.extensions[id].attachment_points) {
    if (type == host) return shape;
  }
  const Extension& extension = set_.extensions()[id];
  std::vector<std::string> attachment_points;
  for (const auto& entry : extension.attachment_points)
    attachment_points.push_back(set_.type(entry.first).name);
  report(path, Code::UNEXPECTED_EXTENSION_OBJECT, document_.span(node - 1),
         quoted(extension.name) + " is not allowed on " + quoted(set_.type(frame.type).name) + ".",
         attachment_points.empty()
             ? "remove the object, and only list the extension in \"extensionsUsed\""
             : "move it to " + join_or(attachment_points));
  return kNone;
}

void Walker::neighbours(Frame& frame, ExtensionId id, const Path& path, json::NodeId node) {
  const auto sibling = std::find(frame.siblings.begin(), frame.siblings.end(), id);
  const auto at = static_cast<std::size_t>(sibling - frame.siblings.begin());
  if (frame.checked[at]) return;
  frame.checked[at] = true;
  if (!deviations().no_additional_rules) {
    exclusions(frame, id, path, node);
    companions(frame, id, path, node);
    fallback(frame, id, path, node);
  }
  if (set_.extensions()[id].standalone) standalone(frame, id, path, node);
}

bool Walker::is_present(const Frame& frame, const RelationPlan& relation) const {
  if (relation.other == kNone)
    return document_.find(frame.node, relation.relation->extension) != json::kNoNode;
  return std::find(frame.siblings.begin(), frame.siblings.end(), relation.other) !=
         frame.siblings.end();
}

bool Walker::excludes(ExtensionId one, ExtensionId other) const {
  const auto& list = tables_.extensions[one].excludes;
  return std::any_of(list.begin(), list.end(),
                     [other](const RelationPlan& r) { return r.other == other; });
}

// A pair is reported once: at the first of the two that excludes the other.
void Walker::exclusions(const Frame& frame, ExtensionId id, const Path& path, json::NodeId node) {
  const auto position = [&](ExtensionId sought) {
    return std::find(frame.siblings.begin(), frame.siblings.end(), sought);
  };
  for (const RelationPlan& plan : tables_.extensions[id].excludes) {
    if (!is_present(frame, plan)) continue;
    if (plan.other != kNone && excludes(plan.other, id) && position(plan.other) < position(id))
      continue;
    const std::string& name = set_.extensions()[id].name;
    report(path, Code::EXTENSION_EXCLUDED, document_.span(node - 1),
           quoted(name) + " and " + quoted(plan.relation->extension) +
               " are mutually exclusive: " + clause(plan.relation->because),
           "remove one of them");
  }
}

void Walker::companions(const Frame& frame, ExtensionId id, const Path& path, json::NodeId node) {
  const ExtensionPlan& plan = tables_.extensions[id];
  const std::string& name = set_.extensions()[id].name;
  for (const RelationPlan& needed : plan.requires_) {
    if (is_present(frame, needed)) continue;
    const std::string& other = needed.relation->extension;
    Finding finding(
        Code::EXTENSION_COMPANION_MISSING,
        quoted(name) + " requires " + quoted(other) + ": " + clause(needed.relation->because),
        "add " + quoted(other) + " to the same object", document_.span(node - 1),
        needed.relation->error ? Severity::error : Severity::warning);
    schema_sink_.report(path, std::move(finding));
  }
  for (const RelationPlan& stronger : plan.overridden_by) {
    if (!is_present(frame, stronger) || !has_effect(frame, stronger)) continue;
    report(path, Code::EXTENSION_OVERRIDDEN, document_.span(node - 1),
           quoted(name) + " is overridden by " + quoted(stronger.relation->extension) + ": " +
               clause(stronger.relation->because));
  }
}

// Whether the other extension has values other than its defaults.
bool Walker::has_effect(const Frame& frame, const RelationPlan& relation) const {
  const json::NodeId object = document_.find(frame.node, relation.relation->extension);
  if (object == json::kNoNode || relation.other == kNone) return object != json::kNoNode;
  const TypeId host = set_.type(frame.type).origin;
  TypeId type = kNone;
  for (const auto& [home, shape] : tables_.extensions[relation.other].attachment_points) {
    if (home == host) type = set_.shape(shape).type;
  }
  for (const auto& member : document_.members(object)) {
    const Property* property = set_.find_property(type, document_.key(member.key_id));
    if (property == nullptr) continue;
    const bool number = document_.is_number(member.value);
    const bool is_default = number && !property->default_json.empty() &&
                            document_.number(member.value).value ==
                                std::strtod(property->default_json.c_str(), nullptr);
    if (!is_default && document_.raw(member.value) != property->default_json) return true;
  }
  return false;
}

void Walker::standalone(const Frame& frame, ExtensionId id, const Path& path, json::NodeId node) {
  std::vector<std::string> others;
  const json::NodeId end = document_.next(frame.node);
  for (json::NodeId at = frame.node + 1; at < end; at = document_.next(at + 1)) {
    const json::KeyId key = document_.node(at).next;
    const ExtensionId other = names_.extension(key);
    const bool reported = !deviations().no_additional_rules && other != kNone &&
                          (excludes(id, other) || excludes(other, id));
    const bool served = !deviations().no_additional_rules && other != kNone &&
                        is_fallback(set_.extensions()[id].name, set_.extensions()[other]);
    if (other != id && !reported && !served) others.push_back(quoted(document_.key(key)));
  }
  if (others.empty()) return;
  report(path, Code::MULTIPLE_EXTENSIONS, document_.span(node - 1),
         quoted(set_.extensions()[id].name) + " must be the only extension, but there is also " +
             join_or(others, 4) + ".");
}

// Readers without the extension need the host's own member, unless this extension or one beside it
// is required.
void Walker::fallback(const Frame& frame, ExtensionId id, const Path& path, json::NodeId node) {
  const Extension& extension = set_.extensions()[id];
  if (extension.must_be_required != MustBeRequired::without_fallback || extension.fallback.empty())
    return;
  if (document_.find(frame.parent->node, extension.fallback) != json::kNoNode) return;
  std::vector<std::string>& lacking = result_.without_fallback;
  if (std::find(lacking.begin(), lacking.end(), extension.name) == lacking.end()) {
    lacking.push_back(extension.name);
  }
  const auto guards = [&](ExtensionId sibling) {
    const Extension& other = set_.extensions()[sibling];
    return other.must_be_required == MustBeRequired::without_fallback && is_required(other.name);
  };
  if (std::any_of(frame.siblings.begin(), frame.siblings.end(), guards)) return;
  report(path, Code::NON_REQUIRED_EXTENSION, document_.span(node - 1),
         quoted(extension.name) + " has no fallback " + quoted(extension.fallback) +
             " and is not in 'extensionsRequired'.",
         "add \"" + extension.name + "\" to \"extensionsRequired\", or add " +
             quoted(extension.fallback));
}

}  // namespace gltfx::schema
