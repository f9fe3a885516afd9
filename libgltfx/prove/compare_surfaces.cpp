// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_surfaces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prove/compare_unknown_modes.hpp"
#include "prove/drawn_materials.hpp"
#include "prove/hash_sum.hpp"
#include "prove/shown_pieces.hpp"
#include "prove/soup_lists.hpp"
#include "prove/stream_change.hpp"
#include "prove/texture_use.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;

class SurfaceComparison {
 public:
  SurfaceComparison(const Comparison& all, const SurfacePair& pair) : all_(all), pair_(pair) {}

  SurfaceChanges run() {
    for (const SurfacePiece& piece : pair_.ours) here_.push_back(show_piece(piece));
    for (const SurfacePiece& piece : pair_.theirs) there_.push_back(show_piece(piece));
    if (!leave_out_unread()) return std::move(result_);
    std::map<std::uint64_t, ShownGroup> groups = grouped();
    for (const auto& [material, group] : groups) compare_order(group);
    std::erase_if(groups, [](const auto& group) { return group.second.equal(); });
    if (groups.empty()) return std::move(result_);
    find_other_materials(groups);
    groups = grouped();
    std::erase_if(groups, [](const auto& group) { return group.second.equal(); });
    join_equal_materials(groups);
    join_lone_groups(groups);
    for (auto& [material, group] : groups) compare_group(material, group);
    return std::move(result_);
  }

 private:
  // Materials of our side by number, the first of equal ones; those of the other side by their
  // partner.
  std::uint64_t material_of(const SurfacePiece& piece, bool ours) {
    if (!piece.material || is_like_none(piece, ours)) return UINT64_MAX;
    if (ours) return first_equal(*piece.material);
    const auto [at, is_new] = materials_.try_emplace(*piece.material);
    if (is_new) at->second = find_material(*piece.material);
    return at->second;
  }

  // Whether a material is drawn as none is, which the other asset has in its place.
  bool is_like_none(const SurfacePiece& piece, bool ours) {
    if (!all_.options.drawn) return false;
    const std::vector<ShownPiece>& others = ours ? there_ : here_;
    const bool any = std::any_of(others.begin(), others.end(), [](const ShownPiece& each) {
      return !each.piece->material.has_value();
    });
    if (!any) return false;
    return ours ? drawn_materials().are_alike(piece.material, {})
                : drawn_materials().are_alike({}, piece.material);
  }

  DrawnMaterials& drawn_materials() {
    if (!drawn_materials_) drawn_materials_.emplace(all_);
    return *drawn_materials_;
  }

  std::uint64_t find_material(std::uint32_t material) {
    const ItemId theirs{all_.theirs.list("/materials"), material};
    if (const ItemId partner = all_.match.ours(theirs)) return first_equal(partner.index);
    // One of several equal ones.
    for (const ShownPiece& each : here_) {
      if (!each.piece->material) continue;
      const ItemId one{all_.ours.list("/materials"), *each.piece->material};
      if (!all_.match.same(one, theirs)) continue;
      all_.log.note_equal(pointer_of(*each.piece, "material"));
      return first_equal(one.index);
    }
    for (const ShownPiece& each : here_) {
      if (!all_.options.drawn || !each.piece->material) continue;
      if (drawn_materials().are_alike(each.piece->material, material)) {
        return first_equal(*each.piece->material);
      }
    }
    return (std::uint64_t{1} << 32U) + material;
  }

  // Where groups of equal materials are joined, the first of them.
  std::uint32_t first_equal(std::uint32_t material) const {
    const ItemId item{all_.ours.list("/materials"), material};
    const auto found = first_equal_.find(all_.ours.item(item).content);
    return found == first_equal_.end() ? material : found->second;
  }

