// SPDX-License-Identifier: Apache-2.0
/// Changes of the transforms of nodes, in the text and in keyframes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/graph.hpp"
#include "model/node.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// A change of a transform: the translation t becomes factor * t + shift, the rest of the transform
/// is multiplied by `factor` if `scales`.
struct NodeMove {
  double factor = 1;
  model::Vector3 shift{};
  bool scales = false;

  bool operator==(const NodeMove&) const = default;
};

/// By node.
using NodeMoves = std::map<model::NodeIndex, NodeMove>;

/// The transform of a node in the precision in which it is written. Returns why that is not
/// possible, half a sentence, or an empty string.
std::string read_exact_transform(const json::Document& document, const model::Node& node,
                                 model::Affine& transform);

/// A number in 15 significant digits: products such as 0.01 * 3.7 have no more.
double rounded(double value);

/// Whether a JSON pointer may lead to the transform of a node.
bool is_pointed_transform(const StepData& data, const graph::PointerText& pointer,
                          const NodeMoves& moves);

/// Edits transforms and the keyframes of translations and scales. Returns objects that forbid it;
/// then the changes are not usable.
std::vector<ConvertNote> move_nodes(const StepData& data, const NodeMoves& moves,
                                    StepChanges& changes);

}  // namespace gltfx::steps
