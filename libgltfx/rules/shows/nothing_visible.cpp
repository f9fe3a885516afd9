// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/external_places.hpp"
#include "model/fields.hpp"
#include "model/pose.hpp"
#include "model/skin.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/shows/flat_nodes.hpp"
#include "rules/shows/primitive_extent.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::Primitive;
using model::RootArray;
using model::SemanticKind;

// Why something that is drawn is not seen. `none`: it is seen, or nobody can tell.
enum class Unseen : std::uint8_t { none, hidden, scaled_to_zero, collapsed, clear };

// By node. What it shows is seen in another file.
std::vector<std::uint8_t> has_external_asset(const Context& context) {
  std::vector<std::uint8_t> has(context.views.nodes.size(), 0);
  for (const auto& place : model::external_places(context.document, context.views)) {
    has[place.node] = 1;
  }
  return has;
}

// The walk over the nodes of a scene, up to the first one that shows something.
class SceneWalk {
 public:
  explicit SceneWalk(DataPhase& phase)
      : phase_(phase),
        context_(phase.context),
        meshes_(context_.views.meshes.size()),
        external_(has_external_asset(context_)),
        moves_(may_change_scales(context_)),
        flat_(context_) {
    const bool decodes = pixel_level(context_.options) != PixelLevel::headers;
    if (decodes && phase.textures) pixels_ = &phase.textures->pixels;
  }

  // Whether nothing is seen for certain.
  bool run(const std::vector<model::NodeIndex>& roots) {
    std::vector<std::uint8_t> reached(context_.views.nodes.size(), 0);
    std::vector<Step> steps;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
      steps.push_back({*root, model::Affine(), false});
    }
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      if (std::exchange(reached[step.node], 1) != 0) continue;
      const model::Node& node = context_.views.nodes[step.node];
      const Step below{step.node, step.parent * model::stored_transform(context_.asset, node),
                       step.hidden || is_hidden(node)};
      if (external_[step.node] != 0 && !below.hidden) return false;
      if (node.mesh && shows(node, below)) return false;
      model::for_each_index(context_.asset, node.children, RootArray::nodes,
                            [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                              if (child) steps.push_back({*child, below.parent, below.hidden});
                            });
    }
    return true;
  }

  struct Cause {
    Unseen reason = Unseen::none;
    model::NodeIndex node = 0;
    std::uint32_t mesh = 0;
  };
  // Of the meshes that were met.
  const std::vector<Cause>& causes() const { return causes_; }
  std::uint64_t nodes_with_mesh() const { return nodes_with_mesh_; }

 private:
  struct Step {
    model::NodeIndex node = 0;
    model::Affine parent;  ///< its own transform included, once it is entered
    bool hidden = false;
  };

  bool is_hidden(const model::Node& node) const {
    if (node.extensions == json::kNoNode) return false;
    const json::NodeId object =
        model::object_member(context_.document, node.extensions, "KHR_node_visibility");
    if (object == json::kNoNode) return false;
    return !model::Properties(context_.document, object).flag("visible", true);
  }

  // A joint that is scaled to 0, if all joints of the skin are.
  std::optional<model::NodeIndex> flat_joint(std::uint32_t skin) {
    const auto [known, is_new] = flat_joints_.try_emplace(skin);
    if (is_new) known->second = find_flat_joint(skin);
    return known->second;
  }
  std::optional<model::NodeIndex> find_flat_joint(std::uint32_t skin) {
    const model::Skin read =
        model::read_skin(context_.asset, context_.asset.elements(RootArray::skins)[skin]);
    std::optional<model::NodeIndex> first;
    for (const model::NodeIndex joint : read.joint_nodes) {
      const auto cause = flat_.cause(joint);
      if (!cause) return std::nullopt;
      if (!first) first = cause;
    }
    return first;
  }

  bool shows(const model::Node& node, const Step& step) {
    ++nodes_with_mesh_;
    Unseen reason = Unseen::none;
    model::NodeIndex at = step.node;
    const auto joint = node.skin && !step.hidden ? flat_joint(*node.skin) : std::nullopt;
    if (step.hidden) {
      reason = Unseen::hidden;
    } else if (joint || (!node.skin && is_flat(step.parent))) {
      reason = Unseen::scaled_to_zero;
      at = joint.value_or(at);
    } else {
      reason = reason_of(*node.mesh, node.skin.has_value());
    }
    const bool may_move = moves_ && reason != Unseen::collapsed;
    if (reason == Unseen::none || may_move) return true;
    constexpr std::size_t kMostCauses = 1024;
    if (causes_.size() < kMostCauses) causes_.push_back({reason, at, *node.mesh});
    return false;
  }

  Unseen reason_of(std::uint32_t mesh, bool skinned) {
    std::optional<Unseen>& known = meshes_[mesh];
    if (known) return *known;
    Unseen reason = Unseen::none;
    for (const Primitive& primitive : context_.views.meshes[mesh].primitives) {
      const Unseen own = reason_of(primitive, skinned);
      if (own == Unseen::none) {
        reason = own;
        break;
      }
      reason = std::max(reason, own);
    }
    known = reason;
    return reason;
  }

  Unseen reason_of(const Primitive& primitive, bool skinned) {
    if (primitive.node == json::kNoNode || !primitive.mode) return Unseen::none;
    // Without positions, or with positions that have no data, it has findings of its own.
    const model::Attribute* position = primitive.find(SemanticKind::position);
    if (position == nullptr || !position->accessor) return Unseen::none;
    const auto data = phase_.open(*position->accessor);
    if (!data || data->implied()) return Unseen::none;
    const bool deforms = skinned || !primitive.targets.empty();
    if (!deforms && has_extent(phase_, primitive, *data) == false) return Unseen::collapsed;
    const bool extended = context_.document.find(primitive.node, "extensions") != json::kNoNode;
    return !extended && is_clear(phase_, primitive, pixels_) ? Unseen::clear : Unseen::none;
  }

  DataPhase& phase_;
  const Context& context_;
  std::map<std::uint32_t, std::optional<model::NodeIndex>> flat_joints_;  // by skin
  std::vector<std::optional<Unseen>> meshes_;
  const std::vector<std::uint8_t> external_;
  const bool moves_;
  FlatNodes flat_;
  PixelSource* pixels_ = nullptr;  ///< null: images are not decoded
  std::vector<Cause> causes_;
  std::uint64_t nodes_with_mesh_ = 0;
};

