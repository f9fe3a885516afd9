// SPDX-License-Identifier: Apache-2.0
// Primitives: attributes, indices and morph targets compared with each other.

#include <algorithm>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/core/mesh_state.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

using model::Attribute;
using model::Mode;
using model::Primitive;
using model::SemanticKind;

const model::Accessor& accessor_of(const Context& context, const Attribute& attribute) {
  return context.views.accessors[*attribute.accessor];
}

// Attributes with a wrong name are reported; their accessors are not checked.
bool is_usable(const Context& context, const Attribute& attribute) {
  const bool named = attribute.semantic.kind != SemanticKind::invalid ||
                     context.deviations.consequences_are_reported;
  return named && attribute.accessor.has_value();
}

// --- Attributes ---

bool differ(const Context& context, std::optional<std::uint64_t> expected,
            std::optional<std::uint64_t> count) {
  if (!context.deviations.missing_integers_are_minus_one && !(expected && count)) return false;
  return expected != count;
}

void check_attributes(MeshState& state, const Primitive& primitive, const Path& path) {
  const Context& context = state.context;
  std::optional<std::uint64_t> count;
  for (const Attribute& attribute : primitive.attributes) {
    report_references(context, attribute.value);
    if (!is_usable(context, attribute)) continue;
    const Path at(path, attribute.name);
    const AttributeUse use{attribute, accessor_of(context, attribute), false};
    report_use(context, *attribute.accessor, model::AccessorUse::vertex_attribute, attribute.value,
               at);
    check_attribute(state, use, at);
    if (!count) count = use.accessor.count;
    if (count && differ(context, count, use.accessor.count)) {
      report_link(context, at, attribute.value, Code::MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT,
                  fmt::format("{} has {} elements, but the first attribute has {}.",
                              quoted(attribute.name), use.accessor.count.value_or(0), *count));
    }
    check_shared_view(state, use, at);
  }
}

std::optional<std::uint64_t> vertex_count(const Context& context, const Primitive& primitive) {
  for (const Attribute& attribute : primitive.attributes) {
    if (!is_usable(context, attribute)) continue;
    const auto count = accessor_of(context, attribute).count;
    if (count) return count;
  }
  return std::nullopt;
}

// --- Indices ---

bool is_index_format(const model::Format& format) {
  using model::ComponentType;
  return format.type == model::ElementType::scalar && !format.normalized &&
         (format.component == ComponentType::uint8 || format.component == ComponentType::uint16 ||
          format.component == ComponentType::uint32);
}

void check_indices(const Context& context, const Primitive& primitive, const Path& path) {
  report_references(context, primitive.indices_node);
  if (!primitive.indices) return;
  const Path at(path, "indices");
  const json::NodeId place = primitive.indices_node;
  report_use(context, *primitive.indices, model::AccessorUse::indices, place, at);
  const model::Accessor& accessor = context.views.accessors[*primitive.indices];
  const model::BufferView* view = context.views.view_of(accessor);
  // If the view has the target of indices, its stride is already reported as an error of the view.
  const bool at_error =
      view != nullptr && view->byte_stride &&
      (context.deviations.consequences_are_reported || view->target != model::ViewTarget::indices);
  if (at_error) {
    report_link(context, at, place, Code::MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE,
                fmt::format("Buffer view {} contains indices, but has a byteStride.",
                            *accessor.buffer_view));
  }
  if (is_index_format(accessor.format)) return;
  if (!accessor.format.known() && !context.deviations.unknown_formats_are_checked) return;
  report_link(context, at, place, Code::MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT,
              fmt::format("The indices are {}; they must be SCALAR of UNSIGNED_BYTE, "
                          "UNSIGNED_SHORT or UNSIGNED_INT.",
                          model::format_text(accessor.format)));
}

// --- Mode ---

bool goes_with(std::uint64_t count, Mode mode) {
  switch (mode) {
    case Mode::lines:
      return count % 2 == 0;
    case Mode::line_loop:
    case Mode::line_strip:
      return count >= 2;
    case Mode::triangles:
      return count % 3 == 0;
    case Mode::triangle_strip:
    case Mode::triangle_fan:
      return count >= 3;
    default:
      return true;
  }
}

std::string_view mode_demand(Mode mode) {
  switch (mode) {
    case Mode::lines:
      return "a multiple of 2";
    case Mode::line_loop:
    case Mode::line_strip:
      return "at least 2";
    case Mode::triangles:
      return "a multiple of 3";
    default:
      return "at least 3";
  }
}

