// SPDX-License-Identifier: Apache-2.0
#include "rules/core/fix_data.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/accessor_data.hpp"
#include "rules/core/fix_elements.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

/// Floats that may be changed.
struct Floats {
  std::uint32_t accessor;
  Elements elements;
};

std::optional<Floats> open_floats(Fixing& fixing, std::optional<std::uint32_t> accessor,
                                  std::string_view role) {
  if (!accessor || role.empty()) return std::nullopt;
  auto elements = open_elements(fixing, *accessor, role);
  if (!elements || !elements->is_float()) return std::nullopt;
  return Floats{*accessor, *std::move(elements)};
}

// `member` refers to an accessor.
std::optional<Floats> open_floats(Fixing& fixing, const Subject& member) {
  return open_floats(fixing, fixing.index(RootArray::accessors, member.value), member.name);
}

/// Changes of a list of numbers, applied only if all of them are possible.
class Changes {
 public:
  void set(std::uint64_t element, unsigned component, double value) {
    changes_.push_back({element, component, value});
  }
  bool make(Fixing& fixing, std::uint32_t accessor, Elements& elements) const {
    if (changes_.empty()) return false;
    for (const Change& change : changes_) {
      elements.set(change.element, change.component, change.value);
    }
    follow_with_bounds(fixing, accessor, elements);
    return true;
  }
  bool make(Fixing& fixing, Floats& floats) const {
    return make(fixing, floats.accessor, floats.elements);
  }

 private:
  struct Change {
    std::uint64_t element;
    unsigned component;
    double value;
  };
  std::vector<Change> changes_;
};

double length_of(const Elements& elements, std::uint64_t element, unsigned components) {
  double square = 0;
  for (unsigned c = 0; c < components; ++c) {
    const double value = elements.get(element, c);
    square += value * value;
  }
  return std::sqrt(square);
}

// Maximum deviation of lengths that are left unchanged: the error of single precision.
constexpr double kUnit = 1e-4;

// Changes vectors of the first `components` numbers to unit length, for elements that `counts`
// accepts.
template <class Counts>
bool make_unit(Fixing& fixing, Floats& floats, unsigned components, const Counts& counts) {
  const Elements& elements = floats.elements;
  Changes changes;
  for (std::uint64_t i = 0; i < elements.count(); ++i) {
    if (!counts(i)) continue;
    const double length = length_of(elements, i, components);
    if (!(std::abs(length - 1) > kUnit)) {
      if (std::isnan(length)) return false;
      continue;
    }
    if (!std::isfinite(length) || length < 1e-6) return false;  // no direction
    for (unsigned c = 0; c < components; ++c) changes.set(i, c, elements.get(i, c) / length);
  }
  return changes.make(fixing, floats);
}

bool all_count(std::uint64_t) { return true; }

}  // namespace

bool make_unit_vectors(Fixing& fixing, const Subject& subject) {
  auto floats = open_floats(fixing, subject);
  return floats && floats->elements.components() >= 3 && make_unit(fixing, *floats, 3, all_count);
}

bool make_signs(Fixing& fixing, const Subject& subject) {
  auto floats = open_floats(fixing, subject);
  if (!floats || floats->elements.components() != 4) return false;
  Changes changes;
  for (std::uint64_t i = 0; i < floats->elements.count(); ++i) {
    const double sign = floats->elements.get(i, 3);
    if (sign == 0 || !std::isfinite(sign)) return false;
    if (std::abs(sign) != 1) changes.set(i, 3, sign < 0 ? -1 : 1);
  }
  return changes.make(fixing, *floats);
}

bool make_unit_rotations(Fixing& fixing, const Subject& subject) {
  auto floats = open_floats(fixing, subject);
  return floats && floats->elements.components() == 4 && make_unit(fixing, *floats, 4, all_count);
}