  // A primitive may be joined with another one that has an equal material.
  void join_equal_materials(std::map<std::uint64_t, ShownGroup>& groups) {
    const bool lone = std::any_of(groups.begin(), groups.end(), [](const auto& group) {
      return group.second.ours.empty() || group.second.theirs.empty();
    });
    if (!lone) return;
    const std::uint32_t list = all_.ours.list("/materials");
    for (const ShownPiece& each : here_) {
      if (!each.piece->material) continue;
      const std::uint32_t material = *each.piece->material;
      const auto [at, is_new] =
          first_equal_.try_emplace(all_.ours.item({list, material}).content, material);
      if (!is_new) at->second = std::min(at->second, material);
    }
    materials_.clear();
    groups = grouped();
    std::erase_if(groups, [](const auto& group) { return group.second.equal(); });
  }

  const TextureUse& use_of(std::uint64_t material) const {
    const auto& uses = all_.texture_uses;
    return material < uses.size() - 1 ? uses[material] : uses.back();
  }

  std::map<std::uint64_t, ShownGroup> grouped() {
    std::map<std::uint64_t, ShownGroup> groups;
    for (ShownPiece& each : here_) {
      if (!each.done) groups[material_of(*each.piece, true)].ours.push_back(&each);
    }
    for (ShownPiece& each : there_) {
      if (!each.done) groups[material_of(*each.piece, false)].theirs.push_back(&each);
    }
    return groups;
  }

  // Whether the rest is to be compared.
  bool leave_out_unread() {
    const auto unread = [](const ShownPiece& each) { return !each.readable; };
    const auto ours = std::find_if(here_.begin(), here_.end(), unread);
    const auto theirs = std::find_if(there_.begin(), there_.end(), unread);
    const bool lost = theirs != there_.end();
    result_.unread = ours != here_.end() || lost;
    if (!result_.unread) return true;
    if (ours != here_.end() && lost) {
      if (compare_unknown_modes(all_, pair_, result_.changes)) return false;
      all_.log.leave_out(fmt::format("{} cannot be read in either asset.", pair_.our_place));
      return true;
    }
    Change& change = add("geometry.elements",
                         fmt::format("can be read in the {} asset only", lost ? "old" : "new"));
    // What several meshes use is told once, at its place.
    auto& pointer = lost ? change.new_pointer : change.old_pointer;
    const std::string place = place_of_unread(*(lost ? theirs : ours)->piece);
    if (place.empty()) return false;
    change.also.push_back(*pointer);
    (lost ? change.old_pointer : change.new_pointer).reset();
    pointer = place;
    return false;
  }

  // The accessor that cannot be read, or the index that leads to none.
  static std::string place_of_unread(const SurfacePiece& piece) {
    const Side& side = piece.content->side();
    const json::NodeId value = soup_of(piece).unread;
    if (value == json::kNoNode) return {};
    const Link* link = side.link(value);
    return side.pointer(link == nullptr || link->target == json::kNoNode ? value : link->target);
  }

  Change& add(std::string_view kind, std::string what) {
    return result_.changes.emplace_back(change_of(pair_, kind, std::move(what)));
  }

  static std::string pointer_of(const SurfacePiece& piece, std::string_view member) {
    const Side& side = piece.content->side();
    const json::NodeId value = side.document().find(piece.primitive, member);
    return side.pointer(value == json::kNoNode ? piece.primitive : value);
  }

  // Equal shapes with other materials: the material of the primitive is what changed.
  void find_other_materials(std::map<std::uint64_t, ShownGroup>& groups) {
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<ShownPiece*>> waiting;
    for (auto& [material, group] : groups) {
      for (ShownPiece* each : group.theirs) {
        if (each->sum != Hash128{}) waiting[{each->sum.high, each->sum.low}].push_back(each);
      }
    }
    const auto take = [&](ShownPiece& ours, bool same_material, std::uint64_t material) {
      const auto found = waiting.find({ours.sum.high, ours.sum.low});
      if (found == waiting.end()) return;
      for (ShownPiece* other : found->second) {
        if (other->done) continue;
        if ((material_of(*other->piece, false) == material) != same_material) continue;
        ours.done = other->done = true;
        if (!same_material) tell_material(*ours.piece, *other->piece);
        return;
      }
    };
    for (const bool same_material : {true, false}) {
      for (auto& [material, group] : groups) {
        for (ShownPiece* each : group.ours) {
          if (!each->done) take(*each, same_material, material);
        }
      }
    }
  }

