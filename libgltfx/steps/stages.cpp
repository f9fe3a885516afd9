// SPDX-License-Identifier: Apache-2.0
#include "steps/stages.hpp"

#include <utility>

#include "change/apply.hpp"
#include "change/chain.hpp"
#include "change/place.hpp"

namespace gltfx::steps {

std::optional<Error> Stages::add(change::Change change) {
  auto placed = change::place(std::move(change), asset(), nullptr);
  if (!placed) return placed.error();
  change::append(all_, *placed, *before_.container().json);
  last_ = *std::move(placed);
  return std::nullopt;
}

std::optional<Error> Stages::apply() {
  if (!last_) return std::nullopt;
  auto next = change::apply(asset(), *last_);
  if (!next) return next.error();
  last_.reset();
  now_ = std::make_shared<const model::OpenedAsset>(*std::move(next));
  return std::nullopt;
}

}  // namespace gltfx::steps
