// SPDX-License-Identifier: Apache-2.0
// The annotation `upgrade`, behind the vocabulary check.
#include "schema/shape_builder.hpp"

namespace gltfx::schema {
namespace {

std::string text_of(const Build& build, Site at) {
  return at.exists() ? build.text(at) : std::string();
}

template <class Read>
void each_element(const Build& build, Site list, const Read& read) {
  if (!list.exists()) return;
  for (const json::NodeId element : build.document(list).elements(list.node)) {
    read(Site{list.source, element});
  }
}

std::vector<Relation> read_others(const Build& build, Site list) {
  std::vector<Relation> others;
  each_element(build, list, [&](Site relation) {
    others.push_back({build.text(build.member(relation, "extension")),
                      build.text(build.member(relation, "because")), false});
  });
  return others;
}

UpgradeStep::Kind kind_of(std::string_view word) {
  if (word == "copy") return UpgradeStep::Kind::copy;
  return word == "place" ? UpgradeStep::Kind::place : UpgradeStep::Kind::move;
}

UpgradeStep read_step(const Build& build, Site at) {
  UpgradeStep step;
  step.kind = kind_of(build.text(build.member(at, "step")));
  step.from = text_of(build, build.member(at, "from"));
  step.to = build.text(build.member(at, "to"));
  const Site otherwise = build.member(at, "otherwise");
  if (otherwise.exists()) step.otherwise = build.document(otherwise).raw(otherwise.node);
  const Site take = build.member(at, "take");
  if (take.exists()) step.take = build.document(take).unsigned_integer(take.node).value_or(0);
  step.swizzle = text_of(build, build.member(at, "swizzle"));
  step.accept_index = build.member(at, "accept").exists();
  step.generations = read_names(build, build.member(at, "generations"));
  return step;
}

}  // namespace

Upgrade read_upgrade(const Build& build, Site at) {
  Upgrade upgrade;
  const auto word = [&](std::string_view name) { return build.member(at, name); };
  upgrade.to = text_of(build, word("to"));
  upgrade.alternatives = read_names(build, word("alternatives"));
  upgrade.opt_in = text_of(build, word("optIn"));
  upgrade.together = word("together").exists() &&
                     build.document(at).kind(word("together").node) == json::Kind::true_value;
  upgrade.conversion = text_of(build, word("convert"));
  upgrade.hidden_by = read_others(build, word("hiddenBy"));
  upgrade.blocked_by = read_others(build, word("blockedBy"));
  each_element(build, build.member(at, "steps"),
               [&](Site step) { upgrade.steps.push_back(read_step(build, step)); });
  each_element(build, build.member(at, "losses"), [&](Site loss) {
    upgrade.losses.push_back({text_of(build, build.member(loss, "vertexAttribute")),
                              read_names(build, build.member(loss, "generations")),
                              build.text(build.member(loss, "because"))});
  });
  each_element(build, word("stays"), [&](Site stay) {
    upgrade.stays.push_back({read_names(build, build.member(stay, "generations")),
                             build.text(build.member(stay, "because"))});
  });
  return upgrade;
}

}  // namespace gltfx::schema