  // Of materials with equal values, one may stand for another; if their names are different, where
  // one of them came or went.
  bool are_equal_materials(const SurfacePiece& ours, const SurfacePiece& theirs) const {
    if (!ours.material || !theirs.material) return false;
    const ItemId one{all_.ours.list("/materials"), *ours.material};
    const ItemId other{all_.theirs.list("/materials"), *theirs.material};
    if (all_.match.same(one, other)) return true;
    return all_.ours.item(one).content == all_.theirs.item(other).content &&
           (!all_.match.theirs(one) || !all_.match.ours(other));
  }

  // Where the material blends, a picture shows the order of triangles.
  void compare_order(const ShownGroup& group) {
    const auto blends = [](const ShownPiece* each) {
      return each->piece->known != nullptr && each->piece->known->order != Hash128{};
    };
    if (group.ours.empty() || group.theirs.empty() || !group.equal() ||
        !std::all_of(group.ours.begin(), group.ours.end(), blends) ||
        !std::all_of(group.theirs.begin(), group.theirs.end(), blends)) {
      return;
    }
    const bool as_many = group.ours.size() == group.theirs.size();
    const auto order = [as_many](const std::vector<ShownPiece*>& pieces) {
      Hash128 all;
      for (const ShownPiece* each : pieces) {
        if (as_many) {
          add_to_sum(all, hash_order(soup_of(*each->piece), {}));
        } else {
          all = hash_order(soup_of(*each->piece), all);
        }
      }
      return all;
    };
    if (!as_many && pair_.our_place == "/meshes") return;  // objects have no order
    if (order(group.ours) == order(group.theirs)) return;
    const SurfacePiece& ours = *group.ours.front()->piece;
    const SurfacePiece& theirs = *group.theirs.front()->piece;
    if (is_draco(ours) != is_draco(theirs)) {
      return all_.log.note_storage("Draco gives blended triangles another order");
    }
    Change& change = add("geometry.elements",
                         "triangles have another order, which shows because the material blends");
    if (group.ours.size() > 1 || !as_many) return;
    change.old_pointer = pointer_of(ours, "indices");
    change.new_pointer = pointer_of(theirs, "indices");
  }

  static bool is_draco(const SurfacePiece& piece) {
    const model::Asset& asset = piece.content->side().asset();
    return model::read_draco(asset, model::read_primitive(asset, piece.primitive)).has_value();
  }

  void tell_material(const SurfacePiece& ours, const SurfacePiece& theirs) {
    if (are_equal_materials(ours, theirs)) {
      return all_.log.note_equal(pointer_of(ours, "material"));
    }
    if (all_.options.drawn && drawn_materials().are_alike(ours.material, theirs.material)) return;
    const auto called = [](const Content& content, const std::optional<std::uint32_t>& material) {
      return material ? Comparison::called(content, {content.list("/materials"), *material})
                      : std::string("no material");
    };
    const std::string before = called(all_.ours, ours.material);
    const std::string after = called(all_.theirs, theirs.material);
    Change& change = add("geometry.material", fmt::format("uses {} instead of {}", after, before));
    change.old_pointer = pointer_of(ours, "material");
    change.new_pointer = pointer_of(theirs, "material");
    change.before = before;
    change.after = after;
  }

