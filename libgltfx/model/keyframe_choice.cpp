// SPDX-License-Identifier: Apache-2.0
#include "model/keyframe_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/node.hpp"

namespace gltfx::model {
namespace {

using Keys = std::vector<std::uint32_t>;

constexpr double kRotationBound = 1.0 / (1 << 24);
// Below this cosine, rotations are so far apart that rounding may flip the shorter arc.
constexpr double kLeastCosine = 0.1;
constexpr double kLongArc = 0.6;  // rotations by some 106 degrees
// The bound of AnimationComparison::curves.
constexpr double kCurveBound = 1.0 / (1 << 22);
constexpr int kParts = 5;
// Maximum depth of splits; only splits that remove almost nothing go deeper.
constexpr int kMostDepth = 64;

double last_place(float value) {
  const float size = std::fabs(value);
  const float next = std::nextafter(size, std::numeric_limits<float>::infinity());
  return static_cast<double>(next) - static_cast<double>(size);
}

Quaternion quaternion_at(const KeyedCurve& curve, std::size_t key) {
  Quaternion q{};
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = static_cast<double>(curve.values[key * 4 + i]);
  return q;
}

/// An interpolation from keyframe `from` to keyframe `to`.
struct Arc {
  std::uint32_t from, to;
};

/// The distance of a keyframe from an arc.
struct Misfit {
  double away = 0;
  bool counts = false;  ///< it is more than rounding

  void note(double distance, double bound) {
    away = std::max(away, distance);
    counts |= distance > bound;
  }
};

/// A keyframe between the ends of an arc.
struct Farthest {
  std::uint32_t key = 0;
  Misfit misfit;
};

/// Splits arcs at the farthest keyframe, as the Douglas-Peucker algorithm does. That keyframe is
/// kept, so a second call for the kept keyframes splits at the same places.
class Choice {
 public:
  Choice(std::span<const float> times, std::span<const KeyedCurve> curves)
      : times_(times), curves_(curves), kept_(times.size()) {}

  Keys run() {
    std::uint32_t last = 0;
    kept_[0] = true;
    for (std::uint32_t key = 1; key < times_.size(); ++key) {
      if (key + 1 < times_.size() && !begins_step(key) && !turns_far(last, key)) continue;
      kept_[key] = true;
      thin({last, key});
      last = key;
    }
    Keys keys;
    for (std::uint32_t key = 0; key < times_.size(); ++key) {
      if (kept_[key]) keys.push_back(key);
    }
    return keys;
  }

 private:
  double time(std::size_t key) const { return static_cast<double>(times_[key]); }

  // Whether a step curve changes its value at this keyframe.
  bool begins_step(std::size_t key) const {
    return std::any_of(curves_.begin(), curves_.end(), [&](const KeyedCurve& curve) {
      const float* const here = curve.values.data() + key * curve.width;
      return curve.kind == CurveKind::step &&
             !std::equal(here, here + curve.width, here - curve.width);
    });
  }

  // Whether a rotation is too far from another one for a single arc.
  bool turns_far(std::size_t from, std::size_t key) const {
    return std::any_of(curves_.begin(), curves_.end(), [&](const KeyedCurve& curve) {
      return curve.kind == CurveKind::rotation && cosine(curve, from, key) < kLongArc;
    });
  }

  static double cosine(const KeyedCurve& curve, std::size_t a, std::size_t b) {
    const Quaternion p = unit(quaternion_at(curve, a));
    const Quaternion q = unit(quaternion_at(curve, b));
    return std::inner_product(p.begin(), p.end(), q.begin(), 0.0);
  }

  // Keeps the keyframes that the arc needs.
  void thin(const Arc& whole) {
    struct Part {
      Arc arc;
      int depth;
    };
    std::vector<Part> parts{{whole, 0}};
    while (!parts.empty()) {
      const auto [arc, depth] = parts.back();
      parts.pop_back();
      if (arc.to - arc.from < 2) continue;
      const Farthest farthest = farthest_from(arc);
      if (!farthest.misfit.counts && !is_wide(arc)) {
        if (!follows(arc)) keep_all(arc);
      } else if (depth == kMostDepth) {
        keep_all(arc);
      } else {
        kept_[farthest.key] = true;
        parts.push_back({{arc.from, farthest.key}, depth + 1});
        parts.push_back({{farthest.key, arc.to}, depth + 1});
      }
    }
  }
  void keep_all(const Arc& arc) {
    std::fill(kept_.begin() + arc.from, kept_.begin() + arc.to, true);
  }

  // The farthest keyframe; keyframes beyond the bound have priority, then earlier ones.
  Farthest farthest_from(const Arc& arc) const {
    Farthest found{arc.from + 1, misfit_of(arc, arc.from + 1)};
    for (std::uint32_t key = arc.from + 2; key < arc.to; ++key) {
      const Misfit misfit = misfit_of(arc, key);
      if (misfit.counts < found.misfit.counts) continue;
      if (misfit.counts > found.misfit.counts || misfit.away > found.misfit.away)
        found = {key, misfit};
    }
    return found;
  }

