// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/version_shapes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/graph.hpp"
#include "graph/unknown_indices.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "steps/moved_members.hpp"

namespace gltfx::upgrade {
namespace {

using steps::kShapeNumbers;
using steps::kShapesExtension;

// What refers to one of the shapes, or may do so.
std::optional<std::string> find_user(const json::Document& document, const schema::Set& set,
                                     json::NodeId list) {
  const graph::Graph graph(document, set);
  const auto inside = [&](json::NodeId value) {
    return value >= list && value < document.next(list);
  };
  for (const graph::Use& use : graph.uses()) {
    if (inside(use.target)) return graph.tree().pointer(use.at);
  }
  const json::NodeId unknown = graph::find_unknown_with_integer(graph);
  if (unknown != json::kNoNode) return graph.tree().pointer(unknown);
  return std::nullopt;
}

// The members of a shape of that type, with those that are absent.
std::string with_numbers(const json::Document& document, json::NodeId body, std::string_view type) {
  std::vector<std::string> members;
  if (body != json::kNoNode) {
    for (const auto member : document.members(body)) {
      members.push_back(fmt::format("{}:{}", document.raw(member.key), document.raw(member.value)));
    }
  }
  for (const steps::ShapeNumber& number : kShapeNumbers) {
    if (number.type != type || document.find(body, number.member) != json::kNoNode) continue;
    members.push_back(fmt::format(R"("{}":{})", number.member, number.value));
  }
  return fmt::format("{{{}}}", fmt::join(members, ","));
}

Result<std::string> converted_shape(const json::Document& document, json::NodeId shape) {
  if (!document.is_object(shape)) return Error{"a shape is not an object"};
  const std::string type = model::string_member(document, shape, "type");
  const json::NodeId body = document.find(shape, type);
  if (type.empty() || (body != json::kNoNode && !document.is_object(body))) {
    return Error{"a shape has no type"};
  }
  if (model::true_member(document, body, "doubleSided")) {
    return Error{"a plane has two sides, for which glTF 2.1 has no member"};
  }
  std::vector<std::string> members;
  for (const auto member : document.members(shape)) {
    const bool is_body = member.value == body;
    members.push_back(fmt::format(
        "{}:{}", document.raw(member.key),
        is_body ? with_numbers(document, body, type) : std::string(document.raw(member.value))));
  }
  if (body == json::kNoNode) {
    members.push_back(
        fmt::format("{}:{}", json::string_value(type), with_numbers(document, body, type)));
  }
  return fmt::format("{{{}}}", fmt::join(members, ","));
}

}  // namespace

std::optional<Result<std::vector<std::string>>> shapes_of_extension(const json::Document& document,
                                                                    const schema::Set& set) {
  const json::NodeId root = document.root();
  const json::NodeId object = model::extension_object(document, root, kShapesExtension);
  const json::NodeId list = document.find(object, "shapes");
  if (list == json::kNoNode) return std::nullopt;
  const json::NodeId present = document.find(root, "shapes");
  const bool fits = present == json::kNoNode || document.kind(present) == json::Kind::array;
  if (document.kind(list) != json::Kind::array || document.object_size(object) != 1 || !fits) {
    return Error{"it has other members than a list of shapes"};
  }
  if (const auto user = find_user(document, set, list)) {
    return Error{fmt::format("{} refers to it", printable(*user))};
  }
  std::vector<std::string> shapes;
  for (const json::NodeId element : document.elements(list)) {
    auto shape = converted_shape(document, element);
    if (!shape) return shape.error();
    shapes.push_back(*std::move(shape));
  }
  return shapes;
}

}  // namespace gltfx::upgrade
