// SPDX-License-Identifier: Apache-2.0
/// Members of `extras` that may be references.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "json/document.hpp"

namespace gltfx::graph {

/// Numbers and lists of numbers below some `extras`, as values of members whose name contains one
/// of the words, which are lower case. In the order of the text.
std::vector<json::NodeId> likely_indices(const json::Document& document,
                                         std::initializer_list<std::string_view> words);

}  // namespace gltfx::graph
