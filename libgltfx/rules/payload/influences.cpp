// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/mesh.hpp"
#include "model/skin.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/finding.hpp"
#include "rules/payload/describe.hpp"
#include "rules/payload/influence_check.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;
using model::SemanticKind;

constexpr FixEntry kInfluenceFixes[] = {
    {Code::ACCESSOR_WEIGHTS_NON_NORMALIZED, normalize_weights},
    {Code::ACCESSOR_JOINTS_USED_ZERO_WEIGHT, clear_unweighted_joints},
};

// The smallest skin that deforms a mesh.
struct Limit {
  std::uint64_t joints = 0;  ///< 0: the mesh has no skin
  std::uint32_t skin = 0;
};

std::vector<Limit> joint_limits(const Context& context) {
  std::vector<std::uint64_t> counts;
  for (const json::NodeId skin : context.asset.elements(model::RootArray::skins)) {
    counts.push_back(model::read_skin(context.asset, skin).joint_count);
  }
  std::vector<Limit> limits(context.asset.count(model::RootArray::meshes));
  for (const model::Node& node : context.views.nodes) {
    if (!node.mesh || !node.skin || counts[*node.skin] == 0) continue;
    Limit& limit = limits[*node.mesh];
    const std::uint64_t joints = counts[*node.skin];
    if (limit.joints == 0 || joints < limit.joints) limit = {joints, *node.skin};
  }
  return limits;
}

using SetAttributes = std::vector<const model::Attribute*>;

// The first attribute of each set of a kind.
SetAttributes by_set(const model::Primitive& primitive, SemanticKind kind, std::size_t sets) {
  SetAttributes found(sets, nullptr);
  for (const model::Attribute& attribute : primitive.attributes) {
    const model::Semantic& semantic = attribute.semantic;
    if (semantic.kind != kind || semantic.set >= sets) continue;
    if (found[semantic.set] == nullptr) found[semantic.set] = &attribute;
  }
  return found;
}

// A primitive whose joints and weights are checked.
struct Skinned {
  std::uint32_t mesh = 0;
  std::uint32_t primitive = 0;
  Limit limit;
  SetAttributes joints, weights;  // by set, none of them null
  bool lossy = false;             ///< the weights were quantized
};

// Errors of all primitives, the first of each kind; Deviations::each_finding_is_listed: one by one
// up to a limit.
class InfluenceReport {
 public:
  explicit InfluenceReport(DataPhase& phase) : phase_(phase) {}

  void begin(Skinned skinned) { primitives_.push_back(std::move(skinned)); }

  void note(const Influence& influence) {
    const std::size_t primitive = primitives_.size() - 1;
    if (!phase_.context.deviations.each_finding_is_listed || !phase_.budget.list(1)) {
      const Key key{primitive, influence.error, influence.set};
      const auto [at, fresh] = tallies_.try_emplace(key, found_.size());
      if (!fresh) {
        ++found_[at->second].count;
        return;
      }
    }
    found_.push_back({influence, primitive, 1});
  }

  void finish() {
    if (phase_.context.deviations.primitives_are_read_in_step) {
      std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
        return a.influence.index < b.influence.index;
      });
    }
    for (const Found& found : found_) send(found);
  }

 private:
  using Key = std::tuple<std::size_t, InfluenceError, std::uint32_t>;
  struct Found {
    Influence influence;
    std::size_t primitive = 0;
    std::uint64_t count = 1;
  };

  static Code code(InfluenceError error) {
    static constexpr std::array<Code, kInfluenceErrors> kCodes{
        Code::ACCESSOR_JOINTS_INDEX_OOB, Code::ACCESSOR_JOINTS_INDEX_DUPLICATE,
        Code::ACCESSOR_WEIGHTS_NEGATIVE, Code::ACCESSOR_JOINTS_USED_ZERO_WEIGHT,
        Code::ACCESSOR_WEIGHTS_NON_NORMALIZED};
    return kCodes[static_cast<std::size_t>(error)];
  }

  static std::string sentence(const Influence& found, const Limit& limit) {
    const std::string value = value_text(found.value);
    const std::uint64_t vertex = found.index / 4;
    const std::uint64_t slot = found.index % 4;
    switch (found.error) {
      case InfluenceError::joint_out_of_range:
        return fmt::format("Joint {} of vertex {} is {}, but skin {} has {} joints.", slot, vertex,
                           value, limit.skin, limit.joints);
      case InfluenceError::joint_repeated:
        return fmt::format("Joint {} of vertex {} is {}, which the vertex already has.", slot,
                           vertex, value);
      case InfluenceError::negative_weight:
        return fmt::format("Weight {} of vertex {} is {}; it must not be negative.", slot, vertex,
                           value);
      case InfluenceError::joint_without_weight:
        return fmt::format("Joint {} of vertex {} is {}, but its weight is 0.", slot, vertex,
                           value);
      case InfluenceError::wrong_sum:
        return fmt::format("The weights of vertex {} sum to {}; they must sum to 1.", vertex,
                           value);
    }
    return {};
  }

  void send(const Found& found) const {
    const Skinned& skinned = primitives_[found.primitive];
    const Influence& influence = found.influence;
    const bool weights = influence.error == InfluenceError::negative_weight ||
                         influence.error == InfluenceError::wrong_sum;
    const std::string name = fmt::format("{}_{}", weights ? "WEIGHTS" : "JOINTS", influence.set);
    std::string message = sentence(influence, skinned.limit);
    if (found.count > 1) message += fmt::format(" This is the first of {}.", found.count);
    if (weights && skinned.lossy) message += kAfterDraco;
    Finding finding = finding_on(phase_.context,
                                 (weights ? skinned.weights : skinned.joints)[influence.set]->value,
                                 code(influence.error), std::move(message));
    finding.count = found.count;
    if (weights && skinned.lossy) finding.severity = Severity::warning;
    with_path({Place::Kind::attribute, skinned.mesh, skinned.primitive, name, json::kNoNode},
              [&](const Path& path) { phase_.sink.report(path, std::move(finding)); });
  }

  DataPhase& phase_;
  std::vector<Skinned> primitives_;
  std::vector<Found> found_;
  std::map<Key, std::size_t> tallies_;
};

