// SPDX-License-Identifier: Apache-2.0
#include "prove/node_tree.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "model/instancing.hpp"
#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

template <std::size_t N>
bool read_numbers(const json::Document& document, json::NodeId array, std::array<double, N>& to) {
  if (array == json::kNoNode) return true;
  if (document.kind(array) != json::Kind::number_array || document.array_size(array) != N) {
    return false;
  }
  std::size_t i = 0;
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    to[i++] = at.number().value;
  }
  return true;
}

LocalPlace read_local(const json::Document& document, const model::Node& node) {
  LocalPlace local;
  if (node.object == json::kNoNode) return local;
  if (node.matrix != json::kNoNode) {
    local.is_matrix = true;
    std::array<double, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    local.readable = read_numbers(document, node.matrix, matrix);
    for (std::size_t i = 0; i < 4; ++i) {
      local.bottom[i] = matrix[4 * i + 3];
      for (std::size_t k = 0; k < 3; ++k) local.affine.columns[i][k] = matrix[4 * i + k];
    }
    return local;
  }
  const bool translation = read_numbers(document, node.translation, local.translation);
  const bool rotation = read_numbers(document, node.rotation, local.rotation);
  const bool scale = read_numbers(document, node.scale, local.scale);
  local.readable = translation && rotation && scale;
  local.affine = model::Affine::from_parts(local.translation, local.rotation, local.scale);
  return local;
}

double largest_entry(const model::Affine& a) {
  double largest = 0;
  for (const model::Vector3& column : a.columns) {
    for (const double each : column) largest = std::max(largest, std::fabs(each));
  }
  return largest;
}

double farthest_entry(const model::Affine& a, const model::Affine& b) {
  double farthest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      farthest = std::max(farthest, std::fabs(a.columns[i][k] - b.columns[i][k]));
    }
  }
  return farthest;
}

std::vector<std::uint32_t> listed_nodes(const Side& side, json::NodeId list) {
  std::vector<std::uint32_t> nodes;
  model::for_each_index(side.asset(), list, RootArray::nodes,
                        [&](std::uint64_t, const std::optional<std::uint32_t>& index, Span) {
                          if (index) nodes.push_back(*index);
                        });
  return nodes;
}

}  // namespace

bool same_place(const LocalPlace& a, const LocalPlace& b) {
  if (a.is_matrix != b.is_matrix) {
    constexpr double kSingle = 1.0 / (1 << 21);  // both may be rounded
    const double size = std::max(largest_entry(a.affine), largest_entry(b.affine));
    return farthest_entry(a.affine, b.affine) <= kSingle * size;
  }
  if (a.is_matrix) return a.affine == b.affine && a.bottom == b.bottom;
  model::Quaternion opposite = b.rotation;
  for (double& each : opposite) each = -each;
  return a.translation == b.translation && a.scale == b.scale &&
         (a.rotation == b.rotation || a.rotation == opposite);
}

std::vector<std::uint32_t> nodes_of_scene(const Content& content, ItemId scene) {
  const json::NodeId object = content.item(scene).node;
  const json::Document& document = content.side().document();
  if (!document.is_object(object)) return {};
  return listed_nodes(content.side(), document.find(object, "nodes"));
}

double farthest_corner_of(const Content::Box& box, const model::Affine& one,
                          const model::Affine& other) {
  double square = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const model::Vector3 a = one.point(box.corner(i));
    const model::Vector3 b = other.point(box.corner(i));
    const model::Vector3 apart{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    square = std::max(square, model::dot(apart, apart));
  }
  return std::sqrt(square);
}

double greatest_scale_of(const model::Affine& place) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    most = std::max(most, model::dot(place.columns[i], place.columns[i]));
  }
  return std::sqrt(most);
}

std::optional<std::vector<model::Affine>> read_copies(const Side& side, const model::Node& node,
                                                      model::MemoryBudget& budget) {
  auto copies = model::read_instancing(side.asset(), side.views(), side.resources(), node, budget);
  if (!copies || !copies->readable) return std::nullopt;
  return std::move(copies->transforms);
}

