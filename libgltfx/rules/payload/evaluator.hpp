// SPDX-License-Identifier: Apache-2.0
/// Checks components one after the other, exactly as the Khronos validator does.
#pragma once

#include <cmath>
#include <cstdint>

#include "rules/payload/element_check.hpp"
#include "rules/payload/element_kernels.hpp"

namespace gltfx::validate {

enum class ErrorKind : std::uint8_t {
  invalid_float,
  not_unit,
  bad_sign,
  not_clamped,
  index_out_of_range,
  restart,
  negative_time,
  not_increasing,
  not_unit_quaternion,
  bad_matrix,
  not_unit_instance,
  not_unit_splat,
  negative_scale,
  bad_opacity,
  out_of_limits,
};
inline constexpr std::size_t kErrorKinds = 15;

/// One component or element that is invalid.
struct DataError {
  ErrorKind kind = ErrorKind::invalid_float;
  std::uint64_t index = 0;  ///< index of the component, counted over all elements
  unsigned component = 0;   ///< index within its element
  double value = 0;         ///< the component, or the length of the vector
  double other = 0;         ///< the previous time; the last vertex
};

/// One check over one accessor. Components come in order, from the first to the last.
class Evaluator {
 public:
  /// `restart` is the index value that restarts primitives: the greatest of its type.
  Evaluator(const Check& check, double restart) : check_(&check), restart_(restart) {}

  /// Feeds one component and calls `emit(error)` for each error that it completes.
  template <typename Emit>
  void feed(std::uint64_t index, unsigned component, double value, Emit&& emit) {
    switch (check_->kind) {
      case CheckKind::finite:
        if (!std::isfinite(value))
          emit(DataError{ErrorKind::invalid_float, index, component, value});
        break;
      case CheckKind::unit_vector:
        feed_vector(index, component, value, emit);
        break;
      case CheckKind::unit_tangent:
        if (component < 3) {
          feed_vector(index, component, value, emit);
        } else if (value != 1.0 && value != -1.0 &&
                   !(std::abs(std::abs(value) - 1.0) <= check_->bound_slack)) {
          emit(DataError{ErrorKind::bad_sign, index, component, value});
        }
        break;
      case CheckKind::clamped:
        if (value < -check_->bound_slack || value > 1.0 + check_->bound_slack) {
          emit(DataError{ErrorKind::not_clamped, index, component, value});
        }
        break;
      case CheckKind::index:
        feed_index(index, value, emit);
        break;
      case CheckKind::times:
        feed_time(index, value, emit);
        break;
      case CheckKind::quaternion:
        // Of the three vectors of a cubic spline, the first and the last are tangents.
        if (check_->cubic && index / 4 % 3 != 1) break;
        feed_quaternion(ErrorKind::not_unit_quaternion, index, component, value, emit);
        break;
      case CheckKind::instance_rotation:
        feed_quaternion(ErrorKind::not_unit_instance, index, component, value, emit);
        break;
      case CheckKind::splat_rotation:
        feed_quaternion(ErrorKind::not_unit_splat, index, component, value, emit);
        break;
      case CheckKind::limits:
        feed_limited(index, component, value, emit);
        break;
      case CheckKind::splat_scale:
        if (value < 0.0) emit(DataError{ErrorKind::negative_scale, index, component, value});
        break;
      case CheckKind::splat_opacity:
        if (value < 0.0 || value > 1.0) {
          emit(DataError{ErrorKind::bad_opacity, index, component, value});
        }
        break;
      case CheckKind::bind_matrix:
        feed_matrix(index, component, value, emit);
        break;
      default:
        break;
    }
  }

 private:
  template <typename Emit>
  void feed_vector(std::uint64_t index, unsigned component, double value, Emit&& emit) {
    sum_ = component == 0 ? value * value : sum_ + value * value;
    if (component != 2) return;
    const double length = std::sqrt(sum_);
    if (std::abs(length - 1.0) > kernels::kVectorTolerance + check_->length_slack) {
      emit(DataError{ErrorKind::not_unit, index, component, length});
    }
  }

  template <typename Emit>
  void feed_index(std::uint64_t index, double value, Emit&& emit) {
    const auto most = static_cast<double>(check_->most);
    if (value > most) emit(DataError{ErrorKind::index_out_of_range, index, 0, value, most});
    if (value == restart_) emit(DataError{ErrorKind::restart, index, 0, value});
  }

  template <typename Emit>
  void feed_time(std::uint64_t index, double value, Emit&& emit) {
    if (value < 0.0) {
      emit(DataError{ErrorKind::negative_time, index, 0, value});
      return;
    }
    if (index != 0 && value <= last_) {
      emit(DataError{ErrorKind::not_increasing, index, 0, value, last_});
    }
    last_ = value;
  }

  template <typename Emit>
  void feed_quaternion(ErrorKind error, std::uint64_t index, unsigned component, double value,
                       Emit&& emit) {
    sum_ = component == 0 ? value * value : sum_ + value * value;
    if (component != 3) return;
    const double length = std::sqrt(sum_);
    if (std::abs(length - 1.0) > kernels::kQuaternionTolerance + check_->length_slack) {
      emit(DataError{error, index, component, length});
    }
  }

  template <typename Emit>
  void feed_limited(std::uint64_t index, unsigned component, double value, Emit&& emit) {
    if (check_->cubic && index / check_->group % 3 != 1) return;
    if (!check_->limits.exclude(value)) return;
    const bool low = value <= check_->limits.least;
    emit(DataError{ErrorKind::out_of_limits, index, component, value,
                   low ? check_->limits.least : check_->limits.most});
  }

  template <typename Emit>
  void feed_matrix(std::uint64_t index, unsigned component, double value, Emit&& emit) {
    if (component % 4 != 3) return;
    const double wanted = component == 15 ? 1.0 : 0.0;
    if (value != wanted) emit(DataError{ErrorKind::bad_matrix, index, component, value, wanted});
  }

  const Check* check_;
  double restart_;
  double sum_ = 0;
  double last_ = 0;
};

}  // namespace gltfx::validate
