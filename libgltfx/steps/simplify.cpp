// SPDX-License-Identifier: Apache-2.0
// Removes triangles of a surface within a measured error.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/equal_records.hpp"
#include "base/parallel.hpp"
#include "model/elements.hpp"
#include "report/wording.hpp"
#include "steps/simplify_places.hpp"
#include "steps/simplify_search.hpp"
#include "steps/storage.hpp"
#include "steps/vertex_sets.hpp"

namespace gltfx::steps {
namespace {

constexpr std::uint32_t kUnused = UINT32_MAX;

/// A set of vertices with its jobs, one for each list of indices.
struct SimplifySet {
  const VertexSet* set = nullptr;
  OpenedVertices vertices;
  std::size_t first_job = 0;  ///< of as many as there are lists
};

/// Triangles, and lists of them.
struct SimplifyCounts {
  std::uint64_t before = 0, after = 0;  ///< of lists that could change
  std::uint64_t left = 0;               ///< of primitives that are left
  std::uint64_t lists = 0;              ///< that change
};

class Simplifier {
 public:
  explicit Simplifier(const StepInput& input)
      : data_(input),
        changes_(data_),
        numbers_(data_),
        wanted_(*input.options.simplify),
        sets_(find_vertex_sets(data_)) {}

  Result<StepOutcome> run() {
    for (const VertexSet& set : sets_) {
      std::string why = set.obstacle.empty() ? add(set) : set.obstacle;
      if (!why.empty()) leave(set, std::move(why));
    }
    if (jobs_.empty()) return std::move(outcome_);
    auto places = find_simplify_places(data_, jobs_, counts_.left > 0);
    if (!places) return places.error();
    simplify(*places);
    for (const SimplifySet& each : opened_) store(each);
    if (counts_.after == counts_.before) return std::move(outcome_);
    if (std::string why = find_doubt(data_.graph, "accessors"); !why.empty()) {
      outcome_.row.refused.push_back({{}, std::move(why)});
      return std::move(outcome_);
    }
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.own_proof = true;
    describe(*places);
    return std::move(outcome_);
  }

 private:
  void leave(const VertexSet& set, std::string why) {
    for (const model::Primitive* primitive : set.primitives)
      counts_.left += triangles_of(*primitive);
    outcome_.row.left.push_back({place_of(data_, set), std::move(why)});
  }

  std::uint64_t triangles_of(const model::Primitive& primitive) const {
    if (!primitive.mode || !model::draws_triangles(*primitive.mode)) return 0;
    const model::Attribute* const at = primitive.find(model::SemanticKind::position);
    const auto counted = primitive.indices ? primitive.indices
                         : at != nullptr   ? at->accessor
                                           : std::nullopt;
    if (!counted) return 0;
    const std::uint64_t count = data_.views.accessors[*counted].count.value_or(0);
    return primitive.mode == model::Mode::triangles ? count / 3
                                                    : count - std::min<std::uint64_t>(count, 2);
  }

  static std::string obstacle_of(const model::Primitive& primitive) {
    if (primitive.mode != model::Mode::triangles) return "has primitives that are not triangles";
    if (!primitive.indices) return "has triangles without indices, which share no vertices";
    if (!primitive.targets.empty()) return "has morph targets";
    if (primitive.find(model::SemanticKind::joints) != nullptr) return "is skinned";
    const model::Attribute* const at = primitive.find(model::SemanticKind::position);
    return at == nullptr || !at->accessor ? "has no positions" : std::string();
  }

  // Why a set is left; empty: it is not.
  std::string add(const VertexSet& set) {
    for (const model::Primitive* primitive : set.primitives) {
      if (std::string why = obstacle_of(*primitive); !why.empty()) return why;
    }
    SimplifySet opened{&set, {}, jobs_.size()};
    if (std::string why = open_vertices(data_, set, opened.vertices); !why.empty()) return why;
    std::map<std::uint32_t, const model::Primitive*> by_indices;
    for (const model::Primitive* primitive : set.primitives) {
      const auto [first, is_new] = by_indices.try_emplace(*primitive->indices, primitive);
      if (!is_new && positions_of(*first->second) != positions_of(*primitive))
        return "shares its indices with primitives that have other positions";
    }
    std::vector<SimplifyJob> jobs;
    for (const IndexList& list : opened.vertices.indices) {
      const model::Primitive& primitive = *by_indices.at(list.accessor);
      std::string why = read(primitive, opened.vertices, list, jobs.emplace_back());
      if (!why.empty()) return why;
    }
    std::move(jobs.begin(), jobs.end(), std::back_inserter(jobs_));
    opened_.push_back(std::move(opened));
    return {};
  }