  // If one material is left on each side, shape and material changed.
  void join_lone_groups(std::map<std::uint64_t, ShownGroup>& groups) {
    std::vector<std::uint64_t> lost, found;
    for (const auto& [material, group] : groups) {
      if (group.theirs.empty()) lost.push_back(material);
      if (group.ours.empty()) found.push_back(material);
    }
    if (lost.size() != 1 || found.size() != 1) return;
    ShownGroup& group = groups[lost.front()];
    group.theirs = groups[found.front()].theirs;
    groups.erase(found.front());
    tell_material(*group.ours.front()->piece, *group.theirs.front()->piece);
  }

  using SoupsByArity = std::map<unsigned, std::pair<std::vector<Soup>, std::vector<Soup>>>;

  // Triangles became lines, for example.
  void tell_mode(const SoupsByArity& soups, const SurfacePiece& ours, const SurfacePiece& theirs) {
    std::string before, after;
    for (const auto& [arity, both] : soups) {
      if (!both.first.empty()) before = counted_elements(both.first.front().elements(), arity);
      if (!both.second.empty()) after = counted_elements(both.second.front().elements(), arity);
    }
    Change& change = add("geometry.elements", fmt::format("{} became {}", before, after));
    change.old_pointer = pointer_of(ours, "mode");
    change.new_pointer = pointer_of(theirs, "mode");
  }

  static bool any_has_normals(const ShownGroup& group) {
    const auto has_normals = [](const ShownPiece* each) {
      const model::Asset& asset = each->piece->content->side().asset();
      const auto attributes = model::read_primitive(asset, each->piece->primitive).attributes;
      return std::any_of(attributes.begin(), attributes.end(), [](const auto& attribute) {
        return attribute.semantic.kind == SemanticKind::normal;
      });
    };
    return std::any_of(group.ours.begin(), group.ours.end(), has_normals) ||
           std::any_of(group.theirs.begin(), group.theirs.end(), has_normals);
  }

  void compare_group(std::uint64_t material, const ShownGroup& group) {
    SoupsByArity by_arity;
    const bool with_normals = all_.options.drawn && any_has_normals(group);
    const auto read = [&](const std::vector<ShownPiece*>& pieces, bool ours) {
      for (const ShownPiece* each : pieces) {
        Soup soup = soup_of(*each->piece, with_normals);
        if (soup.elements() == 0) continue;
        auto& both = by_arity[soup.arity];
        (ours ? both.first : both.second).push_back(std::move(soup));
      }
    };
    read(group.ours, true);
    read(group.theirs, false);
    const SurfacePiece* one = group.ours.empty() ? nullptr : group.ours.front()->piece;
    const SurfacePiece* other = group.theirs.empty() ? nullptr : group.theirs.front()->piece;
    const bool lone = group.ours.size() == 1 && group.theirs.size() == 1;
    const SoupGroup pieces{pair_, use_of(material), one, other, lone};
    if (lone && by_arity.size() > 1) return tell_mode(by_arity, *one, *other);
    if (by_arity.empty()) by_arity[3];
    for (auto& [arity, both] : by_arity) {
      compare_soup_lists(all_, pieces, std::move(both.first), std::move(both.second),
                         result_.changes);
    }
  }

  const Comparison& all_;
  const SurfacePair& pair_;
  std::vector<ShownPiece> here_, there_;
  std::map<std::uint32_t, std::uint64_t> materials_;  ///< of the other side, by number
  std::optional<DrawnMaterials> drawn_materials_;     ///< where they are asked
  std::unordered_map<Hash128, std::uint32_t, HashHasher> first_equal_;  ///< by content
  SurfaceChanges result_;
};

}  // namespace

bool SurfaceChanges::same_places() const {
  return std::none_of(changes.begin(), changes.end(), [](const Change& change) {
    return change.level == CompareLevel::differs &&
           (change.kind == "geometry.elements" || change.kind == "geometry.position" ||
            change.kind == "geometry.winding");
  });
}

SurfaceChanges compare_surfaces(const Comparison& comparison, const SurfacePair& pair) {
  return SurfaceComparison(comparison, pair).run();
}

}  // namespace gltfx::prove
