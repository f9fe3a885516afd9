// SPDX-License-Identifier: Apache-2.0
// Objects and elements without effect: unused vertices, equal materials and meshes, keyframes that
// interpolation gives.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "measure/duplicates.hpp"
#include "measure/source.hpp"
#include "measure/take.hpp"
#include "model/info.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/waste.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

// --- Vertices ---

struct Unused {
  std::uint32_t mesh = 0;
  std::uint64_t vertices = 0, unused = 0, bytes = 0;
};

// Whether only indices can tell which vertices are used.
bool is_countable(const Context& context, const model::Primitive& primitive) {
  if (primitive.node == json::kNoNode || !primitive.indices) return false;
  const model::Attribute* positions = primitive.find(model::SemanticKind::position);
  if (positions == nullptr || !positions->accessor) return false;
  const model::Accessor& accessor = context.views.accessors[*positions->accessor];
  if (!accessor.buffer_view || !accessor.count) return false;
  const json::NodeId extensions = context.document.find(primitive.node, "extensions");
  if (extensions == json::kNoNode) return true;
  const std::size_t known =
      context.document.find(extensions, "KHR_materials_variants") == json::kNoNode ? 0 : 1;
  return context.document.is_object(extensions) &&
         context.document.object_size(extensions) == known;
}

// The vertices of one POSITION accessor.
struct VertexSet {
  std::uint32_t mesh = 0;
  std::uint64_t vertices = 0, each = 0;
  std::set<std::uint32_t> indices;  // accessors
  std::uint64_t index_count = 0;
  bool countable = true;
};

std::map<std::uint32_t, VertexSet> vertex_sets(const Context& context) {
  std::map<std::uint32_t, VertexSet> sets;
  const auto& accessors = context.views.accessors;
  const auto& meshes = context.views.meshes;
  for (std::uint32_t i = 0; i < meshes.size(); ++i) {
    for (const model::Primitive& primitive : meshes[i].primitives) {
      const model::Attribute* positions = primitive.find(model::SemanticKind::position);
      if (positions == nullptr || !positions->accessor) continue;
      const auto [at, fresh] = sets.try_emplace(*positions->accessor);
      VertexSet& set = at->second;
      if (fresh) {
        set.mesh = i;
        set.vertices = accessors[*positions->accessor].count.value_or(0);
        set.each = model::vertex_bytes(context.views, primitive);
      }
      set.countable = set.countable && is_countable(context, primitive);
      if (!set.countable || !set.indices.insert(*primitive.indices).second) continue;
      const auto count = accessors[*primitive.indices].count.value_or(UINT64_MAX);
      set.index_count = saturating_add(set.index_count, count);
    }
  }
  return sets;
}

std::uint64_t bytes_of(std::uint64_t count, std::uint64_t each) {
  return checked_mul(count, each).value_or(UINT64_MAX);
}

// Whether a primitive has fewer indices than vertices.
bool has_few_indices(const Context& context) {
  const auto& accessors = context.views.accessors;
  const auto has_few = [&](const model::Primitive& primitive) {
    if (!is_countable(context, primitive)) return false;
    const auto& positions = primitive.find(model::SemanticKind::position)->accessor;
    return accessors[*primitive.indices].count < accessors[*positions].count;
  };
  const auto& meshes = context.views.meshes;
  return std::any_of(meshes.begin(), meshes.end(), [&](const model::Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), has_few);
  });
}

// Each index uses one vertex at most.
std::vector<Unused> surely_unused(const Context& context) {
  std::vector<Unused> all;
  if (!has_few_indices(context)) return all;
  for (const auto& [accessor, set] : vertex_sets(context)) {
    if (!set.countable || set.index_count >= set.vertices) continue;
    const std::uint64_t unused = set.vertices - set.index_count;
    all.push_back({set.mesh, set.vertices, unused, bytes_of(unused, set.each)});
  }
  return all;
}

// By all indices.
std::vector<Unused> counted_unused(const DataPhase& phase) {
  const Context& context = phase.context;
  const std::map<std::uint32_t, VertexSet> sets = vertex_sets(context);
  measure::Request request;
  request.wanted.emplace();
  request.wanted->push_back({MeasureScope::primitive, measure::Name::unused_vertices});
  const Measurements taken = measure::take(phase.measured, request);
  const MeasureColumn* column = taken.find(MeasureScope::primitive, "unused-vertices");
  std::vector<Unused> all;
  for (std::size_t i = 0; column != nullptr && i < column->values.size(); ++i) {
    const auto* unused = std::get_if<double>(&column->values[i]);
    if (unused == nullptr || *unused <= 0) continue;
    const MeasuredPrimitive& at = taken.primitives[i];
    const model::Primitive& primitive = context.views.meshes[at.mesh].primitives[at.index];
    const model::Attribute* positions = primitive.find(model::SemanticKind::position);
    if (positions == nullptr || !positions->accessor) continue;
    const auto found = sets.find(*positions->accessor);
    if (found == sets.end() || !found->second.countable) continue;
    const VertexSet& set = found->second;
    const auto count = static_cast<std::uint64_t>(*unused);
    all.push_back({at.mesh, set.vertices, count, bytes_of(count, set.each)});
  }
  return all;
}

