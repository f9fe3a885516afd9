// SPDX-License-Identifier: Apache-2.0
/// What is asked of the elements of accessors, and from where.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "model/accessor.hpp"
#include "model/animation.hpp"
#include "model/object_model.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Where a check comes from, and so where its findings point.
struct Place {
  enum class Kind : std::uint8_t {
    accessor,
    attribute,
    indices,
    times,
    channel,
    matrices,
    instances
  };
  Kind kind = Kind::accessor;
  std::uint32_t outer = 0;            ///< index of the accessor, mesh, animation, skin or node
  std::uint32_t inner = 0;            ///< index of the primitive, sampler or channel
  std::string_view name;              ///< of the attribute; lives in the document
  json::NodeId node = json::kNoNode;  ///< the value to mark
  std::string_view extension = {};    ///< that the attribute of instances belongs to
};

/// Calls `use` with the path of a place.
template <typename Use>
void with_path(const Place& place, Use&& use) {
  static constexpr std::string_view kRoots[] = {"accessors",  "meshes", "meshes", "animations",
                                                "animations", "skins",  "nodes"};
  static constexpr std::string_view kInner[] = {"",         "primitives", "primitives", "samplers",
                                                "channels", "",           "extensions"};
  static constexpr std::string_view kLast[] = {
      "", "", "indices", "input", "sampler", "inverseBindMatrices", ""};
  const auto kind = static_cast<std::size_t>(place.kind);
  const Path root;
  const Path array(root, kRoots[kind]);
  const Path outer(array, std::uint64_t{place.outer});
  if (place.kind == Place::Kind::accessor) return use(outer);
  if (place.kind == Place::Kind::matrices) return use(Path(outer, kLast[kind]));
  const Path members(outer, kInner[kind]);
  if (place.kind == Place::Kind::instances) {
    const Path extension(members, place.extension);
    const Path attributes(extension, "attributes");
    return use(Path(attributes, place.name));
  }
  const Path inner(members, std::uint64_t{place.inner});
  if (place.kind != Place::Kind::attribute) return use(Path(inner, kLast[kind]));
  const Path attributes(inner, "attributes");
  use(Path(attributes, place.name));
}

enum class CheckKind : std::uint8_t {
  finite,
  minimum,
  maximum,
  unit_vector,   ///< VEC3
  unit_tangent,  ///< VEC4: a unit vector and a sign
  clamped,       ///< 0 to 1
  index,
  times,
  quaternion,
  bind_matrix,
  instance_rotation,
  splat_rotation,
  splat_scale,
  splat_opacity,
  limits,  ///< of the property that is animated
};

/// What a number may be.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< not the least itself
  bool below_most = false;   ///< likewise

  bool any() const { return std::isfinite(least) || std::isfinite(most); }
  bool exclude(double value) const {
    return value < least || value > most || (above_least && value == least) ||
           (below_most && value == most);
  }
};

struct Check {
  CheckKind kind = CheckKind::finite;
  bool triangles = false;   ///< index: of a list of triangles
  bool cubic = false;       ///< quaternion, limits: only the middle one of three counts
  std::int64_t most = 0;    ///< index: the last vertex; -1 without any. limits: whose they are
  std::size_t same_as = 0;  ///< the first check of this accessor that asks the same; may be itself
  Place place;
  std::vector<double> bounds;  ///< minimum, maximum: as declared, one a component
  Limits limits;
  std::uint64_t group = 1;    ///< limits: components of one of a cubic spline's three
  double bound_slack = 0;     ///< what declared bounds may differ by, in components as stored
  double bound_widening = 0;  ///< how far declared bounds may lie outside, beyond that
  double length_slack = 0;    ///< what lengths may differ by beyond the usual
};

/// An accessor with its checks, in the order in which they are reported.
struct Schedule {
  std::uint32_t accessor = 0;
  std::vector<Check> checks;
};

/// All checks of an asset, in the order of the Khronos validator: accessors in the order in which
/// they got their first check.
std::vector<Schedule> schedule_checks(const Context& context);

/// The check of a vertex attribute by its whole name; nothing where any finite value may stand.
std::optional<CheckKind> vertex_value_check(std::string_view name);

/// The check of an attribute of instances.
std::optional<CheckKind> instance_value_check(std::string_view name, const model::Format& format);

/// The check of what a channel writes into a property that it names by a pointer: a rotation, or
/// numbers with limits. Nothing for other properties and other channels. `model` is that of the
/// asset; the place is left to the caller.
std::optional<Check> pointer_value_check(const Context& context, model::ObjectModel& model,
                                         const model::AnimationChannel& channel);

/// How far from 1 a unit vector of `components` numbers of that type may be when each of them is
/// off by one step; 0 for floats.
double length_of_steps(model::ComponentType type, unsigned components);

}  // namespace gltfx::validate
