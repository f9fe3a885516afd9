// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "model/accessor_data.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/core/fix_elements.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

using model::Accessor;
using model::AccessorData;

/// Least and greatest value of each component.
struct Bounds {
  std::vector<double> least, most;
};

template <class T>
std::optional<Bounds> bounds_of(const AccessorData& data) {
  const unsigned components = data.components();
  Bounds bounds{std::vector<double>(components, std::numeric_limits<double>::infinity()),
                std::vector<double>(components, -std::numeric_limits<double>::infinity())};
  bool finite = true;
  data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
    for (std::size_t i = 0; i < elements * components; ++i) {
      const auto value = static_cast<double>(values[i]);
      finite = finite && std::isfinite(value);
      double& least = bounds.least[i % components];
      double& most = bounds.most[i % components];
      least = std::min(least, value);
      most = std::max(most, value);
    }
  });
  return finite ? std::optional(std::move(bounds)) : std::nullopt;
}

// Elements without bytes are zeros, unless the geometry is compressed.
bool is_plain(Fixing& fixing, const Accessor& accessor) {
  if (accessor.buffer_view || accessor.sparse != json::kNoNode) return true;
  for (const model::Mesh& mesh : fixing.views().meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      if (fixing.document().find(primitive.node, "extensions") != json::kNoNode) return false;
    }
  }
  return true;
}

std::optional<Bounds> read_bounds(Fixing& fixing, const Accessor& accessor) {
  if (!model::is_core_component(accessor.format.component) || !is_plain(fixing, accessor)) {
    return std::nullopt;
  }
  if (!accessor.buffer_view && accessor.sparse == json::kNoNode) {
    if (!accessor.count) return std::nullopt;
    const std::vector<double> zeros(model::component_count(accessor.format.type));
    return Bounds{zeros, zeros};
  }
  const auto data = AccessorData::open(fixing.elements(), fixing.views(), fixing.resources(),
                                       accessor, model::Malformed::unusable);
  if (!data || !fixing.table<ReadBudget>().take(data->count(), data->components())) {
    return std::nullopt;
  }
  return model::with_component_type(accessor.format.component,
                                    [&](auto type) { return bounds_of<decltype(type)>(*data); });
}

std::string list_of(const Accessor& accessor, const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) {
    if (text.size() > 1) text += ", ";
    text += bound_text(accessor.format.component, value);
  }
  return text + "]";
}

bool write_bounds(Fixing& fixing, const Accessor& accessor) {
  // Many primitives may share the accessor.
  if (fixing.is_claimed(accessor.node)) return false;
  const auto bounds = read_bounds(fixing, accessor);
  if (!bounds || !fixing.claim(accessor.node)) return false;
  const auto write = [&](std::string_view member, const std::vector<double>& values) {
    const json::NodeId old = fixing.document().find(accessor.node, member);
    const std::string text = list_of(accessor, values);
    return old == json::kNoNode ? fixing.append_member(accessor.node, member, text)
                                : fixing.replace(old, text);
  };
  const bool least = write("min", bounds->least);
  return write("max", bounds->most) && least;
}

}  // namespace

std::string bound_text(model::ComponentType type, double value) {
  if (model::is_integer(type)) return fmt::format("{}", static_cast<std::int64_t>(value));
  return fmt::format("{}", static_cast<float>(value) + 0.0F);  // no -0
}

bool add_bounds(Fixing& fixing, const Subject& user) {
  const auto accessor = fixing.index(model::RootArray::accessors, user.value);
  return accessor && write_bounds(fixing, fixing.views().accessors[*accessor]);
}

bool write_bound(Fixing& fixing, json::NodeId value) {
  const json::Document& document = fixing.document();
  json::NodeId object = fixing.parent(value);
  for (; object != json::kNoNode && document.is_array(object); object = fixing.parent(object)) {
    value = object;
  }
  const auto index = fixing.index(model::RootArray::accessors, object);
  if (!index) return false;
  const bool minimum = document.find(object, "min") == value;
  if (!minimum && document.find(object, "max") != value) return false;
  const Accessor& accessor = fixing.views().accessors[*index];
  if (model::is_sound_bound(document, accessor.format, value)) return false;
  if (fixing.is_claimed(value)) return true;
  const auto bounds = read_bounds(fixing, accessor);
  return bounds && fixing.replace(value, list_of(accessor, minimum ? bounds->least : bounds->most));
}

bool correct_bounds(Fixing& fixing, const Subject& bound) {
  const json::NodeId array = bound.node();
  if (fixing.document().kind(array) != json::Kind::number_array) return false;
  const auto index = fixing.index(model::RootArray::accessors, fixing.parent(array));
  if (!index) return false;
  const Accessor& accessor = fixing.views().accessors[*index];
  const bool minimum = accessor.min == array;
  if (!minimum && accessor.max != array) return false;
  // For the finding on another number of the same array or of the other array.
  if (!model::is_sound_bound(fixing.document(), accessor.format, array)) return false;
  const auto bounds = read_bounds(fixing, accessor);
  if (!bounds) return false;
  if (fixing.claim(array)) {
    correct_numbers(fixing, accessor.format.component, array,
                    minimum ? bounds->least : bounds->most);
  }
  return true;
}

void correct_numbers(Fixing& fixing, model::ComponentType type, json::NodeId array,
                     const std::vector<double>& wanted) {
  std::size_t i = 0;
  for (json::NumberCursor at(fixing.document(), array); at.valid(); at.advance(), ++i) {
    const double declared = at.number().value;
    const bool same = model::is_integer(type)
                          ? declared == wanted[i]
                          : static_cast<float>(declared) == static_cast<float>(wanted[i]);
    if (!same) fixing.replace_text(at.number().span, bound_text(type, wanted[i]));
  }
}

}  // namespace gltfx::validate
