// SPDX-License-Identifier: Apache-2.0
#include "model/clip_moments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "model/elements.hpp"
#include "model/pose.hpp"

namespace gltfx::model {
namespace {

// Between two keyframes.
constexpr std::uint64_t kLinearSteps = 4, kSplineSteps = 12, kMostSteps = 64;
constexpr double kStepAngle = 5 * std::numbers::pi / 180;
constexpr std::uint64_t kMostReadKeys = std::uint64_t{1} << 22U;  // channels may share keyframes

/// The object and the member in a pointer such as "/nodes/3/rotation".
struct ChangedMember {
  std::string_view array, member;
  std::uint32_t index = 0;
};

std::optional<ChangedMember> changed_member(std::string_view pointer) {
  ChangedMember found;
  for (const std::string_view array : {"/nodes/", "/meshes/"}) {
    if (pointer.starts_with(array)) found.array = array;
  }
  if (found.array.empty()) return std::nullopt;
  const char* const end = pointer.data() + pointer.size();
  const auto read = std::from_chars(pointer.data() + found.array.size(), end, found.index);
  if (read.ec != std::errc() || read.ptr == end || *read.ptr != '/') return std::nullopt;
  found.member = {read.ptr + 1, static_cast<std::size_t>(end - read.ptr - 1)};
  return found;
}

std::uint64_t weights_owner(bool is_mesh, std::uint32_t index) {
  return std::uint64_t{index} << 1U | (is_mesh ? 1U : 0U);
}

template <std::size_t N>
std::array<double, N> in_double(const std::array<float, N>& from) {
  std::array<double, N> to{};
  for (std::size_t i = 0; i < N; ++i) to[i] = static_cast<double>(from[i]);
  return to;
}

double product_of(const std::vector<float>& a, const std::vector<float>& b) {
  double product = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    product += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  }
  return std::clamp(product, -1.0, 1.0);
}

// The angle between the rotations of two keyframes.
double angle_between(const Curve& curve, std::uint64_t keyframe) {
  return 2 * std::acos(std::abs(product_of(element_at(curve.values, keyframe),
                                           element_at(curve.values, keyframe + 1))));
}

std::uint64_t steps_between(const ClipChannel& channel, std::uint64_t keyframe) {
  switch (channel.curve.interpolation) {
    case Interpolation::step:
      return 1;
    case Interpolation::cubic_spline:
      return kSplineSteps;
    default:
      break;
  }
  if (!channel.rotation) return kLinearSteps;
  const double angle = angle_between(channel.curve, keyframe);
  if (!std::isfinite(angle)) return kLinearSteps;
  return std::clamp(static_cast<std::uint64_t>(std::ceil(angle / kStepAngle)), kLinearSteps,
                    kMostSteps);
}

// Adds moments between two others until a rotation turns little from each to the next. Splines turn
// fast where they are near 0, from a rotation to the opposite quaternion, which is the same one.
void add_turns(const ClipChannel& channel, double begin, double end, std::vector<double>& times) {
  constexpr std::size_t kHalvings = 6;
  std::vector<double> moments{begin, end};
  for (std::size_t i = 0; i < kHalvings; ++i) {
    std::vector<double> closer;
    std::vector<float> before = value_at(channel.curve, begin, channel.width, true);
    for (std::size_t k = 0; k + 1 < moments.size(); ++k) {
      std::vector<float> after = value_at(channel.curve, moments[k + 1], channel.width, true);
      closer.push_back(moments[k]);
      if (2 * std::acos(product_of(before, after)) > 2 * kStepAngle) {
        closer.push_back(moments[k] + (moments[k + 1] - moments[k]) / 2);
      }
      before = std::move(after);
    }
    closer.push_back(end);
    if (closer.size() == moments.size()) break;
    moments = std::move(closer);
  }
  times.insert(times.end(), moments.begin() + 1, moments.end());
}

// In order, without moments that are nearly the same, and not too many of them.
void sift(std::vector<double>& times, std::size_t most) {
  constexpr double kSame = 1e-7;
  std::sort(times.begin(), times.end());
  if (times.empty()) return;
  const double same = kSame * (times.back() - times.front());
  const auto end =
      std::unique(times.begin(), times.end(), [&](double a, double b) { return b - a <= same; });
  times.erase(end, times.end());
  const std::size_t count = times.size();
  if (count <= most) return;
  for (std::size_t i = 0; i < most; ++i) times[i] = times[i * (count - 1) / (most - 1)];
  times.resize(most);
}

}  // namespace

ClipMoments::ClipMoments(const GeometrySource& source, const schema::Set& schemas,
                         std::uint32_t animation, MemoryBudget& budget)
    : source_(source),
      animation_(animation),
      budget_(budget),
      channels_(open_clip(source.asset, source.views, source.resources, schemas, animation)) {
  for (std::size_t i = 0; i < channels_.size(); ++i) add_channel(i);
  find_times();
}

