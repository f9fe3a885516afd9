// SPDX-License-Identifier: Apache-2.0
// Extensions of a mesh about several of its primitives (EXT_mesh_primitive_restart,
// EXT_mesh_manifold): a schema file cannot compare primitives, so this file names the two.
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "json/equal.hpp"
#include "model/accessor.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

bool is_strip(model::Mode mode) {
  return mode == model::Mode::line_loop || mode == model::Mode::line_strip ||
         mode == model::Mode::triangle_strip || mode == model::Mode::triangle_fan;
}

bool same_attributes(const model::Primitive& a, const model::Primitive& b) {
  if (a.attributes.size() != b.attributes.size()) return false;
  std::unordered_map<std::string_view, std::optional<std::uint32_t>> all;
  for (const model::Attribute& each : a.attributes) all.emplace(each.name, each.accessor);
  return std::all_of(b.attributes.begin(), b.attributes.end(), [&](const model::Attribute& each) {
    const auto found = all.find(each.name);
    return found != all.end() && found->second == each.accessor;
  });
}

// Members except the indices and those that are compared by their meaning.
std::map<std::string_view, json::NodeId> other_members(const json::Document& document,
                                                       const model::Primitive& primitive) {
  std::map<std::string_view, json::NodeId> members;
  for (const auto member : document.members(primitive.node)) {
    members[document.key(member.key_id)] = member.value;
  }
  for (const std::string_view name : {"indices", "attributes", "mode", "material"}) {
    members.erase(name);
  }
  return members;
}

bool same_but_indices(const json::Document& document, const model::Primitive& a,
                      const model::Primitive& b) {
  if (a.mode != b.mode || a.material != b.material || !same_attributes(a, b)) return false;
  const auto ours = other_members(document, a);
  const auto theirs = other_members(document, b);
  return std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                    [&](const auto& one, const auto& other) {
                      return one.first == other.first &&
                             json::equal(document, one.second, other.second);
                    });
}

// The reason why a primitive cannot be in a group; empty: it can.
std::string why_not_grouped(const json::Document& document, const model::Primitive& primitive) {
  if (primitive.mode && !is_strip(*primitive.mode)) {
    return fmt::format("its mode is {}, which does not use primitive restart",
                       model::mode_name(*primitive.mode));
  }
  if (primitive.indices_node == json::kNoNode) return "it has no indices";
  if (document.find(primitive.node, "targets") != json::kNoNode) return "it has morph targets";
  return {};
}

class RestartCheck {
 public:
  RestartCheck(const Context& context, const ExtensionPlace& place, const Path& path)
      : context_(context),
        groups_(object_list(context.document, place.object, "primitiveGroups")),
        primitives_(context.views.meshes[place.index].primitives),
        owner_(primitives_.size(), SIZE_MAX),
        list_(path, "primitiveGroups") {}

  void run() {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Path group(list_, g);
      const Path members(group, "primitives");
      const json::NodeId array = context_.document.find(groups_[g], "primitives");
      if (array == json::kNoNode || context_.document.kind(array) != json::Kind::number_array) {
        continue;
      }
      const model::Primitive* first = nullptr;
      std::uint64_t position = 0;
      for (json::NumberCursor at(context_.document, array); at.valid(); at.advance(), ++position) {
        const double value = at.number().value;
        if (!at.number().is_integer() || value < 0 ||
            value >= static_cast<double>(primitives_.size())) {
          continue;
        }
        check(static_cast<std::size_t>(value), g, first, at.number().span, Path(members, position));
      }
    }
  }

 private:
  void check(std::size_t index, std::size_t group, const model::Primitive*& first, Span span,
             const Path& path) {
    const model::Primitive& primitive = primitives_[index];
    if (primitive.node == json::kNoNode) return;
    if (owner_[index] != SIZE_MAX && owner_[index] != group) {
      report_link(context_, path, span, Code::RESTART_PRIMITIVE_REPEATED,
                  fmt::format("Primitive {} is already in group {}.", index, owner_[index]));
    }
    owner_[index] = group;
    const std::string why = why_not_grouped(context_.document, primitive);
    if (!why.empty()) {
      report_link(context_, path, span, Code::RESTART_PRIMITIVE_UNFIT,
                  fmt::format("Primitive {} cannot be in a group: {}.", index, why));
    } else if (first == nullptr) {
      first = &primitive;
    } else if (!same_but_indices(context_.document, primitive, *first)) {
      report_link(
          context_, path, span, Code::RESTART_PRIMITIVES_DIFFER,
          fmt::format(
              "Primitive {} differs from the first one of its group in more than the indices.",
              index));
    }
  }

  const Context& context_;
  std::vector<json::NodeId> groups_;
  const std::vector<model::Primitive>& primitives_;
  std::vector<std::size_t> owner_;  ///< group of each primitive
  Path list_;
};

