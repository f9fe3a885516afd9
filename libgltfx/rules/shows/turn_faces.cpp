// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/turn_faces.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "rules/core/fix_elements.hpp"

namespace gltfx::validate {
namespace {

using model::Primitive;
using model::RootArray;

bool has_one_user(Fixing& fixing, std::uint32_t accessor) {
  return fixing.graph().users(fixing.views().accessors[accessor].node).size() == 1;
}

// The index accessor, if its triangles can be turned and nothing else uses it.
std::optional<Elements> writable_triangles(Fixing& fixing, const Primitive& primitive) {
  if (primitive.mode != model::Mode::triangles || !primitive.indices ||
      !has_one_user(fixing, *primitive.indices)) {
    return std::nullopt;
  }
  return open_elements(fixing, *primitive.indices, "indices");
}

std::optional<Elements> writable_normals(Fixing& fixing, const Primitive& primitive) {
  const model::Attribute* normal = primitive.find(model::SemanticKind::normal);
  if (normal == nullptr || !normal->accessor || !has_one_user(fixing, *normal->accessor)) {
    return std::nullopt;
  }
  return open_elements(fixing, *normal->accessor, "NORMAL");
}

void turn_triangles(Fixing& fixing, const Primitive& primitive, Elements& indices) {
  for (std::uint64_t i = 0; i + 2 < indices.count(); i += 3) {
    const double second = indices.get(i + 1, 0);
    indices.set(i + 1, 0, indices.get(i + 2, 0));
    indices.set(i + 2, 0, second);
  }
  fixing.claim(fixing.views().accessors[*primitive.indices].node);
}

void turn_normals(Fixing& fixing, const Primitive& primitive, Elements& normals) {
  const model::ComponentType type = normals.format().component;
  const double most = normals.is_float() ? 1e30 : model::value_range(type).most;
  for (std::uint64_t i = 0; i < normals.count(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const double value = normals.get(i, k);
      // No -0, and no number that an integer cannot hold.
      normals.set(i, k, value == 0 ? 0 : std::min(-value, most));
    }
  }
  const model::Attribute* normal = primitive.find(model::SemanticKind::normal);
  follow_with_bounds(fixing, *normal->accessor, normals);
}

// The primitives that a finding is about: one, or all of a mesh.
std::vector<const Primitive*> primitives_at(Fixing& fixing, const Subject& subject) {
  std::vector<const Primitive*> found;
  const json::NodeId root = fixing.tree().root_element(subject.node());
  const auto mesh = fixing.index(RootArray::meshes, root);
  if (!mesh) return found;
  for (const Primitive& each : fixing.views().meshes[*mesh].primitives) {
    const bool whole = subject.node() == root;
    const bool own = each.node == subject.node();
    const model::Attribute* normal = each.find(model::SemanticKind::normal);
    if (whole || own || (normal != nullptr && normal->value == subject.node())) {
      found.push_back(&each);
    }
  }
  return found;
}

}  // namespace

bool turn_wrong_one(Fixing& fixing, const Subject& subject) {
  const auto primitives = primitives_at(fixing, subject);
  if (primitives.size() != 1) return false;
  if (primitives.front()->node == subject.node()) {
    auto indices = writable_triangles(fixing, *primitives.front());
    if (!indices) return false;
    turn_triangles(fixing, *primitives.front(), *indices);
    return true;
  }
  auto normals = writable_normals(fixing, *primitives.front());
  if (!normals) return false;
  turn_normals(fixing, *primitives.front(), *normals);
  return true;
}

bool turn_inside_out(Fixing& fixing, const Subject& subject) {
  const auto primitives = primitives_at(fixing, subject);
  std::vector<Elements> indices;
  std::vector<std::optional<Elements>> normals;
  for (const Primitive* each : primitives) {
    auto own = writable_triangles(fixing, *each);
    auto lit = writable_normals(fixing, *each);
    if (!own || (each->find(model::SemanticKind::normal) != nullptr && !lit)) return false;
    indices.push_back(*std::move(own));
    normals.push_back(std::move(lit));
  }
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    turn_triangles(fixing, *primitives[i], indices[i]);
    if (normals[i]) turn_normals(fixing, *primitives[i], *normals[i]);
  }
  return !primitives.empty();
}

}  // namespace gltfx::validate
