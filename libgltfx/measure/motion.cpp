// SPDX-License-Identifier: Apache-2.0
// Skins and animations.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>
#include <vector>

#include "measure/take.hpp"
#include "model/accessor_data.hpp"
#include "model/skin.hpp"

namespace gltfx::measure {
namespace {

using model::NodeIndex;
using model::RootArray;

// The number of joints on the longest path from a root to a joint.
std::uint64_t joint_depth(const model::SceneGraph& graph, const std::vector<NodeIndex>& joints) {
  const std::unordered_set<NodeIndex> of_skin(joints.begin(), joints.end());
  std::vector<std::uint32_t> depths(graph.size());
  std::vector<bool> known(graph.size());
  std::vector<NodeIndex> way;
  std::uint64_t deepest = 0;
  for (const NodeIndex joint : joints) {
    if (graph.root(joint) == model::kNoNodeIndex) continue;
    NodeIndex at = joint;
    for (; at != model::kNoNodeIndex && !known[at]; at = graph.parent(at)) way.push_back(at);
    std::uint32_t depth = at == model::kNoNodeIndex ? 0 : depths[at];
    for (; !way.empty(); way.pop_back()) {
      if (of_skin.contains(way.back())) ++depth;
      depths[way.back()] = depth;
      known[way.back()] = true;
    }
    deepest = std::max<std::uint64_t>(deepest, depths[joint]);
  }
  return deepest;
}

// The times of keyframes, seconds.
struct Times {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();
  double least_gap = std::numeric_limits<double>::infinity();
  std::uint64_t keyframes = 0;  // of the longest input
  bool readable = true;
};

Times read_times(const Source& source, const model::Accessor& input) {
  Times times;
  const auto data = model::AccessorData::open(source.asset(), source.views(), source.resources(),
                                              input, model::Malformed::unusable);
  times.readable = data && data->components() == 1 && !data->implied() &&
                   data->format().component == model::ComponentType::float32;
  if (!times.readable) return times;
  times.keyframes = data->count();
  std::optional<double> previous;
  data->visit<float>([&](const float* values, std::size_t count, std::uint64_t) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto time = static_cast<double>(values[i]);
      if (!std::isfinite(time)) continue;
      times.first = std::min(times.first, time);
      times.last = std::max(times.last, time);
      if (previous && time > *previous) {
        times.least_gap = std::min(times.least_gap, time - *previous);
      }
      previous = time;
    }
  });
  return times;
}

// Reads each input once, however many animations share it.
class InputTimes {
 public:
  explicit InputTimes(const Source& source)
      : source_(source), known_(source.views().accessors.size()) {}

  Times of(const model::Animation& animation) {
    Times all;
    for (const model::AnimationSampler& sampler : animation.samplers) {
      if (!sampler.input) continue;
      std::optional<Times>& times = known_[*sampler.input];
      if (!times) times = read_times(source_, source_.views().accessors[*sampler.input]);
      all.first = std::min(all.first, times->first);
      all.last = std::max(all.last, times->last);
      all.least_gap = std::min(all.least_gap, times->least_gap);
      all.keyframes = std::max(all.keyframes, times->keyframes);
      all.readable = all.readable && times->readable;
    }
    return all;
  }

 private:
  const Source& source_;
  std::vector<std::optional<Times>> known_;  // by accessor
};

void set_times(Taking& taking, std::size_t element, const Times& times) {
  const auto set = [&](Name name, bool applies, std::string_view otherwise, auto value) {
    Column* column = taking.column(MeasureScope::animation, name);
    if (column == nullptr) return;
    if (!times.readable) {
      column->could_not_be_taken(element, "The times of keyframes could not be read.");
    } else if (!applies) {
      column->does_not_apply(element, otherwise);
    } else {
      column->set(element, value);
    }
  };
  const bool any = times.first <= times.last;
  constexpr std::string_view kNoKeys = "The animation has no keyframes.";
  set(Name::keyframes, true, {}, times.keyframes);
  set(Name::animation_start, any, kNoKeys, MeasureValue(times.first));
  set(Name::animation_length, any, kNoKeys, MeasureValue(times.last));
  set(Name::animation_rate, std::isfinite(times.least_gap),
      "No curve has two keyframes at different times.", MeasureValue(1 / times.least_gap));
}

bool wants_times(const Taking& taking) {
  return taking.wants(Name::keyframes) || taking.wants(Name::animation_start) ||
         taking.wants(Name::animation_length) || taking.wants(Name::animation_rate);
}

}  // namespace

void take_skins(Taking& taking) {
  const Source& source = taking.source();
  const auto& objects = source.asset().elements(RootArray::skins);
  Column* joints = taking.column(MeasureScope::skin, Name::joints);
  Column* depth = taking.column(MeasureScope::skin, Name::joint_depth);
  std::uint64_t work = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] == json::kNoNode) continue;
    const model::Skin skin = model::read_skin(source.asset(), objects[i]);
    if (joints != nullptr) joints->set(i, skin.joint_count);
    if (depth == nullptr) continue;
    // Each skin looks at all nodes.
    work += source.views().nodes.size();
    if (work > (std::uint64_t{1} << 28U)) {
      depth->could_not_be_taken(i, "There are too many skins and nodes.");
    } else {
      depth->set(i, joint_depth(source.scene_graph(), skin.joint_nodes));
    }
  }
}

void take_animations(Taking& taking) {
  const Source& source = taking.source();
  Column* channels = taking.column(MeasureScope::animation, Name::channels);
  Column* bytes = taking.column(MeasureScope::animation, Name::animation_bytes);
  const bool times = wants_times(taking);
  InputTimes inputs(source);
  for (std::size_t i = 0; i < source.views().animations.size(); ++i) {
    const model::Animation& animation = source.views().animations[i];
    if (animation.object == json::kNoNode) continue;
    if (channels != nullptr) channels->set(i, std::uint64_t{animation.channels.size()});
    if (bytes != nullptr) bytes->set(i, source.byte_count().animations[i]);
    if (times) set_times(taking, i, inputs.of(animation));
  }
}

}  // namespace gltfx::measure
