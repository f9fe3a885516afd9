// SPDX-License-Identifier: Apache-2.0
/// Where a value of one object stands in another one, and how far two values are apart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prove/side.hpp"

namespace gltfx::prove {

/// Where a value stands, or would stand.
struct Stand {
  std::string pointer;
  bool there = false;
  json::NodeId value = json::kNoNode;  ///< there; else what is missing there
};

/// The steps from an object down to a value.
std::vector<std::string> steps_to(const Side& side, json::NodeId object, json::NodeId value);

/// Finds where a value of `object` stands in `other_object`, or else the last object above it that
/// is there. `own`: the pointer to what is missing there; of a missing list of extensions, to the
/// extension.
Stand find_stand(const Side& side, json::NodeId object, const Side& other,
                 json::NodeId other_object, json::NodeId value, std::string& own);

/// The name of a member, or of the member whose array has the value.
std::string value_label(const Side& side, json::NodeId value);

/// Two numbers, or two lists of as many numbers.
struct NumbersApart {
  double most = 0;
  std::size_t differing = 0;
  std::size_t which = 0;  ///< the last of those that differ
  bool is_list = false;
};
/// Values of other kinds: none differs.
NumbersApart numbers_apart(const json::Document& here, json::NodeId ours,
                           const json::Document& there, json::NodeId theirs);

}  // namespace gltfx::prove
