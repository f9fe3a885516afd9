// SPDX-License-Identifier: Apache-2.0
/// Objects of a document that carry an extension where it is at home, and as which of the shapes
/// that went by its name each is read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"
#include "steps/upgrade/context.hpp"

namespace gltfx::upgrade {

/// The root, members of the root, and elements of its arrays, in the order of the schema and then
/// of the document. Homes further below are not looked at.
std::vector<Host> hosts_of(const json::Document& document, const schema::Set& set,
                           const schema::Extension& extension);

struct Decision {
  const schema::Generation* generation =
      nullptr;  ///< null: the extension has only one, or `problem`
  std::string because;
  std::string problem;  ///< why the wanted generation cannot be it
};

/// `wanted` is one of the names in a generation's ("v2/v3" has two); any other word, such as
/// "auto", leaves it to the members.
Decision decide_generation(const json::Document& document, const schema::Extension& extension,
                           json::NodeId object, std::string_view wanted);

/// Whether a generation's name is, or has among its alternatives, that word.
bool is_called(const schema::Generation& generation, std::string_view word);

}  // namespace gltfx::upgrade
