// SPDX-License-Identifier: Apache-2.0
/// The rules on the scene graph as a whole in words; what checks them is in node_graph.cpp.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> node_graph_rules();

}  // namespace gltfx::validate
