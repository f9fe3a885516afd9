// SPDX-License-Identifier: Apache-2.0
/// Nodes that are scaled to 0.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/node.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Whether nothing has an area after the transform.
bool is_flat(const model::Affine& transform);

/// Whether animations and behaviours may change scales, or anything of an extension.
bool may_change_scales(const Context& context);

/// Looks at each node once.
class FlatNodes {
 public:
  explicit FlatNodes(const Context& context)
      : context_(context), known_(context.views.nodes.size()) {}

  /// The node, or the nearest one above it, whose own transform is_flat(); nothing: none is.
  std::optional<model::NodeIndex> cause(model::NodeIndex node);

 private:
  const Context& context_;
  struct Known {
    bool seen = false;
    std::optional<model::NodeIndex> cause;
  };
  std::vector<Known> known_;
};

}  // namespace gltfx::validate
