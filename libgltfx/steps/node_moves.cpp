// SPDX-License-Identifier: Apache-2.0
#include "steps/node_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "model/animation.hpp"
#include "model/double_array.hpp"
#include "steps/accessor_bounds.hpp"
#include "steps/json_edits.hpp"

namespace gltfx::steps {
namespace {

using model::AnimationPath;
using model::Interpolation;
using model::Node;
using model::Vector3;

constexpr const char* kUnreadable = "has a transform that cannot be read";

std::string vector_text(const Vector3& values) {
  return fmt::format("[{},{},{}]", number_text(values[0]), number_text(values[1]),
                     number_text(values[2]));
}

/// Edits the text of one node.
class NodeText {
 public:
  NodeText(const StepData& data, json::Editor& editor) : data_(data), editor_(editor) {}

  void move(const Node& node, const NodeMove& move) {
    if (node.matrix != json::kNoNode) return move_matrix(node, move);
    const Vector3 still{};
    const Vector3 translation =
        model::double_array<3>(data_.document, node.translation).value_or(still);
    Vector3 moved{};
    for (std::size_t i = 0; i < 3; ++i)
      moved[i] = rounded(move.factor * translation[i] + move.shift[i]) + 0.0;
    set(node.object, node.translation, "translation", translation, moved);
    if (!move.scales || move.factor == 1) return;
    const Vector3 scale =
        model::double_array<3>(data_.document, node.scale).value_or(Vector3{1, 1, 1});
    for (std::size_t i = 0; i < 3; ++i) moved[i] = rounded(move.factor * scale[i]);
    set(node.object, node.scale, "scale", scale, moved);
  }

 private:
  void set(json::NodeId object, json::NodeId array, std::string_view name, const Vector3& before,
           const Vector3& after) {
    if (before == after) return;
    if (array == json::kNoNode) return editor_.append_member(object, name, vector_text(after));
    std::size_t i = 0;
    for (json::NumberCursor at(data_.document, array); at.valid(); at.advance(), ++i) {
      if (before[i] != after[i]) editor_.replace_text(at.number().span, number_text(after[i]));
    }
  }

  void move_matrix(const Node& node, const NodeMove& move) {
    std::size_t i = 0;
    for (json::NumberCursor at(data_.document, node.matrix); at.valid(); at.advance(), ++i) {
      if (i % 4 == 3 || (i < 12 && !move.scales)) continue;
      const double before = at.number().value;
      const double after = rounded(move.factor * before + (i < 12 ? 0 : move.shift[i % 4])) + 0.0;
      if (after != before) editor_.replace_text(at.number().span, number_text(after));
    }
  }

  const StepData& data_;
  json::Editor& editor_;
};

/// The change of the values of a curve.
struct CurveMove {
  double factor = 1;
  Vector3 shift{};
  bool operator==(const CurveMove&) const = default;
  bool changes() const { return *this != CurveMove{}; }
};

/// Samplers with the same output, the same kind of curve and the same change.
struct MovedCurve {
  std::uint32_t output = 0;
  bool cubic = false;
  CurveMove move;
  std::vector<json::NodeId> samplers;
};

/// Changes keyframes.
class CurveMover {
 public:
  CurveMover(const StepData& data, const NodeMoves& moves, StepChanges& changes)
      : data_(data), moves_(moves), changes_(changes) {}

  std::vector<ConvertNote> run() {
    for (const model::Animation& animation : data_.views.animations) collect(animation);
    for (const MovedCurve& curve : curves_) {
      std::string why = store(curve);
      if (!why.empty()) refuse(curve.samplers.front(), std::move(why));
    }
    return std::move(refused_);
  }

 private:
  void refuse(json::NodeId object, std::string why) {
    refused_.push_back({data_.pointer(object), std::move(why)});
  }

  CurveMove move_of(const model::AnimationChannel& channel) const {
    const auto found = channel.node ? moves_.find(*channel.node) : moves_.end();
    if (found == moves_.end()) return {};
    const NodeMove& move = found->second;
    if (channel.path == AnimationPath::translation) return {move.factor, move.shift};
    if (channel.path == AnimationPath::scale && move.scales) return {move.factor, {}};
    return {};
  }

