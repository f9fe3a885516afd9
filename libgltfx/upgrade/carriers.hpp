// SPDX-License-Identifier: Apache-2.0
/// Objects of a document that carry an extension where it is at home.
#pragma once

#include <vector>

#include "upgrade/context.hpp"

namespace gltfx::upgrade {

/// The root, members of the root, and elements of its arrays, in the order of the schema and then
/// of the document. Homes further below are not looked at.
std::vector<Carrier> carriers_of(const json::Document& document, const schema::Set& set,
                                 const schema::Extension& extension);

}  // namespace gltfx::upgrade
