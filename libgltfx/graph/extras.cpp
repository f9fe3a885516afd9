// SPDX-License-Identifier: Apache-2.0
#include "graph/extras.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace gltfx::graph {

std::vector<json::NodeId> likely_indices(const json::Document& document,
                                         std::initializer_list<std::string_view> words) {
  std::vector<json::NodeId> found;
  const json::KeyId extras = document.key_id("extras");
  if (extras == json::kNoKey) return found;
  const auto sounds_like_an_index = [&](std::string_view name) {
    std::string lower(name);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
      return lower.find(word) != std::string::npos;
    });
  };
  json::NodeId end = 0;  // of the current extras
  for (json::NodeId id = 0; id < document.node_count(); ++id) {
    const json::Node& node = document.node(id);
    if (node.kind != json::Kind::key) continue;
    if (node.next == extras) end = std::max(end, document.next(id + 1));
    const json::Kind kind = document.kind(id + 1);
    const bool number = kind == json::Kind::number || kind == json::Kind::number_array;
    if (id < end && number && sounds_like_an_index(document.key(node.next))) {
      found.push_back(id + 1);
    }
  }
  return found;
}

}  // namespace gltfx::graph
