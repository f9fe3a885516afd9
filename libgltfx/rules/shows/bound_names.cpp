// SPDX-License-Identifier: Apache-2.0
// Names by which engines find morph targets and nodes.
#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "model/skin.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using json::NodeId;
using model::RootArray;

// The array of names of a mesh, or json::kNoNode.
NodeId target_names(const json::Document& document, const model::Mesh& mesh) {
  if (mesh.node == json::kNoNode) return json::kNoNode;
  const NodeId extras = model::object_member(document, mesh.node, "extras");
  const NodeId names = extras == json::kNoNode ? extras : document.find(extras, "targetNames");
  const bool list = names != json::kNoNode && document.kind(names) == json::Kind::array;
  return list ? names : json::kNoNode;
}

std::size_t target_count(const model::Mesh& mesh) {
  return mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
}

void check_repeats(DataPhase& phase, std::size_t mesh, NodeId names) {
  const json::Document& document = phase.context.document;
  std::unordered_map<std::string, std::size_t> first;
  std::size_t index = 0;
  for (const NodeId name : document.elements(names)) {
    const std::size_t at = index++;
    if (!document.is_string(name)) continue;
    const auto [known, fresh] = first.emplace(document.string(name), at);
    if (fresh) continue;
    report_at(phase.sink, fmt::format("/meshes/{}/extras/targetNames/{}", mesh, at),
              finding_on(phase.context, name, Code::MORPH_TARGET_NAME_REPEATED,
                         fmt::format("Morph targets {} and {} are both named {}: by name, only one "
                                     "of them can be moved.",
                                     known->second, at, gltfx::quoted(known->first))));
  }
}

void check_target_names(DataPhase& phase) {
  const json::Document& document = phase.context.document;
  const auto& meshes = phase.context.views.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const NodeId names = target_names(document, meshes[i]);
    const bool known = !meshes[i].primitives.empty() && !meshes[i].has_holes &&
                       !meshes[i].primitives.front().targets_are_broken;
    if (names == json::kNoNode || !known) continue;
    const std::size_t count = document.array_size(names);
    const std::size_t targets = target_count(meshes[i]);
    if (count != targets) {
      report_at(phase.sink, fmt::format("/meshes/{}/extras/targetNames", i),
                finding_on(
                    phase.context, names, Code::MORPH_TARGET_NAMES_COUNT,
                    fmt::format("targetNames has {} name{} for {} morph target{}; engines bind the "
                                "wrong ones, or leave all names out.",
                                count, count == 1 ? "" : "s", targets, targets == 1 ? "" : "s")));
    }
    check_repeats(phase, i, names);
  }
}

// --- Nodes ---

std::vector<std::uint8_t> moving_nodes(const Context& context) {
  std::vector<std::uint8_t> moving(context.views.nodes.size(), 0);
  for (const model::Animation& animation : context.views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.node) moving[*channel.node] = 1;
    }
  }
  for (const NodeId object : context.asset.elements(RootArray::skins)) {
    if (object == json::kNoNode) continue;
    for (const model::NodeIndex joint : model::read_skin(context.asset, object).joint_nodes) {
      moving[joint] = 1;
    }
  }
  return moving;
}

void check_node_names(DataPhase& phase) {
  const Context& context = phase.context;
  if (context.views.animations.empty() && context.asset.count(RootArray::skins) == 0) return;
  const std::vector<std::uint8_t> moving = moving_nodes(context);
  std::unordered_map<std::string, std::uint32_t> first;
  for (std::uint32_t i = 0; i < moving.size(); ++i) {
    const NodeId object = context.views.nodes[i].object;
    const NodeId name = object == json::kNoNode ? object : context.document.find(object, "name");
    if (name == json::kNoNode || !context.document.is_string(name)) continue;
    std::string text = context.document.string(name);
    if (text.empty()) continue;
    const auto [known, fresh] = first.emplace(std::move(text), i);
    if (fresh || (moving[i] == 0 && moving[known->second] == 0)) continue;
    const std::uint32_t other = moving[i] != 0 ? i : known->second;
    report_at(
        phase.sink, fmt::format("/nodes/{}/name", i),
        finding_on(context, name, Code::NODE_NAME_REPEATED,
                   fmt::format("Nodes {} and {} are both named {}, and node {} is animated or "
                               "a joint: engines that bind by name may move the wrong one.",
                               known->second, i, gltfx::quoted(known->first), other)));
  }
}

// --- Fix ---

// The first names, and a name of its own for each further target.
bool complete_target_names(Fixing& fixing, const Subject& subject) {
  const json::Document& document = fixing.document();
  const NodeId names = subject.value;
  if (names == json::kNoNode || document.kind(names) != json::Kind::array) return false;
  const NodeId mesh = fixing.parent(fixing.parent(names));
  const auto index = fixing.index(RootArray::meshes, mesh);
  if (!index) return false;
  const std::size_t count = target_count(fixing.views().meshes[*index]);
  std::set<std::string> known;
  std::vector<std::string> kept;
  for (const NodeId name : document.elements(names)) {
    if (!document.is_string(name)) return false;
    if (kept.size() < count) kept.push_back(document.string(name));
  }
  known.insert(kept.begin(), kept.end());
  for (std::size_t number = kept.size(); kept.size() < count; ++number) {
    std::string name = fmt::format("target_{}", number);
    if (known.insert(name).second) kept.push_back(std::move(name));
  }
  std::string json = "[";
  for (const std::string& name : kept)
    json += (json.size() > 1 ? ", " : "") + json::string_value(name);
  return fixing.replace(names, json + "]");
}

// The name with the index of the target, and once more if another target has that name.
bool rename_target(Fixing& fixing, const Subject& subject) {
  const json::Document& document = fixing.document();
  const NodeId name = subject.value;
  if (name == json::kNoNode || !document.is_string(name)) return false;
  const NodeId names = fixing.parent(name);
  if (names == json::kNoNode || document.kind(names) != json::Kind::array) return false;
  std::set<std::string> known;
  std::size_t index = 0;
  std::size_t at = 0;
  for (const NodeId each : document.elements(names)) {
    if (document.is_string(each)) known.insert(document.string(each));
    if (each == name) index = at;
    ++at;
  }
  std::string renamed = document.string(name);
  do renamed += fmt::format("_{}", index);
  while (known.contains(renamed));
  return fixing.replace_scalar(name, json::string_value(renamed));
}

}  // namespace

void check_bound_names(DataPhase& phase) {
  check_target_names(phase);
  check_node_names(phase);
}

const RuleGroup& bound_names_rules() {
  static constexpr FixEntry kFixes[] = {{Code::MORPH_TARGET_NAMES_COUNT, complete_target_names},
                                        {Code::MORPH_TARGET_NAME_REPEATED, rename_target}};
  static constexpr RuleGroup group{.fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