bool make_unit_keyframes(Fixing& fixing, const Subject& subject) {
  const json::NodeId list = fixing.parent(subject.owner);
  const auto index = fixing.index(RootArray::animations, fixing.parent(list));
  if (!index) return false;
  const model::Animation& animation = fixing.views().animations[*index];
  const std::uint32_t position = fixing.tree().position(subject.owner);
  if (position >= animation.channels.size() || !animation.channels[position].sampler) return false;
  const model::AnimationSampler& sampler =
      animation.samplers[*animation.channels[position].sampler];
  auto floats = open_floats(fixing, sampler.output, "output");
  if (!floats || floats->elements.components() != 4) return false;
  const bool cubic = sampler.interpolation == model::Interpolation::cubic_spline;
  return make_unit(fixing, *floats, 4, [cubic](std::uint64_t i) { return !cubic || i % 3 == 1; });
}

bool clamp(Fixing& fixing, const Subject& subject) {
  constexpr double kNearly = 1.0 / 512;
  auto floats = open_floats(fixing, subject);
  if (!floats) return false;
  Changes changes;
  for (std::uint64_t i = 0; i < floats->elements.count(); ++i) {
    for (unsigned c = 0; c < floats->elements.components(); ++c) {
      const double value = floats->elements.get(i, c);
      if (!(value >= -kNearly && value <= 1 + kNearly)) return false;
      if (value < 0 || value > 1) changes.set(i, c, std::clamp(value, 0.0, 1.0));
    }
  }
  return changes.make(fixing, *floats);
}

bool normalize_weights(Fixing& fixing, const Subject& subject) {
  constexpr double kNearly = 0.05;
  // The sum includes all sets of a vertex.
  if (subject.name != "WEIGHTS_0" || fixing.document().holds(subject.owner, "WEIGHTS_1")) {
    return false;
  }
  auto floats = open_floats(fixing, subject);
  if (!floats || floats->elements.components() != 4) return false;
  Changes changes;
  for (std::uint64_t i = 0; i < floats->elements.count(); ++i) {
    double sum = 0;
    for (unsigned c = 0; c < 4; ++c) {
      if (!(floats->elements.get(i, c) >= 0)) return false;
      sum += floats->elements.get(i, c);
    }
    if (!(std::abs(sum - 1) <= kNearly)) return false;
    if (std::abs(sum - 1) <= 1e-7) continue;
    for (unsigned c = 0; c < 4; ++c) changes.set(i, c, floats->elements.get(i, c) / sum);
  }
  return changes.make(fixing, *floats);
}

namespace {

std::optional<std::uint32_t> find_attribute(const model::Primitive& primitive,
                                            std::string_view name) {
  for (const model::Attribute& attribute : primitive.attributes) {
    if (attribute.name == name) return attribute.accessor;
  }
  return std::nullopt;
}

}  // namespace

bool clear_unweighted_joints(Fixing& fixing, const Subject& subject) {
  const auto accessor = fixing.index(RootArray::accessors, subject.value);
  if (!accessor || !subject.name.starts_with("JOINTS_")) return false;
  // Many primitives may share the accessor.
  if (fixing.is_claimed(fixing.views().accessors[*accessor].node)) return false;
  const std::string weights_name = "WEIGHTS_" + std::string(subject.name.substr(7));
  // A joint may have a weight in another primitive.
  std::optional<std::uint32_t> weights;
  for (const model::Primitive* primitive : primitives_with(fixing, *accessor)) {
    if (find_attribute(*primitive, subject.name) != accessor) continue;
    const auto own = find_attribute(*primitive, weights_name);
    if (!own || (weights && weights != own)) return false;
    weights = own;
  }
  if (!weights) return false;
  const auto data =
      model::AccessorData::open(fixing.elements(), fixing.views(), fixing.resources(),
                                fixing.views().accessors[*weights], model::Malformed::unusable);
  auto elements = open_elements(fixing, *accessor, subject.name);
  if (!data || !elements || elements->is_float() || elements->components() != 4 ||
      data->components() != 4 || data->count() != elements->count()) {
    return false;
  }
  Changes changes;
  model::with_component_type(data->format().component, [&](auto type) {
    data->visit<decltype(type)>([&](const auto* values, std::size_t count, std::uint64_t first) {
      for (std::size_t i = 0; i < count * 4; ++i) {
        const auto slot = static_cast<unsigned>(i % 4);
        const std::uint64_t vertex = first + i / 4;
        if (values[i] == 0 && elements->get(vertex, slot) != 0) changes.set(vertex, slot, 0);
      }
    });
  });
  return changes.make(fixing, *accessor, *elements);
}

}  // namespace gltfx::validate
