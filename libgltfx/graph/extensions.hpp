// SPDX-License-Identifier: Apache-2.0
/// Finds the objects of extensions in a document.
#pragma once

#include "json/document.hpp"

namespace gltfx::graph {

/// Calls `visit` with the members of `extensions` in the nodes [begin, end), except those in
/// `extras`.
template <class Visit>
void each_extension(const json::Document& document, json::NodeId begin, json::NodeId end,
                    const Visit& visit) {
  const json::KeyId extras = document.key_id("extras");
  const json::KeyId extensions = document.key_id("extensions");
  for (json::NodeId id = begin; id < end;) {
    const json::Node& node = document.node(id);
    const bool key = node.kind == json::Kind::key;
    if (key && node.next == extensions && document.is_object(id + 1)) {
      for (const auto member : document.members(id + 1)) visit(member);
    }
    id = key && node.next == extras ? document.next(id + 1) : id + 1;
  }
}

template <class Visit>
void each_extension(const json::Document& document, const Visit& visit) {
  each_extension(document, 0, static_cast<json::NodeId>(document.node_count()), visit);
}

}  // namespace gltfx::graph
