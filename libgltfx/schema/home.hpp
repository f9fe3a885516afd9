// SPDX-License-Identifier: Apache-2.0
/// Where a member belongs that the type of its object does not know, as far as the schemas of the
/// objects nearby tell.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// An object, and the one that holds it, be it as the element of an array or in `extensions`.
struct Neighbourhood {
  TypeId type = kNone;
  json::NodeId object = json::kNoNode;
  TypeId type_above = kNone;  ///< kNone: of the root there is none
  json::NodeId object_above = json::kNoNode;
  bool among_others = false;  ///< an element of an array that has more of them
};

struct Home {
  enum class Way : std::uint8_t {
    none,       ///< nowhere, or there are several
    member,     ///< in a member of the object
    element,    ///< in an element of an array that is a member
    above,      ///< in the object above
    extension,  ///< in an extension of the object
  };
  Way way = Way::none;
  TypeId type = kNone;       ///< that knows the member
  std::string_view through;  ///< name of that member, array or extension; lives in the Set
  /// The object, where there is exactly one; kNoNode: it can be made, if the way is `member`.
  json::NodeId object = json::kNoNode;
  bool is_certain = false;  ///< which object it is, or that it is to be made
};

/// The only place nearby that knows a member of that name. Of several places the one that the
/// document has; those of extensions are looked at last.
Home find_home(const Set& set, const json::Document& document, const Neighbourhood& around,
               std::string_view name);

/// "'pbrMetallicRoughness'", "an element of 'primitives'", "the root object".
std::string home_name(const Set& set, const Home& home);

}  // namespace gltfx::schema
