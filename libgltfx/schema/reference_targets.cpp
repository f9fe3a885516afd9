// SPDX-License-Identifier: Apache-2.0
#include "schema/reference_targets.hpp"

#include <algorithm>

namespace gltfx::schema {

// All targets are looked up in each asset, which has only a few of them: the contents of a missing
// object are skipped.
ReferenceTargets::ReferenceTargets(const json::Document& document, const Set& set)
    : document_(document), tables_(set.walk_tables()), from_root_(tables_.targets.size(), 0) {
  arrays_.reserve(16);  // most assets have fewer
  arrays_.emplace_back();
  std::vector<json::NodeId> values{document.root()};  // after so many steps; kNoNode is the last
  for (const auto& [target, shared] : tables_.lookups) {
    if (values.back() == json::kNoNode && shared + 1 >= values.size()) continue;
    const TargetPlan& plan = tables_.targets[target];
    const std::vector<std::string>& steps = plan.target.steps;
    values.resize(std::min<std::size_t>(values.size(), shared + 1));
    while (values.back() != json::kNoNode && values.size() <= steps.size() &&
           steps[values.size() - 1] != "*") {
      values.push_back(document.find(values.back(), steps[values.size() - 1]));
    }
    if (values.back() == json::kNoNode) continue;
    if (plan.steps_over) {
      const std::uint64_t size = largest(document.root(), steps);
      if (size == 0) continue;
      Array& array = arrays_.emplace_back();
      array.size = size;
      array.is_array = true;
    } else {
      arrays_.push_back(read(values.back()));
    }
    from_root_[target] = static_cast<std::uint32_t>(arrays_.size() - 1);
  }
}

ReferenceTargets::Array ReferenceTargets::read(json::NodeId node) const {
  Array array;
  array.node = node;
  array.is_array = document_.is_array(node);
  if (!array.is_array) return array;
  if (document_.kind(node) == json::Kind::number_array) {
    array.size = document_.array_size(node);
    array.holes.assign(array.size, true);
  } else {
    const json::NodeId end = document_.next(node);
    for (json::NodeId element = node + 1; element < end; element = document_.next(element)) {
      if (!document_.is_object(element)) {
        array.holes.resize(array.size + 1);
        array.holes[array.size] = true;
      }
      ++array.size;
    }
  }
  array.used.resize(array.size);
  return array;
}

// The value that steps without '*' lead to.
json::NodeId ReferenceTargets::value_at(json::NodeId from,
                                        const std::vector<std::string>& steps) const {
  for (const std::string& step : steps) from = document_.find(from, step);
  return from;
}

// All values that steps lead to; '*' goes to every element.
std::vector<json::NodeId> ReferenceTargets::places(json::NodeId from,
                                                   const std::vector<std::string>& steps) const {
  std::vector<json::NodeId> now{from};
  for (const std::string& step : steps) {
    std::vector<json::NodeId> next;
    for (const json::NodeId place : now) {
      if (step == "*") {
        if (document_.kind(place) != json::Kind::array) continue;
        for (const json::NodeId element : document_.elements(place)) next.push_back(element);
      } else if (const json::NodeId member = document_.find(place, step); member != json::kNoNode) {
        next.push_back(member);
      }
    }
    now = std::move(next);
  }
  return now;
}

// If several arrays may be meant, an index must fit the largest.
std::uint64_t ReferenceTargets::largest(json::NodeId from,
                                        const std::vector<std::string>& steps) const {
  std::uint64_t size = 0;
  for (const json::NodeId place : places(from, steps)) {
    if (document_.is_array(place))
      size = std::max<std::uint64_t>(size, document_.array_size(place));
  }
  return size;
}

ReferenceTargets::Array* ReferenceTargets::below(const Target& target, json::NodeId object,
                                                 const Path& path) {
  const json::NodeId node = value_at(object, target.steps);
  if (node == json::kNoNode) return nullptr;
  const auto [known, is_new] = local_at_.emplace(node, local_.size());
  if (is_new) {
    std::string pointer = path.pointer();
    for (const std::string& step : target.steps) append_pointer_step(pointer, step);
    local_.push_back({read(node), std::move(pointer)});
  }
  return &local_[known->second].array;
}

// Looked up once per element: many references may lead to an element with many members.
bool ReferenceTargets::has_member(Array& array, std::uint64_t index, ShapeId shape,
                                  const std::vector<std::string>& steps) const {
  const auto [known, is_new] = array.having.try_emplace(shape);
  if (is_new) {
    for (json::NodeId place : document_.elements(array.node)) {
      for (const std::string& step : steps) place = document_.find(place, step);
      known->second.push_back(place != json::kNoNode);
    }
  }
  return known->second[index];
}

bool ReferenceTargets::has_name(std::uint32_t target, std::string_view name) {
  const auto [known, is_new] = names_.try_emplace(target);
  if (is_new) {
    for (const json::NodeId place :
         places(document_.root(), tables_.targets[target].target.steps)) {
      if (document_.is_string(place)) known->second.insert(document_.string(place));
      if (!document_.is_object(place)) continue;
      for (const auto member : document_.members(place)) {
        known->second.emplace(document_.key(member.key_id));
      }
    }
  }
  return known->second.count(std::string(name)) != 0;
}

void ReferenceTargets::move_to(CheckResult& result) {
  result.targets.reserve(arrays_.size());
  for (std::size_t i = 0; i < from_root_.size(); ++i) {
    if (from_root_[i] == 0) continue;  // the usual case
    Array& array = from_root(static_cast<std::uint32_t>(i));
    if (!array.is_array || tables_.targets[i].steps_over || array.node == json::kNoNode) continue;
    result.targets.push_back({tables_.targets[i].pointer, array.node, std::move(array.used)});
  }
  for (Local& local : local_) {
    if (!local.array.is_array) continue;
    result.local_targets.push_back(
        {std::move(local.pointer), local.array.node, std::move(local.array.used)});
  }
}

}  // namespace gltfx::schema
