// SPDX-License-Identifier: Apache-2.0
#include "prove/forget_undrawn.hpp"

#include <algorithm>
#include <vector>

#include "model/variants.hpp"
#include "prove/drawn_items.hpp"
#include "prove/drawn_materials.hpp"

namespace gltfx::prove {
namespace {

/// A value and the names of members that lead to it from its object.
struct PointedValue {
  json::NodeId value = json::kNoNode;
  ItemId item;
  std::vector<std::string_view> names;  ///< the last one first
};

PointedValue find_pointed(const Content& content, const std::optional<std::string>& pointer) {
  PointedValue found;
  if (!pointer) return found;
  const graph::Tree& tree = content.side().tree();
  found.value = tree.find(*pointer).node;
  for (json::NodeId at = found.value; at != json::kNoNode && at != 0; at = tree.parent(at)) {
    found.item = content.find(at);
    if (found.item) break;
    if (tree.is_member(at)) found.names.push_back(tree.name(at));
  }
  return found;
}

constexpr std::string_view kVariants = "/extensions/KHR_materials_variants/variants";

class Undrawn {
 public:
  explicit Undrawn(const Comparison& all)
      : all_(all), materials_(all), same_weights_(have_same_weights()) {}

  bool is(const Change& change) {
    if (is_hidden(change)) return true;
    const PointedValue ours = find_pointed(all_.ours, change.old_pointer);
    const PointedValue theirs = find_pointed(all_.theirs, change.new_pointer);
    if (is_never_drawn_in(all_.ours, ours) && is_never_drawn_in(all_.theirs, theirs)) return true;
    if (change.kind == "node.value" && (is_named(ours, "camera") || is_named(theirs, "camera"))) {
      return true;
    }
    // Its joints say where it is.
    if (change.kind == "skin.value" &&
        (is_named(ours, "skeleton") || is_named(theirs, "skeleton"))) {
      return true;
    }
    const bool weights = is_named(ours, "weights") || is_named(theirs, "weights");
    if (weights && (change.kind == "node.value" || change.kind == "mesh.value")) {
      return same_weights_;
    }
    if (change.kind == "mesh.value" && has_name(ours, theirs, "KHR_materials_variants")) {
      return keeps_variants(ours, theirs);
    }
    if (change.kind == "material.value") return keeps_looks(change, ours, theirs);
    if (change.kind == "texture.value") return keeps_sampler(change);
    return false;
  }

 private:
  bool is_hidden(const Change& change) const {
    if (!change.old_pointer && !change.new_pointer) return false;
    return (!change.old_pointer || all_.our_drawn->hides(*change.old_pointer)) &&
           (!change.new_pointer || all_.their_drawn->hides(*change.new_pointer));
  }

  static bool is_named(const PointedValue& pointed, std::string_view name) {
    return !pointed.names.empty() && pointed.names.back() == name;
  }

