// SPDX-License-Identifier: Apache-2.0
/// The checks of the elements of accessors, and their places.
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

/// The place of a check, which its findings point to.
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
  std::string_view name;              ///< name of the attribute; lives in the document
  json::NodeId node = json::kNoNode;  ///< the value to mark
  std::string_view extension = {};    ///< extension of the attribute of instances
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
  limits,  ///< limits of the animated property
};

/// The allowed range of a number.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< the least is excluded
  bool below_most = false;   ///< the most is excluded

  bool any() const { return std::isfinite(least) || std::isfinite(most); }
  bool exclude(double value) const {
    return value < least || value > most || (above_least && value == least) ||
           (below_most && value == most);
  }
};

struct Check {
  CheckKind kind = CheckKind::finite;
  bool triangles = false;  ///< index: of a list of triangles
  bool cubic = false;      ///< quaternion, limits: only the middle one of three counts
  /// index: the last vertex, -1 if there is none. limits: id of their shape.
  std::int64_t most = 0;
  std::size_t same_as = 0;  ///< the first equal check of this accessor; may be itself
  Place place;
  std::vector<double> bounds;  ///< minimum, maximum: as declared, one per component
  Limits limits;
  std::uint64_t group = 1;    ///< limits: components of one of the three vectors of a cubic spline
  double bound_slack = 0;     ///< allowed difference of declared bounds, in components as stored
  double bound_widening = 0;  ///< further distance by which declared bounds may be outside
  double length_slack = 0;    ///< additional allowed difference of lengths
};

/// An accessor with its checks, in the order in which they are reported.
struct Schedule {
  std::uint32_t accessor = 0;
  std::vector<Check> checks;
};

/// All checks of an asset, in the order of the Khronos validator: accessors in the order of their
/// first checks.
std::vector<Schedule> schedule_checks(const Context& context);

/// The check of a vertex attribute by its whole name; nothing if any finite value is allowed.
std::optional<CheckKind> vertex_value_check(std::string_view name);

/// The check of an attribute of instances.
std::optional<CheckKind> instance_value_check(std::string_view name, const model::Format& format);

/// The check of the values that a channel writes into a property given by a pointer: a rotation, or
/// numbers with limits. Nothing for other properties and other channels. `model` is the object
/// model of the asset; the caller sets the place.
std::optional<Check> pointer_value_check(const Context& context, model::ObjectModel& model,
                                         const model::AnimationChannel& channel);

/// The maximum distance from 1 of the length of a unit vector of `components` numbers of that type
/// if each is off by one step; 0 for floats.
double length_of_steps(model::ComponentType type, unsigned components);

}  // namespace gltfx::validate
