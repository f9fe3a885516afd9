// SPDX-License-Identifier: Apache-2.0
#include "steps/stages.hpp"

#include <utility>

#include "change/apply.hpp"
#include "change/place.hpp"

namespace gltfx::steps {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

std::optional<Error> Stages::add(change::Change change) {
  auto placed = change::place(std::move(change), asset(), nullptr);
  if (!placed) return placed.error();
  if (all_.empty()) {
    all_ = *placed;
  } else {
    all_.edits = json::chain_edits(*before_.container().json, all_.edits, placed->edits);
    append(all_.files, placed->files);
    append(all_.replaced, placed->replaced);
    if (placed->format) {  // its bytes include those of all changes before
      all_.format = placed->format;
      all_.bin = {};
    }
    if (!placed->bin.empty()) all_.bin = placed->bin;
  }
  last_ = *std::move(placed);
  return std::nullopt;
}

std::optional<Error> Stages::apply() {
  if (!last_) return std::nullopt;
  auto next = change::apply(asset(), *last_);
  if (!next) return next.error();
  last_.reset();
  now_.emplace(*std::move(next));
  return std::nullopt;
}

}  // namespace gltfx::steps
