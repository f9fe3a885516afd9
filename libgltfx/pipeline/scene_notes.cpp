// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_notes.hpp"

#include <utility>

#include <fmt/format.h>

namespace gltfx {
namespace {

constexpr std::size_t kMostSentences = 32;

}  // namespace

void SceneNotes::add(std::string sentence) {
  if (sentences_.size() < kMostSentences) {
    sentences_.push_back(std::move(sentence));
  } else {
    ++more_;
  }
}

void SceneNotes::add(const std::string& place, const std::string& fate) {
  Kind& kind = kinds_[fate];
  if (kind.count++ == 0) kind.first = place;
}

std::vector<std::string> SceneNotes::take() {
  for (const auto& [fate, kind] : kinds_) {
    if (kind.count == 1) {
      add(fmt::format("{} {}.", kind.first, fate));
    } else {
      add(fmt::format("{} {}, and {} more like it.", kind.first, fate, kind.count - 1));
    }
  }
  if (more_ > 0) sentences_.push_back(fmt::format("{} more notes were left out.", more_));
  return std::move(sentences_);
}

}  // namespace gltfx
