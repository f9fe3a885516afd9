// SPDX-License-Identifier: Apache-2.0
// Accessors of extensions, and their formats. The schema vocabulary states that a member is an
// accessor, but not its format; so this file has a table by extension.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/accessor.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::ComponentType;
using model::ElementType;

// The component types allowed for a member, not normalized unless stated.
enum class Components : std::uint8_t {
  floats,
  bytes,
  unsigned_bytes,
  wide_indices,
  indices,
  normals
};

bool allows(Components components, const model::Format& format) {
  const ComponentType type = format.component;
  const bool float32 = type == ComponentType::float32;
  if (components == Components::normals) {
    return float32 || type == ComponentType::int8 || type == ComponentType::int16;
  }
  if (format.normalized) return false;
  switch (components) {
    case Components::floats:
      return float32;
    case Components::bytes:
      return type == ComponentType::int8;
    case Components::unsigned_bytes:
      return type == ComponentType::uint8;
    case Components::wide_indices:
      return type == ComponentType::uint16 || type == ComponentType::uint32;
    default:
      return type == ComponentType::uint8 || type == ComponentType::uint16 ||
             type == ComponentType::uint32;
  }
}

std::string_view components_text(Components components) {
  constexpr std::string_view kTexts[] = {"FLOAT",
                                         "BYTE",
                                         "UNSIGNED_BYTE",
                                         "UNSIGNED_SHORT or UNSIGNED_INT",
                                         "UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT",
                                         "FLOAT, BYTE or SHORT"};
  return kTexts[static_cast<std::size_t>(components)];
}

struct Wanted {
  std::string_view member;
  std::optional<ElementType> type;  ///< nothing: any
  Components components;
};

// The objects with the members: the extension's object itself, or the objects of one of its lists.
struct Home {
  enum class On : std::uint8_t { root, mesh, primitive };
  std::string_view extension;
  On on;
  std::string_view list;
  Wanted wanted[3];
};

constexpr Home kHomes[] = {
    {"CESIUM_primitive_outline",
     Home::On::primitive,
     "",
     {{"indices", ElementType::scalar, Components::wide_indices}, {}, {}}},
    {"CESIUM_tile_edges",
     Home::On::primitive,
     "",
     {{"left", ElementType::scalar, Components::wide_indices},
      {"bottom", ElementType::scalar, Components::wide_indices},
      {"right", ElementType::scalar, Components::wide_indices}}},
    {"CESIUM_tile_edges",
     Home::On::primitive,
     "",
     {{"top", ElementType::scalar, Components::wide_indices}, {}, {}}},
    {"EXT_mesh_primitive_edge_visibility",
     Home::On::primitive,
     "",
     {{"visibility", ElementType::scalar, Components::unsigned_bytes},
      {"silhouetteNormals", ElementType::vec3, Components::normals},
      {}}},
    {"EXT_mesh_primitive_edge_visibility",
     Home::On::primitive,
     "lineStrings",
     {{"indices", ElementType::scalar, Components::indices}, {}, {}}},
    {"EXT_mesh_primitive_restart",
     Home::On::mesh,
     "primitiveGroups",
     {{"indices", ElementType::scalar, Components::indices}, {}, {}}},
    {"MPEG_animation_timing",
     Home::On::root,
     "",
     {{"accessor", ElementType::scalar, Components::bytes}, {}, {}}},
    {"MPEG_mesh_linking",
     Home::On::mesh,
     "",
     {{"pose", ElementType::mat4, Components::floats},
      {"weights", std::nullopt, Components::floats},
      {}}},
    {"MPEG_viewport_recommended",
     Home::On::root,
     "viewports",
     {{"translation", ElementType::vec3, Components::floats},
      {"rotation", ElementType::vec4, Components::floats},
      {"parameters", ElementType::vec4, Components::floats}}},
};

