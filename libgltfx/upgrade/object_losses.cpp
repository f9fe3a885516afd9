// SPDX-License-Identifier: Apache-2.0
/// What a legacy object loses on its way, and what vertex colours and animations have to become for
/// it to lose nothing.
#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/parse.hpp"
#include "schema/phrases.hpp"
#include "upgrade/object_plan.hpp"

namespace gltfx::upgrade {

void ObjectPlan::lose(std::string note) {
  if (action_.fate == UpgradeFate::safe) action_.fate = UpgradeFate::unsafe;
  action_.notes.push_back(std::move(note));
}

void ObjectPlan::follow_animation(const schema::UpgradeStep& step,
                                  const std::vector<std::string>& path) {
  auto followers =
      find_followers(context_, carrier_, path, {"extensions", successor_.name, step.to}, step.take);
  if (!followers) {
    return lose(fmt::format("{} is animated, but {}; the copy in {} is not animated", step.from,
                            followers.error().message, step.to));
  }
  action_.notes.push_back(
      fmt::format("{} is animated; channels for {} are added", step.from, step.to));
  followers_.insert(followers_.end(), followers->begin(), followers->end());
}

void ObjectPlan::note_losses() {
  for (const schema::UpgradeLoss& loss : extension_.upgrade.losses) {
    if (!applies(loss.generations)) continue;
    if (!loss.vertex_attribute.empty()) {
      note_lost_attribute(loss);
    } else if (extension_.upgrade.opt_in.empty()) {
      lose(loss.because);
    } else {
      action_.lossy = true;
      action_.notes.push_back(loss.because);
    }
  }
}

void ObjectPlan::note_lost_attribute(const schema::UpgradeLoss& loss) {
  const std::string& name = loss.vertex_attribute;
  if (carrier_.array != "materials" || !context_.is_used_with(name, carrier_.index)) return;
  Problem problem = std::string("cannot be converted");
  if (name == "COLOR_0") problem = judge_tint();
  if (problem) lose(fmt::format("{} {}: {}", name, *problem, schema::clause(loss.because)));
}

// Vertex colours multiply the base colour; so does a colour that is a copy of it, when they are the
// same for all vertices.
ObjectPlan::Problem ObjectPlan::judge_tint() {
  const auto& steps = extension_.upgrade.steps;
  const auto copy = std::find_if(steps.begin(), steps.end(), [this](const auto& step) {
    return step.kind == schema::UpgradeStep::Kind::copy && step.take == 3 &&
           step.from == "pbrMetallicRoughness/baseColorFactor" && applies(step.generations);
  });
  if (copy == steps.end()) return "cannot be converted";
  const Tint tint = find_tint(context_.asset, context_.values, context_.uses_of(carrier_.index));
  if (!tint.problem.empty()) return tint.problem;
  if (tint.parts.size() > 1 && is_pointed_at({})) {
    return "differs between primitives, but an animation or graph references the material";
  }
  return fold_tint(*copy, tint);
}

// The first colour stays with the material, copies of it get the others.
ObjectPlan::Problem ObjectPlan::fold_tint(const schema::UpgradeStep& step, const Tint& tint) {
  if (tint.parts.size() == 1 && tint.parts.front().color == tint_) return std::nullopt;  // white
  auto found = std::find_if(found_.begin(), found_.end(),
                            [&](const Found& each) { return each.step == &step; });
  if (found == found_.end()) {
    found_.emplace_back(&step, json::kNoNode);
    found = std::prev(found_.end());
    found->json = "[1,1,1]";
  }
  const json::Parsed base = json::parse(found->json);
  const std::vector<json::Number> factor = numbers_of(base.document, base.document.root());
  const auto product = [&](const Rgb& color) {
    return fmt::format("[{},{},{}]", number_text(factor[0].value * color[0]),
                       number_text(factor[1].value * color[1]),
                       number_text(factor[2].value * color[2]));
  };
  tint_ = tint.parts.front().color;
  found->json = product(tint_);
  action_.notes.push_back(fmt::format("COLOR_0 is multiplied into {}", step.to));
  for (std::size_t i = 1; i < tint.parts.size(); ++i) {
    splits_.push_back({carrier_.host,
                       {"extensions", successor_.name, step.to},
                       product(tint.parts[i].color),
                       tint.parts[i].users});
  }
  if (!splits_.empty()) {
    action_.notes.push_back(
        fmt::format("it differs between primitives; the material is duplicated ({})",
                    splits_.size() == 1 ? "1 copy" : fmt::format("{} copies", splits_.size())));
  }
  return std::nullopt;
}

}  // namespace gltfx::upgrade