  static bool has_name(const PointedValue& ours, const PointedValue& theirs,
                       std::string_view name) {
    const auto has = [&](const std::vector<std::string_view>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    return has(ours.names) || has(theirs.names);
  }

  // Whether an extension of an object may change a picture.
  static bool is_drawn(const Content& content, std::string_view name, json::NodeId extension) {
    const json::Document& document = content.side().document();
    const bool known =
        document.is_object(extension) && content.side().graph().type(extension) != schema::kNone;
    return known && !is_never_drawn(content, name) && !keeps_visible(document, name, extension);
  }

  // Of what one asset lacks, the other one decides.
  static bool is_never_drawn_in(const Content& content, const PointedValue& pointed) {
    if (pointed.value == json::kNoNode) return true;
    if (pointed.names.empty()) return false;
    const json::Document& document = content.side().document();
    if (pointed.names.front() == "extensions" && document.is_object(pointed.value)) {
      for (const auto member : document.members(pointed.value)) {
        if (is_drawn(content, document.key(member.key_id), member.value)) return false;
      }
      return true;
    }
    for (std::size_t i = 0; i + 1 < pointed.names.size(); ++i) {
      if (pointed.names[i + 1] != "extensions") continue;
      const std::string_view name = pointed.names[i];
      const bool whole = i == 0;  // an extension that came or went
      if (whole && !is_drawn(content, name, pointed.value)) return true;
      if (!whole && is_never_drawn(content, name)) return true;
    }
    return false;
  }

  // The materials of each primitive without a variant and with each, by the numbers of the old
  // asset; each once.
  std::vector<std::vector<std::uint64_t>> materials_of(const Content& content,
                                                       std::uint32_t mesh) const {
    const bool is_ours = &content == &all_.ours;
    const std::uint32_t our_variants = all_.ours.list(kVariants);
    const auto count = our_variants == kNoItem ? 0 : all_.ours.lists()[our_variants].items.size();
    const auto number_of = [&](std::optional<std::uint32_t> material) -> std::uint64_t {
      if (!material) return UINT64_MAX;
      if (is_ours) return *material;
      const ItemId partner = all_.match.ours({all_.theirs.list("/materials"), *material});
      return partner ? partner.index : (std::uint64_t{1} << 32U) + *material;
    };
    std::vector<std::vector<std::uint64_t>> rows;
    const Side& side = content.side();
    for (const model::Primitive& primitive : side.views().meshes[mesh].primitives) {
      std::vector<std::uint64_t> row{number_of(primitive.material)};
      for (std::uint32_t i = 0; i < count; ++i) {
        const ItemId variant{our_variants, i};
        const ItemId shown = is_ours ? variant : all_.match.theirs(variant);
        if (!shown) continue;
        row.push_back(number_of(model::material_of(side.asset(), primitive, shown.index)));
      }
      rows.push_back(std::move(row));
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }

  // Mappings and primitives may have any order.
  bool keeps_variants(const PointedValue& ours, const PointedValue& theirs) const {
    const std::uint32_t list = all_.ours.list(kVariants);
    const std::uint32_t other_list = all_.theirs.list(kVariants);
    if (list == kNoItem || other_list == kNoItem) return false;
    if (all_.ours.lists()[list].items.size() != all_.theirs.lists()[other_list].items.size()) {
      return false;
    }
    const ItemId one = ours.item ? ours.item : all_.match.ours(theirs.item);
    const ItemId other = all_.match.theirs(one);
    if (!one || !other) return false;
    return materials_of(all_.ours, one.index) == materials_of(all_.theirs, other.index);
  }

  bool keeps_looks(const Change& change, const PointedValue& ours, const PointedValue& theirs) {
    const ItemId one = ours.item ? ours.item : all_.match.ours(theirs.item);
    const ItemId other = theirs.item ? theirs.item : all_.match.theirs(ours.item);
    if (!one || !other) return false;
    if (change.old_pointer && !materials_.covers(all_.ours, *change.old_pointer)) return false;
    if (change.new_pointer && !materials_.covers(all_.theirs, *change.new_pointer)) return false;
    return materials_.are_alike(one.index, other.index);
  }

  // Filters that are not stated are those that a renderer takes anyway.
  bool keeps_sampler(const Change& change) const {
    // A sampler is part of its textures, and another object.
    if (change.also.empty() || !change.also.front().ends_with("/sampler")) return false;
    const bool is_ours = change.old_pointer.has_value();
    const ItemId item = find_pointed(is_ours ? all_.ours : all_.theirs, change.also.front()).item;
    const ItemId one = is_ours ? item : all_.match.ours(item);
    const ItemId other = all_.match.theirs(one);
    if (!one || !other) return false;
    const auto sampler_of = [](const Content& content, ItemId texture) {
      return model::read_texture(content.side().asset(), content.item(texture).node).sampler;
    };
    return sampler_of(all_.ours, one) == sampler_of(all_.theirs, other);
  }

  // The weights of each node, of its mesh if it has none, as long as the longer list.
  bool have_same_weights() const {
    bool same = true;
    all_.for_each_pair("/nodes", [&](ItemId ours, ItemId theirs) {
      const Side& here = all_.ours.side();
      const Side& there = all_.theirs.side();
      if (!here.views().nodes[ours.index].mesh || !there.views().nodes[theirs.index].mesh) return;
      auto one = model::morph_weights(here.asset(), here.views(), ours.index);
      auto other = model::morph_weights(there.asset(), there.views(), theirs.index);
      const std::size_t count = std::max(one.size(), other.size());
      one.resize(count);
      other.resize(count);
      same = same && one == other;
    });
    return same;
  }

  const Comparison& all_;
  DrawnMaterials materials_;
  const bool same_weights_;
};

}  // namespace

void forget_undrawn(const Comparison& comparison) {
  if (comparison.log.changes().empty()) return;
  Undrawn undrawn(comparison);
  comparison.log.forget([&](const Change& change) { return undrawn.is(change); });
}

}  // namespace gltfx::prove
