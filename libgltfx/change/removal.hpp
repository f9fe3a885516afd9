// SPDX-License-Identifier: Apache-2.0
/// What else leaves a document with a value that is taken out of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::change {

/// What an extension's object has beside the members of its own type: its `extras` unless they are
/// empty, the extensions on it, and members that the type does not have. In the order of the text,
/// each once. `type` may be schema::kNone: then every other member is the object's own.
std::vector<std::string> foreign_members(const json::Document& document, const schema::Set& set,
                                         json::NodeId object, schema::TypeId type);

/// What a value that is no extension's object takes with it: `extras` anywhere in it, and
/// extensions that the set does not know.
std::vector<std::string> foreign_below(const json::Document& document, const schema::Set& set,
                                       json::NodeId value);

/// Both, of an extension's object that goes with all that is in it.
std::vector<std::string> foreign_content(const json::Document& document, const schema::Set& set,
                                         json::NodeId object, schema::TypeId type);

/// Extensions all of whose objects lie in values that are taken out, with one of those values.
/// Objects in `extras` do not count. Linear in the document.
std::map<std::string, json::NodeId> extensions_taken_out(const json::Document& document,
                                                         std::vector<json::NodeId> values);

}  // namespace gltfx::change