void check_member(const Context& context, json::NodeId object, const Wanted& wanted,
                  const Path& path) {
  const auto index = context.asset.index(object, wanted.member, model::RootArray::accessors);
  if (!index) return;
  const model::Format& format = context.views.accessors[*index].format;
  if (!format.known()) return;
  const ElementType type = wanted.type.value_or(format.type);
  if (format.type == type && allows(wanted.components, format)) return;
  report_member(context.link_sink, context, path, object, wanted.member,
                Code::EXTENSION_ACCESSOR_INVALID_FORMAT,
                fmt::format("Accessor {} is {}; it must be {} of {}.", *index, format_text(format),
                            model::element_type_name(type), components_text(wanted.components)));
}

void check_object(const Context& context, const Home& home, json::NodeId object, const Path& path) {
  for (const Wanted& wanted : home.wanted) {
    if (!wanted.member.empty()) check_member(context, object, wanted, path);
  }
}

void check_home(const Context& context, const Home& home, json::NodeId object, const Path& path) {
  if (home.list.empty()) return check_object(context, home, object, path);
  const Path list(path, home.list);
  const auto objects = object_list(context.document, object, home.list);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] != json::kNoNode) check_object(context, home, objects[i], Path(list, i));
  }
}

void check_formats(const Context& context) {
  for (const Home& home : kHomes) {
    const auto use = [&](const ExtensionPlace& place, const Path& path) {
      check_home(context, home, place.object, path);
    };
    if (home.on == Home::On::mesh) {
      for_each_extension(context, model::RootArray::meshes, home.extension, use);
    } else if (home.on == Home::On::primitive) {
      for_each_primitive_extension(context, home.extension, use);
    } else if (const json::NodeId object = root_extension(context, home.extension);
               object != json::kNoNode) {
      const Path root;
      const Path extensions(root, "extensions");
      check_home(context, home, object, Path(extensions, home.extension));
    }
  }
}

// The count of the accessor that a member refers to.
std::optional<std::uint64_t> count_of(const Context& context, json::NodeId object,
                                      std::string_view member) {
  const auto index = context.asset.index(object, member, model::RootArray::accessors);
  return index ? context.views.accessors[*index].count : std::nullopt;
}

void report_count(const Context& context, const Path& path, json::NodeId object,
                  std::string_view member, std::string message) {
  report_member(context.link_sink, context, path, object, member,
                Code::EXTENSION_ACCESSOR_INVALID_COUNT, std::move(message));
}

// Two indices per edge.
void check_outlines(const Context& context) {
  for_each_primitive_extension(
      context, "CESIUM_primitive_outline", [&](const ExtensionPlace& place, const Path& path) {
        const auto count = count_of(context, place.object, "indices");
        if (!count || *count % 2 == 0) return;
        report_count(
            context, path, place.object, "indices",
            fmt::format("The number of indices is {}; it must be even, two per edge.", *count));
      });
}

// Two bits per edge, three edges per triangle.
void check_visibility(const Context& context) {
  for_each_primitive_extension(
      context, "EXT_mesh_primitive_edge_visibility",
      [&](const ExtensionPlace& place, const Path& path) {
        const auto mode = model::unsigned_member(context.document, place.host, "mode").value_or(4);
        const auto count = count_of(context, place.object, "visibility");
        const auto indices = count_of(context, place.host, "indices");
        if (!count || !indices || *indices < 3 || mode < 4 || mode > 6) return;
        const std::uint64_t triangles = mode == 4 ? *indices / 3 : *indices - 2;
        const std::uint64_t bytes = triangles / 4 * 3 + (triangles % 4 * 6 + 7) / 8;
        if (*count == bytes) return;
        report_count(context, path, place.object, "visibility",
                     fmt::format("The visibility has {} bytes; for {} triangles it must have {}.",
                                 *count, triangles, bytes));
      });
}

}  // namespace

const RuleGroup& extension_accessors_rules() {
  static constexpr LinkRule kLinkRules[] = {check_formats, check_outlines, check_visibility};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
