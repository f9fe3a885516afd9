// SPDX-License-Identifier: Apache-2.0
/// Finds the object nearby that a misplaced member belongs to, by the schemas of these objects.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// An object, and the one that contains it, as the element of an array or in `extensions`.
struct Neighbourhood {
  TypeId type = kNone;
  json::NodeId object = json::kNoNode;
  TypeId type_above = kNone;  ///< kNone for the root
  json::NodeId object_above = json::kNoNode;
  bool among_others = false;    ///< an element of an array with several elements
  Version version = kVersion2;  ///< members of later versions are no home
};

struct Home {
  enum class Way : std::uint8_t {
    none,       ///< no place, or several
    member,     ///< in a member of the object
    element,    ///< in an element of an array that is a member
    above,      ///< in the object above
    extension,  ///< in an extension of the object
  };
  Way way = Way::none;
  TypeId type = kNone;       ///< type that has the member
  std::string_view through;  ///< name of that member, array or extension; lives in the Set
  /// The object, if there is exactly one; kNoNode: it can be created if the way is `member`.
  json::NodeId object = json::kNoNode;
  bool is_certain = false;  ///< the object, or that it must be created, is certain
};

/// The only place nearby for a member of that name. Of several places, the one that exists in the
/// document; extensions come last.
Home find_home(const Set& set, const json::Document& document, const Neighbourhood& around,
               std::string_view name);

/// "'pbrMetallicRoughness'", "an element of 'primitives'", "the root object".
std::string home_name(const Set& set, const Home& home);

}  // namespace gltfx::schema
