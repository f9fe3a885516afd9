// SPDX-License-Identifier: Apache-2.0
#include "prove/value_stand.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "prove/column.hpp"

namespace gltfx::prove {

std::vector<std::string> steps_to(const Side& side, json::NodeId object, json::NodeId value) {
  std::vector<std::string> steps;
  const graph::Tree& tree = side.tree();
  while (value != object && value != json::kNoNode && value != 0) {
    steps.push_back(tree.is_member(value) ? std::string(tree.name(value))
                                          : std::to_string(tree.position(value)));
    value = tree.parent(value);
  }
  if (value != object) steps.clear();
  std::reverse(steps.begin(), steps.end());
  return steps;
}

Stand find_stand(const Side& side, json::NodeId object, const Side& other,
                 json::NodeId other_object, json::NodeId value, std::string& own) {
  const std::vector<std::string> steps = steps_to(side, object, value);
  json::NodeId at = other_object;
  json::NodeId mine = object;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const graph::Place next = other.tree().step(at, steps[i]);
    mine = side.tree().step(mine, steps[i]).node;
    if (next.node == json::kNoNode || next.element) {
      const bool is_list_of_extensions =
          steps[i] == "extensions" && side.tree().is_member(mine) && i + 1 < steps.size();
      if (is_list_of_extensions) mine = side.tree().step(mine, steps[i + 1]).node;
      own = side.pointer(mine);
      return {other.pointer(at), false, mine};
    }
    at = next.node;
  }
  own = side.pointer(value);
  return {other.pointer(at), !steps.empty(), steps.empty() ? value : at};
}

std::string value_label(const Side& side, json::NodeId value) {
  const graph::Tree& tree = side.tree();
  while (value != 0 && !tree.is_member(value)) value = tree.parent(value);
  return value == 0 ? std::string("value") : printable(std::string(tree.name(value)).substr(0, 80));
}

NumbersApart numbers_apart(const json::Document& here, json::NodeId ours,
                           const json::Document& there, json::NodeId theirs) {
  NumbersApart found;
  if (here.is_number(ours) && there.is_number(theirs)) {
    found.most = std::fabs(here.number(ours).value - there.number(theirs).value);
    found.differing = 1;
    return found;
  }
  found.is_list = here.kind(ours) == json::Kind::number_array &&
                  there.kind(theirs) == json::Kind::number_array &&
                  here.array_size(ours) == there.array_size(theirs);
  if (!found.is_list) return found;
  json::NumberCursor one(here, ours);
  json::NumberCursor two(there, theirs);
  for (std::size_t i = 0; one.valid() && two.valid(); one.advance(), two.advance(), ++i) {
    const double distance = apart(one.number().value, two.number().value);
    if (distance == 0) continue;
    ++found.differing;
    found.which = i;
    found.most = std::max(found.most, distance);
  }
  return found;
}

}  // namespace gltfx::prove
