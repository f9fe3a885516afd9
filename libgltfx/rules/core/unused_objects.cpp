// SPDX-License-Identifier: Apache-2.0
// Objects without references, and weights that are always overridden.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/core/accessor_extent.hpp"
#include "rules/core/use.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/fix_deletion.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

// --- Objects ---

// Root arrays whose objects are only used by other objects, in the order of the report. Scenes and
// animations are chosen at run time.
constexpr std::array kArrays{RootArray::accessors, RootArray::buffers, RootArray::buffer_views,
                             RootArray::cameras,   RootArray::images,  RootArray::materials,
                             RootArray::meshes,    RootArray::nodes,   RootArray::samplers,
                             RootArray::skins,     RootArray::textures};

// Indices of `array` (of the member of an object) that refer to nodes.
void mark_nodes(const Context& context, json::NodeId object, std::string_view member,
                std::vector<bool>& used) {
  model::for_each_index(context.asset, context.document.find(object, member), RootArray::nodes,
                        [&](std::uint64_t, std::optional<std::uint32_t> index, Span) {
                          if (index) used[*index] = true;
                        });
}

void mark_animated(const Context& context, json::NodeId animation, std::vector<bool>& used) {
  const json::NodeId channels = context.document.find(animation, "channels");
  if (channels == json::kNoNode || context.document.kind(channels) != json::Kind::array) return;
  if (context.document.find(animation, "samplers") == json::kNoNode) return;
  for (const json::NodeId channel : context.document.elements(channels)) {
    const json::NodeId target = model::object_member(context.document, channel, "target");
    const auto node = context.asset.index(target, "node", RootArray::nodes);
    if (node) used[*node] = true;
  }
}

// The skeleton of a skin does not count as a use of its node.
std::vector<bool> nodes_in_fewer_uses(const Context& context) {
  std::vector<bool> used(context.asset.count(RootArray::nodes));
  for (const json::NodeId scene : context.asset.elements(RootArray::scenes)) {
    mark_nodes(context, scene, "nodes", used);
  }
  for (const json::NodeId node : context.asset.elements(RootArray::nodes)) {
    mark_nodes(context, node, "children", used);
  }
  for (const json::NodeId skin : context.asset.elements(RootArray::skins)) {
    mark_nodes(context, skin, "joints", used);
  }
  for (const json::NodeId animation : context.asset.elements(RootArray::animations)) {
    mark_animated(context, animation, used);
  }
  return used;
}

// An accessor does not count as a use of its view if its size cannot be computed.
std::vector<bool> views_in_fewer_uses(const Context& context) {
  std::vector<bool> used(context.views.buffer_views.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    used[i] = context.views.usage.view(static_cast<std::uint32_t>(i)).used();
  }
  for (const model::Accessor& accessor : context.views.accessors) {
    if (accessor.buffer_view && is_measurable(context, accessor))
      used[*accessor.buffer_view] = true;
  }
  return used;
}

void report_unused(const Context& context, const Path& path, json::NodeId object) {
  const std::string name = context.asset.name(object);
  report_link(context, path, object, Code::UNUSED_OBJECT,
              name.empty() ? std::string("The object is not used.")
                           : fmt::format("The object {} is not used.", gltfx::quoted(name)));
}

void check_array(const Context& context, RootArray array) {
  const auto& objects = context.asset.elements(array);
  if (objects.empty()) return;
  const std::string_view name = model::root_array_name(array);
  const schema::TargetArray* target = context.checked.root_target(name);
  const bool nodes = array == RootArray::nodes;
  const bool fewer =
      context.deviations.fewer_uses_count && (nodes || array == RootArray::buffer_views);
  const std::vector<bool> used = !fewer  ? std::vector<bool>()
                                 : nodes ? nodes_in_fewer_uses(context)
                                         : views_in_fewer_uses(context);
  const Path root;
  const Path path(root, name);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] == json::kNoNode) continue;
    if (fewer ? used[i] : target == nullptr || target->used.contains(i)) continue;
    report_unused(context, Path(path, static_cast<std::uint64_t>(i)), objects[i]);
  }
}

// An array of an extension at the root, such as lights.
void check_extension_array(const Context& context, const ActiveExtensions& active,
                           const schema::TargetArray& target) {
  if (!target.pointer.starts_with("/extensions/")) return;
  const auto steps = split_pointer(target.pointer);
  if (!steps || steps->size() != 3) return;
  if (!active.contains((*steps)[1])) return;
  if (context.order != nullptr) context.order->report_from_root();
  if (context.document.kind(target.node) != json::Kind::array) return;
  const Path root;
  const Path extensions(root, (*steps)[0]);
  const Path extension(extensions, (*steps)[1]);
  const Path array(extension, (*steps)[2]);
  std::uint64_t index = 0;
  for (const json::NodeId object : context.document.elements(target.node)) {
    const std::uint64_t at = index++;
    if (!context.document.is_object(object) || target.used.contains(at)) continue;
    report_unused(context, Path(array, at), object);
  }
}

void check_objects(const Context& context) {
  if (!unseen_user(context).empty()) return;
  for (const RootArray array : kArrays) check_array(context, array);
  const ActiveExtensions active(context);
  std::vector<const schema::TargetArray*> arrays;
  arrays.reserve(context.checked.targets.size());
  for (const schema::TargetArray& target : context.checked.targets) {
    if (target.node != json::kNoNode) arrays.push_back(&target);
  }
  std::sort(arrays.begin(), arrays.end(),
            [](const auto* a, const auto* b) { return a->node < b->node; });
  for (const schema::TargetArray* target : arrays) check_extension_array(context, active, *target);
}

// --- Weights of meshes ---

void check_mesh_weights(const Context& context) {
  if (!unseen_user(context).empty()) return;
  struct Uses {
    bool any = false, with_own_weights = true;
  };
  const auto& meshes = context.asset.elements(RootArray::meshes);
  std::vector<Uses> uses(meshes.size());
  for (const model::Node& node : context.views.nodes) {
    if (!node.mesh) continue;
    Uses& use = uses[*node.mesh];
    use.any = true;
    const bool bare = context.document.find(meshes[*node.mesh], "primitives") == json::kNoNode;
    if (bare && context.deviations.fewer_uses_count) continue;
    if (node.weights == json::kNoNode) use.with_own_weights = false;
  }
  const Path root;
  const Path array(root, "meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!uses[i].any || !uses[i].with_own_weights) continue;
    if (context.document.find(meshes[i], "weights") == json::kNoNode) continue;
    report_member(context.link_sink, context, Path(array, static_cast<std::uint64_t>(i)), meshes[i],
                  "weights", Code::UNUSED_MESH_WEIGHTS,
                  "Every node with the mesh has its own weights.");
  }
}

}  // namespace

const RuleGroup& unused_objects_rules() {
  static constexpr LinkRule kLinkRules[] = {check_objects, check_mesh_weights};
  static constexpr FixEntry kFixes[] = {{Code::UNUSED_MESH_WEIGHTS, remove_marked},
                                        {Code::UNUSED_OBJECT, delete_unused, FixStage::deletion}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
