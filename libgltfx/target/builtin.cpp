// SPDX-License-Identifier: Apache-2.0
#include "target/builtin.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "target/embedded.hpp"
#include "target/target_file.hpp"

namespace gltfx::target {
namespace {

// A target that is read when it is first asked for. A test reads them all: they have no errors.
struct BuiltinTarget {
  std::once_flag once;
  std::shared_ptr<const Target> target;
};

std::shared_ptr<const Target> read_once(std::size_t position) {
  static std::vector<BuiltinTarget> targets(embedded_targets().size());
  BuiltinTarget& one = targets[position];
  std::call_once(one.once, [&] {
    auto read = read_target(embedded_targets()[position].text);
    if (read) one.target = std::make_shared<const Target>(*std::move(read));
  });
  return one.target;
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
  static const std::vector<std::shared_ptr<const Target>> targets = [] {
    std::vector<std::shared_ptr<const Target>> read;
    for (const target::EmbeddedTarget& each : target::embedded_targets()) {
      if (auto one = target::builtin_target(each.name)) read.push_back(std::move(one));
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
