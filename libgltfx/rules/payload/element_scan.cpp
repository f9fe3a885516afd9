// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/element_scan.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "rules/payload/element_kernels.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;

template <typename T>
constexpr bool kIsIndex = std::is_unsigned_v<T>;

// Components as the checks read them: normalized if the accessor is.
template <typename T>
double component_value(const Check& check, const model::Format& format, T value) {
  if constexpr (std::is_integral_v<T>) {
    if (format.normalized && check.kind != CheckKind::index) return model::normalize(value);
  }
  return static_cast<double>(value);
}

// One check over the blocks of an accessor whose components are of type T.
template <typename T>
class Running {
 public:
  Running(const AccessorData& data, const Check& check, Outcome& outcome)
      : data_(data),
        check_(check),
        outcome_(outcome),
        evaluator_(check, static_cast<double>(std::numeric_limits<T>::max())),
        extremes_(data.components(), check.kind == CheckKind::maximum) {}

  void block(const T* values, std::size_t elements, std::uint64_t first) {
    const std::size_t count = elements * data_.components();
    first_index_ = first * data_.components();
    switch (check_.kind) {
      case CheckKind::minimum:
      case CheckKind::maximum:
        return extremes_.add(values, elements);
      case CheckKind::index:
        return block_of_indices(values, count);
      case CheckKind::finite:
      case CheckKind::clamped:
      case CheckKind::unit_vector:
      case CheckKind::unit_tangent:
        if constexpr (std::is_same_v<T, float>) return block_of_floats(values, elements);
        return look_closer(values, count);
      default:
        return look_closer(values, count);
    }
  }

  // Selects the wrong bounds; elements outside them are counted in a second pass.
  void finish() {
    if (check_.kind != CheckKind::minimum && check_.kind != CheckKind::maximum) return;
    for (unsigned i = 0; i < data_.components(); ++i) {
      const auto actual = static_cast<double>(extremes_.of(i));
      const double declared = check_.bounds[i];
      if (actual != declared && !is_near(actual, declared)) {
        outcome_.bounds.push_back({i, declared, actual, 0});
      }
    }
    if (!outcome_.bounds.empty()) count_outside();
  }

 private:
  // NaN is not near any number.
  bool is_near(double actual, double declared) const {
    const bool wider = check_.kind == CheckKind::minimum ? declared < actual : declared > actual;
    const double slack = check_.bound_slack + (wider ? check_.bound_widening : 0);
    return std::abs(actual - declared) <= slack;
  }

  void block_of_floats(const float* values, std::size_t elements) {
    const std::size_t count = elements * data_.components();
    switch (check_.kind) {
      case CheckKind::finite:
        return note(ErrorKind::invalid_float, kernels::count_non_finite(values, count), values,
                    count);
      case CheckKind::clamped:
        return note_unclamped(kernels::count_unclamped(values, count), values, count);
      case CheckKind::unit_vector:
        return note_units(kernels::count_non_unit<3>(values, elements), 0, values, count);
      default:
        return note_units(kernels::count_non_unit<4>(values, elements),
                          kernels::count_bad_signs(values, elements), values, count);
    }
  }

  void note_unclamped(std::size_t errors, const float* values, std::size_t count) {
    if (errors != 0 && check_.bound_slack != 0) return look_closer(values, count);
    note(ErrorKind::not_clamped, errors, values, count);
  }

  void note_units(const kernels::UnitCount& units, std::size_t signs, const float* values,
                  std::size_t count) {
    const bool errors = units.errors != 0 || signs != 0;
    if (units.uncertain != 0 || (errors && check_.length_slack != 0)) {
      return look_closer(values, count);
    }
    note(ErrorKind::not_unit, units.errors, values, count);
    note(ErrorKind::bad_sign, signs, values, count);
  }

