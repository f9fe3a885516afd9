// SPDX-License-Identifier: Apache-2.0
#include "base/interned.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "base/fork.hpp"

namespace gltfx {
namespace {

using Texts = std::set<std::string, std::less<>>;

ForkMutex adding;

}  // namespace

std::string_view interned(std::string_view text) {
  static constinit MadeOnce<std::unique_ptr<Texts>> texts;
  Texts& all = *texts.get([] { return std::make_unique<Texts>(); });
  const std::lock_guard lock(adding);
  const auto known = all.find(text);
  return known != all.end() ? *known : *all.emplace(text).first;
}

}  // namespace gltfx
