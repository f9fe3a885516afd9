// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/fields.hpp"
#include "prove/column.hpp"
#include "prove/equal_images.hpp"
#include "prove/hash_sum.hpp"
#include "prove/lengths.hpp"
#include "prove/value_stand.hpp"

namespace gltfx::prove {
namespace {

/// What is found out for many values.
struct ValueFacts {
  explicit ValueFacts(const Comparison& all) : lengths(all), images(all) {}
  MaterialLengths lengths;
  EqualImages images;
};

bool is_plain(LeafKind kind) { return kind <= LeafKind::aside; }

/// Compares the leaves of two objects.
class ValuePair {
 public:
  ValuePair(const Comparison& all, ValueFacts& facts, const Item& ours, const Item& theirs,
            std::string_view list, std::string name)
      : all_(all),
        facts_(facts),
        ours_(ours),
        theirs_(theirs),
        list_(list),
        name_(std::move(name)) {}

  /// `skipped`: a leaf with that path does not count.
  void run(const Hash128* skipped) {
    const auto collect = [&](const Content& content, const Item& item) {
      std::vector<const Leaf*> leaves;
      for (std::uint32_t i = item.first; i < item.last; ++i) {
        const Leaf& leaf = content.leaves()[i];
        if (!is_plain(leaf.kind) || (skipped != nullptr && leaf.path == *skipped)) continue;
        leaves.push_back(&leaf);
      }
      std::stable_sort(leaves.begin(), leaves.end(),
                       [](const Leaf* a, const Leaf* b) { return hash_less(a->path, b->path); });
      return leaves;
    };
    const auto here = collect(all_.ours, ours_);
    const auto there = collect(all_.theirs, theirs_);
    std::vector<LeafPair> pairs;
    auto other = there.begin();
    for (const Leaf* leaf : here) {
      for (; other != there.end() && hash_less((*other)->path, leaf->path); ++other) {
        pairs.push_back({nullptr, *other});
      }
      const bool has_partner = other != there.end() && (*other)->path == leaf->path;
      pairs.push_back({leaf, has_partner ? *other++ : nullptr});
    }
    for (; other != there.end(); ++other) pairs.push_back({nullptr, *other});
    tell(std::move(pairs));
  }

 private:
  /// Leaves of one path; null: that side has none.
  struct LeafPair {
    const Leaf* ours = nullptr;
    const Leaf* theirs = nullptr;
  };

  // In the order of the texts, because the order of hashes is another one in each run.
  void tell(std::vector<LeafPair> pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const LeafPair& a, const LeafPair& b) {
      const bool added = a.ours == nullptr;
      if (added != (b.ours == nullptr)) return !added;
      return added ? a.theirs < b.theirs : a.ours < b.ours;
    });
    if (tell_sampler(pairs)) {
      std::erase_if(pairs, [this](const LeafPair& pair) { return is_of_sampler(pair); });
    }
    for (const LeafPair& pair : pairs) {
      if (pair.ours != nullptr && pair.theirs != nullptr) {
        both(*pair.ours, *pair.theirs);
      } else {
        only_one(pair.ours != nullptr ? *pair.ours : *pair.theirs, pair.ours != nullptr);
      }
    }
  }

  bool is_of_sampler(const LeafPair& pair) const {
    return pair.ours != nullptr ? is_of_sampler(all_.ours.side(), ours_, *pair.ours)
                                : is_of_sampler(all_.theirs.side(), theirs_, *pair.theirs);
  }

  // A texture that uses another sampler has changed once, whatever is different there.
  bool tell_sampler(const std::vector<LeafPair>& pairs) const {
    std::vector<std::string> parts;
    for (const LeafPair& pair : pairs) {
      if (!is_of_sampler(pair)) continue;
      const auto text = [](const Content& content, const Leaf* leaf) {
        return leaf == nullptr ? std::string("none")
                               : short_value(content.side().document(), leaf->at);
      };
      const bool same =
          pair.ours != nullptr && pair.theirs != nullptr && pair.ours->value == pair.theirs->value;
      if (same) continue;
      const std::string label = pair.ours != nullptr
                                    ? value_label(all_.ours.side(), pair.ours->at)
                                    : value_label(all_.theirs.side(), pair.theirs->at);
      parts.push_back(fmt::format("{} {} -> {}", label, text(all_.ours, pair.ours),
                                  text(all_.theirs, pair.theirs)));
    }
    const json::NodeId here = all_.ours.side().document().find(ours_.node, "sampler");
    const json::NodeId there = all_.theirs.side().document().find(theirs_.node, "sampler");
    if (parts.size() < 2 || here == json::kNoNode || there == json::kNoNode) return false;
    Change change;
    change.kind = kind_of(list_, "value");
    change.name = name_;
    change.old_pointer = all_.ours.side().pointer(here);
    change.new_pointer = all_.theirs.side().pointer(there);
    change.before = short_value(all_.ours.side().document(), here);
    change.after = short_value(all_.theirs.side().document(), there);
    if (change.before == change.after) return false;
    change.what = fmt::format("uses another sampler: {}", fmt::join(parts, ", "));
    all_.log.add(std::move(change));
    return true;
  }