// Positions that nothing uses: the file was written without its meshes.
bool has_lost_vertices(const Context& context) {
  const auto& accessors = context.views.accessors;
  const bool bare = context.views.nodes.empty() && context.views.animations.empty() &&
                    context.checked.extensions_used.empty();
  return bare && std::any_of(accessors.begin(), accessors.end(), [](const auto& each) {
           return each.format.type == model::ElementType::vec3 &&
                  each.format.component == model::ComponentType::float32;
         });
}

std::string cause_text(const Context& context, const SceneWalk::Cause& cause) {
  const std::string node = object_label(context, RootArray::nodes, cause.node);
  const std::string mesh = object_label(context, RootArray::meshes, cause.mesh);
  switch (cause.reason) {
    case Unseen::hidden:
      return fmt::format("{} or a parent of it is hidden", node);
    case Unseen::scaled_to_zero:
      return fmt::format("{} or a parent of it is scaled to 0", node);
    case Unseen::collapsed:
      return fmt::format("all vertices of {} are at one place or on one line", mesh);
    case Unseen::clear:
      return fmt::format("the material of {} has an alpha that leaves nothing of it", mesh);
    case Unseen::none:
      break;
  }
  return {};
}

void report_nothing(DataPhase& phase, const std::string& pointer, json::NodeId place,
                    std::string message, std::optional<Severity> severity = {}) {
  Finding finding = finding_on(phase.context, place, Code::NOTHING_VISIBLE, std::move(message));
  finding.severity = severity;
  report_at(phase.sink, pointer, std::move(finding));
}

// At the object that causes it: a mesh, or a node.
void report_causes(DataPhase& phase, const SceneWalk& walk) {
  const Context& context = phase.context;
  const SceneWalk::Cause& first = walk.causes().front();
  const std::uint64_t others = walk.nodes_with_mesh() - 1;
  std::string message = fmt::format("{}{}", kNothingIsVisible, cause_text(context, first));
  if (others > 0) {
    message += fmt::format("; the {} shows nothing either",
                           others == 1 ? "other node with a mesh"
                                       : fmt::format("rest of {} nodes with a mesh", others + 1));
  }
  const bool of_node = first.reason == Unseen::hidden || first.reason == Unseen::scaled_to_zero;
  const std::uint32_t index = of_node ? first.node : first.mesh;
  report_nothing(phase, fmt::format("/{}/{}", of_node ? "nodes" : "meshes", index),
                 of_node ? context.views.nodes[index].object : context.views.meshes[index].node,
                 message + ".");
}

