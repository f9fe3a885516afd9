// SPDX-License-Identifier: Apache-2.0
/// Content that is lost when a value is removed from a document.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::change {

/// Members of an extension's object that its type does not have: its `extras` unless they are
/// empty, the extensions on it, and unknown members. In the order of the text, each once. `type`
/// may be schema::kNone: then all other members count as the object's own.
std::vector<std::string> foreign_members(const json::Document& document, const schema::Set& set,
                                         json::NodeId object, schema::TypeId type);

/// Foreign content of a value that is not an extension's object: `extras` anywhere in it, and
/// extensions that the set does not have.
std::vector<std::string> foreign_below(const json::Document& document, const schema::Set& set,
                                       json::NodeId value);

/// Both, for an extension's object that is removed with all that it contains.
std::vector<std::string> foreign_content(const json::Document& document, const schema::Set& set,
                                         json::NodeId object, schema::TypeId type);

/// Extensions whose objects are all inside removed values, with one of these values. Objects in
/// `extras` do not count. Linear in the document.
std::map<std::string, json::NodeId> extensions_taken_out(const json::Document& document,
                                                         std::vector<json::NodeId> values);

}  // namespace gltfx::change
