// SPDX-License-Identifier: Apache-2.0
// Morph targets and weights, which all primitives of a mesh share.
#include "model/mesh.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

std::string targets_text(std::size_t count) {
  return fmt::format("{} morph target{}", count, count == 1 ? "" : "s");
}

// A broken value is already reported and not counted.
bool lack_targets(const Context& context, json::NodeId primitive) {
  return !context.deviations.broken_values_are_absent &&
         model::has_broken_targets(context.document, primitive);
}

// After version 2.0, a primitive without targets counts as one whose targets have no effect.
bool some_may_lack_targets(const Context& context) { return context.version > schema::kVersion2; }

// The targets that all primitives have which have any.
std::size_t expected_targets(const Context& context, const std::vector<json::NodeId>& primitives) {
  for (const json::NodeId primitive : primitives) {
    const std::size_t count = model::morph_targets(context.document, primitive).size();
    if (count > 0 || !some_may_lack_targets(context)) return count;
  }
  return 0;
}

void check_target_counts(const Context& context, const std::vector<json::NodeId>& primitives,
                         std::size_t expected, const Path& path) {
  const json::Document& document = context.document;
  const Path array(path, "primitives");
  for (std::size_t i = 1; i < primitives.size(); ++i) {
    if (primitives[i] == json::kNoNode || lack_targets(context, primitives[i])) continue;
    const std::size_t count = model::morph_targets(document, primitives[i]).size();
    if (count == expected || (count == 0 && some_may_lack_targets(context))) continue;
    const Path primitive(array, static_cast<std::uint64_t>(i));
    const Path targets(primitive, "targets");
    const json::NodeId place = count > 0 ? document.find(primitives[i], "targets") : primitives[i];
    context.schema_sink.report(
        count > 0 ? targets : primitive,
        finding_on(context, place, Code::MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT,
                   fmt::format("The primitive has {}, but the first one has {}.",
                               targets_text(count), targets_text(expected))));
  }
}

void check_mesh(const Context& context, json::NodeId mesh, const Path& path) {
  const json::Document& document = context.document;
  const auto primitives = model::primitives(document, mesh);
  if (primitives.empty() || primitives.front() == json::kNoNode) return;
  if (lack_targets(context, primitives.front())) return;
  const std::size_t expected = expected_targets(context, primitives);
  check_target_counts(context, primitives, expected, path);
  const json::NodeId weights = document.find(mesh, "weights");
  if (weights == json::kNoNode || document.kind(weights) != json::Kind::number_array) return;
  const std::size_t count = document.array_size(weights);
  if (count == expected) return;
  report_member(context.schema_sink, context, path, mesh, "weights",
                Code::MESH_INVALID_WEIGHTS_COUNT,
                fmt::format("The mesh has {} weight{}, but its primitives have {}.", count,
                            count == 1 ? "" : "s", targets_text(expected)));
}

}  // namespace

const RuleGroup& mesh_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {{"mesh", check_mesh, "primitives"}};
  static constexpr RuleGroup group{.object_rules = kObjectRules};
  return group;
}

}  // namespace gltfx::validate
