// SPDX-License-Identifier: Apache-2.0
/// Animations of a value that is copied: the copy is animated in the same way.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "steps/upgrade/context.hpp"
#include "steps/upgrade/vertex_colors.hpp"

namespace gltfx::upgrade {

/// A channel that gets a twin.
struct Follower {
  json::NodeId animation = json::kNoNode;
  json::NodeId channel = json::kNoNode;
  json::NodeId pointer = json::kNoNode;  ///< string
  std::string target;                    ///< JSON pointer of the target of the twin
  /// If components are taken: the sampler whose values are cut, and their accessor.
  json::NodeId sampler = json::kNoNode;
  std::uint64_t output = 0;
  std::uint64_t take = 0;  ///< number of components of each value in the copy; 0: all
};

/// The channels with targets at or below `from` in an element of a root array, and their new
/// targets below `to` there. An Error, the end of a sentence, if the value may be changed by
/// something other than an animation channel, or its values cannot be cut.
Result<std::vector<Follower>> find_followers(Context& context, const Host& host,
                                             const std::vector<std::string>& from,
                                             const std::vector<std::string>& to,
                                             std::uint64_t take);

/// Adds the twin: a channel with the same sampler, or with a sampler whose values are cut and
/// multiplied by `tint`.
void follow(Context& context, const Follower& follower, const Rgb& tint);

}  // namespace gltfx::upgrade
