// SPDX-License-Identifier: Apache-2.0
#include "measure/vertex_use.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/checked.hpp"
#include "model/info.hpp"
#include "model/vertex_cache.hpp"

namespace gltfx::measure {
namespace {

using model::Primitive;
using model::PrimitiveData;
using model::SemanticKind;

std::vector<Subject> subjects_of(const Taking& taking) {
  std::vector<Subject> subjects;
  const auto& meshes = taking.source().views().meshes;
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    std::size_t element = taking.first_primitive(mesh);
    for (const Primitive& primitive : meshes[mesh].primitives) {
      subjects.push_back({&primitive, element++});
    }
  }
  return subjects;
}

class UnusedVertices {
 public:
  UnusedVertices(const Source& source, Column& column)
      : source_(source), budget_(geometry_bytes(source)), column_(column) {}

  void take(const std::vector<Subject>& subjects) {
    std::map<VertexKey, std::vector<Subject>> groups;
    for (const Subject& subject : subjects) {
      if (subject.primitive->find(SemanticKind::position) == nullptr) {
        column_.does_not_apply(subject.element, "The primitive has no positions.");
      } else {
        groups[vertex_key(source_, *subject.primitive)].push_back(subject);
      }
    }
    for (const auto& [key, group] : groups) take_group(group);
  }

 private:
  void take_group(const std::vector<Subject>& group) {
    const PrimitiveData first(source_.geometry(), *group.front().primitive);
    const std::uint64_t count = vertices_of(first);
    std::string_view why;
    std::vector<bool> used;
    if (count >= UINT32_MAX || !budget_.take(count / 8)) {
      why = kTooLarge;
    } else {
      used.resize(static_cast<std::size_t>(count));
    }
    std::set<std::optional<std::uint32_t>> marked;  // indices
    for (const Subject& subject : group) {
      const bool fresh = marked.insert(subject.primitive->indices).second;
      if (why.empty() && fresh) why = mark(*subject.primitive, used);
    }
    const auto unused = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), false));
    for (const Subject& subject : group) {
      if (why.empty()) {
        column_.set(subject.element, subject.element == group.front().element ? unused : 0);
      } else {
        column_.could_not_be_taken(subject.element, why);
      }
    }
  }

  std::string_view mark(const Primitive& primitive, std::vector<bool>& used) {
    const PrimitiveData data(source_.geometry(), primitive);
    const std::uint64_t indices = model::index_count(data, used.size());
    if (!budget_.take(checked_mul(indices, sizeof(std::uint32_t)))) return kTooLarge;
    const std::uint32_t restart = model::restart_index(data);
    const auto vertices = static_cast<std::uint32_t>(used.size());
    const bool read = model::for_each_index(data, vertices, [&](std::uint32_t index) {
      if (index < vertices && index != restart) used[index] = true;
    });
    return read ? std::string_view() : kNoIndices;
  }

  static std::uint64_t vertices_of(const PrimitiveData& data) {
    if (data.packed() != nullptr) return data.packed()->points;
    const auto& accessor = data.primitive().find(SemanticKind::position)->accessor;
    return accessor ? data.source().views.accessors[*accessor].count.value_or(0) : 0;
  }

  const Source& source_;
  model::MemoryBudget budget_;
  Column& column_;
};

// The largest number of weights above 0 of a vertex.
void take_joints(const Source& source, const std::vector<Subject>& subjects, Column& column) {
  model::MemoryBudget budget(geometry_bytes(source));
  for (const auto& [primitive, element] : subjects) {
    const PrimitiveData data(source.geometry(), *primitive);
    std::vector<std::uint32_t> joints;  // by vertex
    std::string_view why = "The primitive has no weights.";
    bool fault = false;
    for (const model::Attribute& attribute : primitive->attributes) {
      if (attribute.semantic.kind != SemanticKind::weights || fault) continue;
      const auto weights = data.open(attribute);
      const bool affordable =
          weights && budget.take(checked_mul(weights->count(), sizeof(float) * 4));
      fault = !affordable;
      why = !weights ? "Weights cannot be read." : affordable ? "" : kTooLarge;
      if (fault) continue;
      const auto count = static_cast<std::size_t>(weights->count());
      if (joints.size() < count) joints.resize(count);
      model::for_each_component(*weights, count, [&](std::size_t i, unsigned, float weight) {
        if (weight > 0) ++joints[i];
      });
    }
    if (fault) {
      column.could_not_be_taken(element, why);
    } else if (joints.empty()) {
      column.does_not_apply(element, why);
    } else {
      column.set(element, std::uint64_t{*std::max_element(joints.begin(), joints.end())});
    }
  }
}

class Caches {
 public:
  explicit Caches(Taking& taking) : taking_(taking), budget_(geometry_bytes(taking.source())) {}