  static std::uint32_t positions_of(const model::Primitive& primitive) {
    return *primitive.find(model::SemanticKind::position)->accessor;
  }

  std::string read(const model::Primitive& primitive, const OpenedVertices& vertices,
                   const IndexList& list, SimplifyJob& job) {
    job.corners = read_index_list(list.data);
    if (job.corners.empty() || job.corners.size() % 3 != 0) return "has an incomplete triangle";
    for (const std::uint32_t corner : job.corners) {
      if (corner >= vertices.count) return "has an index that is out of range";
      if (corner == restart_index(list.data))
        return "has an index that is reserved for primitive restart";
    }
    localize(job, static_cast<std::size_t>(vertices.count));
    const graph::Tree& tree = data_.graph.tree();
    job.primitive = primitive.node;
    job.mesh = tree.position(tree.parent(tree.parent(primitive.node)));
    for (const model::Attribute& attribute : primitive.attributes) {
      const bool is_normal = attribute.semantic.kind == model::SemanticKind::normal;
      if (!is_normal && attribute.semantic.kind != model::SemanticKind::texcoord) continue;
      job.values.push_back({is_normal, column_of(vertices, *attribute.accessor, job)});
    }
    return read_points(vertices, positions_of(primitive), job);
  }

  // Numbers vertices by first use, so that time and memory depend only on the length of the list.
  void localize(SimplifyJob& job, std::size_t vertices) {
    if (local_.size() < vertices) local_.resize(vertices, kUnused);
    for (std::uint32_t& corner : job.corners) {
      std::uint32_t& number = local_[corner];
      if (number == kUnused) {
        number = static_cast<std::uint32_t>(job.vertices.size());
        job.vertices.push_back(corner);
      }
      corner = number;
    }
    for (const std::uint32_t vertex : job.vertices) local_[vertex] = kUnused;
  }

  // The elements of the vertices of a job, in at most three components.
  model::Vectors<3> column_of(const OpenedVertices& vertices, std::uint32_t accessor,
                              const SimplifyJob& job) {
    model::Vectors<3>& all = columns_[accessor];
    if (all.empty()) {
      const auto column = std::lower_bound(
          vertices.columns.begin(), vertices.columns.end(), accessor,
          [](const VertexColumn& each, std::uint32_t wanted) { return each.accessor < wanted; });
      all.resize(static_cast<std::size_t>(vertices.count));
      if (column->data.components() <= 3) model::read_elements(column->data, all);
    }
    model::Vectors<3> own;
    own.reserve(job.vertices.size());
    for (const std::uint32_t vertex : job.vertices) own.push_back(all[vertex]);
    return own;
  }

  std::string read_points(const OpenedVertices& vertices, std::uint32_t accessor,
                          SimplifyJob& job) {
    job.positions = column_of(vertices, accessor, job);
    for (std::array<float, 3>& position : job.positions) {
      for (float& each : position) {
        if (!std::isfinite(each)) return "has positions that are not finite";
        if (each == 0) each = 0;  // not -0, which is the same place
      }
    }
    std::string records(job.positions.size() * sizeof(job.positions.front()), '\0');
    std::memcpy(records.data(), job.positions.data(), records.size());
    job.same = first_equal_records(records, sizeof(job.positions.front()));
    return model::is_affordable(job.surface(), job.same) ? std::string()
                                                         : "has too many triangles at a vertex";
  }

  void simplify(const SimplifyPlaces& places) {
    const unsigned jobs = data_.input.options.jobs;
    for (const SimplifyJob& job : jobs_) counts_.before += job.corners.size() / 3;
    if (wanted_.triangles > 0) {
      const std::uint64_t most = std::max(wanted_.triangles, counts_.left + 1) - counts_.left;
      if (counts_.before > most) return simplify_to(jobs_, most, jobs);
      for (SimplifyJob& job : jobs_) job.result = job.corners;
      return;
    }
    const bool side_by_side = jobs_.size() > 2;
    parallel_ordered(
        jobs_.size(), side_by_side ? jobs : 1,
        [&](std::size_t i) {
          simplify_within(jobs_[i], wanted_.error * places.diagonals[i], side_by_side ? 1 : jobs);
        },
        [](std::size_t) {});
  }

