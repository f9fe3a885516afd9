// SPDX-License-Identifier: Apache-2.0
#include "steps/stages.hpp"

#include <utility>

#include "change/apply.hpp"
#include "change/place.hpp"

namespace gltfx::steps {

std::optional<Error> Stages::add(change::Change change) {
  auto placed = change::place(std::move(change), asset(), nullptr);
  if (!placed) return placed.error();
  auto next = change::apply(asset(), *placed);
  if (!next) return next.error();
  all_.edits = json::chain_edits(*before_.container().json, all_.edits, placed->edits);
  all_.files.insert(all_.files.end(), placed->files.begin(), placed->files.end());
  now_.emplace(*std::move(next));
  return std::nullopt;
}

}  // namespace gltfx::steps
