// SPDX-License-Identifier: Apache-2.0
// VRMC_vrm_animation: the translation of a node along X is the weight of an expression. The checks
// need the values of the animation, so this file names the extension.
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "model/node.hpp"
#include "rules/extension_walk.hpp"
#include "rules/extensions/vrm_humanoid.hpp"
#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

struct Weight {
  std::string pointer;
  json::NodeId value = json::kNoNode;
  bool reported = false;
};
using Weights = std::unordered_map<std::uint32_t, Weight>;  // by node

Weights read_weights(const Context& context, json::NodeId object) {
  const json::Document& document = context.document;
  const json::NodeId expressions = model::object_member(document, object, "expressions");
  Weights weights;
  for (const std::string_view group : {"preset", "custom"}) {
    const json::NodeId list = model::object_member(document, expressions, group);
    if (list == json::kNoNode) continue;
    for (const auto member : document.members(list)) {
      const auto node = context.asset.index(member.value, "node", model::RootArray::nodes);
      if (!node) continue;
      std::string pointer = fmt::format("/extensions/{}/expressions/{}", kAvatarAnimation, group);
      append_pointer_step(pointer, document.key(member.key_id));
      weights.try_emplace(*node, Weight{pointer + "/node", document.find(member.value, "node")});
    }
  }
  return weights;
}

// The first X of `accessor` that is not a weight. Tangents of cubic splines are not values.
std::optional<float> bad_weight(DataPhase& phase, std::uint32_t accessor, bool cubic) {
  const model::Format& format = phase.context.views.accessors[accessor].format;
  if (format.type != model::ElementType::vec3 ||
      format.component != model::ComponentType::float32) {
    return std::nullopt;
  }
  const auto data = phase.open(accessor);
  if (!data || !phase.budget.take(data->count(), data->components())) return std::nullopt;
  constexpr float kRounding = 1e-3F;
  std::optional<float> bad;
  data->visit<float>([&](const float* values, std::size_t elements, std::uint64_t first) {
    for (std::size_t i = 0; i < elements && !bad; ++i) {
      const float weight = values[3 * i];
      const bool is_value = !cubic || (first + i) % 3 == 1;
      if (is_value && (weight < -kRounding || weight > 1 + kRounding)) bad = weight;
    }
  });
  return bad;
}

void report_weight(DataPhase& phase, Weight& weight, float value) {
  if (weight.reported) return;
  weight.reported = true;
  report_at(phase.sink, weight.pointer,
            finding_on(phase.context, weight.value, Code::EXPRESSION_ANIMATED_WEIGHT,
                       fmt::format("The animation moves the node along X to {}; a weight must be "
                                   "between 0 and 1.",
                                   number_text(static_cast<double>(value)))));
}

void check_channels(DataPhase& phase, json::NodeId animation, Weights& weights) {
  const json::Document& document = phase.context.document;
  const auto samplers = object_list(document, animation, "samplers");
  for (const json::NodeId channel : object_list(document, animation, "channels")) {
    const json::NodeId target = model::object_member(document, channel, "target");
    const auto node = phase.context.asset.index(target, "node", model::RootArray::nodes);
    const auto found = node ? weights.find(*node) : weights.end();
    if (found == weights.end() || found->second.reported) continue;
    if (model::string_member(document, target, "path") != "translation") continue;
    const auto index = model::unsigned_member(document, channel, "sampler");
    if (!index || *index >= samplers.size()) continue;
    const json::NodeId sampler = samplers[static_cast<std::size_t>(*index)];
    const auto output = phase.context.asset.index(sampler, "output", model::RootArray::accessors);
    const bool cubic = model::string_member(document, sampler, "interpolation") == "CUBICSPLINE";
    const auto bad = output ? bad_weight(phase, *output, cubic) : std::nullopt;
    if (bad) report_weight(phase, found->second, *bad);
  }
}

}  // namespace

void check_expression_weights(DataPhase& phase) {
  if (phase.context.deviations.no_additional_rules) return;
  const json::NodeId object = root_extension(phase.context, kAvatarAnimation);
  if (object == json::kNoNode) return;
  Weights weights = read_weights(phase.context, object);
  if (weights.empty()) return;
  for (const json::NodeId animation : phase.context.asset.elements(model::RootArray::animations)) {
    if (animation != json::kNoNode) check_channels(phase, animation, weights);
  }
}

}  // namespace gltfx::validate