  void block_of_indices(const T* values, std::size_t count) {
    if constexpr (kIsIndex<T>) {
      const T greatest = kernels::greatest(values, count);
      if (static_cast<std::int64_t>(greatest) > check_.most) {
        const std::size_t above =
            check_.most < 0
                ? count
                : kernels::count_above(values, count, static_cast<std::uint64_t>(check_.most));
        note(ErrorKind::index_out_of_range, above, values, count);
      }
      constexpr T kRestart = std::numeric_limits<T>::max();
      if (greatest == kRestart) {
        note(ErrorKind::restart, kernels::count_equal(values, count, kRestart), values, count);
      }
      if (check_.triangles) outcome_.degenerate += kernels::count_degenerate(values, count);
    } else {
      look_closer(values, count);
    }
  }

  // Adds errors that a kernel has counted, and searches for the first of them.
  template <typename V>
  void note(ErrorKind kind, std::size_t errors, const V* values, std::size_t count) {
    if (errors == 0) return;
    Tally& tally = outcome_.errors[static_cast<std::size_t>(kind)];
    bool searching = tally.count == 0;
    tally.count += errors;
    for (std::size_t i = 0; i < count && searching; ++i) {
      evaluate(values, i, [&](const DataError& error) {
        if (error.kind != kind || !searching) return;
        tally.first = error;
        searching = false;
      });
    }
  }

  template <typename V>
  void look_closer(const V* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      evaluate(values, i, [&](const DataError& error) {
        Tally& tally = outcome_.errors[static_cast<std::size_t>(error.kind)];
        if (tally.count++ == 0) tally.first = error;
      });
    }
  }

  template <typename V, typename Emit>
  void evaluate(const V* values, std::size_t i, Emit&& emit) {
    evaluator_.feed(first_index_ + i, static_cast<unsigned>(i % data_.components()),
                    component_value(check_, data_.format(), values[i]), emit);
  }

  void count_outside() {
    const bool below = check_.kind == CheckKind::minimum;
    data_.visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
      for (BoundError& error : outcome_.bounds) {
        for (std::size_t i = 0; i < elements; ++i) {
          const auto value = static_cast<double>(values[i * data_.components() + error.component]);
          error.outside += (below ? value < error.declared : value > error.declared) ? 1U : 0U;
        }
      }
    });
  }

  const AccessorData& data_;
  const Check& check_;
  Outcome& outcome_;
  Evaluator evaluator_;
  kernels::Extremes<T> extremes_;
  std::uint64_t first_index_ = 0;
};

template <typename T>
void scan_typed(const AccessorData& data, const std::vector<Check>& checks,
                std::vector<Outcome>& outcomes) {
  std::vector<Running<T>> running;
  running.reserve(checks.size());
  for (std::size_t i = 0; i < checks.size(); ++i) {
    if (checks[i].same_as == i) running.emplace_back(data, checks[i], outcomes[i]);
  }
  data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t first) {
    for (Running<T>& each : running) each.block(values, elements, first);
  });
  for (Running<T>& each : running) each.finish();
}

}  // namespace

std::uint64_t Outcome::total() const {
  std::uint64_t sum = 0;
  for (const Tally& tally : errors) sum += tally.count;
  return sum;
}

std::vector<Outcome> scan(const AccessorData& data, const std::vector<Check>& checks) {
  std::vector<Outcome> outcomes(checks.size());
  model::with_component_type(data.format().component, [&](auto zero) {
    scan_typed<decltype(zero)>(data, checks, outcomes);
  });
  for (std::size_t i = 0; i < checks.size(); ++i) {
    if (checks[i].same_as != i) outcomes[i] = outcomes[checks[i].same_as];
  }
  return outcomes;
}

void list_errors(const AccessorData& data, const std::vector<Check>& checks,
                 const std::function<void(const Check&, const DataError&)>& use) {
  model::with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    std::vector<Evaluator> evaluators;
    evaluators.reserve(checks.size());
    for (const Check& check : checks) {
      evaluators.emplace_back(check, static_cast<double>(std::numeric_limits<T>::max()));
    }
    data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t first) {
      for (std::size_t i = 0; i < elements * data.components(); ++i) {
        const auto component = static_cast<unsigned>(i % data.components());
        for (std::size_t c = 0; c < checks.size(); ++c) {
          const double value = component_value(checks[c], data.format(), values[i]);
          evaluators[c].feed(first * data.components() + i, component, value,
                             [&](const DataError& error) { use(checks[c], error); });
        }
      }
    });
  });
}

}  // namespace gltfx::validate
