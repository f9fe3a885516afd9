// SPDX-License-Identifier: Apache-2.0
/// Takes the measures of an asset. A page of schema/measures/ names the function that takes its
/// measure; one function may take several, in one pass.
#pragma once

#include <gltfx/measure.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "measure/names.hpp"
#include "measure/source.hpp"

namespace gltfx::measure {

/// A measure on the elements of one scope.
struct Wanted {
  MeasureScope on = MeasureScope::asset;
  Name measure{};
};

/// What to take.
struct Request {
  /// Nothing: all. For the value of the asset, ask for MeasureScope::asset.
  std::optional<std::vector<Wanted>> wanted;
  bool pixels = false;  ///< decode images for the measures that need pixels
  MeasureParameters parameters;
};

/// Values of a measure while they are taken. All begin as "does not apply".
class Column {
 public:
  Column(Measurements& to, std::vector<MeasureValue>& values) : to_(to), values_(values) {}

  std::size_t size() const { return values_.size(); }
  void set(std::size_t element, MeasureValue value) { values_[element] = std::move(value); }
  void set(std::size_t element, std::uint64_t value) {
    values_[element] = static_cast<double>(value);
  }
  /// There is no value: one sentence.
  void does_not_apply(std::size_t element, std::string_view why) { miss(element, why, false); }
  void could_not_be_taken(std::size_t element, std::string_view why) { miss(element, why, true); }

 private:
  void miss(std::size_t element, std::string_view why, bool fault);

  Measurements& to_;
  std::vector<MeasureValue>& values_;
};

/// What a function that takes measures reads and fills.
class Taking {
 public:
  Taking(const Source& source, const Request& request);
  Taking(const Taking&) = delete;
  Taking& operator=(const Taking&) = delete;

  const Source& source() const { return source_; }
  const MeasureParameters& parameters() const { return request_.parameters; }
  bool pixels() const { return request_.pixels; }

  /// Whether anything is wanted of the measure.
  bool wants(Name measure) const;
  /// The column to fill, or null: it is not wanted.
  Column* column(MeasureScope on, Name measure);
  /// The elements of MeasureScope::primitive of a mesh: the first one; the others follow.
  std::size_t first_primitive(std::size_t mesh) const { return first_primitives_[mesh]; }
  /// The element of MeasureScope::material for the primitives without a material.
  std::size_t plain_material() const { return count(MeasureScope::material) - 1; }
  /// The number of elements.
  std::size_t count(MeasureScope scope) const { return counts_[static_cast<std::size_t>(scope)]; }

  /// Adds the values of the asset. Call it once, at the end.
  Measurements finish();

 private:
  void count_elements();
  void want(MeasureScope on, Name measure);
  void make_columns();

  const Source& source_;
  const Request& request_;
  Measurements taken_;
  std::array<std::size_t, kMeasureScopeCount> counts_{};
  std::vector<std::size_t> first_primitives_;                    // by mesh
  std::vector<std::uint16_t> wanted_;                            // by Name: one bit for each scope
  std::array<std::vector<Column>, kMeasureScopeCount> columns_;  // as those of taken_
};

/// Takes the requested measures. Every loop has a budget of work; a measure that exceeds it has no
/// value and a reason.
Measurements take(const Source& source, const Request& request);

/// Takes the measures of welded surfaces.
void take_topology(Taking& taking);

/// A function that pages name, and the measures of those pages.
struct TakeEntry {
  void (*take)(Taking&) = nullptr;
  std::span<const Name> measures;
};
std::span<const TakeEntry> take_entries();

}  // namespace gltfx::measure
