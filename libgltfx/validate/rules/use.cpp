// SPDX-License-Identifier: Apache-2.0
// One buffer view, one accessor: one kind of data.
#include "validate/rules/use.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {

std::string_view unseen_user(const Context& context) {
  if (context.deviations.unsupported_extensions_are_skipped) return {};
  for (const std::string& name : context.checked.extensions_seen) {
    if (context.schemas.find_extension(name) == schema::kNone) return name;
  }
  return {};
}

void report_view_use(const Context& context, std::uint32_t view, model::ViewUse kind,
                     json::NodeId place, const Path& path) {
  const auto& first = context.views.usage.view(view);
  if (first.kind != kind) {
    report_link(
        context, path, place, Code::BUFFER_VIEW_TARGET_OVERRIDE,
        fmt::format("Buffer view {} is used for {}, but {} for {}.", view, model::use_text(kind),
                    first.place == json::kNoNode ? "its target is" : "its first use is",
                    model::use_text(first.kind)));
    return;
  }
  const bool wants_target = kind == model::ViewUse::vertices || kind == model::ViewUse::indices;
  if (!wants_target || first.place != place) return;
  // Indices in a view with a stride have another error, which a target would not fix.
  const bool strided = context.views.buffer_views[view].byte_stride.has_value();
  const bool told = strided && kind == model::ViewUse::indices;
  if (told && !context.deviations.consequences_are_reported) return;
  report_link(
      context, path, place, Code::BUFFER_VIEW_TARGET_MISSING,
      fmt::format("Buffer view {} contains {}, but has no target.", view, model::use_text(kind)),
      fmt::format("add \"target\": {} to buffer view {}",
                  kind == model::ViewUse::vertices ? 34962 : 34963, view));
}

void report_use(const Context& context, std::uint32_t accessor, model::AccessorUse kind,
                json::NodeId place, const Path& path) {
  const auto& first = context.views.usage.accessor(accessor);
  if (first.kind != kind) {
    report_link(context, path, place, Code::ACCESSOR_USAGE_OVERRIDE,
                fmt::format("Accessor {} is used for {}, but its first use is for {}.", accessor,
                            model::use_text(kind), model::use_text(first.kind)));
  }
  const auto view = context.views.accessors[accessor].buffer_view;
  if (view) report_view_use(context, *view, model::view_use(kind), place, path);
}

}  // namespace gltfx::validate
