// SPDX-License-Identifier: Apache-2.0
/// The features of schema/targets/features.json in an asset, and their places. The member `has` of
/// a feature defines how it is detected.
#pragma once

#include <gltfx/targets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>

#include "model/resource_data.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// The use of a feature by an asset.
enum class FeatureUse : std::uint8_t { used, required, required_with_fallback };

struct FeaturePlace {
  json::NodeId node = json::kNoNode;  ///< the first object with it; kNoNode: the file itself
  FeatureUse use = FeatureUse::used;
  bool fallback = false;  ///< of an extension: each object with it has a fallback
};

/// Features by name. Names of features other than extensions have static storage; those of
/// extensions live in the context.
class Features {
 public:
  explicit Features(std::span<const TargetChoice> targets) : targets_(targets) {}

  /// Whether one of the targets refuses or ignores the feature. Used to skip features with an
  /// expensive search.
  bool matters(std::string_view name) const;
  /// Keeps the first place.
  void note(std::string_view name, json::NodeId node, FeatureUse use = FeatureUse::used,
            bool fallback = false) {
    // Many objects have the features of an earlier object: comparing the address of the literal
    // avoids a comparison of texts.
    const char*& last = recent_[(reinterpret_cast<std::uintptr_t>(name.data()) >> 3U) % 16];
    if (last == name.data()) return;
    last = name.data();
    places_.try_emplace(name, FeaturePlace{node, use, fallback});
  }
  void note_if(bool has, std::string_view name, json::NodeId node) {
    if (has) note(name, node);
  }
  bool has(std::string_view name) const { return places_.count(name) > 0; }
  const std::map<std::string_view, FeaturePlace>& all() const { return places_; }

 private:
  std::span<const TargetChoice> targets_;
  std::map<std::string_view, FeaturePlace> places_;
  std::array<const char*, 16> recent_{};  // names in places_
};

/// Whether a coordinate is beyond a million, where steps of single precision are 1/16 and more.
inline bool is_far(const std::array<float, 3>& point) {
  return std::any_of(point.begin(), point.end(), [](float v) { return std::abs(v) > 1e6F; });
}

/// All features of an asset whose links were checked. Linear in the document.
Features find_features(const Context& context, const model::ResourceData& resources);

// Parts of the search, each in a file of its own.
void find_geometry_features(const Context& context, Features& features);
void find_material_features(const Context& context, Features& features);
void find_scene_features(const Context& context, Features& features);
void find_metadata_features(const Context& context, Features& features);
void find_file_features(const Context& context, const model::ResourceData& resources,
                        Features& features);

}  // namespace gltfx::validate
