// SPDX-License-Identifier: Apache-2.0
#include "target/repair.hpp"

#include <algorithm>

#include "base/fork.hpp"
#include "target/embedded.hpp"
#include "target/target_file.hpp"

namespace gltfx::target {

const std::array<std::string_view, kRepairCount> kRepairNames{
    "decode-draco",    "decode-meshopt",      "float-attributes",
    "float-texcoords", "float-colors",        "float-weights",
    "float-rotations", "float-morph-weights", "plain-accessors",
    "separate-views",  "wide-indices",        "write-indices",
    "lists",           "instance-nodes",      "inverse-bind-matrices",
    "core-images",     "rgb-images",          "media-types",
    "one-file",        "no-data-uris"};

std::optional<Repair> repair_of(std::string_view feature) {
  using ByFeature = std::map<std::string, Repair, std::less<>>;
  static constinit MadeOnce<ByFeature> repairs;
  const ByFeature& all = repairs.get([] {
    auto read = read_repairs(embedded_features());
    return read ? *std::move(read) : ByFeature();
  });
  const auto found = all.find(feature);
  return found == all.end() ? std::nullopt : std::optional(found->second);
}

void Repairs::add(Repair repair, std::string_view feature, bool only_required) {
  const auto [found, is_new] = features_[repair].try_emplace(std::string(feature), only_required);
  if (!is_new) found->second = found->second && only_required;
}

bool Repairs::has_any(std::initializer_list<Repair> repairs) const {
  return std::any_of(repairs.begin(), repairs.end(), [this](Repair one) { return has(one); });
}

std::map<std::string, bool, std::less<>> Repairs::features(Repair repair) const {
  const auto found = features_.find(repair);
  return found == features_.end() ? std::map<std::string, bool, std::less<>>() : found->second;
}

}  // namespace gltfx::target
