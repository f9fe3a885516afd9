// SPDX-License-Identifier: Apache-2.0
/// What help texts name.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace gltfx::program {

/// The long options of the help of a verb.
std::set<std::string> options_in(const std::string& help);

/// The verbs of the help of the program, in its order.
std::vector<std::string> verbs_in(const std::string& help);

}  // namespace gltfx::program
