// SPDX-License-Identifier: Apache-2.0
// One buffer view, one accessor: one kind of data.
#include "validate/rules/use.hpp"

#include <fmt/format.h>

#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}, {"buffer": 0, "byteLength": 1, "target": 34963}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})";

constexpr RuleDescription kRules[] = {
    {"ACCESSOR_USAGE_OVERRIDE", Severity::error, "An accessor is used for two kinds of data",
     "Vertex attributes, indices, animation data and skinning matrices have different forms and go "
     "to different places; readers upload an accessor once.",
     "Give each use an accessor of its own.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_PLACE": 1}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 1}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_PLACE": 1}, "indices": 2, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 1}, {"componentType": 5121, "type": "SCALAR", "count": 1}]})",
     Fix::none, true},
    {"BUFFER_VIEW_TARGET_MISSING", Severity::hint,
     "A buffer view with vertices or indices does not say so",
     "With target a reader can upload the view as it is, before it has looked at any mesh.",
     "Add target: 34962 for vertex attributes, 34963 for indices.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}, {"buffer": 0, "byteLength": 1}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     kGood, Fix::safe, true},
    {"BUFFER_VIEW_TARGET_OVERRIDE", Severity::error, "A buffer view is used for two kinds of data",
     "A view becomes one GPU buffer or one file; vertex attributes, indices, images and animation "
     "data cannot share it.",
     "Give each kind of data a view of its own, or correct target.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}, {"buffer": 0, "byteLength": 1, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     kGood, Fix::none, true},
};

}  // namespace

void report_view_use(const Context& context, std::uint32_t view, model::ViewUse kind,
                     json::NodeId place, const Path& path) {
  const auto& first = context.views.usage.view(view);
  if (first.kind != kind) {
    report_link(
        context, path, place, "BUFFER_VIEW_TARGET_OVERRIDE",
        fmt::format("View {} holds {} by its {}; here it is used for {}.", view,
                    model::use_text(first.kind),
                    first.place == json::kNoNode ? "target" : "first use", model::use_text(kind)));
    return;
  }
  const bool wants_target = kind == model::ViewUse::vertices || kind == model::ViewUse::indices;
  if (!wants_target || first.place != place) return;
  // Indices in a view with a stride have another fault, which a target would not mend.
  const bool strided = context.views.buffer_views[view].byte_stride.has_value();
  if (strided && kind == model::ViewUse::indices && !context.khronos()) return;
  report_link(context, path, place, "BUFFER_VIEW_TARGET_MISSING",
              fmt::format("View {} holds {}, but has no target.", view, model::use_text(kind)),
              fmt::format("add \"target\": {} to buffer view {}",
                          kind == model::ViewUse::vertices ? 34962 : 34963, view));
}

void report_use(const Context& context, std::uint32_t accessor, model::AccessorUse kind,
                json::NodeId place, const Path& path) {
  const auto& first = context.views.usage.accessor(accessor);
  if (first.kind != kind) {
    report_link(context, path, place, "ACCESSOR_USAGE_OVERRIDE",
                fmt::format("Accessor {} holds {} by its first use; here it is used for {}.",
                            accessor, model::use_text(first.kind), model::use_text(kind)));
  }
  const auto view = context.views.accessors[accessor].buffer_view;
  if (view) report_view_use(context, *view, model::view_use(kind), place, path);
}

const Family& use_family() {
  static const Family family{"use", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