  void collect(const model::Animation& animation) {
    std::vector<std::optional<CurveMove>> known(animation.samplers.size());
    for (const model::AnimationChannel& channel : animation.channels) {
      if (!channel.sampler || *channel.sampler >= known.size()) continue;
      auto& move = known[*channel.sampler];
      const CurveMove own = move_of(channel);
      if (!move) {
        move = own;
      } else if (*move != own) {
        return refuse(animation.samplers[*channel.sampler].object,
                      "animates several nodes, which move differently");
      }
    }
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i] && known[i]->changes()) add(animation.samplers[i], *known[i]);
    }
  }

  void add(const model::AnimationSampler& sampler, const CurveMove& move) {
    if (!sampler.output || sampler.interpolation == Interpolation::unknown)
      return refuse(sampler.object, "has members that cannot be read");
    const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
    auto& places = by_output_[*sampler.output];
    for (const std::size_t place : places) {
      MovedCurve& curve = curves_[place];
      if (curve.cubic == cubic && curve.move == move)
        return curve.samplers.push_back(sampler.object);
    }
    places.push_back(curves_.size());
    curves_.push_back({*sampler.output, cubic, move, {sampler.object}});
  }

  // Why a curve cannot change; empty: it changes.
  std::string store(const MovedCurve& curve) {
    std::optional<model::AccessorData> data;
    if (std::string why = data_.open(curve.output, data); !why.empty()) return why;
    if (data->format() !=
        model::Format{model::ElementType::vec3, model::ComponentType::float32, false})
      return "has keyframes that are not single-precision vectors";
    std::string bytes = packed_bytes(*data);
    const std::string before = bytes;
    for (std::size_t i = 0; i < data->count(); ++i) {
      const bool is_tangent = curve.cubic && i % 3 != 1;
      for (std::size_t k = 0; k < 3; ++k) {
        float value = 0;
        char* const at = bytes.data() + (3 * i + k) * sizeof(float);
        std::memcpy(&value, at, sizeof(value));
        value = static_cast<float>(curve.move.factor * static_cast<double>(value) +
                                   (is_tangent ? 0 : curve.move.shift[k]));
        std::memcpy(at, &value, sizeof(value));
      }
    }
    if (bytes == before) return {};
    const model::Accessor& accessor = data_.views.accessors[curve.output];
    if (data_.graph.users(accessor.node).size() == curve.samplers.size()) {
      changes_.contents.set(curve.output, {std::move(bytes), data->count(), true});
      return {};
    }
    const std::string json =
        accessor_like(data_.document, accessor,
                      {add_view(bytes), data->count(), model::ComponentType::none}, bytes);
    const std::uint64_t index = changes_.additions.add_element("accessors", json);
    for (const json::NodeId sampler : curve.samplers)
      set_number(data_.document, changes_.editor, sampler, "output", index);
    return {};
  }

  std::uint64_t add_view(const std::string& bytes) {
    const std::uint64_t offset = changes_.buffer.add(bytes);
    return changes_.additions.add_element(
        "bufferViews",
        view_json({changes_.buffer.index(), offset, bytes.size(), 0, model::ViewTarget::none}));
  }

  const StepData& data_;
  const NodeMoves& moves_;
  StepChanges& changes_;
  std::vector<MovedCurve> curves_;
  std::map<std::uint32_t, std::vector<std::size_t>> by_output_;  ///< positions in curves_
  std::vector<ConvertNote> refused_;
};

}  // namespace

double rounded(double value) {
  const std::string text = fmt::format("{:.15g}", value);
  double read = value;
  read_double(text.data(), text.data() + text.size(), read);
  return read;
}

std::string read_exact_transform(const json::Document& document, const Node& node,
                                 model::Affine& transform) {
  transform = {};
  if (node.matrix != json::kNoNode) {
    const auto matrix = model::double_array<16>(document, node.matrix);
    if (!matrix) return kUnreadable;
    for (std::size_t i = 0; i < 16; ++i) {
      if (i % 4 < 3) transform.columns[i / 4][i % 4] = (*matrix)[i];
    }
    return {};
  }
  const auto translation = model::double_array<3>(document, node.translation);
  const auto rotation = model::double_array<4>(document, node.rotation);
  const auto scale = model::double_array<3>(document, node.scale);
  const bool broken = (!translation && node.translation != json::kNoNode) ||
                      (!rotation && node.rotation != json::kNoNode) ||
                      (!scale && node.scale != json::kNoNode);
  if (broken) return kUnreadable;
  transform = model::Affine::from_parts(translation.value_or(Vector3{}),
                                        rotation.value_or(model::Quaternion{0, 0, 0, 1}),
                                        scale.value_or(Vector3{1, 1, 1}));
  return {};
}

bool is_pointed_transform(const StepData& data, const graph::PointerText& pointer,
                          const NodeMoves& moves) {
  constexpr std::array<std::string_view, 3> kOfTransforms{"translation", "scale", "matrix"};
  const auto& steps = pointer.steps;
  if (steps.size() < 3 || steps[0] != "nodes") return false;
  if (std::find(kOfTransforms.begin(), kOfTransforms.end(), steps[2]) == kOfTransforms.end())
    return false;
  if (pointer.varying != json::kNoNode || pointer.way.size() < 2) return true;
  return moves.contains(data.graph.tree().position(pointer.way[1]));
}

std::vector<ConvertNote> move_nodes(const StepData& data, const NodeMoves& moves,
                                    StepChanges& changes) {
  std::vector<ConvertNote> refused;
  for (const graph::PointerText& pointer : data.graph.pointers()) {
    if (!is_pointed_transform(data, pointer, moves)) continue;
    refused.push_back({data.pointer(pointer.at), "may change a transform when the asset runs"});
  }
  NodeText text(data, changes.editor);
  for (const auto& [index, move] : moves) {
    const Node& node = data.views.nodes[index];
    model::Affine transform;
    if (std::string why = read_exact_transform(data.document, node, transform); !why.empty()) {
      refused.push_back({data.pointer(node.object), std::move(why)});
      continue;
    }
    text.move(node, move);
  }
  auto curves = CurveMover(data, moves, changes).run();
  refused.insert(refused.end(), std::make_move_iterator(curves.begin()),
                 std::make_move_iterator(curves.end()));
  return refused;
}

}  // namespace gltfx::steps
