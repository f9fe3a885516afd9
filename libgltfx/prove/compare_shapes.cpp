// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_shapes.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "model/inverse.hpp"
#include "prove/compare_copies.hpp"
#include "prove/compare_surfaces.hpp"
#include "prove/skin_pair.hpp"

namespace gltfx::prove {
namespace {

/// A mesh of each asset, at matched nodes.
struct MeshUse {
  std::uint32_t our_node = 0, their_node = 0;  ///< that carry the mesh: a helper or the node itself
  std::uint32_t our_owner = 0, their_owner = 0;  ///< the matched nodes
  bool moved = false;                            ///< the owners are placed differently
};

// Of one pair of meshes at moved nodes, because each takes as long as the mesh is large.
constexpr unsigned kMostPlaces = 64;

class ShapeComparison {
 public:
  ShapeComparison(const Comparison& all, const Helpers& helpers, std::vector<bool>& moved)
      : all_(all),
        helpers_(helpers),
        skins_(all),
        our_list_(all.ours.list("/nodes")),
        their_list_(all.theirs.list("/nodes")),
        moved_(moved) {}

  void run() {
    collect();
    compare_shapes();
    skins_.tell_rest();
    compare_free_meshes();
  }

 private:
  ItemId ours(std::uint32_t node) const { return {our_list_, node}; }
  ItemId theirs(std::uint32_t node) const { return {their_list_, node}; }
  const model::Node& our_node(std::uint32_t node) const {
    return all_.ours.side().views().nodes[node];
  }
  const model::Node& their_node(std::uint32_t node) const {
    return all_.theirs.side().views().nodes[node];
  }

  // Nodes whose place differs, and meshes by the nodes that show them.
  void collect() {
    moved_.assign(all_.our_nodes.size(), false);
    for (std::uint32_t i = 0; our_list_ != kNoItem && i < all_.our_nodes.size(); ++i) {
      const ItemId other = all_.match.theirs(ours(i));
      if (!other) continue;
      moved_[i] = !same_place(all_.our_nodes.local(i), all_.their_nodes.local(other.index));
      MeshUse use{i, other.index, i, other.index, moved_[i]};
      if (helpers_.ours[i] != kNoItem) use.our_node = helpers_.ours[i];
      if (helpers_.theirs[other.index] != kNoItem) use.their_node = helpers_.theirs[other.index];
      const auto& here = our_node(use.our_node).mesh;
      const auto& there = their_node(use.their_node).mesh;
      if (here && there) uses_[{*here, *there}].push_back(use);
    }
  }

  bool helps(const MeshUse& use) const {
    return use.our_node != use.our_owner || use.their_node != use.their_owner;
  }

  // Whether the transform of a node only places its mesh.
  bool is_leaf(const MeshUse& use) const {
    const auto leaf = [](const NodeTree& tree, const model::Node& node, std::uint32_t i,
                         std::uint32_t carrier) {
      const auto& children = tree.children(i);
      const bool alone = children.empty() || (children.size() == 1 && children.front() == carrier);
      return alone && !node.camera && !node.skin && node.extensions == json::kNoNode;
    };
    return leaf(all_.our_nodes, our_node(use.our_owner), use.our_owner, use.our_node) &&
           leaf(all_.their_nodes, their_node(use.their_owner), use.their_owner, use.their_node);
  }

  std::vector<SurfacePiece> pieces(const Content& content, std::uint32_t mesh,
                                   const model::Affine& place,
                                   const std::vector<double>* joints) const {
    std::vector<SurfacePiece> all;
    for (const Surface& surface : content.surfaces(mesh)) {
      if (surface.primitive == json::kNoNode) continue;
      all.push_back({&content, surface.primitive, surface.material, place, joints, &surface});
    }
    return all;
  }

  SurfacePair surface_pair(std::uint32_t here, std::uint32_t there) const {
    SurfacePair pair;
    const ItemId one{all_.ours.list("/meshes"), here};
    const ItemId other{all_.theirs.list("/meshes"), there};
    pair.name = all_.our_name(one);
    pair.our_place = all_.our_pointer(one);
    pair.their_place = all_.their_pointer(other);
    return pair;
  }

  void compare_shapes() {
    for (const auto& [meshes, uses] : uses_) compare_mesh(meshes.first, meshes.second, uses);
  }

