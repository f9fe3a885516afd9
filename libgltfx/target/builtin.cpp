// SPDX-License-Identifier: Apache-2.0
#include "target/builtin.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/fork.hpp"
#include "target/embedded.hpp"
#include "target/target_file.hpp"

namespace gltfx::target {
namespace {

// A target that is read at first use. A test reads them all: they have no errors.
using BuiltinTarget = MadeOnce<std::shared_ptr<const Target>>;

std::shared_ptr<const Target> read_once(std::size_t position) {
  static constinit MadeOnce<std::unique_ptr<BuiltinTarget[]>> targets;
  const auto& all =
      targets.get([] { return std::make_unique<BuiltinTarget[]>(embedded_targets().size()); });
  return all[position].get([&] {
    auto read = read_target(embedded_targets()[position].text);
    return read ? std::make_shared<const Target>(*std::move(read)) : nullptr;
  });
}

}  // namespace

std::shared_ptr<const Target> builtin_target(std::string_view name) {
  const auto all = embedded_targets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  if (found == all.end()) return nullptr;
  return read_once(static_cast<std::size_t>(found - all.begin()));
}

}  // namespace gltfx::target

namespace gltfx {

const std::vector<std::shared_ptr<const Target>>& builtin_targets() {
  static constinit MadeOnce<std::vector<std::shared_ptr<const Target>>> targets;
  return targets.get([] {
    std::vector<std::shared_ptr<const Target>> read;
    for (const target::EmbeddedTarget& each : target::embedded_targets()) {
      if (auto one = target::builtin_target(each.name)) read.push_back(std::move(one));
    }
    return read;
  });
}

const std::map<std::string, Feature, std::less<>>& target_features() {
  static constinit MadeOnce<std::map<std::string, Feature, std::less<>>> features;
  return features.get([] {
    auto read = target::read_features(target::embedded_features());
    return read ? *std::move(read) : std::map<std::string, Feature, std::less<>>();
  });
}

}  // namespace gltfx
