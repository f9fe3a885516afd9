// SPDX-License-Identifier: Apache-2.0
/// Values that a shape accepts, and values that it does not, made from the shape only.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "schema/set.hpp"

namespace gltfx::test {

using Json = nlohmann::ordered_json;

/// Something a made value refers to and that the document must therefore have.
struct Need {
  std::string from;  ///< pointer to the object the target's steps start at; empty: the root
  schema::Target target;
  std::string at;                  ///< pointer to the value that refers
  bool is_name = false;            ///< `refName`: the value must become an existing name
  std::vector<std::string> has{};  ///< `refHas`: members of the referenced object
};

/// Makes smallest valid values.
class ValueMaker {
 public:
  explicit ValueMaker(const schema::Set& set) : set_(set) {}

  /// An object around the place where values are made: targets may start there.
  struct Around {
    schema::TypeId origin;
    std::string pointer;
  };
  /// From now on values are made inside these objects, the outermost first.
  void stand_in(std::vector<Around> around) { open_ = std::move(around); }

  /// The smallest value for a shape, which will be at `pointer`. Objects that it refers to are
  /// added to
  /// `needs`.
  Json make(schema::ShapeId shape, const std::string& pointer, std::vector<Need>& needs);
  /// Adds the members that a shape requires to an existing object.
  void complete(schema::ShapeId shape, Json& object, const std::string& pointer,
                std::vector<Need>& needs);
  /// Whether a value fits a shape; references are ignored.
  bool holds(schema::ShapeId shape, const Json& value) const;

 private:
  Json make_number(const schema::Shape& shape, const std::string& pointer,
                   std::vector<Need>& needs);
  Json make_string(const schema::Shape& shape, const std::string& pointer,
                   std::vector<Need>& needs);
  Json make_array(const schema::Shape& shape, const std::string& pointer, std::vector<Need>& needs);
  void complete_members(const schema::Shape& shape, Json& object, const std::string& pointer,
                        std::vector<Need>& needs);
  void complete_branches(const schema::Shape& shape, Json& object, const std::string& pointer,
                         std::vector<Need>& needs);
  void complete_dependencies(const schema::Shape& shape, Json& object, const std::string& pointer,
                             std::vector<Need>& needs);
  schema::ShapeId nearest_branch(const std::vector<schema::ShapeId>& branches,
                                 const Json& object) const;
  std::string member_name(const schema::Shape& shape, const Json& object) const;
  void need(const schema::Target& target, const std::string& pointer, bool is_name,
            std::vector<Need>& needs);

  const schema::Set& set_;
  std::vector<Around> open_;  ///< objects around the value that is made
};

/// A value that is wrong in one way.
struct BadValue {
  std::string how;  ///< "below", "wrong type"
  Json value;
};

/// Every kind of invalid value of a shape, independent of other values; `good` is a valid one.
std::vector<BadValue> bad_values(const schema::Set& set, schema::ShapeId shape, const Json& good);

}  // namespace gltfx::test
