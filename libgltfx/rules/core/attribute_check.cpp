// SPDX-License-Identifier: Apache-2.0
// One vertex attribute: its use, bounds, format and alignment.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/core/mesh_state.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

void report(const MeshState& state, const AttributeUse& use, const Path& path, Code code,
            std::string message, std::string help = {}) {
  report_link(state.context, path, use.attribute.value, code, std::move(message), std::move(help));
}

// The Khronos validator ignores bounds with an error, which is reported already.
bool has_bounds(const Context& context, const model::Accessor& accessor) {
  const json::Document& document = context.document;
  return document.find(accessor.node, "min") != json::kNoNode &&
         document.find(accessor.node, "max") != json::kNoNode;
}

void check_bounds(const MeshState& state, const AttributeUse& use, const Path& path) {
  if (use.attribute.semantic.kind != model::SemanticKind::position) return;
  if (has_bounds(state.context, use.accessor)) return;
  report(
      state, use, path, Code::MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS,
      fmt::format("Accessor {} has positions, but not both min and max.", *use.attribute.accessor));
}

std::string format_help(const MeshState& state, const AttributeUse& use) {
  const std::string_view extension =
      extension_that_allows(state.context.schemas, use.attribute, use.target, use.accessor.format);
  if (extension.empty()) return {};
  return fmt::format("add {} to extensionsUsed and extensionsRequired: it allows this format",
                     extension);
}

// True if the format is allowed for the attribute, or there is no rule for it.
bool check_format(const MeshState& state, const AttributeUse& use, const Path& path) {
  const model::Format format = use.accessor.format;
  const bool checked = format.known() && model::is_core_component(format.component);
  const FormatList* allowed = state.formats.find(use.attribute, use.target);
  if (allowed == nullptr) {
    if (use.target || format.component != model::ComponentType::uint32) return true;
    report(state, use, path, Code::MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT,
           fmt::format("{} is {}; attributes cannot have 32-bit integers.",
                       quoted(use.attribute.name), model::format_text(format)));
    return false;
  }
  if (format.known() && allows(*allowed, format)) return true;
  // An unknown type is an error of the accessor, not of its use.
  if (!checked && !state.context.deviations.unknown_formats_are_checked) return true;
  report(state, use, path, Code::MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT,
         fmt::format("{} is {}; it must be {}.", quoted(use.attribute.name),
                     model::format_text(format), formats_text(*allowed)),
         format_help(state, use));
  return false;
}

// Whether another rule has already reported the offset.
bool offset_is_reported(const model::Accessor& accessor) {
  const unsigned component = model::component_size(accessor.format.component);
  if (component != 0 && *accessor.byte_offset % component != 0) return true;
  return model::is_matrix(accessor.format.type);
}

bool is_misaligned(const MeshState& state, const model::Accessor& accessor, bool good_format) {
  const bool consequences = state.context.deviations.consequences_are_reported;
  const bool by_offset = accessor.byte_offset && *accessor.byte_offset % 4 != 0;
  if (by_offset && (consequences || !offset_is_reported(accessor))) return true;
  const model::BufferView* view = state.context.views.view_of(accessor);
  if (view == nullptr || view->byte_stride || !accessor.format.known()) return false;
  return model::element_size(accessor.format) % 4 != 0 && (consequences || good_format);
}

std::string alignment_text(const model::Accessor& accessor) {
  if (accessor.byte_offset && *accessor.byte_offset % 4 != 0) {
    return fmt::format("The attribute has byteOffset {}, which is not a multiple of 4.",
                       *accessor.byte_offset);
  }
  return fmt::format("Elements of {} bytes without a byteStride are not 4-byte aligned.",
                     model::element_size(accessor.format));
}

constexpr FixEntry kAttributeFixes[] = {
    {Code::MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS, add_bounds},
};

}  // namespace

const RuleGroup& attribute_check_rules() {
  static constexpr RuleGroup group{.fixes = kAttributeFixes};
  return group;
}

void check_attribute(MeshState& state, const AttributeUse& use, const Path& path) {
  check_bounds(state, use, path);
  const bool good_format = check_format(state, use, path);
  if (!is_misaligned(state, use.accessor, good_format)) return;
  report(state, use, path, Code::MESH_PRIMITIVE_ACCESSOR_UNALIGNED, alignment_text(use.accessor));
}

void check_shared_view(MeshState& state, const AttributeUse& use, const Path& path) {
  const std::uint32_t index = *use.attribute.accessor;
  const model::BufferView* view = state.context.views.view_of(use.accessor);
  if (view == nullptr || view->byte_stride || state.seen_accessors[index]) return;
  state.seen_accessors[index] = true;
  const std::uint32_t view_index = *use.accessor.buffer_view;
  const bool shared = state.views_in_use[view_index];
  state.views_in_use[view_index] = true;
  if (!shared) return;
  report(state, use, path, Code::MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE,
         fmt::format("Buffer view {} is shared by several attributes, but has no byteStride.",
                     view_index),
         fmt::format("add byteStride to buffer view {}", view_index));
}

}  // namespace gltfx::validate
