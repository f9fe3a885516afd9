// SPDX-License-Identifier: Apache-2.0
#include "model/opened_asset.hpp"

#include <utility>

#include "model/asset.hpp"

namespace gltfx::model {

OpenedAsset::OpenedAsset(std::string name, container::Container container,
                         container::Resolver resolver)
    : name_(std::move(name)), container_(std::move(container)), resolver_(std::move(resolver)) {}

OpenedAsset::OpenedAsset(std::string name, container::Container container,
                         container::Resolver resolver, json::Parsed parsed)
    : OpenedAsset(std::move(name), std::move(container), std::move(resolver)) {
  parsed_ = std::make_unique<const json::Parsed>(std::move(parsed));
}

const json::Parsed& OpenedAsset::parsed() const {
  if (!parsed_) {
    parsed_ = std::make_unique<const json::Parsed>(container_.json ? json::parse(container_.json)
                                                                   : json::Parsed());
  }
  return *parsed_;
}

const Views& OpenedAsset::views() const {
  if (!views_) views_ = std::make_unique<const Views>(Asset(document()));
  return *views_;
}

}  // namespace gltfx::model
