// SPDX-License-Identifier: Apache-2.0
// Cameras: the members that a projection needs (specification section 3.10).
#include <numbers>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

// A number that the schema walk accepts; one outside its range is reported there.
std::optional<double> positive(const Context& context, json::NodeId object, std::string_view name,
                               bool or_zero = false) {
  const auto value = model::number_member(context.document, object, name);
  return value && (*value > 0 || (or_zero && *value == 0)) ? value : std::nullopt;
}

void check_planes(const Context& context, json::NodeId object, const Path& path,
                  bool near_may_be_zero) {
  const auto far_plane = positive(context, object, "zfar");
  const auto near_plane = positive(context, object, "znear", near_may_be_zero);
  if (!far_plane || !near_plane || *far_plane > *near_plane) return;
  context.schema_sink.report(
      path,
      finding_on(context, context.document.find(object, "zfar"), Code::CAMERA_ZFAR_LEQUAL_ZNEAR,
                 fmt::format("zfar is {}; it must be greater than znear, {}.",
                             number_text(*far_plane), number_text(*near_plane))));
}

void check_magnification(const Context& context, json::NodeId object, const Path& path,
                         std::string_view name, bool zero) {
  const auto value = model::number_member(context.document, object, name);
  if (!value || (zero ? *value != 0 : *value >= 0)) return;
  report_member(context.schema_sink, context, path, object, name,
                zero ? Code::CAMERA_XMAG_YMAG_ZERO : Code::CAMERA_XMAG_YMAG_NEGATIVE,
                zero ? fmt::format("{} is 0; it must not be 0.", name)
                     : fmt::format("{} is {}; it should be positive.", name, number_text(*value)));
}

void check_orthographic(const Context& context, json::NodeId object, const Path& path) {
  check_planes(context, object, path, true);
  for (const bool zero : {true, false}) {
    check_magnification(context, object, path, "xmag", zero);
    check_magnification(context, object, path, "ymag", zero);
  }
}

void check_angle(const Context& context, json::NodeId object, const Path& path) {
  const auto angle = positive(context, object, "yfov");
  if (angle && *angle >= std::numbers::pi) {
    const bool degrees = *angle > 6.3 && *angle < 180;
    context.schema_sink.report(
        path,
        finding_on(context, context.document.find(object, "yfov"), Code::CAMERA_YFOV_GEQUAL_PI,
                   fmt::format("yfov is {} radians; it must be less than pi.", number_text(*angle)),
                   degrees ? fmt::format("for {} degrees, write {:.6g}", number_text(*angle),
                                         *angle * std::numbers::pi / 180)
                           : std::string()));
  }
}

void check_near_and_far(const Context& context, json::NodeId object, const Path& path) {
  check_planes(context, object, path, false);
}

void check_camera(const Context& context, json::NodeId camera, const Path& path) {
  // Only the projection named by `type` applies.
  const std::string type = model::string_member(context.document, camera, "type");
  const json::NodeId projection = model::object_member(context.document, camera, type);
  if (projection == json::kNoNode) return;
  if (type == "orthographic") check_orthographic(context, projection, Path(path, type));
  if (type == "perspective") {
    check_angle(context, projection, Path(path, type));
    check_near_and_far(context, projection, Path(path, type));
  }
}

// --- In reading order ---

schema::Reading read_projection(const Context& context, json::NodeId camera,
                                std::string_view name) {
  const bool named = model::string_member(context.document, camera, "type") == name;
  return named ? schema::Reading::check : schema::Reading::drop;
}
schema::Reading read_orthographic(const Context& context, json::NodeId camera, json::NodeId,
                                  const Path&) {
  return read_projection(context, camera, "orthographic");
}
schema::Reading read_perspective(const Context& context, json::NodeId camera, json::NodeId,
                                 const Path&) {
  return read_projection(context, camera, "perspective");
}

// null has the wrong type and also counts as missing.
void check_given(const Context& context, json::NodeId camera, const Path& path,
                 std::string_view name) {
  if (model::string_member(context.document, camera, "type") != name) return;
  const json::NodeId value = context.document.find_in_text(camera, name);
  if (value == json::kNoNode || context.document.kind(value) != json::Kind::null) return;
  context.schema_sink.report(path, finding_on(context, camera, Code::UNDEFINED_PROPERTY,
                                              fmt::format("The camera has no {}.", name)));
}
void check_orthographic_given(const Context& context, json::NodeId camera, const Path& path) {
  check_given(context, camera, path, "orthographic");
}
void check_perspective_given(const Context& context, json::NodeId camera, const Path& path) {
  check_given(context, camera, path, "perspective");
}

}  // namespace

const RuleGroup& camera_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"camera", check_camera, {}, Runs::otherwise},
      {"camera", check_orthographic_given, "orthographic", Runs::in_reading_order},
      {"camera", check_perspective_given, "perspective", Runs::in_reading_order},
      {"camera.orthographic", check_orthographic, "znear", Runs::in_reading_order},
      {"camera.perspective", check_angle, "yfov", Runs::in_reading_order},
      {"camera.perspective", check_near_and_far, "znear", Runs::in_reading_order}};
  static constexpr MemberRuleEntry kMemberRules[] = {{"camera", "orthographic", read_orthographic},
                                                     {"camera", "perspective", read_perspective}};
  static constexpr RuleGroup group{.object_rules = kObjectRules, .member_rules = kMemberRules};
  return group;
}

}  // namespace gltfx::validate
