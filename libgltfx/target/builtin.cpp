// SPDX-License-Identifier: Apache-2.0
#include <gltfx/targets.hpp>

#include <utility>

#include "target/embedded.hpp"
#include "target/target_file.hpp"

namespace gltfx {

// A test reads them all: what is embedded has no errors.
const std::vector<std::shared_ptr<const Target>>& builtin_targets() {
  static const std::vector<std::shared_ptr<const Target>> targets = [] {
    std::vector<std::shared_ptr<const Target>> read;
    for (const char* const text : target::embedded_targets()) {
      auto one = target::read_target(text);
      if (one) read.push_back(std::make_shared<const Target>(*std::move(one)));
    }
    return read;
  }();
  return targets;
}

const std::map<std::string, Feature, std::less<>>& target_features() {
  static const std::map<std::string, Feature, std::less<>> features = [] {
    auto read = target::read_features(target::embedded_features());
    return read ? *std::move(read) : std::map<std::string, Feature, std::less<>>();
  }();
  return features;
}

}  // namespace gltfx
