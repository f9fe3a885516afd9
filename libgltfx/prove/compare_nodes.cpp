// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "prove/compare_shapes.hpp"
#include "prove/drawn_items.hpp"

namespace gltfx::prove {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

std::string number(double value) { return fmt::format("{:.4g}", value); }

// The axis that a vector follows, or nothing.
std::string_view axis_of(const model::Vector3& vector) {
  constexpr std::string_view kAxes[] = {"x", "y", "z"};
  const double length = std::sqrt(model::dot(vector, vector));
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::fabs(vector[i]) > 0.9999 * length) return kAxes[i];
  }
  return {};
}

std::string shift_text(const model::Vector3& shift) {
  const std::string_view axis = axis_of(shift);
  if (!axis.empty()) {
    const std::size_t at = axis == "x" ? 0 : axis == "y" ? 1 : 2;
    return fmt::format("moved by {} along {}", number(shift[at]), axis);
  }
  return fmt::format("moved by ({}, {}, {})", number(shift[0]), number(shift[1]), number(shift[2]));
}

std::string turn_text(const model::Quaternion& from, const model::Quaternion& to) {
  const model::Quaternion p = model::unit(from);
  const model::Quaternion q = model::unit(to);
  // The rotation from one to the other: q times the inverse of p.
  const model::Vector3 a{-p[0], -p[1], -p[2]};
  const model::Vector3 b{q[0], q[1], q[2]};
  const model::Vector3 across = model::cross(b, a);
  model::Vector3 axis{};
  for (std::size_t i = 0; i < 3; ++i) axis[i] = q[3] * a[i] + p[3] * b[i] + across[i];
  const double cosine = q[3] * p[3] - model::dot(b, a);
  const double sine = std::sqrt(model::dot(axis, axis));
  double degrees = 2 * std::atan2(sine, std::fabs(cosine)) * 180 / std::numbers::pi;
  const std::string_view about = axis_of(axis);
  return about.empty() ? fmt::format("turned by {} deg", number(degrees))
                       : fmt::format("turned by {} deg about {}", number(degrees), about);
}

class NodeComparison {
 public:
  NodeComparison(const Comparison& all, const Helpers& helpers)
      : all_(all),
        helpers_(helpers),
        our_list_(all.ours.list("/nodes")),
        their_list_(all.theirs.list("/nodes")) {}