void check_mode(const Context& context, const Primitive& primitive, const Path& path) {
  const bool indexed = primitive.indices.has_value();
  const bool broken = primitive.indices_node != json::kNoNode && !indexed;
  if (!primitive.mode || (broken && !context.deviations.broken_values_are_absent)) return;
  const auto count = indexed ? context.views.accessors[*primitive.indices].count
                             : vertex_count(context, primitive);
  if (!count || goes_with(*count, *primitive.mode)) return;
  report_link(
      context, path, primitive.node, Code::MESH_PRIMITIVE_INCOMPATIBLE_MODE,
      fmt::format("The primitive has {}; for {} it must have {}.",
                  *count == 1 ? (indexed ? "1 index" : "1 vertex")
                              : fmt::format("{} {}", *count, indexed ? "indices" : "vertices"),
                  model::mode_name(*primitive.mode), mode_demand(*primitive.mode)));
}

// --- Morph targets ---

// Attributes by name, so that many of them in many targets stay linear.
class BaseAttributes {
 public:
  explicit BaseAttributes(const std::vector<Attribute>& attributes) {
    for (const Attribute& attribute : attributes) sorted_.push_back(&attribute);
    std::stable_sort(sorted_.begin(), sorted_.end(),
                     [](const Attribute* a, const Attribute* b) { return a->name < b->name; });
  }
  const Attribute* find(std::string_view name) const {
    const auto at = std::lower_bound(
        sorted_.begin(), sorted_.end(), name,
        [](const Attribute* each, std::string_view wanted) { return each->name < wanted; });
    return at != sorted_.end() && (*at)->name == name ? *at : nullptr;
  }

 private:
  std::vector<const Attribute*> sorted_;
};

void check_base(const Context& context, const Attribute& attribute, const Attribute* base,
                const Path& path) {
  const bool broken = base != nullptr && !base->accessor;
  if (base == nullptr || (broken && context.deviations.broken_values_are_absent)) {
    report_link(
        context, path, attribute.value, Code::MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR,
        fmt::format("The target has {}, but the primitive does not.", quoted(attribute.name)));
    return;
  }
  if (broken) return;
  const auto count = accessor_of(context, attribute).count;
  const auto expected = accessor_of(context, *base).count;
  if (!differ(context, expected, count)) return;
  report_link(context, path, attribute.value,
              Code::MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT,
              fmt::format("{} has {} elements, but the primitive has {} vertices.",
                          quoted(attribute.name), count.value_or(0), expected.value_or(0)));
}

bool can_be_morphed(const Context& context, const Attribute& attribute) {
  const SemanticKind kind = attribute.semantic.kind;
  return context.deviations.consequences_are_reported ||
         (kind != SemanticKind::joints && kind != SemanticKind::weights);
}

void check_targets(MeshState& state, const Primitive& primitive, const Path& path) {
  if (primitive.targets.empty()) return;
  const Context& context = state.context;
  const BaseAttributes bases(primitive.attributes);
  const Path array(path, "targets");
  for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
    const Path target(array, static_cast<std::uint64_t>(i));
    for (const Attribute& attribute : model::read_attributes(context.asset, primitive.targets[i])) {
      report_references(context, attribute.value);
      if (!is_usable(context, attribute) || !can_be_morphed(context, attribute)) continue;
      const Path at(target, attribute.name);
      report_use(context, *attribute.accessor, model::AccessorUse::vertex_attribute,
                 attribute.value, at);
      check_base(context, attribute, bases.find(attribute.name), at);
      const AttributeUse use{attribute, accessor_of(context, attribute), true};
      check_attribute(state, use, at);
      check_shared_view(state, use, at);
    }
  }
}

// --- All primitives ---

void check_primitive(MeshState& state, const Primitive& primitive, const Path& path) {
  MaterialCheck materials(state, primitive, path);
  const bool variants_first = state.context.deviations.reading_order;
  if (variants_first) materials.check_variants();
  check_attributes(state, primitive, Path(path, "attributes"));
  check_indices(state.context, primitive, path);
  check_mode(state.context, primitive, path);
  if (!variants_first) materials.check_variants();
  materials.check_material();
  check_targets(state, primitive, path);
}

void check_meshes(const Context& context) {
  MeshState state(context);
  const Path root;
  const Path array(root, "meshes");
  std::uint64_t mesh_index = 0;
  for (const model::Mesh& mesh : context.views.meshes) {
    const Path owner(array, mesh_index++);
    const Path list(owner, "primitives");
    std::uint64_t index = 0;
    for (const Primitive& primitive : mesh.primitives) {
      const Path path(list, index++);
      if (primitive.node != json::kNoNode) check_primitive(state, primitive, path);
    }
  }
}

}  // namespace

const RuleGroup& mesh_primitive_rules() {
  static constexpr LinkRule kLinkRules[] = {check_meshes};
  static constexpr FixEntry kFixes[] = {
      {Code::MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE, remove_index_stride}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
