// SPDX-License-Identifier: Apache-2.0
/// Animations of a value of which there is a copy from now on: the copy moves along.
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
  std::string target;                    ///< JSON pointer that the twin has instead
  /// With components to take: the sampler whose values are cut, and their accessor.
  json::NodeId sampler = json::kNoNode;
  std::uint64_t output = 0;
  std::uint64_t take = 0;  ///< components of each value that the copy has; 0: all
};

/// The channels that lead to, or below, `from` in an element of a root array, with their new target
/// below `to` there. An Error, the end of a sentence, when something else than a channel of an
/// animation may change the value, or its values cannot be cut.
Result<std::vector<Follower>> find_followers(Context& context, const Host& host,
                                             const std::vector<std::string>& from,
                                             const std::vector<std::string>& to,
                                             std::uint64_t take);

/// Adds the twin: a channel with the same sampler, or with one whose values are cut and multiplied
/// by `tint`.
void follow(Context& context, const Follower& follower, const Rgb& tint);

}  // namespace gltfx::upgrade
