// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_manifold: a solid, and vertices that are merged in it but separate in the drawn mesh.
// The checks need the indices, so this file names the extension.
#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/topology.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kManifoldsExtension = "EXT_mesh_manifold";

class ManifoldCheck {
 public:
  ManifoldCheck(DataPhase& phase, const ExtensionPlace& place, const Path& path)
      : phase_(phase),
        context_(phase.context),
        mesh_(context_.views.meshes[place.index]),
        object_(place.object),
        path_(path) {}

  void run() {
    const json::NodeId whole =
        model::object_member(context_.document, object_, "manifoldPrimitive");
    if (whole == json::kNoNode) return;
    const model::Primitive primitive = model::read_primitive(context_.asset, whole);
    if (!primitive.indices || primitive.mode != model::Mode::triangles) return;
    const auto indices = read_indices(phase_, *primitive.indices);
    if (!indices) return;
    check_closed(triangles_of(model::Mode::triangles, *indices));
    check_merges(primitive, *indices);
  }

 private:
  void report(std::string_view member, Code code, std::string message) const {
    report_member(phase_.sink, context_, path_, object_, member, code, std::move(message));
  }

  // Each edge of a triangle is shared with exactly one other triangle, in the opposite direction.
  void check_closed(const std::vector<Triangle>& triangles) const {
    std::vector<std::uint64_t> sides;
    sides.reserve(triangles.size() * 3);
    for (const Triangle& each : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        sides.push_back(std::uint64_t{each[i]} << 32U | each[(i + 1) % 3]);
      }
    }
    std::sort(sides.begin(), sides.end());
    std::size_t errors = 0;
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const std::uint64_t other = sides[i] << 32U | sides[i] >> 32U;
      const bool repeated = i > 0 && sides[i] == sides[i - 1];
      if (!repeated && std::binary_search(sides.begin(), sides.end(), other)) continue;
      if (errors++ == 0) first = sides[i];
    }
    if (errors == 0) return;
    report("manifoldPrimitive", Code::MANIFOLD_NOT_CLOSED,
           fmt::format("The edge from vertex {} to {} does not have exactly one opposite edge. {} "
                       "of {} edges are not closed.",
                       first >> 32U, first & UINT32_MAX, errors, sides.size()));
  }

  // --- Differences between the indices of the manifold and those that are drawn ---

  std::optional<std::uint32_t> accessor(std::string_view member) const {
    return context_.asset.index(object_, member, model::RootArray::accessors);
  }

  // The indices of all primitives, in their order in the buffer view.
  std::optional<Indices> drawn_indices() const {
    std::vector<std::uint32_t> parts;
    for (const model::Primitive& each : mesh_.primitives) {
      if (!each.indices) return std::nullopt;
      parts.push_back(*each.indices);
    }
    const auto& accessors = context_.views.accessors;
    std::sort(parts.begin(), parts.end(), [&](std::uint32_t a, std::uint32_t b) {
      return accessors[a].byte_offset.value_or(0) < accessors[b].byte_offset.value_or(0);
    });
    Indices all;
    for (const std::uint32_t part : parts) {
      const auto indices = read_indices(phase_, part);
      if (!indices) return std::nullopt;
      all.insert(all.end(), indices->begin(), indices->end());
    }
    return all;
  }

  void check_merges(const model::Primitive& primitive, const Indices& merged) {
    const auto drawn = drawn_indices();
    if (!drawn || drawn->size() != merged.size()) return;
    const auto places = accessor("mergeIndices");
    const auto values = accessor("mergeValues");
    std::unordered_map<std::uint32_t, std::uint32_t> merges;
    if (places && values && !read_merges(*places, *values, merges)) return;
    std::size_t unlisted = 0;
    for (std::size_t i = 0; i < merged.size(); ++i) {
      const auto found = merges.find(static_cast<std::uint32_t>(i));
      const bool listed = found != merges.end();
      if (listed ? found->second != merged[i] : (*drawn)[i] != merged[i]) ++unlisted;
    }
    if (unlisted != 0) {
      report(
          "mergeIndices", Code::MANIFOLD_MERGE_INVALID,
          fmt::format("{} indices of the manifold are neither drawn indices nor listed as merged.",
                      unlisted));
    }
    check_positions(primitive, merged, *drawn);
  }

  bool read_merges(std::uint32_t places, std::uint32_t values,
                   std::unordered_map<std::uint32_t, std::uint32_t>& merges) {
    const auto where = read_indices(phase_, places);
    const auto what = read_indices(phase_, values);
    if (!where || !what) return false;
    if (where->size() != what->size()) {
      report(
          "mergeIndices", Code::MANIFOLD_MERGE_INVALID,
          fmt::format("The number of merged indices is {}, but the number of merged values is {}.",
                      where->size(), what->size()));
      return false;
    }
    for (std::size_t i = 0; i < where->size(); ++i) merges[(*where)[i]] = (*what)[i];
    return true;
  }

  void check_positions(const model::Primitive& primitive, const Indices& merged,
                       const Indices& drawn) {
    const model::Attribute* position = primitive.find(model::SemanticKind::position);
    if (position == nullptr || !position->accessor || merged == drawn) return;
    const auto first = first_at_position(phase_, *position->accessor);
    if (!first) return;
    const auto place = [&](std::uint32_t vertex) {
      return vertex < first->size() ? (*first)[vertex] : UINT32_MAX;
    };
    for (std::size_t i = 0; i < merged.size(); ++i) {
      if (place(merged[i]) == place(drawn[i])) continue;
      report(
          "mergeValues", Code::MANIFOLD_MERGE_INVALID,
          fmt::format("Index {} refers to vertex {} instead of {}, which has a different position.",
                      i, merged[i], drawn[i]));
      return;
    }
  }

  DataPhase& phase_;
  const Context& context_;
  const model::Mesh& mesh_;
  json::NodeId object_;
  const Path& path_;
};

}  // namespace

void check_manifolds(DataPhase& phase) {
  for_each_extension(phase.context, model::RootArray::meshes, kManifoldsExtension,
                     [&](const ExtensionPlace& place, const Path& path) {
                       ManifoldCheck(phase, place, path).run();
                     });
}

}  // namespace gltfx::validate
