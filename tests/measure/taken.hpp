// SPDX-License-Identifier: Apache-2.0
/// Measures of small assets.
#pragma once

#include <string>
#include <string_view>

#include "measure/measured.hpp"

namespace gltfx::test {

/// All measures, those of pixels included.
inline measure::Request with_pixels() {
  measure::Request request;
  request.pixels = true;
  return request;
}

/// Measures of an asset that needs no other file.
class Taken {
 public:
  explicit Taken(const std::string& bytes, const measure::Request& request = with_pixels())
      : values_(measure::test::measured(bytes, request)) {}

  const MeasureValue& value(MeasureScope on, std::string_view name, std::size_t element = 0) const {
    return values_.find(on, name)->values[element];
  }
  /// A number; fails for anything else.
  double number(std::string_view name, std::size_t element = 0,
                MeasureScope on = MeasureScope::material) const {
    return std::get<double>(value(on, name, element));
  }
  double of_asset(std::string_view name) const { return number(name, 0, MeasureScope::asset); }
  /// Why there is no value; fails if there is one.
  const MeasureReason& reason(std::string_view name, std::size_t element = 0,
                              MeasureScope on = MeasureScope::material) const {
    return values_.reasons[std::get<NotMeasured>(value(on, name, element)).reason];
  }
  const Measurements& all() const { return values_; }

 private:
  Measurements values_;
};

}  // namespace gltfx::test