void ClipMoments::add_channel(std::size_t channel) {
  const auto changed = changed_member(channels_[channel].pointer);
  if (!changed || !is_read(channel)) return;
  const bool is_mesh = changed->array == "/meshes/";
  if (changed->member.starts_with("weights")) {
    weights_[weights_owner(is_mesh, changed->index)].push_back(channel);
    return;
  }
  if (is_mesh) return;
  const Node& node = source_.views.nodes[changed->index];
  if (node.matrix != json::kNoNode) return;
  const auto slot = [&]() -> std::optional<std::size_t> Moved::* {
    if (changed->member == "translation") return &Moved::translation;
    if (changed->member == "rotation") return &Moved::rotation;
    return changed->member == "scale" ? &Moved::scale : nullptr;
  }();
  if (slot == nullptr) return;
  const auto [known, is_new] = moved_.try_emplace(changed->index);
  known->second.*slot = channel;
  if (!is_new) return;
  const Transform stored = read_transform(source_.asset.document(), node);
  known->second.stored = {stored.translation.value_or(std::array<float, 3>{}),
                          stored.rotation.value_or(std::array<float, 4>{0, 0, 0, 1}),
                          stored.scale.value_or(std::array<float, 3>{1, 1, 1})};
  known->second.exact = stored_transform(source_.asset, node).columns[3];
}

bool ClipMoments::is_read(std::size_t channel) const {
  const ClipChannel& read = channels_[channel];
  return read.curve.times.count() > 0 &&
         !value_at(read.curve, 0, read.width, read.rotation).empty();
}

void ClipMoments::find_times() {
  std::uint64_t steps = kMostReadKeys;
  for (const auto& [node, moved] : moved_) {
    for (const auto& each : {moved.translation, moved.rotation, moved.scale}) {
      if (each) add_times(channels_[*each], steps);
    }
  }
  for (const auto& [owner, channels] : weights_) {
    for (const std::size_t each : channels) add_times(channels_[each], steps);
  }
  sift(times_, kMost);
}

void ClipMoments::add_times(const ClipChannel& channel, std::uint64_t& steps) {
  constexpr std::size_t kMostCollected = std::size_t{1} << 20U;
  const std::uint64_t count = channel.curve.times.count();
  double begin = static_cast<double>(element_at(channel.curve.times, 0)[0]);
  if (!std::isfinite(begin)) return;
  times_.push_back(begin);
  for (std::uint64_t i = 1; i < count && steps > 0; ++i) {
    const double end = static_cast<double>(element_at(channel.curve.times, i)[0]);
    if (!std::isfinite(end)) return;
    const std::uint64_t parts = steps_between(channel, i - 1);
    const bool turns =
        channel.rotation && channel.curve.interpolation == Interpolation::cubic_spline;
    double last = begin;
    for (std::uint64_t k = 1; k <= parts; ++k) {
      const double next =
          begin + (end - begin) * static_cast<double>(k) / static_cast<double>(parts);
      if (turns) {
        add_turns(channel, last, next, times_);
      } else {
        times_.push_back(next);
      }
      last = next;
    }
    steps -= std::min(steps, parts);
    begin = end;
    if (times_.size() > kMostCollected) sift(times_, kMostCollected / 2);
  }
}

ClipMoments::Parts ClipMoments::parts_at(const Moved& moved, double time) const {
  Parts parts = moved.stored;
  const auto read = [&](const std::optional<std::size_t>& channel, auto& to) {
    if (!channel) return;
    const ClipChannel& from = channels_[*channel];
    const std::vector<float> values = value_at(from.curve, time, from.width, from.rotation);
    if (values.size() == to.size()) std::copy(values.begin(), values.end(), to.begin());
  };
  read(moved.translation, parts.translation);
  read(moved.rotation, parts.rotation);
  read(moved.scale, parts.scale);
  return parts;
}

Affine ClipMoments::affine_of(const Moved& moved, const Parts& parts) {
  const Vector3 translation = moved.translation ? in_double(parts.translation) : moved.exact;
  return Affine::from_parts(translation, in_double(parts.rotation), in_double(parts.scale));
}

Affine ClipMoments::transform(NodeIndex node, std::size_t moment) {
  Moved& moved = moved_.at(node);
  if (!moved.tried) {
    moved.tried = true;
    if (budget_.take(checked_mul(times_.size(), sizeof(Parts)))) {
      for (const double time : times_) moved.known.push_back(parts_at(moved, time));
    }
  }
  return moved.known.empty() ? transform_at(node, times_[moment])
                             : affine_of(moved, moved.known[moment]);
}

Affine ClipMoments::transform_at(NodeIndex node, double time) const {
  const Moved& moved = moved_.at(node);
  return affine_of(moved, parts_at(moved, time));
}

bool ClipMoments::morphs(NodeIndex node, std::uint32_t mesh) const {
  return weights_.count(weights_owner(false, node)) > 0 ||
         weights_.count(weights_owner(true, mesh)) > 0;
}

AnimatedValues ClipMoments::weights_at(NodeIndex node, std::uint32_t mesh, double time) const {
  AnimatedValues values;
  for (const std::uint64_t owner : {weights_owner(false, node), weights_owner(true, mesh)}) {
    const auto found = weights_.find(owner);
    if (found == weights_.end()) continue;
    for (const std::size_t each : found->second) {
      const ClipChannel& from = channels_[each];
      values.insert_or_assign(from.pointer, value_at(from.curve, time, from.width, false));
    }
  }
  return values;
}

}  // namespace gltfx::model
