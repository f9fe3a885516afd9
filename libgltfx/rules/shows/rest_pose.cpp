// SPDX-License-Identifier: Apache-2.0
// Skinned meshes as nobody has posed them, and the reach of morph targets.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/geometry.hpp"
#include "model/pose.hpp"
#include "model/skin.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::Affine;
using model::NodeIndex;
using model::RootArray;
using model::Vector3;

// A joint is suspicious at this distance, and an edge has grown, in widths of the mesh. Rigs that
// are exported in another pose than the one they were bound in turn their joints, but leave them
// where bones end, and stretch edges by far less.
constexpr double kJointAway = 0.25;
constexpr double kGrown = 0.5;
// Of the edges. A few may belong to parts that are put aside on purpose.
constexpr double kMostGrown = 0.01;
// Where weights are smooth, a gap is spread over many short edges: the change of all lengths, in
// parts of their sum.
constexpr double kMostChange = 0.5;

double length_of(const Vector3& a) { return std::sqrt(model::dot(a, a)); }
Vector3 between(const Vector3& a, const Vector3& b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

// The point that a transform moves to 0.
std::optional<Vector3> origin_of(const Affine& transform) {
  const double determinant = transform.determinant();
  if (!std::isfinite(determinant) || determinant == 0) return std::nullopt;
  const auto& c = transform.columns;
  const Vector3 to{-c[3][0], -c[3][1], -c[3][2]};
  return Vector3{model::dot(to, model::cross(c[1], c[2])) / determinant,
                 model::dot(c[0], model::cross(to, c[2])) / determinant,
                 model::dot(c[0], model::cross(c[1], to)) / determinant};
}

// A skin at rest.
struct RestSkin {
  model::Skin skin;
  std::vector<Affine> matrices;  ///< from the mesh to the scene, by joint
  double scale = 1;              ///< that most joints have in common
  std::size_t worst = 0;         ///< the joint that is farthest from where its bone ends
  double away = 0;               ///< its distance, in the units of the mesh
};

double common_scale(const std::vector<Affine>& matrices) {
  std::vector<double> scales;
  for (const Affine& each : matrices) {
    const double scale = std::cbrt(std::abs(each.determinant()));
    if (std::isfinite(scale) && scale > 0) scales.push_back(scale);
  }
  if (scales.empty()) return 0;
  const auto half = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
  std::nth_element(scales.begin(), half, scales.end());
  return *half;
}

// The nearest joint above each joint, or the first joint for those without one.
std::vector<std::size_t> joints_above(const model::SceneGraph& graph, const model::Skin& skin) {
  std::map<NodeIndex, std::size_t> joints;
  for (std::size_t i = 0; i < skin.joint_nodes.size(); ++i) joints.emplace(skin.joint_nodes[i], i);
  std::vector<std::size_t> above(skin.joint_nodes.size(), 0);
  for (std::size_t i = 0; i < above.size(); ++i) {
    constexpr int kMostSteps = 64;  // helpers between joints are few
    NodeIndex node = graph.parent(skin.joint_nodes[i]);
    for (int step = 0; node != model::kNoNodeIndex && step < kMostSteps; ++step) {
      const auto found = joints.find(node);
      if (found != joints.end()) {
        above[i] = found->second;
        break;
      }
      node = graph.parent(node);
    }
  }
  return above;
}

class RestPose {
 public:
  explicit RestPose(DataPhase& phase)
      : phase_(phase),
        context_(phase.context),
        widths_(context_.views.meshes.size()),
        pose_(phase.pose()) {}

  void run() {
    const auto& skins = context_.asset.elements(RootArray::skins);
    std::vector<std::vector<std::uint32_t>> meshes(skins.size());
    for (std::size_t i = 0; i < context_.views.nodes.size(); ++i) {
      const model::Node& node = context_.views.nodes[i];
      if (!node.mesh || !node.skin || pose_.in_scene[i] == 0) continue;
      auto& of_skin = meshes[*node.skin];
      if (std::find(of_skin.begin(), of_skin.end(), *node.mesh) == of_skin.end() &&
          of_skin.size() < kMostMeshes) {
        of_skin.push_back(*node.mesh);
      }
    }
    for (std::uint32_t i = 0; i < skins.size(); ++i) {
      if (!meshes[i].empty()) check(i, meshes[i]);
    }
  }

 private:
  static constexpr std::size_t kMostMeshes = 64;

  struct Edges {
    std::uint64_t all = 0, grown = 0;
    double length = 0, change = 0;  ///< sums of lengths as bound, and of their changes

    bool fit() const {
      return static_cast<double>(grown) <= kMostGrown * static_cast<double>(all) &&
             change <= kMostChange * length;
    }
  };

  void check(std::uint32_t index, const std::vector<std::uint32_t>& meshes) {
    auto rest = read(index);
    if (!rest) return;
    for (const std::uint32_t mesh : meshes) {
      const double width = width_of(mesh);
      if (!(width > 0) || rest->away <= kJointAway * width) continue;
      const Edges edges = stretch(*rest, mesh, width);
      if (edges.fit()) continue;
      return report(index, *rest, mesh, width, edges);
    }
  }

  std::optional<RestSkin> read(std::uint32_t index) {
    RestSkin rest;
    rest.skin = model::read_skin(context_.asset, context_.asset.elements(RootArray::skins)[index]);
    rest.matrices =
        model::joint_matrices(context_.asset, context_.views, phase_.resources, index, pose_);
    if (rest.matrices.empty()) return std::nullopt;
    if (rest.skin.inverse_bind_matrices && !phase_.open(*rest.skin.inverse_bind_matrices)) {
      return std::nullopt;
    }
    rest.scale = common_scale(rest.matrices);
    if (!(rest.scale > 0)) return std::nullopt;
    find_worst(rest);
    return rest;
  }

  // Where the matrix of a joint puts the place that the joint was bound at is where the joint is.
  // The matrix of the joint above puts it there, too, if joints have only turned since.
  void find_worst(RestSkin& rest) const {
    const std::vector<std::size_t> above = joints_above(context_.graph, rest.skin);
    for (std::size_t i = 0; i < above.size(); ++i) {
      const Vector3 place = pose_.world[rest.skin.joint_nodes[i]].columns[3];
      const auto bound = bound_place(rest, i, place);
      if (!bound) continue;
      const double away =
          length_of(between(rest.matrices[above[i]].point(*bound), place)) / rest.scale;
      if (!(away > rest.away)) continue;
      rest.away = away;
      rest.worst = i;
    }
  }

  // In the space of the mesh.
  static std::optional<Vector3> bound_place(const RestSkin& rest, std::size_t joint,
                                            const Vector3& place) {
    Affine centered = rest.matrices[joint];
    for (std::size_t k = 0; k < 3; ++k) centered.columns[3][k] -= place[k];
    return origin_of(centered);
  }

  double width_of(std::uint32_t mesh) {
    std::optional<double>& width = widths_[mesh];
    if (!width) width = phase_.box_of_mesh(mesh).width();
    return *width;
  }

  Edges stretch(const RestSkin& rest, std::uint32_t mesh, double width) {
    Edges edges;
    // A file may list one mesh under many skins.
    if (!phase_.budget.take(context_.views.meshes[mesh].primitives.size(), 64)) return edges;
    model::MemoryBudget budget(kGeometryBytes);
    const model::GeometrySource source{context_.asset, context_.views, phase_.resources, draco_};
    for (const model::Primitive& primitive : context_.views.meshes[mesh].primitives) {
      if (model::joint_sets(primitive) == 0 || !take_work(primitive)) continue;
      model::Geometry bound;
      model::Geometry posed;
      model::GeometryRequest request{};
      if (read_geometry(source, primitive, request, budget, bound) != model::GeometryError::none) {
        continue;
      }
      request.joints = rest.matrices;
      if (read_geometry(source, primitive, request, budget, posed) != model::GeometryError::none) {
        continue;
      }
      if (!posed.skinned || posed.positions.size() != bound.positions.size()) continue;
      const Stretch own{bound, posed, rest.scale, width};
      own.add_triangles(edges);
      if (rest.skin.inverse_bind_matrices) own.add_seams(edges);
    }
    return edges;
  }

  bool take_work(const model::Primitive& primitive) {
    const model::Attribute* positions = primitive.find(model::SemanticKind::position);
    if (positions == nullptr || !positions->accessor) return false;
    const auto& count = context_.views.accessors[*positions->accessor].count;
    return count && phase_.budget.take(*count, 11);
  }

  // Edges before and after joints have moved them.
  struct Stretch {
    const model::Geometry& bound;
    const model::Geometry& posed;
    double scale;
    double width;

    static double distance(const model::Geometry& in, std::size_t a, std::size_t b) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double one =
            static_cast<double>(in.positions[a][k]) - static_cast<double>(in.positions[b][k]);
        sum += one * one;
      }
      return std::sqrt(sum);
    }
    void add(std::size_t a, std::size_t b, Edges& edges) const {
      const double before = distance(bound, a, b);
      const double longer = distance(posed, a, b) / scale - before;
      ++edges.all;
      if (longer > kGrown * width) ++edges.grown;
      edges.length += before;
      edges.change += std::abs(longer);
    }
    void add_triangles(Edges& edges) const {
      for (const model::Triangle& each : bound.triangles) {
        for (std::size_t k = 0; k < 3; ++k) add(each[k], each[(k + 1) % 3], edges);
      }
    }
    // Vertices at one place: corners of faces with normals of their own.
    void add_seams(Edges& edges) const {
      std::vector<std::uint32_t> order(bound.positions.size());
      std::iota(order.begin(), order.end(), 0U);
      std::erase_if(order, [&](std::uint32_t i) { return !is_finite(bound.positions[i]); });
      std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return bound.positions[a] != bound.positions[b] ? bound.positions[a] < bound.positions[b]
                                                        : a < b;
      });
      for (std::size_t i = 1; i < order.size(); ++i) {
        if (bound.positions[order[i]] == bound.positions[order[i - 1]]) {
          add(order[i - 1], order[i], edges);
        }
      }
    }
  };

  void report(std::uint32_t index, const RestSkin& rest, std::uint32_t mesh, double width,
              const Edges& edges) {
    const std::string joint =
        object_label(context_, RootArray::nodes, rest.skin.joint_nodes[rest.worst]);
    std::string message = fmt::format(
        "At rest, the joints change the edges of {} by {:.0f} % of their length on average, and {} "
        "of "
        "{} edges grow by more than half of the width of the mesh: the inverse bind matrices do "
        "not "
        "fit the joints. For example, {} is {:.3g} widths of the mesh away from the end of its "
        "bone.",
        object_label(context_, RootArray::meshes, mesh),
        100 * edges.change / std::max(edges.length, 1e-30), edges.grown, edges.all, joint,
        rest.away / width);
    const bool matrices = rest.skin.inverse_bind_matrices.has_value();
    report_at(
        phase_.sink, fmt::format("/skins/{}{}", index, matrices ? "/inverseBindMatrices" : ""),
        finding_on(context_, matrices ? rest.skin.inverse_bind_matrices_value : rest.skin.object,
                   Code::SKIN_STRETCHED_AT_REST, std::move(message)));
  }

  static constexpr std::uint64_t kGeometryBytes = std::uint64_t{1} << 28U;

  DataPhase& phase_;
  const Context& context_;
  std::vector<std::optional<double>> widths_;  ///< by mesh
  const model::Pose& pose_;
  const model::DracoMeshes draco_;  // none: bitstreams are not decoded twice
};

}  // namespace

