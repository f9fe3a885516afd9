// SPDX-License-Identifier: Apache-2.0
// Morph targets and weights, which all primitives of a mesh share.
#include "model/mesh.hpp"

#include <fmt/format.h>

#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [
  {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]},
  {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}], "weights": [0]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})";

constexpr RuleDescription kRules[] = {
    {"MESH_INVALID_WEIGHTS_COUNT", Severity::error,
     "A mesh has not as many weights as morph targets",
     "Each weight says how far one target is applied; readers run past the end of the shorter list "
     "or refuse the mesh.",
     "Give one weight for each morph target.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [
  {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]},
  {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}], "weights": [0, 1]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     kGood, Fix::none, true},
    {"MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT", Severity::error,
     "The primitives of a mesh have different numbers of morph targets",
     "The weights belong to the mesh, so each target must exist in every primitive; otherwise "
     "parts "
     "of the model come apart.",
     "Give all primitives the same number of targets, empty ones as zero offsets.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [
  {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]},
  {"attributes": {"POSITION": 0}}], "weights": [0]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     kGood, Fix::none, true},
};

std::string targets_text(std::size_t count) {
  return fmt::format("{} morph target{}", count, count == 1 ? "" : "s");
}

void check_target_counts(const Context& context, const std::vector<json::NodeId>& primitives,
                         std::size_t expected, const Path& path) {
  const json::Document& document = context.document;
  const Path array(path, "primitives");
  for (std::size_t i = 1; i < primitives.size(); ++i) {
    if (primitives[i] == json::kNoNode) continue;
    const std::size_t count = model::morph_targets(document, primitives[i]).size();
    if (count == expected) continue;
    const Path primitive(array, static_cast<std::uint64_t>(i));
    const Path targets(primitive, "targets");
    const json::NodeId place = count > 0 ? document.find(primitives[i], "targets") : primitives[i];
    context.schema_sink.report(
        count > 0 ? targets : primitive,
        finding_on(context, place, "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT",
                   fmt::format("This primitive has {}, but the first one has {}.",
                               targets_text(count), targets_text(expected))));
  }
}

void check_mesh(const Context& context, json::NodeId mesh, const Path& path) {
  const json::Document& document = context.document;
  const auto primitives = model::primitives(document, mesh);
  if (primitives.empty() || primitives.front() == json::kNoNode) return;
  const std::size_t expected = model::morph_targets(document, primitives.front()).size();
  check_target_counts(context, primitives, expected, path);
  const json::NodeId weights = document.find(mesh, "weights");
  if (weights == json::kNoNode || document.kind(weights) != json::Kind::number_array) return;
  const std::size_t count = document.array_size(weights);
  if (count == expected) return;
  report_member(context.schema_sink, context, path, mesh, "weights", "MESH_INVALID_WEIGHTS_COUNT",
                fmt::format("The mesh has {} weight{}, but its primitives have {}.", count,
                            count == 1 ? "" : "s", targets_text(expected)));
}

constexpr ObjectRuleEntry kObjectRules[] = {{"mesh", check_mesh, "primitives"}};

}  // namespace

const Family& mesh_family() {
  static const Family family{"mesh", kRules, kObjectRules, {}};
  return family;
}

}  // namespace gltfx::validate