std::optional<std::uint32_t> first_with_mesh(const Context& context) {
  const auto& nodes = context.views.nodes;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].mesh) return i;
  }
  return std::nullopt;
}

// Meshes of colliders and the like are not meant to be seen.
bool has_other_users(const Context& context) {
  for (const schema::TargetArray& target : context.checked.targets) {
    if (target.pointer != "/meshes") continue;
    for (std::size_t i = 0; i < context.views.meshes.size(); ++i) {
      if (target.used.contains(i)) return true;
    }
  }
  return false;
}

// A scene that reaches no mesh.
void report_empty(DataPhase& phase, const model::SceneRoots& roots) {
  const Context& context = phase.context;
  const auto node = first_with_mesh(context);
  if (!node && (has_other_users(context) || !unseen_user(context).empty())) return;
  if (!node) {
    return report_nothing(phase, "/meshes/0", context.views.meshes.front().node,
                          fmt::format("{}no node has {}.", kNothingIsVisible,
                                      object_label(context, RootArray::meshes, 0)),
                          Severity::info);
  }
  if (!roots.scene) return;
  report_nothing(
      phase, fmt::format("/scenes/{}", *roots.scene),
      context.asset.elements(RootArray::scenes)[*roots.scene],
      fmt::format("{}{} has no node with a mesh; {} is outside of it.", kNothingIsVisible,
                  object_label(context, RootArray::scenes, *roots.scene),
                  object_label(context, RootArray::nodes, *node)));
}

void check_default_scene(DataPhase& phase) {
  const Context& context = phase.context;
  const bool external = !model::external_places(context.document, context.views).empty();
  if (!first_with_mesh(context) && !external) return;
  const std::size_t scenes = context.asset.count(RootArray::scenes);
  const json::NodeId root = context.document.root();
  if (scenes == 0) {
    phase.sink.report(
        Path(), finding_on(context, root, Code::DEFAULT_SCENE_MISSING,
                           "The file has nodes and no scene: many viewers show nothing, and some "
                           "refuse the file."));
    return;
  }
  if (context.document.find(root, "scene") != json::kNoNode) return;
  report_at(phase.sink, "/scenes",
            finding_on(context, context.document.find(root, "scenes"), Code::DEFAULT_SCENE_MISSING,
                       "No scene is the default: a viewer may show the first one, or nothing."));
}

// --- Fix ---

bool set_only_scene(Fixing& fixing, const Subject& subject) {
  const json::Document& document = fixing.document();
  const json::NodeId scenes = subject.value;
  const bool one = scenes != json::kNoNode && document.kind(scenes) == json::Kind::array &&
                   document.array_size(scenes) == 1;
  if (!one || document.find(document.root(), "scenes") != scenes) return false;
  if (document.find(document.root(), "scene") != json::kNoNode) return false;
  return fixing.append_member(document.root(), "scene", "0");
}

}  // namespace

const RuleGroup& default_scene_rules() {
  static constexpr FixEntry kFixes[] = {{Code::DEFAULT_SCENE_MISSING, set_only_scene}};
  static constexpr RuleGroup group{.fixes = kFixes};
  return group;
}

void check_nothing_visible(DataPhase& phase) {
  const Context& context = phase.context;
  check_default_scene(phase);
  if (context.views.meshes.empty()) {
    if (!has_lost_vertices(context)) return;
    return report_nothing(
        phase, "/accessors", context.document.find(context.document.root(), "accessors"),
        fmt::format("{}the file has vertices and no mesh, node or scene that uses them.",
                    kNothingIsVisible),
        Severity::info);
  }
  const model::SceneRoots roots = model::choose_scene(context.asset, context.views);
  SceneWalk walk(phase);
  if (!walk.run(roots.nodes)) return;
  if (!walk.causes().empty()) return report_causes(phase, walk);
  report_empty(phase, roots);
}

}  // namespace gltfx::validate