  // Nodes that keep their place show the mesh as it is; of the others, a leaf may have a transform
  // that undoes what happened to the mesh.
  void compare_mesh(std::uint32_t here, std::uint32_t there, const std::vector<MeshUse>& uses) {
    const ItemId mesh{all_.ours.list("/meshes"), here};
    const ItemId other{all_.theirs.list("/meshes"), there};
    seen_.insert({here, there});
    const bool partners = all_.match.theirs(mesh) == other;
    bool plain = false;
    unsigned places = 0;
    double scale = 0;
    const MeshUse* skinned = nullptr;
    const bool equal = have_equal_surfaces(here, there);
    if (equal && !partners && may_be_joined(mesh, other)) forget_references(uses);
    for (const MeshUse& use : uses) {
      const bool has_skin = our_node(use.our_owner).skin && their_node(use.their_owner).skin;
      if (has_skin && skinned == nullptr) skinned = &use;
      if (has_skin || compare_copied(here, there, use)) continue;
      if (equal && !helps(use)) continue;
      const bool placed = (use.moved || helps(use)) && ++places <= kMostPlaces;
      if (placed && compare_at(here, there, use)) continue;
      plain = true;
      scale = std::max(scale, all_.our_nodes.greatest_scale(use.our_node));
    }
    const bool all_skinned = std::all_of(uses.begin(), uses.end(), [&](const MeshUse& use) {
      return our_node(use.our_owner).skin && their_node(use.their_owner).skin;
    });
    if (skinned != nullptr && compare_skinned(here, there, *skinned)) {
      // Equal vertices of joints with other names were another mesh.
      if (!partners && all_skinned && may_be_joined(mesh, other)) forget_references(uses);
    }
    if (!plain || !partners) return;
    SurfacePair pair = surface_pair(here, there);
    pair.ours = pieces(all_.ours, here, {}, nullptr);
    pair.theirs = pieces(all_.theirs, there, {}, nullptr);
    pair.scale = scale;
    tell(compare_surfaces(all_, pair));
  }

  // Whether the transforms of copies undo what happened to the mesh.
  bool compare_copied(std::uint32_t here, std::uint32_t there, const MeshUse& use) {
    const auto copies = pair_copies(all_, use.our_node, use.their_node);
    if (!copies || copies->moved == 0) return false;
    if (copies->place) {
      SurfacePair pair = surface_pair(here, there);
      pair.ours = pieces(all_.ours, here, {}, nullptr);
      pair.theirs = pieces(all_.theirs, there, *copies->place, nullptr);
      pair.scale = copies->scale * all_.our_nodes.greatest_scale(use.our_node);
      SurfaceChanges changes = compare_surfaces(all_, pair);
      if (changes.level() != CompareLevel::differs) {
        forget_copies(all_, use.our_node, use.their_node);
        tell(std::move(changes));
        return true;
      }
    }
    tell_copies(all_, use.our_node, use.their_node, *copies);
    return false;
  }

  // Of equal meshes one may stand for all; names are told where they count.
  bool may_be_joined(ItemId mesh, ItemId other) const {
    if (all_.match.theirs(mesh) && all_.match.ours(other)) return false;
    const auto has_weights = [](const Content& content, ItemId item) {
      return content.side().document().find(content.item(item).node, "weights") != json::kNoNode;
    };
    return !has_weights(all_.ours, mesh) && !has_weights(all_.theirs, other);
  }

  void forget_references(const std::vector<MeshUse>& uses) {
    std::set<std::string> places;
    for (const MeshUse& use : uses) {
      places.insert(all_.ours.side().pointer(our_node(use.our_node).mesh_value));
    }
    all_.log.forget([&](const Change& change) {
      return change.kind == "node.value" && change.old_pointer &&
             places.contains(*change.old_pointer);
    });
  }

  bool have_equal_surfaces(std::uint32_t here, std::uint32_t there) {
    SurfacePair pair = surface_pair(here, there);
    pair.ours = pieces(all_.ours, here, {}, nullptr);
    pair.theirs = pieces(all_.theirs, there, {}, nullptr);
    const auto sums = [](const std::vector<SurfacePiece>& list) {
      std::vector<std::pair<std::uint64_t, std::uint64_t>> all;
      for (const SurfacePiece& each : list)
        all.emplace_back(each.known->sum.high, each.known->sum.low);
      std::sort(all.begin(), all.end());
      return all;
    };
    const bool readable = std::all_of(pair.ours.begin(), pair.ours.end(),
                                      [](const auto& each) { return each.known->readable; });
    // Materials are told below, where nodes keep their places.
    return readable && sums(pair.ours) == sums(pair.theirs) && same_materials(pair);
  }

  bool same_materials(const SurfacePair& pair) const {
    if (pair.ours.size() != pair.theirs.size()) return false;
    const std::uint32_t here = all_.ours.list("/materials");
    const std::uint32_t there = all_.theirs.list("/materials");
    for (std::size_t i = 0; i < pair.ours.size(); ++i) {
      const auto& one = pair.ours[i].material;
      const auto& other = pair.theirs[i].material;
      if (pair.ours[i].known->sum != pair.theirs[i].known->sum) return false;
      if (pair.ours[i].known->order != pair.theirs[i].known->order) return false;
      if (!all_.match.same(one ? ItemId{here, *one} : ItemId{},
                           other ? ItemId{there, *other} : ItemId{})) {
        return false;
      }
    }
    return true;
  }

