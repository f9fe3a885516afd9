// SPDX-License-Identifier: Apache-2.0
// A buffer view and an accessor each contain one kind of data.
#include "rules/core/use.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/finding.hpp"
#include "rules/fix_users.hpp"

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
  const bool reported = strided && kind == model::ViewUse::indices;
  if (reported && !context.deviations.consequences_are_reported) return;
  report_link(
      context, path, place, Code::BUFFER_VIEW_TARGET_MISSING,
      fmt::format("Buffer view {} contains {}, but has no target.", view, model::use_text(kind)),
      fmt::format("add \"target\": {} to buffer view {}",
                  kind == model::ViewUse::vertices ? 34962 : 34963, view));
}

void report_file_use(const Context& context, std::uint32_t view, json::NodeId place,
                     const Path& path) {
  const auto& first = context.views.usage.view(view);
  if (first.kind == model::ViewUse::none || first.kind == model::ViewUse::image) return;
  report_link(context, path, place, Code::BUFFER_VIEW_TARGET_OVERRIDE,
              fmt::format("Buffer view {} contains a file, but {} for {}.", view,
                          first.place == json::kNoNode ? "its target is" : "it is also used",
                          model::use_text(first.kind)));
}

void report_part_of_whole(const Context& context, std::uint32_t accessor, std::uint32_t view,
                          std::string_view whole, const Path& path) {
  const json::NodeId object = context.views.accessors[accessor].node;
  report_link(context, path, context.document.find(object, "bufferView"),
              Code::BUFFER_VIEW_TARGET_OVERRIDE,
              fmt::format("Buffer view {} contains {}, and accessor {} refers to a part of it.",
                          view, whole, accessor));
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

namespace {

// `user` refers to an accessor or a view.
std::optional<std::uint32_t> view_behind(Fixing& fixing, const Subject& user) {
  if (user.name == "bufferView") return fixing.index(model::RootArray::buffer_views, user.value);
  const auto accessor = fixing.index(model::RootArray::accessors, user.value);
  return accessor ? fixing.views().accessors[*accessor].buffer_view : std::nullopt;
}

std::string_view target_of(model::ViewUse use) {
  if (use == model::ViewUse::vertices) return "34962";
  return use == model::ViewUse::indices ? "34963" : "";
}

bool add_target(Fixing& fixing, const Subject& user) {
  const auto view = view_behind(fixing, user);
  const auto use = view ? fixing.views().usage.view(*view).only() : std::nullopt;
  if (!use || target_of(*use).empty()) return false;
  const json::NodeId object = fixing.views().buffer_views[*view].node;
  const json::NodeId invalid = fixing.document().find(object, "target");
  if (!fixing.claim(object)) return false;
  return invalid == json::kNoNode ? fixing.append_member(object, "target", target_of(*use))
                                  : fixing.replace(invalid, target_of(*use));
}

// The target is set by the use: it describes the view's use and changes nothing else. A file alone
// is no use by an accessor or image.
bool correct_target(Fixing& fixing, const Subject& user) {
  const auto view = view_behind(fixing, user);
  if (!view) return false;
  const auto& uses = fixing.views().usage.view(*view);
  const auto use = uses.used() ? uses.only() : std::optional(model::ViewUse::none);
  if (!use) return false;
  const json::NodeId target =
      fixing.document().find(fixing.views().buffer_views[*view].node, "target");
  if (target == json::kNoNode) return false;
  const std::string_view wanted = target_of(*use);
  return wanted.empty() ? fixing.remove_member(target)
                        : fixing.replace_scalar(target, std::string(wanted));
}

constexpr FixEntry kViewUseFixes[] = {{Code::BUFFER_VIEW_TARGET_MISSING, add_target},
                                      {Code::BUFFER_VIEW_TARGET_OVERRIDE, correct_target}};

}  // namespace

const RuleGroup& view_use_rules() {
  static constexpr RuleGroup group{.fixes = kViewUseFixes};
  return group;
}

bool remove_used_stride(Fixing& fixing, const Subject& user) {
  const auto view = view_behind(fixing, user);
  return view && remove_stride(fixing, *view);
}

bool remove_index_stride(Fixing& fixing, const Subject& user) {
  if (!remove_used_stride(fixing, user)) return false;
  add_target(fixing, user);
  return true;
}

}  // namespace gltfx::validate
