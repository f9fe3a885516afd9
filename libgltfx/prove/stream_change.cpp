// SPDX-License-Identifier: Apache-2.0
#include "prove/stream_change.hpp"

#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;

struct StreamBound {
  std::string_view kind, quantity, unit;
  double bound = 0;
};

StreamBound bound_of(const SoupStream& stream, const CompareBounds& bounds) {
  const auto kind = [&](std::string_view of_vertices) {
    return stream.of_target ? std::string_view("geometry.morph") : of_vertices;
  };
  switch (stream.kind) {
    case SemanticKind::position:
      return {kind("geometry.position"), "position", "%", 100 * bounds.position};
    case SemanticKind::normal:
    case SemanticKind::tangent:
      return {kind("geometry.normal"), "normal", "deg", bounds.normal};
    case SemanticKind::texcoord:
      return {kind("geometry.texcoord"), "texcoord", "texel", bounds.texcoord};
    case SemanticKind::color:
      return {kind("geometry.color"), "color", "", bounds.color};
    case SemanticKind::joints:
    case SemanticKind::weights:
      return {"geometry.weight", "weight", "%", 100 * bounds.weight};
    default:
      return {kind("geometry.custom"), "value", "", 0};
  }
}

std::string_view unit_text(std::string_view quantity) {
  if (quantity == "normal") return " deg";
  return quantity == "texcoord" ? " texels" : "";
}

}  // namespace

std::string counted_elements(std::uint64_t count, unsigned arity) {
  constexpr std::string_view kNouns[] = {"point", "line", "triangle"};
  return fmt::format("{} {}{}", count, kNouns[arity - 1], count == 1 ? "" : "s");
}

double limit_of(const Comparison& all, const SoupStream& stream, double scale) {
  const StreamBound bound = bound_of(stream, all.options.bounds);
  if (bound.quantity == "weight") return bound.bound / 100;
  if (bound.quantity != "position") return bound.bound;
  return scale > 0 ? bound.bound / 100 * all.diagonal / scale : 0;
}

Change describe_stream(const Comparison& all, const StreamDistance& distance, unsigned arity,
                       double scale) {
  const SoupStream& stream = *distance.stream;
  const StreamBound bound = bound_of(stream, all.options.bounds);
  double value = distance.greatest;
  if (bound.quantity == "position") {
    value = all.diagonal > 0 ? 100 * value * scale / all.diagonal
                             : std::numeric_limits<double>::infinity();
  } else if (bound.quantity == "weight") {
    value *= 100;
  }
  Change change;
  change.kind = bound.kind;
  if (distance.mirrored) {
    change.what = fmt::format("v of {} is mirrored", printable(stream.name));
  } else {
    change.what = fmt::format("{} of {} {} by at most {:.4g}{}", printable(stream.name),
                              counted_elements(distance.elements, arity),
                              distance.elements == 1 ? "differs" : "differ", distance.greatest,
                              unit_text(bound.quantity));
  }
  change.measure = CompareMeasure{bound.quantity, value, bound.unit, bound.bound};
  change.level = value <= bound.bound ? CompareLevel::bounds : CompareLevel::differs;
  return change;
}

}  // namespace gltfx::prove
