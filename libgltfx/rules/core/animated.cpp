// SPDX-License-Identifier: Apache-2.0
#include "rules/core/animated.hpp"

#include <algorithm>

#include "model/fields.hpp"

namespace gltfx::validate {

using model::object_member;
using model::RootArray;

Animated::Animated(const Context& context) {
  const json::Document& document = context.document;
  // A behavior graph may write any property.
  const json::NodeId root = object_member(document, document.root(), "extensions");
  if (root != json::kNoNode) {
    for (const auto member : document.members(root)) {
      any_ = any_ || document.find(member.value, "graphs") != json::kNoNode;
    }
  }
  for (const json::NodeId animation : context.asset.elements(RootArray::animations)) {
    const json::NodeId channels = document.find(animation, "channels");
    if (channels == json::kNoNode || document.kind(channels) != json::Kind::array) continue;
    for (const json::NodeId channel : document.elements(channels)) {
      const json::NodeId target = object_member(document, channel, "target");
      const json::NodeId extensions = object_member(document, target, "extensions");
      if (extensions == json::kNoNode) continue;
      for (const auto member : document.members(extensions)) {
        pointers_.push_back(model::string_member(document, member.value, "pointer"));
      }
    }
  }
  std::sort(pointers_.begin(), pointers_.end());
}

bool Animated::contains(const std::string& pointer) const {
  return any_ || std::binary_search(pointers_.begin(), pointers_.end(), pointer);
}

}  // namespace gltfx::validate