  void run() {
    compare_shapes(all_, helpers_, moved_);
    compare_places();
    compare_parents();
    compare_roots();
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

  // How far the farthest corner below a node moves in the scene.
  double movement(std::uint32_t node, std::uint32_t other) const {
    const model::Affine above = all_.our_nodes.parent_world(node);
    const model::Affine before = above * all_.our_nodes.local(node).affine;
    const model::Affine after = above * all_.their_nodes.local(other).affine;
    const double farthest = farthest_corner_of(all_.our_nodes.box(node), before, after);
    return std::isfinite(farthest) ? farthest : kUnknown;
  }

  void compare_places() {
    for (std::uint32_t i = 0; i < moved_.size(); ++i) {
      if (!moved_[i]) continue;
      const std::uint32_t other = all_.match.theirs(ours(i)).index;
      // Where the hierarchy does not count, the place in the scene does.
      if (all_.options.drawn && !have_same_parent(i, other)) continue;
      tell_moved(i, other);
    }
  }

  // Or none.
  bool have_same_parent(std::uint32_t node, std::uint32_t other) const {
    const model::NodeIndex one = all_.our_nodes.parent(node);
    const model::NodeIndex two = all_.their_nodes.parent(other);
    if (one == model::kNoNodeIndex || two == model::kNoNodeIndex) return one == two;
    return all_.match.theirs(ours(one)) == theirs(two);
  }

  void tell_moved(std::uint32_t node, std::uint32_t other) {
    const LocalPlace& before = all_.our_nodes.local(node);
    const LocalPlace& after = all_.their_nodes.local(other);
    const model::Node& here = our_node(node);
    const model::Node& there = their_node(other);
    std::vector<std::string> parts;
    std::vector<std::pair<json::NodeId, json::NodeId>> members;
    const bool whole = before.is_matrix || after.is_matrix;
    if (!whole && before.translation != after.translation) {
      model::Vector3 shift{};
      for (std::size_t i = 0; i < 3; ++i) shift[i] = after.translation[i] - before.translation[i];
      parts.push_back(shift_text(shift));
      members.emplace_back(here.translation, there.translation);
    }
    if (!whole && before.rotation != after.rotation) {
      parts.push_back(turn_text(before.rotation, after.rotation));
      members.emplace_back(here.rotation, there.rotation);
    }
    if (!whole && before.scale != after.scale) {
      parts.push_back(scale_text(before.scale, after.scale));
      members.emplace_back(here.scale, there.scale);
    }
    Change change;
    change.kind = "node.moved";
    change.name = all_.our_name(ours(node));
    change.old_pointer = all_.our_pointer(ours(node));
    change.new_pointer = all_.their_pointer(theirs(other));
    if (whole && here.matrix != json::kNoNode && there.matrix != json::kNoNode) {
      members.emplace_back(here.matrix, there.matrix);
    }
    if (members.size() == 1) {
      const auto [one, two] = members.front();
      const Side& left = all_.ours.side();
      const Side& right = all_.theirs.side();
      if (one != json::kNoNode) change.old_pointer = left.pointer(one);
      if (two != json::kNoNode) change.new_pointer = right.pointer(two);
      if (one != json::kNoNode) change.before = short_value(left.document(), one);
      if (two != json::kNoNode) change.after = short_value(right.document(), two);
    }
    change.what = parts.empty() ? std::string("has another matrix")
                                : fmt::format("{}", fmt::join(parts, ", "));
    const double distance = movement(node, other);
    const double part = all_.diagonal > 0 ? 100 * distance / all_.diagonal : kUnknown;
    const double bound = 100 * all_.options.bounds.position;
    change.measure = CompareMeasure{"position", part, "%", bound};
    if (part <= bound) measure_axes(before.affine, after.affine, *change.measure);
    change.level = change.measure->value <= change.measure->bound ? CompareLevel::bounds
                                                                  : CompareLevel::differs;
    all_.log.add(std::move(change));
  }

  // What a camera or a light looks at depends on its axes, not on its place.
  void measure_axes(const model::Affine& before, const model::Affine& after,
                    CompareMeasure& measure) const {
    double greatest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const model::Vector3& a = before.columns[i];
      const model::Vector3& b = after.columns[i];
      const model::Vector3 across = model::cross(a, b);
      const double angle = std::atan2(std::sqrt(model::dot(across, across)), model::dot(a, b));
      const double one = model::dot(a, a);
      const double other = model::dot(b, b);
      const double growth =
          one == other ? 0 : std::sqrt(std::max(one, other) / std::min(one, other)) - 1;
      greatest = std::max({greatest, angle, std::isnan(growth) ? 0 : growth});
    }
    greatest *= 180 / std::numbers::pi;
    const double bound = all_.options.bounds.normal;
    if (greatest > bound) measure = {"normal", greatest, "deg", bound};
  }

  static std::string scale_text(const model::Vector3& before, const model::Vector3& after) {
    const double factor = after[0] / before[0];
    const bool even =
        std::isfinite(factor) && after[1] / before[1] == factor && after[2] / before[2] == factor;
    if (even) return fmt::format("scaled by {}", number(factor));
    return fmt::format("scale ({}, {}, {}) -> ({}, {}, {})", number(before[0]), number(before[1]),
                       number(before[2]), number(after[0]), number(after[1]), number(after[2]));
  }

  void compare_parents() {
    for (std::uint32_t i = 0; our_list_ != kNoItem && i < all_.our_nodes.size(); ++i) {
      const ItemId other = all_.match.theirs(ours(i));
      if (!other) continue;
      const model::NodeIndex one = all_.our_nodes.parent(i);
      const model::NodeIndex two = all_.their_nodes.parent(other.index);
      if (have_same_parent(i, other.index)) continue;
      const ItemId above = one == model::kNoNodeIndex ? ItemId{} : ours(one);
      const ItemId above_there = two == model::kNoNodeIndex ? ItemId{} : theirs(two);
      Change change;
      change.kind = "node.parent";
      change.name = all_.our_name(ours(i));
      change.old_pointer = all_.our_pointer(ours(i));
      change.new_pointer = all_.their_pointer(other);
      change.before = above ? Comparison::called(all_.ours, above) : "the scene";
      change.after = above_there ? Comparison::called(all_.theirs, above_there) : "the scene";
      change.what = fmt::format("hangs below {}, not {}", change.after, change.before);
      if (above) change.also.push_back(all_.our_pointer(above) + "/children");
      if (above_there) change.also.push_back(all_.their_pointer(above_there) + "/children");
      all_.log.add(std::move(change));
      tell_drawn_elsewhere(i, other.index);
    }
  }