namespace {

// A mesh where its node draws it: once, or as copies.
void add_mesh(const Side& side, const model::Node& node, const Content::Box& mesh,
              model::MemoryBudget& budget, Content::Box& box) {
  const auto copies = read_copies(side, node, budget);
  if (!copies || mesh.empty()) return box.add(mesh);
  for (const model::Affine& each : *copies) {
    for (unsigned i = 0; i < 8; ++i) box.add(each.point(mesh.corner(i)));
  }
}

}  // namespace

NodeTree::NodeTree(const Content& content)
    : graph_(content.side().asset(), content.side().views().nodes) {
  read_locals(content);
  find_order(content);
  find_boxes(content);
}

void NodeTree::read_locals(const Content& content) {
  const Side& side = content.side();
  locals_.reserve(side.views().nodes.size());
  for (const model::Node& node : side.views().nodes) {
    locals_.push_back(read_local(side.document(), node));
  }
}

void NodeTree::find_order(const Content& content) {
  const Side& side = content.side();
  const std::size_t count = locals_.size();
  const std::uint32_t list = content.list("/nodes");
  children_.resize(count);
  places_.resize(count);
  worlds_.resize(count);
  std::vector<bool> taken(count);
  for (std::uint32_t node = 0; node < count; ++node) {
    for (const std::uint32_t child : listed_nodes(side, side.views().nodes[node].children)) {
      if (graph_.parent(child) != node || taken[child]) continue;
      taken[child] = true;
      children_[node].push_back(child);
    }
  }
  const auto add_root = [&](std::uint32_t node) {
    if (!graph_.is_root(node) || taken[node]) return;
    taken[node] = true;
    roots_.push_back(node);
  };
  for (const json::NodeId scene : side.asset().elements(RootArray::scenes)) {
    if (scene == json::kNoNode) continue;
    for (const std::uint32_t node : listed_nodes(side, side.document().find(scene, "nodes"))) {
      add_root(node);
    }
  }
  for (std::uint32_t node = 0; node < count; ++node) add_root(node);
  const auto enter = [&](const std::vector<std::uint32_t>& siblings, const Hash128& above) {
    std::unordered_map<Hash128, std::uint64_t, HashHasher> repeats;
    for (const std::uint32_t node : siblings) {
      const Hash128 label = content.item({list, node}).label;
      places_[node] = hash_of_all(above, label, repeats[label]++);
      order_.push_back(node);
    }
  };
  enter(roots_, {});
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const std::uint32_t node = order_[i];
    worlds_[node] = parent_world(node) * locals_[node].affine;
    enter(children_[node], places_[node]);
  }
}

void NodeTree::find_boxes(const Content& content) {
  const Side& side = content.side();
  model::MemoryBudget budget(kCopyBytes);
  boxes_.assign(locals_.size(), Content::Box::nothing());
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    const model::Node& node = side.views().nodes[*at];
    Content::Box& box = boxes_[*at];
    if (node.mesh) add_mesh(side, node, content.box(*node.mesh), budget, box);
    if (box.empty()) box.add(model::Vector3{0, 0, 0});
    const model::NodeIndex above = graph_.parent(*at);
    if (above == model::kNoNodeIndex) continue;
    for (unsigned i = 0; i < 8; ++i) {
      boxes_[above].add(locals_[*at].affine.point(box.corner(i)));
    }
  }
  Content::Box all = Content::Box::nothing();
  for (const std::uint32_t root : roots_) {
    for (unsigned i = 0; i < 8; ++i) all.add(worlds_[root].point(boxes_[root].corner(i)));
  }
  if (all.empty()) return;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) square += std::pow(all.greatest[i] - all.least[i], 2);
  diagonal_ = std::isfinite(square) ? std::sqrt(square) : 0;
}

model::Affine NodeTree::parent_world(std::uint32_t node) const {
  const model::NodeIndex above = graph_.parent(node);
  return above == model::kNoNodeIndex ? model::Affine{} : worlds_[above];
}

double NodeTree::greatest_scale(std::uint32_t node) const {
  return greatest_scale_of(worlds_[node]);
}

}  // namespace gltfx::prove
