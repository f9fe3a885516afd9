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

UpgradeStep read_step(const Build& build, Site at) {
  UpgradeStep step;
  step.copy = build.text(build.member(at, "step")) == "copy";
  step.from = build.text(build.member(at, "from"));
  step.to = build.text(build.member(at, "to"));
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
  upgrade.to = build.text(build.member(at, "to"));
  upgrade.strength = text_of(build, build.member(at, "strength"));
  each_element(build, build.member(at, "hiddenBy"), [&](Site relation) {
    upgrade.hidden_by.push_back({build.text(build.member(relation, "extension")),
                                 build.text(build.member(relation, "because")), false});
  });
  each_element(build, build.member(at, "steps"),
               [&](Site step) { upgrade.steps.push_back(read_step(build, step)); });
  each_element(build, build.member(at, "losses"), [&](Site loss) {
    upgrade.losses.push_back({build.text(build.member(loss, "vertexAttribute")),
                              read_names(build, build.member(loss, "generations")),
                              build.text(build.member(loss, "because"))});
  });
  return upgrade;
}

}  // namespace gltfx::schema