void check_vertices(DataPhase& phase) {
  const Context& context = phase.context;
  const bool exact = accepts(context.options, Code::UNUSED_VERTICES, Severity::hint);
  const std::vector<Unused> all = exact ? counted_unused(phase) : surely_unused(context);
  std::uint64_t bytes = 0;
  for (const Unused& each : all) bytes = saturating_add(bytes, each.bytes);
  if (all.empty() || !is_worth(phase, bytes)) return;
  const Unused& most = *std::max_element(
      all.begin(), all.end(), [](const Unused& a, const Unused& b) { return a.bytes < b.bytes; });
  std::string message = fmt::format(
      "{}{} of {} vertices of {} are used by no index: {} bytes", exact ? "" : "At least ",
      most.unused, most.vertices, object_label(context, RootArray::meshes, most.mesh), most.bytes);
  if (all.size() > 1) message += fmt::format(", {} bytes with those of other meshes", bytes);
  report_waste(phase, RootArray::meshes, most.mesh, Code::UNUSED_VERTICES, message + ".",
               "`gltfx convert --prune` removes unused vertices");
}

// --- Materials and meshes ---

void report_copies(DataPhase& phase, RootArray array, std::string_view noun,
                   const measure::Duplicates::Pairs& pairs) {
  constexpr std::size_t kFewest = 4;
  if (pairs.size() < kFewest) return;
  const Context& context = phase.context;
  const auto& objects = context.asset.elements(array);
  std::unordered_map<json::NodeId, std::size_t> index;
  for (std::size_t i = 0; i < objects.size(); ++i) index.emplace(objects[i], i);
  const std::size_t copy = index.at(pairs.front().first);
  report_waste(phase, array, copy, Code::DUPLICATE_OBJECTS,
               fmt::format("{} of {} {} equal earlier ones, such as {} and {}.", pairs.size(),
                           objects.size(), noun, object_label(context, array, copy),
                           object_label(context, array, index.at(pairs.front().second))),
               array == RootArray::materials
                   ? "`gltfx convert --dedup` shares equal materials whose names agree"
                   : "let nodes share one mesh in the authoring tool");
}

void check_copies(DataPhase& phase) {
  const measure::Duplicates found = measure::find_duplicates(phase.measured);
  if (!found.complete) return;
  report_copies(phase, RootArray::materials, "materials", found.materials);
  report_copies(phase, RootArray::meshes, "meshes", found.meshes);
}

// --- Keyframes ---

struct Keyframes {
  std::uint64_t all = 0, bytes = 0;
};

// Those of an animation, each time once, and the bytes of its times and values.
Keyframes keyframes_of(const Context& context, const model::Animation& animation) {
  Keyframes keys;
  std::set<std::uint32_t> seen;
  for (const model::AnimationSampler& sampler : animation.samplers) {
    for (const auto& accessor : {sampler.input, sampler.output}) {
      if (!accessor || !seen.insert(*accessor).second) continue;
      const model::Accessor& stored = context.views.accessors[*accessor];
      const std::uint64_t count = stored.count.value_or(0);
      if (accessor == sampler.input) keys.all = saturating_add(keys.all, count);
      keys.bytes = saturating_add(keys.bytes, bytes_of(count, model::element_size(stored.format)));
    }
  }
  return keys;
}

void check_redundant_keyframes(DataPhase& phase) {
  const Context& context = phase.context;
  if (context.views.animations.empty()) return;
  constexpr double kPart = 0.1;
  measure::Request request;
  request.wanted.emplace();
  request.wanted->push_back({MeasureScope::animation, measure::Name::redundant_keyframes});
  const Measurements taken = measure::take(phase.measured, request);
  const MeasureColumn* column = taken.find(MeasureScope::animation, "redundant-keyframes");
  double all = 0;
  double redundant = 0;
  double bytes = 0;
  double most = 0;
  std::size_t first = 0;  // the animation with the most
  for (std::size_t i = 0; column != nullptr && i < column->values.size(); ++i) {
    const auto* count = std::get_if<double>(&column->values[i]);
    if (count == nullptr) continue;
    const Keyframes keys = keyframes_of(context, context.views.animations[i]);
    const double own =
        *count * static_cast<double>(keys.bytes) / std::max(1.0, static_cast<double>(keys.all));
    all += static_cast<double>(keys.all);
    redundant += *count;
    bytes += own;
    if (own > most) {
      most = own;
      first = i;
    }
  }
  if (bytes < static_cast<double>(kWorthBytes) || redundant < kPart * all) return;
  report_waste(
      phase, RootArray::animations, first, Code::REDUNDANT_KEYFRAMES,
      fmt::format("{:.0f} of {:.0f} keyframes have no effect, because interpolation gives the "
                  "same values without them: about {:.0f} bytes.",
                  redundant, all, bytes),
      "`gltfx convert --resample` removes them");
}

}  // namespace

void check_waste_objects(DataPhase& phase) {
  const auto wants = [&](Code code) { return is_enabled(phase.context.options, code); };
  if (wants(Code::UNUSED_VERTICES)) check_vertices(phase);
  if (wants(Code::DUPLICATE_OBJECTS)) check_copies(phase);
  if (wants(Code::REDUNDANT_KEYFRAMES)) check_redundant_keyframes(phase);
}

}  // namespace gltfx::validate