class InfluencePhase {
 public:
  explicit InfluencePhase(DataPhase& phase) : phase_(phase), report_(phase) {}

  void run() {
    const Context& context = phase_.context;
    if (context.asset.count(model::RootArray::skins) == 0) return;
    const std::vector<Limit> limits = joint_limits(context);
    const auto& meshes = context.views.meshes;
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
      if (limits[i].joints != 0) check_mesh(i, meshes[i], limits[i]);
    }
    report_.finish();
  }

 private:
  void check_mesh(std::uint32_t index, const model::Mesh& mesh, const Limit& limit) {
    if (mesh.has_holes && deviations_.broken_values_are_absent) return;
    for (std::uint32_t i = 0; i < mesh.primitives.size(); ++i) {
      check_primitive({index, i, limit, {}, {}}, mesh.primitives[i]);
    }
  }

  void check_primitive(Skinned skinned, const model::Primitive& primitive) {
    const std::size_t sets = model::joint_sets(primitive);
    if (sets == 0) return;
    const std::uint64_t vertices = vertex_count(primitive);
    skinned.joints = by_set(primitive, SemanticKind::joints, sets);
    skinned.weights = by_set(primitive, SemanticKind::weights, sets);
    std::vector<std::optional<AccessorData>> data;
    for (std::size_t set = 0; set < sets; ++set) {
      for (const SemanticKind kind : {SemanticKind::joints, SemanticKind::weights}) {
        const model::Attribute* attribute =
            (kind == SemanticKind::joints ? skinned.joints : skinned.weights)[set];
        if (!has_count(attribute, vertices)) return;
        data.push_back(open(*attribute, kind));
        if (!data.back() && !deviations_.primitives_are_read_in_step) return;
      }
    }
    std::vector<InfluenceSet> influences(sets);
    for (std::size_t set = 0; set < sets; ++set) {
      influences[set] = {data[set * 2] ? &*data[set * 2] : nullptr,
                         data[set * 2 + 1] ? &*data[set * 2 + 1] : nullptr};
    }
    const std::uint64_t joint_count = skinned.limit.joints;
    const double step = weight_step(influences);
    skinned.lossy = step != 0;
    report_.begin(std::move(skinned));
    const bool all_weights = !deviations_.weights_of_reported_joints_are_left_out;
    check_influences_of(influences, joint_count, all_weights, [&](const Influence& influence) {
      if (!is_rounding(influence, step, sets)) report_.note(influence);
    });
  }

  // The step of quantized weights; 0 if they are exact.
  static double weight_step(const std::vector<InfluenceSet>& sets) {
    double step = 0;
    for (const InfluenceSet& set : sets) {
      if (set.weights != nullptr) step = std::max(step, set.weights->step().value_or(0));
    }
    return step;
  }

  // Whether weights are only wrong because each of them was rounded by half a step.
  static bool is_rounding(const Influence& influence, double step, std::size_t sets) {
    if (step == 0) return false;
    switch (influence.error) {
      case InfluenceError::wrong_sum:
        return std::abs(influence.value - 1) <= step * 2 * static_cast<double>(sets) + 1e-6;
      case InfluenceError::negative_weight:
        return influence.value >= -step;
      case InfluenceError::joint_without_weight:
        return true;
      default:
        return false;
    }
  }

  // The count of the first attribute whose accessor has one.
  std::uint64_t vertex_count(const model::Primitive& primitive) const {
    for (const model::Attribute& attribute : primitive.attributes) {
      if (!attribute.accessor) continue;
      const auto count = phase_.context.views.accessors[*attribute.accessor].count;
      if (count) return *count;
    }
    return 0;
  }

  bool has_count(const model::Attribute* attribute, std::uint64_t vertices) const {
    return attribute != nullptr && attribute->accessor &&
           phase_.context.views.accessors[*attribute->accessor].count == vertices;
  }

  std::optional<AccessorData> open(const model::Attribute& attribute, SemanticKind kind) {
    auto data = phase_.open(*attribute.accessor);
    if (!data) return std::nullopt;
    if (data->components() != 4 && !deviations_.consequences_are_reported) return std::nullopt;
    const bool numbers = data->format().component == model::ComponentType::float32;
    if (kind == SemanticKind::joints && numbers) return std::nullopt;
    constexpr std::uint64_t kEffort = 16;  // several times the effort of a vectorized pass
    if (!phase_.budget.take(data->count(), data->components() * kEffort)) return std::nullopt;
    return data;
  }

  DataPhase& phase_;
  const Deviations& deviations_ = phase_.context.deviations;
  InfluenceReport report_;
};

}  // namespace

const RuleGroup& influences_rules() {
  static constexpr RuleGroup group{.fixes = kInfluenceFixes};
  return group;
}

void check_influences(DataPhase& phase) { InfluencePhase(phase).run(); }

}  // namespace gltfx::validate
