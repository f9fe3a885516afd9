// SPDX-License-Identifier: Apache-2.0
#include "model/properties.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/json_pointer.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

// A double beyond the range of float would become an infinity.
float limited(double value, const Limits& limits) {
  const double least = static_cast<double>(limits.least);
  const double most = static_cast<double>(limits.most);
  return static_cast<float>(std::clamp(value, least, most));
}

}  // namespace

bool any_below(const AnimatedValues& values, std::string_view pointer) {
  for (auto at = values.lower_bound(pointer); at != values.end(); ++at) {
    const std::string_view found = at->first;
    if (!found.starts_with(pointer)) return false;
    if (found.size() == pointer.size() || found[pointer.size()] == '/') return true;
  }
  return false;
}

Properties::Properties(const json::Document& document, json::NodeId object,
                       const AnimatedValues* animated, std::string pointer)
    : document_(document), object_(object), animated_(animated), pointer_(std::move(pointer)) {
  if (animated_ != nullptr && !any_below(*animated_, pointer_)) animated_ = nullptr;
}

Properties Properties::object(std::string_view name) const {
  std::string pointer;
  if (animated_ != nullptr) {
    pointer = pointer_;
    append_pointer_step(pointer, name);
  }
  return {document_, object_member(document_, object_, name), animated_, std::move(pointer)};
}

Properties Properties::extension(std::string_view name) const {
  return object("extensions").object(name);
}

const std::vector<float>* Properties::animated(std::string_view name) const {
  if (animated_ == nullptr) return nullptr;
  std::string pointer = pointer_;
  append_pointer_step(pointer, name);
  const auto found = animated_->find(pointer);
  return found == animated_->end() ? nullptr : &found->second;
}

float Properties::number(std::string_view name, float absent, const Limits& limits) const {
  const auto* moved = animated(name);
  if (moved != nullptr && moved->size() == 1 && std::isfinite(moved->front())) {
    return std::clamp(moved->front(), limits.least, limits.most);
  }
  const auto written = number_member(document_, object_, name);
  return written ? limited(*written, limits) : absent;
}

bool Properties::flag(std::string_view name, bool absent) const {
  const auto* moved = animated(name);
  if (moved != nullptr && moved->size() == 1) return moved->front() != 0;
  const json::NodeId value = document_.find(object_, name);
  const bool written = value != json::kNoNode && document_.is_boolean(value);
  return written ? document_.kind(value) == json::Kind::true_value : absent;
}

void Properties::read(std::string_view name, std::span<float> values, const Limits& limits) const {
  const auto* moved = animated(name);
  const auto is_finite = [](float value) { return std::isfinite(value); };
  if (moved != nullptr && moved->size() == values.size() &&
      std::all_of(moved->begin(), moved->end(), is_finite)) {
    std::copy(moved->begin(), moved->end(), values.begin());
  } else {
    std::vector<float> written(values.size());
    const json::NodeId array = document_.find(object_, name);
    if (!read_floats(document_, array, written.size(), written.data())) return;
    std::copy(written.begin(), written.end(), values.begin());
  }
  for (float& value : values) value = std::clamp(value, limits.least, limits.most);
}

}  // namespace gltfx::model
