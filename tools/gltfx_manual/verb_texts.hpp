// SPDX-License-Identifier: Apache-2.0
/// What manual pages say of a verb beside its options, which come from the command line's own
/// table.
#pragma once

#include <string_view>

namespace gltfx::tool {

struct VerbText {
  std::string_view verb;
  std::string_view operands;     ///< what stands behind the options: "PATH..."; may be empty
  std::string_view description;  ///< paragraphs of prose with blank lines between
};

/// The text of a verb, of the program itself for an empty one; null for an unknown one.
const VerbText* find_verb_text(std::string_view verb);

}  // namespace gltfx::tool