  Misfit misfit_of(const Arc& arc, std::size_t key) const {
    const double t = part_of(arc, time(key));
    Misfit misfit;
    for (const KeyedCurve& curve : curves_) {
      if (curve.kind == CurveKind::rotation) {
        add_rotation(curve, arc, key, t, misfit);
      } else if (curve.kind == CurveKind::linear) {
        add_numbers(curve, arc, key, t, misfit);
      }
    }
    return misfit;
  }
  // At keyframes; arcs of rotations differ by a little more between them.
  static double share_of(const KeyedCurve& curve) { return 0.95 * curve.tolerance; }

  static void add_rotation(const KeyedCurve& curve, const Arc& arc, std::size_t key, double t,
                           Misfit& misfit) {
    const Quaternion value = slerp(quaternion_at(curve, arc.from), quaternion_at(curve, arc.to), t);
    const Quaternion here = unit(quaternion_at(curve, key));
    for (std::size_t i = 0; i < here.size(); ++i)
      misfit.note(std::fabs(value[i] - here[i]), std::max(kRotationBound, share_of(curve)));
  }
  static void add_numbers(const KeyedCurve& curve, const Arc& arc, std::size_t key, double t,
                          Misfit& misfit) {
    for (std::size_t i = 0; i < curve.width; ++i) {
      const float here = curve.values[key * curve.width + i];
      const double from = static_cast<double>(curve.values[arc.from * curve.width + i]);
      const double to = static_cast<double>(curve.values[arc.to * curve.width + i]);
      const double away = std::fabs(from * (1 - t) + to * t - static_cast<double>(here));
      if (away > 0) misfit.note(away, std::max(last_place(here), share_of(curve)));
    }
  }

  bool is_wide(const Arc& arc) const {
    return std::any_of(curves_.begin(), curves_.end(), [&](const KeyedCurve& curve) {
      return curve.kind == CurveKind::rotation && cosine(curve, arc.from, arc.to) < kLeastCosine;
    });
  }

  bool follows(const Arc& arc) const {
    for (std::uint32_t key = arc.from; key < arc.to; ++key) {
      if (!follows(arc, key)) return false;
    }
    return true;
  }

  // Whether the arc reproduces the curves from a keyframe to the next one.
  bool follows(const Arc& arc, std::size_t key) const {
    const Arc old{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key + 1)};
    return std::all_of(curves_.begin(), curves_.end(), [&](const KeyedCurve& curve) {
      if (curve.kind == CurveKind::step) return true;
      const double size = std::max(size_of(curve, key), size_of(curve, key + 1));
      for (int part = 0; part < kParts; ++part) {
        const double moment = time(key) + (time(key + 1) - time(key)) * part / kParts;
        if (distance(curve, old, arc, moment) > kCurveBound * size + curve.tolerance) return false;
      }
      return true;
    });
  }

  static double size_of(const KeyedCurve& curve, std::size_t key) {
    double size = 0;
    const auto note = [&](double value) { size = std::max(size, std::fabs(value)); };
    if (curve.kind == CurveKind::rotation) {
      const Quaternion q = unit(quaternion_at(curve, key));
      std::for_each(q.begin(), q.end(), note);
    } else {
      for (std::size_t i = key * curve.width; i < (key + 1) * curve.width; ++i)
        note(static_cast<double>(curve.values[i]));
    }
    return size;
  }

  double distance(const KeyedCurve& curve, const Arc& a, const Arc& b, double moment) const {
    double greatest = 0;
    if (curve.kind == CurveKind::rotation) {
      const Quaternion p = rotation(curve, a, moment);
      const Quaternion q = rotation(curve, b, moment);
      for (std::size_t i = 0; i < p.size(); ++i)
        greatest = std::max(greatest, std::fabs(p[i] - q[i]));
      return greatest;
    }
    for (std::size_t i = 0; i < curve.width; ++i)
      greatest =
          std::max(greatest, std::fabs(number(curve, a, moment, i) - number(curve, b, moment, i)));
    return greatest;
  }

  double part_of(const Arc& arc, double moment) const {
    return std::clamp((moment - time(arc.from)) / (time(arc.to) - time(arc.from)), 0.0, 1.0);
  }
  double number(const KeyedCurve& curve, const Arc& arc, double moment, std::size_t i) const {
    const double t = part_of(arc, moment);
    const double from = static_cast<double>(curve.values[arc.from * curve.width + i]);
    const double to = static_cast<double>(curve.values[arc.to * curve.width + i]);
    return static_cast<double>(static_cast<float>(from * (1 - t) + to * t));
  }
  // Rounds like a reader in single precision.
  Quaternion rotation(const KeyedCurve& curve, const Arc& arc, double moment) const {
    const auto rounded = [](Quaternion q) {
      for (double& each : q) each = static_cast<double>(static_cast<float>(each));
      return q;
    };
    const double t = part_of(arc, moment);
    const Quaternion from = quaternion_at(curve, arc.from);
    if (t == 0) return rounded(unit(from));
    return rounded(unit(rounded(slerp(from, quaternion_at(curve, arc.to), t))));
  }

  std::span<const float> times_;
  std::span<const KeyedCurve> curves_;
  std::vector<bool> kept_;  ///< by keyframe
};

}  // namespace

Keys choose_keyframes(std::span<const float> times, std::span<const KeyedCurve> curves) {
  return Choice(times, curves).run();
}

}  // namespace gltfx::model