  std::string_view kind(const Side& side, const Leaf& leaf) const {
    if (leaf.kind == LeafKind::extras) return "extras";
    if (leaf.kind == LeafKind::foreign) return "extension.unknown";
    if (!list_.empty()) return kind_of(list_, "value");
    return side.pointer(leaf.at) == "/asset/generator" ? "generator" : "asset.value";
  }

  void both(const Leaf& ours, const Leaf& theirs) {
    const Side& here = all_.ours.side();
    const Side& there = all_.theirs.side();
    if (ours.value == theirs.value && (all_.match.same(ours.target, theirs.target) ||
                                       facts_.images.are_equal(ours.target, theirs.target))) {
      const bool partners = !ours.target || all_.match.theirs(ours.target) == theirs.target;
      if (!partners) all_.log.note_equal(here.pointer(ours.at));
      return;
    }
    if (names_gone(ours.at, theirs.at)) return;
    const std::optional<double> length = apart_in_scene(ours, theirs);
    if (length == 0.0) return;
    Change change;
    change.kind = kind(here, ours);
    const bool renamed =
        ours.kind == LeafKind::name && !list_.empty() && here.tree().parent(ours.at) == ours_.node;
    if (renamed) change.kind = kind_of(list_, "renamed");
    change.old_pointer = here.pointer(ours.at);
    change.new_pointer = there.pointer(theirs.at);
    change.name = name_;
    change.before = short_value(here.document(), ours.at);
    change.after = short_value(there.document(), theirs.at);
    change.what =
        fmt::format("{} {} -> {}", value_label(here, ours.at), change.before, change.after);
    if (ours.target || theirs.target) {
      change.what = fmt::format("{} refers to {}, not {}", value_label(here, ours.at),
                                Comparison::called(all_.theirs, theirs.target),
                                Comparison::called(all_.ours, ours.target));
    } else if (length && all_.diagonal > 0) {
      const double bound = all_.options.bounds.position;
      const double part = *length / all_.diagonal;
      change.measure = CompareMeasure{"position", 100 * part, "%", 100 * bound};
      if (part <= bound) change.level = CompareLevel::bounds;
    } else {
      measure(ours, theirs, change);
    }
    if (is_of_sampler(here, ours_, ours)) {
      change.also.push_back(here.pointer(ours_.node) + "/sampler");
    }
    if (renamed) change.what = fmt::format("renamed {} -> {}", change.before, change.after);
    all_.log.add(std::move(change));
  }

  // "scale was removed"; of extensions, which.
  static std::string lost_text(const json::Document& document, json::NodeId value,
                               const std::string& step, const std::string& text,
                               std::string_view fate) {
    constexpr std::size_t kMostNames = 3;
    std::vector<std::string> names;
    if (step == "extensions" && value != json::kNoNode && document.is_object(value)) {
      for (const auto member : document.members(value)) {
        names.push_back(printable(std::string(document.key(member.key_id)).substr(0, 80)));
      }
    }
    if (names.empty()) return fmt::format("{}{} was {}", printable(step), text, fate);
    const std::size_t more = names.size() - std::min(names.size(), kMostNames);
    const bool one = names.size() == 1;
    names.resize(names.size() - more);
    return fmt::format("{}{} {} {}", fmt::join(names, ", "),
                       more > 0 ? fmt::format(" and {} more", more) : "", one ? "was" : "were",
                       fate);
  }