  void take(const std::vector<Subject>& subjects) {
    std::map<VertexKey, std::vector<Subject>> groups;
    for (const Subject& subject : subjects) {
      if (draws_triangles(*subject.primitive)) {
        groups[vertex_key(taking_.source(), *subject.primitive)].push_back(subject);
      } else {
        store(subject.element, {"The primitive has no triangles."});
      }
    }
    for (const auto& [key, group] : groups) take_group(group);
  }

 private:
  struct Values {
    std::string_view why;
    bool fault = false;
    double misses = 0, overhead = 0;
  };
  using Key = std::tuple<std::uint64_t, model::Mode, std::uint64_t>;

  // Of primitives with the same vertices.
  void take_group(const std::vector<Subject>& group) {
    std::map<Key, Values> known;
    numbers_.clear();
    for (const auto& [primitive, element] : group) {
      const std::uint64_t indices = primitive->indices ? *primitive->indices + std::uint64_t{1} : 0;
      const auto [values, fresh] =
          known.try_emplace({indices, *primitive->mode, bytes_of(*primitive)});
      if (fresh) values->second = measure(*primitive);
      store(element, values->second);
    }
  }

  Values measure(const Primitive& primitive) {
    const PrimitiveData data(taking_.source().geometry(), primitive);
    const auto positions = data.open(SemanticKind::position);
    if (!positions) return {missing_positions(data), true};
    const std::uint64_t count = positions->count();
    const std::uint64_t size = bytes_of(primitive);
    const std::uint64_t each = sizeof(model::Triangle) + sizeof(std::uint32_t) + size / 8;
    const std::uint64_t fresh = numbers_.empty() ? count : 0;
    const bool affordable = budget_.take(checked_mul(fresh, sizeof(std::uint32_t))) &&
                            budget_.take(checked_mul(model::index_count(data, count), each));
    if (count >= UINT32_MAX || !affordable) return {kTooLarge, true};
    model::Geometry geometry;
    if (!model::assemble(data, static_cast<std::uint32_t>(count), geometry)) {
      return {kNoIndices, true};
    }
    if (geometry.triangles.empty()) return {"The primitive has no triangles."};
    const std::span<const std::uint32_t> corners(geometry.triangles.front().data(),
                                                 geometry.triangles.size() * 3);
    numbers_.resize(static_cast<std::size_t>(count), kNone);
    std::uint32_t used = 0;
    std::vector<std::uint32_t> numbered;
    numbered.reserve(corners.size());
    for (const std::uint32_t corner : corners) {
      if (numbers_[corner] == kNone) numbers_[corner] = used++;
      numbered.push_back(numbers_[corner]);
    }
    for (const std::uint32_t corner : corners) numbers_[corner] = kNone;
    Values values;
    if (taking_.wants(Name::cache_misses)) values.misses = model::cache_miss_ratio(numbered, used);
    if (taking_.wants(Name::fetch_overhead)) {
      values.overhead = model::fetch_overhead(corners, used, size);
    }
    return values;
  }

  std::uint64_t bytes_of(const Primitive& primitive) const {
    return model::vertex_bytes(taking_.source().views(), primitive);
  }

  void store(std::size_t element, const Values& values) {
    for (const auto& [name, value] : {std::pair{Name::cache_misses, values.misses},
                                      std::pair{Name::fetch_overhead, values.overhead}}) {
      Column* column = taking_.column(MeasureScope::primitive, name);
      if (column == nullptr) continue;
      if (values.fault) {
        column->could_not_be_taken(element, values.why);
      } else if (!values.why.empty()) {
        column->does_not_apply(element, values.why);
      } else {
        column->set(element, MeasureValue(value));
      }
    }
  }

  Taking& taking_;
  static constexpr std::uint32_t kNone = UINT32_MAX;
  model::MemoryBudget budget_;
  std::vector<std::uint32_t> numbers_;  // of vertices, by their first use; else all kNone
};

}  // namespace

void take_vertex_use(Taking& taking) {
  const Source& source = taking.source();
  const std::vector<Subject> subjects = subjects_of(taking);
  const auto column = [&](Name name) { return taking.column(MeasureScope::primitive, name); };
  if (Column* to = column(Name::unused_vertices)) UnusedVertices(source, *to).take(subjects);
  if (Column* to = column(Name::duplicate_vertices)) {
    count_duplicate_vertices(source, subjects, *to);
  }
  if (Column* to = column(Name::joints_per_vertex)) take_joints(source, subjects, *to);
  if (taking.wants(Name::cache_misses) || taking.wants(Name::fetch_overhead)) {
    Caches(taking).take(subjects);
  }
}

}  // namespace gltfx::measure