  // With `drawn` the hierarchy does not count, but the place in the scene does.
  void tell_drawn_elsewhere(std::uint32_t node, std::uint32_t other) {
    if (!all_.options.drawn) return;
    if (all_.our_drawn->in_scene(node) != all_.their_drawn->in_scene(other)) {
      return tell_shown(node, other);
    }
    const model::Affine& before = all_.our_nodes.world(node);
    const model::Affine& after = all_.their_nodes.world(other);
    if (before == after) return;
    const double farthest = farthest_corner_of(all_.our_nodes.box(node), before, after);
    const double part = all_.diagonal > 0 ? 100 * farthest / all_.diagonal : kUnknown;
    Change change;
    change.kind = "node.moved";
    change.name = all_.our_name(ours(node));
    change.old_pointer = all_.our_pointer(ours(node));
    change.new_pointer = all_.their_pointer(theirs(other));
    change.what = "is elsewhere in the scene, below another node";
    change.measure = CompareMeasure{"position", part, "%", 100 * all_.options.bounds.position};
    if (part <= change.measure->bound) measure_axes(before, after, *change.measure);
    change.level = change.measure->value <= change.measure->bound ? CompareLevel::bounds
                                                                  : CompareLevel::differs;
    all_.log.add(std::move(change));
  }

  // Only one of both is in a scene.
  void tell_shown(std::uint32_t node, std::uint32_t other) {
    const bool lost = all_.our_drawn->in_scene(node);
    if (lost ? !all_.our_drawn->shows(node) : !all_.their_drawn->shows(other)) return;
    Change change;
    change.kind = "scene.nodes";
    change.old_pointer = all_.our_pointer(ours(node));
    change.new_pointer = all_.their_pointer(theirs(other));
    change.name = all_.our_name(ours(node));
    change.what = lost ? "is in no scene any more" : "is in a scene now";
    all_.log.add(std::move(change));
  }

  void compare_roots() {
    const std::uint32_t scenes = all_.ours.list("/scenes");
    if (scenes == kNoItem) return;
    for (std::uint32_t i = 0; i < all_.ours.lists()[scenes].items.size(); ++i) {
      const ItemId scene{scenes, i};
      const ItemId other = all_.match.theirs(scene);
      if (!other || !all_.ours.side().document().is_object(all_.ours.item(scene).node) ||
          !all_.theirs.side().document().is_object(all_.theirs.item(other).node)) {
        continue;
      }
      std::set<std::uint32_t> here, there;  // by number of the old asset
      for (const std::uint32_t node : nodes_of_scene(all_.ours, scene)) {
        const ItemId partner = all_.match.theirs(ours(node));
        if (partner && keeps_root(node, partner.index)) here.insert(node);
      }
      for (const std::uint32_t node : nodes_of_scene(all_.theirs, other)) {
        const ItemId partner = all_.match.ours(theirs(node));
        if (partner && keeps_root(partner.index, node)) there.insert(partner.index);
      }
      const bool drawn = all_.options.drawn;
      for (const std::uint32_t node : here) {
        const bool counts = !drawn || all_.our_drawn->shows(node);
        if (counts && !there.contains(node)) tell_root(scene, other, node, true);
      }
      for (const std::uint32_t node : there) {
        const bool counts = !drawn || all_.their_drawn->shows(all_.match.theirs(ours(node)).index);
        if (counts && !here.contains(node)) tell_root(scene, other, node, false);
      }
    }
  }

  // Others have another parent, which is told.
  bool keeps_root(std::uint32_t node, std::uint32_t other) const {
    return all_.our_nodes.parent(node) == model::kNoNodeIndex &&
           all_.their_nodes.parent(other) == model::kNoNodeIndex;
  }

  void tell_root(ItemId scene, ItemId other, std::uint32_t node, bool lost) {
    Change change;
    change.kind = "scene.nodes";
    change.name = all_.our_name(scene);
    change.old_pointer = all_.our_pointer(scene) + "/nodes";
    change.new_pointer = all_.their_pointer(other) + "/nodes";
    change.what = fmt::format("{} {}", lost ? "no longer shows" : "shows",
                              Comparison::called(all_.ours, ours(node)));
    change.also.push_back(all_.our_pointer(ours(node)));
    all_.log.add(std::move(change));
  }

  const Comparison& all_;
  const Helpers& helpers_;
  const std::uint32_t our_list_, their_list_;
  std::vector<bool> moved_;
};

}  // namespace

void compare_nodes(const Comparison& comparison, const Helpers& helpers) {
  NodeComparison(comparison, helpers).run();
}

}  // namespace gltfx::prove