  // Of a length in the space of meshes, which may have another scale than before.
  std::optional<double> apart_in_scene(const Leaf& ours, const Leaf& theirs) const {
    const json::Document& here = all_.ours.side().document();
    const json::Document& there = all_.theirs.side().document();
    if (list_ != "/materials" || ours.target || theirs.target) return std::nullopt;
    if (!here.is_number(ours.at) || !there.is_number(theirs.at)) return std::nullopt;
    if (value_label(all_.ours.side(), ours.at) != "thicknessFactor") return std::nullopt;
    return facts_.lengths.apart_in_scene(all_.ours.find(ours_.node), here.number(ours.at).value,
                                         all_.theirs.find(theirs_.node),
                                         there.number(theirs.at).value);
  }

  // Numbers of materials, lights and cameras have a bound. An index that leads to other data has
  // none.
  void measure(const Leaf& ours, const Leaf& theirs, Change& change) const {
    const Side& here = all_.ours.side();
    const Side& there = all_.theirs.side();
    if (here.link(ours.at) != nullptr || there.link(theirs.at) != nullptr) {
      if (change.before == change.after) {
        change.what = fmt::format("{} leads to other data", value_label(here, ours.at));
      }
      return;
    }
    const NumbersApart apart = numbers_apart(here.document(), ours.at, there.document(), theirs.at);
    if (apart.differing == 1 && apart.is_list) {
      *change.old_pointer += fmt::format("/{}", apart.which);
      *change.new_pointer += fmt::format("/{}", apart.which);
    }
    const bool bounded = list_ == "/materials" || list_ == "/cameras" ||
                         (list_.starts_with("/extensions/") && list_.size() > 12);
    if (apart.differing == 0 || !bounded || ours.kind != LeafKind::value) return;
    const double bound = all_.options.bounds.factor;
    change.measure = CompareMeasure{"factor", apart.most, "", bound};
    if (apart.most <= bound) change.level = CompareLevel::bounds;
  }

  // Whether one value names an object that is gone, which is told, and the other one names nothing.
  bool names_gone(json::NodeId ours, json::NodeId theirs) const {
    const auto target_of = [](const Content& content, json::NodeId value) {
      const Link* link = content.side().link(value);
      return link == nullptr ? ItemId{} : content.find(link->target);
    };
    const ItemId here = target_of(all_.ours, ours);
    const ItemId there = target_of(all_.theirs, theirs);
    if (here && there) return false;
    return (here && !all_.match.theirs(here)) || (there && !all_.match.ours(there));
  }

  // Whether the value is in the member that is named like the type of its object, which is another
  // one now: the parts of a camera, a light or a shape, which come and go with it.
  bool is_of_changed_type(const Side& side, const Item& item, const Leaf& leaf) const {
    const json::Document& here = all_.ours.side().document();
    const json::Document& there = all_.theirs.side().document();
    const std::string before = model::string_member(here, ours_.node, "type");
    const std::string after = model::string_member(there, theirs_.node, "type");
    if (before == after || before.empty() || after.empty()) return false;
    const std::vector<std::string> steps = steps_to(side, item.node, leaf.at);
    return steps.size() > 1 && steps.front() == (&item == &ours_ ? before : after);
  }

  void only_one(const Leaf& leaf, bool ours) {
    if (leaf.kind == LeafKind::aside) return;
    const Side& side = ours ? all_.ours.side() : all_.theirs.side();
    const Side& other = ours ? all_.theirs.side() : all_.ours.side();
    const Item& item = ours ? ours_ : theirs_;
    const Item& partner = ours ? theirs_ : ours_;
    if (is_of_changed_type(side, item, leaf)) return;
    std::string own = side.pointer(leaf.at);
    Stand stand = find_stand(side, item.node, other, partner.node, leaf.at, own);
    if (stand.there && names_gone(ours ? leaf.at : stand.value, ours ? stand.value : leaf.at))
      return;
    const bool in_sampler = is_of_sampler(side, item, leaf);
    if (in_sampler && !other.asset().index(partner.node, "sampler", model::RootArray::samplers)) {
      // An index that leads to none is a value of its own.
      if (other.document().find(partner.node, "sampler") != json::kNoNode) return;
      own = side.pointer(item.node) + "/sampler";
      stand.value = side.document().find(item.node, "sampler");
    }
    Change change;
    change.kind = kind(side, leaf);
    const bool is_name = leaf.kind == LeafKind::name && side.tree().parent(leaf.at) == item.node;
    if (is_name && !list_.empty()) change.kind = kind_of(list_, "renamed");
    change.name = name_;
    std::string& text = ours ? change.before : change.after;
    const bool whole = !stand.there && stand.value != json::kNoNode;
    if (whole && is_element(side, leaf, stand.value)) change.kind = kind_of(list_, "value");
    text = short_value(side.document(), whole ? stand.value : leaf.at);
    auto& pointer = ours ? change.old_pointer : change.new_pointer;
    auto& other_pointer = ours ? change.new_pointer : change.old_pointer;
    pointer = own;
    const std::string what = value_label(side, leaf.at);
    if (stand.there) {
      other_pointer = stand.pointer;
      (ours ? change.after : change.before) = short_value(other.document(), stand.value);
      change.what = fmt::format("{} {} -> {}", what, change.before, change.after);
    } else {
      const bool itself = (!whole || stand.value == leaf.at) && is_short(side.document(), leaf.at);
      const std::string value = itself ? " " + text : std::string();
      change.what = lost_text(side.document(), stand.value, own.substr(own.rfind('/') + 1), value,
                              ours ? "removed" : "added");
    }
    if (in_sampler) change.also.push_back(side.pointer(item.node) + "/sampler");
    all_.log.add(std::move(change));
  }

