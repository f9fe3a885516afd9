// SPDX-License-Identifier: Apache-2.0
/// Visits the objects of one extension; selects the extensions of an asset that rules read.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "model/fields.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// The extensions of the Set, unless Deviations::unsupported_extensions_are_skipped: then those
/// that the Khronos validator supports and the asset declares. Made once for a link rule; the
/// context must outlive it.
class ActiveExtensions {
 public:
  explicit ActiveExtensions(const Context& context);

  bool contains(std::string_view name) const;
  /// The active extension of that name, or null.
  const schema::Extension* find(std::string_view name) const;

 private:
  const schema::Set& schemas_;
  bool all_;
  std::vector<schema::ExtensionId> active_;  // unless all are active
};

/// The extensions of the asset's `extensionsUsed` that are active, in its order.
std::vector<const schema::Extension*> declared_extensions(const Context& context);

/// Whether additional rules about an extension have anything to check: the walk found its objects.
inline bool has_objects_of(const Context& context, std::string_view extension) {
  const auto& seen = context.checked.extensions_seen;
  return !context.deviations.no_additional_rules &&
         std::find(seen.begin(), seen.end(), extension) != seen.end();
}

/// The extensions found by the walk that draw the mesh of a node many times, in the order of the
/// Set.
std::vector<const schema::Extension*> instancing_extensions(const Context& context);

/// An object of an extension and its host object.
struct ExtensionPlace {
  json::NodeId host;
  json::NodeId object;
  std::size_t index;  ///< of the host in its array
};

/// Calls `use(place, path)` for the extension's object on each element of a root array; `path` is
/// that of the extension's object.
template <typename Use>
void for_each_extension(const Context& context, model::RootArray array, std::string_view extension,
                        Use use) {
  if (!has_objects_of(context, extension)) return;
  const Path root;
  const Path list(root, model::root_array_name(array));
  const auto& hosts = context.asset.elements(array);
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    const json::NodeId object = model::extension_object(context.document, hosts[i], extension);
    if (object == json::kNoNode) continue;
    const Path host(list, i);
    const Path extensions(host, "extensions");
    use(ExtensionPlace{hosts[i], object, i}, Path(extensions, extension));
  }
}

/// Likewise for each primitive of each mesh.
template <typename Use>
void for_each_primitive_extension(const Context& context, std::string_view extension, Use use) {
  if (!has_objects_of(context, extension)) return;
  const Path root;
  const Path list(root, "meshes");
  const auto& meshes = context.views.meshes;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Path mesh(list, m);
    const Path primitives(mesh, "primitives");
    for (std::size_t i = 0; i < meshes[m].primitives.size(); ++i) {
      const json::NodeId primitive = meshes[m].primitives[i].node;
      const json::NodeId object = model::extension_object(context.document, primitive, extension);
      if (object == json::kNoNode) continue;
      const Path host(primitives, i);
      const Path extensions(host, "extensions");
      use(ExtensionPlace{primitive, object, i}, Path(extensions, extension));
    }
  }
}

/// The extension's object on the root object, or json::kNoNode.
inline json::NodeId root_extension(const Context& context, std::string_view extension) {
  if (!has_objects_of(context, extension)) return json::kNoNode;
  return model::extension_object(context.document, context.document.root(), extension);
}

/// The objects of an array member; elements that are not objects are json::kNoNode.
inline std::vector<json::NodeId> object_list(const json::Document& document, json::NodeId object,
                                             std::string_view member) {
  std::vector<json::NodeId> found;
  const json::NodeId array = document.find(object, member);
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return found;
  for (const json::NodeId element : document.elements(array)) {
    found.push_back(document.is_object(element) ? element : json::kNoNode);
  }
  return found;
}

}  // namespace gltfx::validate
