// SPDX-License-Identifier: Apache-2.0
/// Which keyframes of curves interpolation reproduces (glTF 2.0 section 3.11 and appendix C).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gltfx::steps {

enum class CurveKind : std::uint8_t {
  linear,
  step,
  rotation,  ///< quaternions along the shorter arc
};

/// The values of one sampler; all numbers are finite.
struct KeyedCurve {
  CurveKind kind = CurveKind::linear;
  std::size_t width = 1;      ///< numbers of a keyframe; rotation: 4
  std::vector<float> values;  ///< as many keyframes as there are times
};

/// The keyframes that stay, in order, the first and the last one among them: all curves have the
/// same ones. At every keyframe that goes, each number of a linear curve is as it was within one
/// unit in the last place, each of a rotation of length 1 within 2^-24, and each of a step exactly;
/// between keyframes the curves are what prove::AnimationComparison::curves asks for. The same
/// call for the keyframes that stay keeps them all. Time n log n. Precondition: there is a time,
/// and times are finite and increase.
std::vector<std::uint32_t> choose_keyframes(std::span<const float> times,
                                            std::span<const KeyedCurve> curves);

}  // namespace gltfx::steps