  // Whether the surfaces at their places are the same, or within bounds; then nothing was moved.
  bool compare_at(std::uint32_t here, std::uint32_t there, const MeshUse& use) {
    const bool leaf = use.moved && is_leaf(use);
    if (use.moved && !leaf && !helps(use)) return false;
    const auto place = [&](const NodeTree& tree, std::uint32_t owner, std::uint32_t carrier) {
      const model::Affine own = leaf ? tree.local(owner).affine : model::Affine{};
      return owner == carrier ? own : own * tree.local(carrier).affine;
    };
    const model::Affine one = place(all_.our_nodes, use.our_owner, use.our_node);
    const model::Affine other = place(all_.their_nodes, use.their_owner, use.their_node);
    SurfacePair pair = surface_pair(here, there);
    pair.ours = pieces(all_.ours, here, one, nullptr);
    pair.theirs = pieces(all_.theirs, there, other, nullptr);
    // Angles are those of the mesh, as at nodes that keep their place.
    if (const auto back = model::inverse(one)) {
      for (SurfacePiece& each : pair.ours) each.turn = model::Affine{};
      for (SurfacePiece& each : pair.theirs) each.turn = *back * other;
    }
    pair.scale = leaf ? greatest_scale_of(all_.our_nodes.parent_world(use.our_owner))
                      : all_.our_nodes.greatest_scale(use.our_owner);
    SurfaceChanges changes = compare_surfaces(all_, pair);
    if (leaf && changes.level() == CompareLevel::differs &&
        !is_explained(changes, here, there, pair)) {
      return false;
    }
    if (leaf) moved_[use.our_owner] = false;
    tell(std::move(changes));
    return true;
  }

  // Whether the transforms bring vertices to their places that are elsewhere without them: then
  // only the other values differ.
  bool is_explained(const SurfaceChanges& placed, std::uint32_t here, std::uint32_t there,
                    SurfacePair pair) const {
    if (!placed.same_places()) return false;
    pair.ours = pieces(all_.ours, here, {}, nullptr);
    pair.theirs = pieces(all_.theirs, there, {}, nullptr);
    return !compare_surfaces(all_, pair).same_places();
  }

  // Whether their surfaces are equal.
  bool compare_skinned(std::uint32_t here, std::uint32_t there, const MeshUse& use) {
    const std::uint32_t one = *our_node(use.our_owner).skin;
    const std::uint32_t other = *their_node(use.their_owner).skin;
    const SkinPair& skin = skins_.get(one, other);
    SurfacePair pair = surface_pair(here, there);
    pair.ours = pieces(all_.ours, here, {}, &skin.our_joints);
    pair.theirs = pieces(all_.theirs, there, skin.place, &skin.their_joints);
    pair.scale = skin.scale;
    SurfaceChanges changes = compare_surfaces(all_, pair);
    if (skin.has_place && changes.level() != CompareLevel::differs) {
      skins_.explain(one, other);
    } else if (skin.has_place) {
      pair.theirs = pieces(all_.theirs, there, {}, &skin.their_joints);
      SurfaceChanges as_stored = compare_surfaces(all_, pair);
      if (changes.same_places() && !as_stored.same_places()) {
        skins_.explain(one, other);
      } else {
        changes = std::move(as_stored);
      }
    }
    const bool equal = changes.changes.empty() && !changes.unread;
    tell(std::move(changes));
    return equal;
  }

  void tell(SurfaceChanges&& changes) {
    for (Change& change : changes.changes) all_.log.add(std::move(change));
  }

  // Meshes that no matched nodes show.
  void compare_free_meshes() {
    const std::uint32_t list = all_.ours.list("/meshes");
    if (list == kNoItem) return;
    for (std::uint32_t i = 0; i < all_.ours.lists()[list].items.size(); ++i) {
      const ItemId other = all_.match.theirs({list, i});
      if (!other || seen_.contains({i, other.index})) continue;
      SurfacePair pair = surface_pair(i, other.index);
      pair.ours = pieces(all_.ours, i, {}, nullptr);
      pair.theirs = pieces(all_.theirs, other.index, {}, nullptr);
      tell(compare_surfaces(all_, pair));
    }
  }

  const Comparison& all_;
  const Helpers& helpers_;
  SkinPairs skins_;
  const std::uint32_t our_list_, their_list_;
  std::vector<bool>& moved_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<MeshUse>> uses_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen_;
};

}  // namespace

void compare_shapes(const Comparison& comparison, const Helpers& helpers,
                    std::vector<bool>& moved) {
  ShapeComparison(comparison, helpers, moved).run();
}

}  // namespace gltfx::prove
