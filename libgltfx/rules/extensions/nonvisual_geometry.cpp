// SPDX-License-Identifier: Apache-2.0
// Extensions on primitives that depend on the primitive itself (MAXAR_nonvisual_geometry,
// NGA_gpm_local), and a matrix whose size is given by the length of its list.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::Mode;

struct ShapeModes {
  std::string_view shape;
  Mode modes[3];
  std::string_view text;
};
constexpr ShapeModes kShapeModes[] = {
    {"points", {Mode::points, Mode::points, Mode::points}, "POINTS"},
    {"path", {Mode::lines, Mode::line_loop, Mode::line_strip}, "LINES, LINE_LOOP or LINE_STRIP"},
    {"surface",
     {Mode::triangles, Mode::triangle_strip, Mode::triangle_fan},
     "TRIANGLES, TRIANGLE_STRIP or TRIANGLE_FAN"},
    {"volume",
     {Mode::triangles, Mode::triangle_strip, Mode::triangles},
     "TRIANGLES or TRIANGLE_STRIP"},
};

void report_mode(const Context& context, const ExtensionPlace& place, const Path& path,
                 std::string message) {
  report_member(context.link_sink, context, path, place.object, "shape",
                Code::NONVISUAL_GEOMETRY_MODE, std::move(message));
}

void check_shape_mode(const Context& context, const ExtensionPlace& place, const Path& path) {
  const std::string shape = model::string_member(context.document, place.object, "shape");
  const model::Primitive primitive = model::read_primitive(context.asset, place.host);
  if (!primitive.mode) return;
  for (const ShapeModes& allowed : kShapeModes) {
    if (allowed.shape != shape) continue;
    for (const Mode mode : allowed.modes) {
      if (mode == *primitive.mode) return;
    }
    report_mode(context, place, path,
                fmt::format("The shape is {}, but the mode is {}; it must be {}.", shape,
                            model::mode_name(*primitive.mode), allowed.text));
  }
}

// Separate lines are a path only if there is just one.
void check_path(const Context& context, const ExtensionPlace& place, const Path& path) {
  if (model::string_member(context.document, place.object, "shape") != "path") return;
  const model::Primitive primitive = model::read_primitive(context.asset, place.host);
  if (primitive.mode != Mode::lines) return;
  const model::Attribute* position = primitive.find(model::SemanticKind::position);
  const auto accessor = primitive.indices ? primitive.indices
                        : position        ? position->accessor
                                          : std::nullopt;
  const auto count = accessor ? context.views.accessors[*accessor].count : std::nullopt;
  if (!count || *count == 2) return;
  report_mode(context, place, path,
              fmt::format("The path has {} vertices in the mode LINES; it must have 2.", *count));
}

constexpr std::string_view kNonvisual = "MAXAR_nonvisual_geometry";

// The mesh that a node names must state the kind of its geometry.
void check_nonvisual_mesh(const Context& context, const ExtensionPlace& place, const Path& path) {
  const auto mesh = context.asset.index(place.object, "mesh", model::RootArray::meshes);
  if (!mesh) return;
  const auto& primitives = context.views.meshes[*mesh].primitives;
  const auto lacks =
      std::find_if(primitives.begin(), primitives.end(), [&](const model::Primitive& primitive) {
        return model::extension_object(context.document, primitive.node, kNonvisual) ==
               json::kNoNode;
      });
  if (lacks == primitives.end()) return;
  report_member(context.link_sink, context, path, place.object, "mesh",
                Code::NONVISUAL_GEOMETRY_UNTOLD,
                fmt::format("Primitive {} of {} does not have {}.", lacks - primitives.begin(),
                            object_label(context, model::RootArray::meshes, *mesh), kNonvisual));
}

void check_nonvisual(const Context& context) {
  for_each_extension(context, model::RootArray::nodes, kNonvisual,
                     [&](const ExtensionPlace& place, const Path& path) {
                       check_nonvisual_mesh(context, place, path);
                     });
  for_each_primitive_extension(context, kNonvisual,
                               [&](const ExtensionPlace& place, const Path& path) {
                                 check_shape_mode(context, place, path);
                                 check_path(context, place, path);
                               });
}

constexpr std::string_view kErrorModel = "NGA_gpm_local";

void check_error_textures(const Context& context) {
  for_each_primitive_extension(
      context, kErrorModel, [&](const ExtensionPlace& place, const Path& path) {
        const model::Primitive primitive = model::read_primitive(context.asset, place.host);
        const auto textures = object_list(context.document, place.object, "ppeTextures");
        const Path list(path, "ppeTextures");
        for (std::size_t i = 0; i < textures.size(); ++i) {
          if (textures[i] == json::kNoNode) continue;
          const std::uint64_t set =
              model::unsigned_member(context.document, textures[i], "texCoord").value_or(0);
          if (primitive.find(model::SemanticKind::texcoord, set) != nullptr) continue;
          report_member(context.link_sink, context, Path(list, i), textures[i], "texCoord",
                        Code::GPM_TEXCOORD_MISSING,
                        fmt::format("The primitive does not have TEXCOORD_{}.", set));
        }
      });
}

void check_covariance(const Context& context) {
  constexpr std::string_view kMember = "covarianceDirectUpperTriangle";
  const json::NodeId object = root_extension(context, kErrorModel);
  const json::NodeId list = context.document.find(object, kMember);
  if (list == json::kNoNode || !context.document.is_array(list)) return;
  const std::uint64_t size = context.document.array_size(list);
  const auto rows =
      static_cast<std::uint64_t>((std::sqrt(8 * static_cast<double>(size) + 1) - 1) / 2);
  if (size == 0 || rows * (rows + 1) / 2 == size) return;
  report_at(context.link_sink, fmt::format("/extensions/{}/{}", kErrorModel, kMember),
            finding_on(context, list, Code::GPM_TRIANGLE_LENGTH,
                       fmt::format("The upper triangle has {} values; it must have {} or {}.", size,
                                   rows * (rows + 1) / 2, (rows + 1) * (rows + 2) / 2)));
}

}  // namespace

const RuleGroup& nonvisual_geometry_rules() {
  static constexpr LinkRule kLinkRules[] = {check_nonvisual, check_error_textures,
                                            check_covariance};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
