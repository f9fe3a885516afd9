// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_drawn.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "model/instancing.hpp"
#include "model/skin.hpp"
#include "prove/compare_surfaces.hpp"

namespace gltfx::prove {
namespace {

constexpr std::uint64_t kMostElements = std::uint64_t{1} << 21U;

/// The nodes and meshes of an asset whose surfaces never move.
class StaticSurfaces {
 public:
  StaticSurfaces(const Content& content, const NodeTree& nodes)
      : content_(content), nodes_(nodes), list_(content.list("/nodes")) {
    find_moving();
    find_static();
  }

  const std::vector<SurfacePiece>& pieces() const { return pieces_; }
  /// Whether all surfaces fit into the memory of a comparison.
  bool fits() const { return elements_ <= kMostElements; }

  /// Whether a pointer leads into a node or a mesh of static surfaces only.
  bool covers(const std::optional<std::string>& pointer) const {
    if (!pointer) return true;
    const auto index = [&](std::string_view list) -> std::optional<std::size_t> {
      if (!pointer->starts_with(list)) return std::nullopt;
      std::size_t number = 0;
      const char* const begin = pointer->data() + list.size();
      const auto read = std::from_chars(begin, pointer->data() + pointer->size(), number);
      return read.ec == std::errc() ? std::optional(number) : std::nullopt;
    };
    if (const auto node = index("/nodes/")) return *node < still_.size() && still_[*node];
    if (const auto mesh = index("/meshes/")) return *mesh < meshes_.size() && meshes_[*mesh];
    return index("/scenes/").has_value();
  }

 private:
  // Targets of animations, of pointers, and joints.
  void find_moving() {
    const Side& side = content_.side();
    moving_.assign(nodes_.size(), false);
    for (const model::Animation& animation : side.views().animations) {
      for (const model::AnimationChannel& channel : animation.channels) {
        if (channel.node) moving_[*channel.node] = true;
      }
    }
    for (const graph::PointerText& pointer : side.graph().pointers()) {
      for (const json::NodeId value : pointer.way) {
        const ItemId item = content_.find(value);
        if (item && item.list == list_) moving_[item.index] = true;
      }
    }
    for (const json::NodeId skin : side.asset().elements(model::RootArray::skins)) {
      if (skin == json::kNoNode) continue;
      for (const model::NodeIndex joint : model::read_skin(side.asset(), skin).joint_nodes) {
        moving_[joint] = true;
      }
    }
  }

  void find_static() {
    const Side& side = content_.side();
    const auto& views = side.views();
    meshes_.assign(views.meshes.size(), true);
    still_.assign(nodes_.size(), true);
    std::vector<bool> below_moving(nodes_.size());
    for (const std::uint32_t node : nodes_.order()) {
      const model::NodeIndex above = nodes_.parent(node);
      below_moving[node] = moving_[node] || (above != model::kNoNodeIndex && below_moving[above]);
      const model::Node& described = views.nodes[node];
      const bool special = described.camera ||
                           (described.extensions != json::kNoNode && !has_copies_only(described));
      if (described.mesh && (below_moving[node] || special || !is_rigid(described))) {
        meshes_[*described.mesh] = false;
      }
      still_[node] = !below_moving[node] && !special && is_rigid(described);
    }
    for (auto at = nodes_.order().rbegin(); at != nodes_.order().rend(); ++at) {
      const model::NodeIndex above = nodes_.parent(*at);
      if (!still_[*at] && above != model::kNoNodeIndex) still_[above] = false;
    }
    add_pieces();
  }

  // Whether its extensions only say where its mesh is drawn.
  bool has_copies_only(const model::Node& node) const {
    const Side& side = content_.side();
    if (model::instance_attributes(side.asset(), node) == json::kNoNode) return false;
    std::size_t members = 0;
    for ([[maybe_unused]] const auto each : side.document().members(node.extensions)) ++members;
    return members == 1;
  }

  bool is_rigid(const model::Node& node) const {
    if (!node.mesh) return true;
    if (node.skin) return false;
    const auto& primitives = content_.side().views().meshes[*node.mesh].primitives;
    return std::all_of(primitives.begin(), primitives.end(), [](const model::Primitive& each) {
      return each.targets.empty() && !each.targets_are_broken;
    });
  }

  void add_pieces() {
    const Side& side = content_.side();
    model::MemoryBudget budget(kMostElements * sizeof(model::Affine));
    for (const std::uint32_t node : nodes_.order()) {
      const model::Node& described = side.views().nodes[node];
      if (!described.mesh || !meshes_[*described.mesh]) continue;
      const auto copies = read_copies(side, described, budget);
      const model::Affine& world = nodes_.world(node);
      if (!copies) {
        add_pieces_of(*described.mesh, world);
      } else {
        for (const model::Affine& copy : *copies) add_pieces_of(*described.mesh, world * copy);
      }
      if (!fits()) return;
    }
  }

  void add_pieces_of(std::uint32_t mesh, const model::Affine& place) {
    for (const Surface& surface : content_.surfaces(mesh)) {
      if (surface.primitive == json::kNoNode || !fits()) continue;
      elements_ += surface.elements + 1;
      pieces_.push_back({&content_, surface.primitive, surface.material, place, nullptr, &surface});
    }
  }

  const Content& content_;
  const NodeTree& nodes_;
  const std::uint32_t list_;
  std::vector<bool> moving_, still_, meshes_;
  std::vector<SurfacePiece> pieces_;
  std::uint64_t elements_ = 0;
};

}  // namespace

void forget_static_surfaces(const Comparison& all) {
  const StaticSurfaces ours(all.ours, all.our_nodes);
  const StaticSurfaces theirs(all.theirs, all.their_nodes);
  if (!ours.fits() || !theirs.fits()) return;
  SurfacePair pair;
  pair.ours = ours.pieces();
  pair.theirs = theirs.pieces();
  pair.our_place = pair.their_place = "/meshes";
  SurfaceChanges changes = compare_surfaces(all, pair);
  if (changes.unread || changes.level() == CompareLevel::differs) return;
  all.log.forget([&](const Change& change) {
    const bool shape = change.kind.starts_with("geometry.") || change.kind.starts_with("node.") ||
                       change.kind == "mesh.value" || change.kind == "scene.nodes";
    return shape && ours.covers(change.old_pointer) && theirs.covers(change.new_pointer);
  });
  for (Change& change : changes.changes) all.log.add(std::move(change));
}

}  // namespace gltfx::prove
