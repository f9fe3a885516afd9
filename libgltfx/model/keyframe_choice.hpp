// SPDX-License-Identifier: Apache-2.0
/// Selects keyframes so that interpolation reproduces the others (glTF 2.0 section 3.11, appendix
/// C).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gltfx::model {

enum class CurveKind : std::uint8_t {
  linear,
  step,
  rotation,  ///< quaternions along the shorter arc
};

/// The values of one sampler; all numbers are finite.
struct KeyedCurve {
  CurveKind kind = CurveKind::linear;
  std::size_t width = 1;      ///< numbers per keyframe; rotation: 4
  std::vector<float> values;  ///< `width` numbers for each time
  /// By how much more components may differ at removed keyframes and between them.
  double tolerance = 0;
};

/// Indices of the keyframes to keep, in order, including the first and the last; the same for all
/// curves. At each removed keyframe, linear values differ by at most one unit in the last place,
/// components of unit rotations by at most 2^-24, and steps not at all; between keyframes the
/// curves satisfy prove::AnimationComparison::curves. A second call for the kept keyframes keeps
/// all of them. Time n log n. Precondition: there is at least one time, and times are finite and
/// increase.
std::vector<std::uint32_t> choose_keyframes(std::span<const float> times,
                                            std::span<const KeyedCurve> curves);

}  // namespace gltfx::model