  void store(const SimplifySet& each) {
    bool changes = false;
    std::uint64_t old_triangles = 0, triangles = 0;
    const std::size_t lists = each.vertices.indices.size();
    for (std::size_t i = each.first_job; i < each.first_job + lists; ++i) {
      changes |= jobs_[i].changes();
      old_triangles += jobs_[i].corners.size() / 3;
      triangles += jobs_[i].result.size() / 3;
      if (!jobs_[i].why.empty())
        outcome_.row.left.push_back({data_.pointer(jobs_[i].primitive), jobs_[i].why});
    }
    if (changes) {
      if (std::string why = numbers_.find(*each.set); !why.empty()) {
        outcome_.row.refused.push_back({place_of(data_, *each.set), std::move(why)});
        changes = false;
      }
    }
    counts_.after += changes ? triangles : old_triangles;
    for (std::size_t i = each.first_job; i < each.first_job + lists; ++i) {
      if (!changes) jobs_[i].result = jobs_[i].corners;
      if (jobs_[i].changes()) ++counts_.lists;
    }
    if (changes) store_used(each);
  }

  // Without the vertices that no triangle uses any more.
  void store_used(const SimplifySet& each) {
    const std::size_t lists = each.vertices.indices.size();
    std::vector<std::uint32_t> numbers(static_cast<std::size_t>(each.vertices.count), kUnused);
    std::vector<std::vector<std::uint32_t>> indices;
    for (std::size_t i = 0; i < lists; ++i) {
      const SimplifyJob& job = jobs_[each.first_job + i];
      indices.push_back(job.result);
      for (std::uint32_t& index : indices.back()) {
        index = job.vertices[index];
        numbers[index] = 0;
      }
    }
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] == kUnused) continue;
      numbers[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(i);
    }
    for (auto& list : indices) {
      for (std::uint32_t& index : list) index = numbers[index];
    }
    store_vertices(changes_, each.vertices, kept, indices, true);
  }

  void describe(const SimplifyPlaces& places) {
    outcome_.row.what =
        fmt::format("{} -> {} triangles in {}", counts_.before + counts_.left,
                    counts_.after + counts_.left, report::counted(counts_.lists, "primitive"));
    double surface = 0, slide = 0, angle = 0;
    bool textures = false, normals = false;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const SimplifyJob& job = jobs_[i];
      if (!job.changes() || !(places.diagonals[i] > 0)) continue;
      surface = std::max(surface, 100 * job.measured / places.diagonals[i]);
      slide = std::max(slide, 100 * job.drift.slide / places.diagonals[i]);
      angle = std::max(angle, job.drift.angle);
      for (const auto& values : job.values) (values.directions ? normals : textures) = true;
    }
    // With a number of triangles, what it takes is the bound.
    const bool within = wanted_.triangles == 0;
    const double percent = 100 * wanted_.error;
    const auto lose = [&](const char* quantity, double bound, double measured, const char* unit) {
      if (!within) bound = measured;
      if (bound > 0) outcome_.row.losses.push_back({quantity, bound, measured, unit});
    };
    lose("surface", percent, surface, " %");
    if (textures) lose("textures", percent, slide, " %");
    if (normals) lose("normals", kMostAngle, angle, " deg");
    if (wanted_.triangles > 0 && counts_.after + counts_.left > wanted_.triangles)
      outcome_.row.left.push_back({"", "fewer triangles would tear borders or seams"});
  }

  const StepData data_;
  StepChanges changes_;
  VertexNumbers numbers_;
  const Simplification wanted_;
  const std::vector<VertexSet> sets_;
  std::vector<SimplifySet> opened_;
  std::vector<SimplifyJob> jobs_;
  std::map<std::uint32_t, model::Vectors<3>> columns_;  ///< by accessor, of all vertices
  std::vector<std::uint32_t> local_;                    ///< by vertex; kUnused between calls
  StepOutcome outcome_;
  SimplifyCounts counts_;
};

}  // namespace

StepDescription simplify_step();
StepDescription simplify_step() {
  return {"simplify",
          "removes triangles and the vertices that only they use",
          "vertices that stay with all attributes, borders that touch, seams, and closed surfaces",
          "the distance of the surfaces, measured both ways: within the bound",
          [](const ConvertOptions& options) { return options.simplify.has_value(); },
          [](const StepInput& input) { return Simplifier(input).run(); }};
}

}  // namespace gltfx::steps
