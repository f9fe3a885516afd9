// SPDX-License-Identifier: Apache-2.0
/// Objects of a document that carry an extension at its defined place, and the generation (one of
/// the drafts with its name) that each is read as.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"
#include "steps/upgrade/context.hpp"

namespace gltfx::upgrade {

/// The root, members of the root, and elements of its arrays, in the order of the schema and then
/// of the document. Deeper places are not searched.
std::vector<Host> hosts_of(const json::Document& document, const schema::Set& set,
                           const schema::Extension& extension);

struct Decision {
  const schema::Generation* generation =
      nullptr;  ///< null: the extension has only one, or `problem`
  std::string because;
  std::string problem;  ///< why the requested generation does not match
};

/// `wanted` is a part of a generation's name ("v2/v3" has two); for any other word, such as "auto",
/// the members decide.
Decision decide_generation(const json::Document& document, const schema::Extension& extension,
                           json::NodeId object, std::string_view wanted);

/// Whether that word is a generation's name, or one of its alternatives.
bool is_called(const schema::Generation& generation, std::string_view word);

}  // namespace gltfx::upgrade