void check_restart(const Context& context) {
  for_each_extension(context, model::RootArray::meshes, "EXT_mesh_primitive_restart",
                     [&](const ExtensionPlace& place, const Path& path) {
                       RestartCheck(context, place, path).run();
                     });
}

// Properties shared by all primitives of a manifold.
struct Shared {
  std::unordered_map<std::string_view, std::uint32_t> accessors;  ///< by attribute name
  std::optional<std::uint32_t> index_view;
};

// The reason why a primitive cannot be part of the manifold; empty: it can.
std::string why_no_part(const Context& context, const model::Primitive& primitive, Shared& shared) {
  if (primitive.mode && *primitive.mode != model::Mode::triangles) {
    return fmt::format("its mode is {}, not TRIANGLES", model::mode_name(*primitive.mode));
  }
  if (primitive.indices_node == json::kNoNode) return "it has no indices";
  for (const model::Attribute& each : primitive.attributes) {
    if (!each.accessor) continue;
    const auto [known, fresh] = shared.accessors.try_emplace(each.name, *each.accessor);
    if (!fresh && known->second != *each.accessor) {
      return fmt::format("its {} is accessor {}, but that of another primitive is {}", each.name,
                         *each.accessor, known->second);
    }
  }
  if (!primitive.indices) return {};
  const auto view = context.views.accessors[*primitive.indices].buffer_view;
  if (!view) return {};
  if (shared.index_view && *shared.index_view != *view) {
    return fmt::format(
        "its indices are in buffer view {}, but those of another primitive are in {}", *view,
        *shared.index_view);
  }
  shared.index_view = view;
  return {};
}

void check_manifold(const Context& context, const ExtensionPlace& place, const Path& path) {
  Shared shared;
  std::size_t index = 0;
  for (const model::Primitive& primitive : context.views.meshes[place.index].primitives) {
    const std::size_t own = index++;
    if (primitive.node == json::kNoNode) continue;
    const std::string why = why_no_part(context, primitive, shared);
    if (why.empty()) continue;
    report_link(context, path, place.object, Code::MANIFOLD_PRIMITIVE_UNFIT,
                fmt::format("Primitive {} cannot be part of the manifold: {}.", own, why));
  }
  const json::NodeId whole =
      model::object_member(context.document, place.object, "manifoldPrimitive");
  if (whole == json::kNoNode) return;
  const std::string why = why_no_part(context, model::read_primitive(context.asset, whole), shared);
  // The schema file checks the manifold's own mode and indices.
  if (why.empty() || !why.starts_with("its ") || why.starts_with("its mode")) return;
  report_member(context.link_sink, context, path, place.object, "manifoldPrimitive",
                Code::MANIFOLD_PRIMITIVE_UNFIT,
                fmt::format("The manifold primitive does not match the others: {}.", why));
}

void check_manifolds(const Context& context) {
  for_each_extension(
      context, model::RootArray::meshes, "EXT_mesh_manifold",
      [&](const ExtensionPlace& place, const Path& path) { check_manifold(context, place, path); });
}

}  // namespace

const RuleGroup& mesh_groups_rules() {
  static constexpr LinkRule kLinkRules[] = {check_restart, check_manifolds};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