void check_rest_pose(DataPhase& phase) {
  if (phase.context.asset.count(RootArray::skins) == 0) return;
  RestPose(phase).run();
}

void check_morph_reach(DataPhase& phase) {
  constexpr double kFar = 10;  // in widths of the mesh
  const Context& context = phase.context;
  for (std::size_t i = 0; i < context.views.meshes.size(); ++i) {
    const auto& primitives = context.views.meshes[i].primitives;
    const bool morphs = std::any_of(primitives.begin(), primitives.end(),
                                    [](const auto& each) { return !each.targets.empty(); });
    if (!morphs) continue;
    const double width = phase.box_of_mesh(static_cast<std::uint32_t>(i)).width();
    if (!(width > 0)) continue;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      for (std::size_t t = 0; t < primitives[p].targets.size(); ++t) {
        for (const model::Attribute& each :
             model::read_attributes(context.asset, primitives[p].targets[t])) {
          if (each.semantic.kind != model::SemanticKind::position || !each.accessor) continue;
          const double reach = phase.box_of(*each.accessor).reach();
          if (reach <= kFar * width) continue;
          report_at(
              phase.sink, fmt::format("/meshes/{}/primitives/{}/targets/{}/POSITION", i, p, t),
              finding_on(context, each.value, Code::MORPH_TARGET_FAR,
                         fmt::format("The target moves vertices by up to {:.3g}, {:.3g} times "
                                     "the width of the mesh, {:.3g}.",
                                     reach, reach / width, width)));
        }
      }
    }
  }
}

}  // namespace gltfx::validate