  // A number or a word, which a sentence can hold.
  static bool is_short(const json::Document& document, json::NodeId value) {
    constexpr std::size_t kMost = 40;
    const json::Kind kind = document.kind(value);
    return kind <= json::Kind::string && document.raw(value).size() <= kMost;
  }

  // Whether a leaf is missing with an element of a list of its object, such as a primitive.
  bool is_element(const Side& side, const Leaf& leaf, json::NodeId missing) const {
    const graph::Tree& tree = side.tree();
    if (list_.empty() || missing == leaf.at || missing == 0 || tree.is_member(missing))
      return false;
    const json::NodeId array = tree.parent(missing);
    if (!tree.is_member(array) || tree.name(array) == "extras") return false;
    const bool ours = &side == &all_.ours.side();
    return tree.parent(array) == (ours ? ours_ : theirs_).node;
  }

  // The sampler of a texture is part of it, but another object.
  static bool is_of_sampler(const Side& side, const Item& item, const Leaf& leaf) {
    const graph::Tree& tree = side.tree();
    const json::NodeId object = tree.root_element(leaf.at);
    return object != json::kNoNode && object != item.node && item.node != 0 &&
           tree.root_element(item.node) == item.node;
  }

  const Comparison& all_;
  ValueFacts& facts_;
  const Item& ours_;
  const Item& theirs_;
  const std::string_view list_;
  const std::string name_;
};

// Leaves in the same order with equal values, as most objects have.
bool have_equal_leaves(const Comparison& all, const Item& ours, const Item& theirs) {
  if (ours.last - ours.first != theirs.last - theirs.first) return false;
  for (std::uint32_t i = 0; i < ours.last - ours.first; ++i) {
    const Leaf& one = all.ours.leaves()[ours.first + i];
    const Leaf& other = all.theirs.leaves()[theirs.first + i];
    if (one.path != other.path || one.kind != other.kind) return false;
    if (!is_plain(one.kind)) continue;
    if (one.value != other.value || all.match.theirs(one.target) != other.target) return false;
  }
  return true;
}

}  // namespace

void compare_values(const Comparison& all, const Helpers& helpers) {
  const Hash128 mesh = hash_of_all(Hash128{}, hash_content("mesh"));
  ValueFacts facts(all);
  for (std::uint32_t list = 0; list < all.ours.lists().size(); ++list) {
    const ItemList& items = all.ours.lists()[list];
    const bool nodes = items.pointer == "/nodes";
    for (std::uint32_t i = 0; i < items.items.size(); ++i) {
      const ItemId ours{list, i};
      const ItemId theirs = all.match.theirs(ours);
      if (!theirs || have_equal_leaves(all, all.ours.item(ours), all.theirs.item(theirs))) continue;
      const bool helped =
          nodes && (helpers.ours[i] != kNoItem || helpers.theirs[theirs.index] != kNoItem);
      ValuePair(all, facts, all.ours.item(ours), all.theirs.item(theirs), items.pointer,
                all.our_name(ours))
          .run(helped ? &mesh : nullptr);
    }
  }
  ValuePair(all, facts, all.ours.root(), all.theirs.root(), "", "").run(nullptr);
  compare_extensions(all);
}

}  // namespace gltfx::prove
