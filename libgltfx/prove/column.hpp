// SPDX-License-Identifier: Apache-2.0
/// Elements of accessors as numbers, whatever they are stored as, and how far apart two lists are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/accessor_data.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// Components of one element.
using Element = std::array<double, 16>;

/// The difference of two numbers; 0 for two that are none, infinite where only one is.
double apart(double a, double b);

/// How the distance of two elements is measured.
enum class Metric : std::uint8_t {
  component,  ///< the greatest difference of a component
  euclidean,  ///< of the first three components
  direction,  ///< the angle in degrees between those; other components as `component`
};
double distance(Metric metric, const Element& a, const Element& b, unsigned components);

/// The elements of an accessor, or of an attribute of a bitstream; zeros where nothing is stored.
/// Integers that are normalized are rounded to single precision, as a file with floats has them.
class Column {
 public:
  /// Nothing when they cannot be read, or are more than their bytes can be worth.
  static std::optional<Column> open(const Side& side, std::uint32_t accessor);
  static std::optional<Column> open(const Side& side, const model::PrimitiveData& data,
                                    const model::Attribute& attribute);

  std::uint64_t count() const { return count_; }
  unsigned components() const { return model::component_count(format_.type); }
  const model::Format& format() const { return format_; }

  /// One element, wherever it is. Precondition: `index` is below count().
  Element at(std::uint64_t index) const;
  /// Copies elements [first, first + count) packed, as they are stored. `next` as for
  /// AccessorData::read().
  void read(std::byte* to, std::uint64_t first, std::size_t count, std::uint64_t& next) const;
  /// Bytes of one element as read() leaves it.
  std::size_t packed_size() const;
  Element decode(const std::byte* from) const;

 private:
  static std::optional<Column> make(const Side& side, std::uint32_t accessor,
                                    std::optional<model::AccessorData> data);

  model::Format format_;
  std::uint64_t count_ = 0;
  std::optional<model::AccessorData> data_;  ///< nothing: zeros
};

struct Farthest {
  double distance = 0;
  std::uint64_t at = 0;  ///< the first element that is so far away
};

/// Over all elements in order. Precondition: as many elements and components.
Farthest farthest(Metric metric, const Column& a, const Column& b);

/// All numbers of a column. Precondition: its components are unsigned integers.
std::vector<std::uint32_t> read_indices(const Column& column);

}  // namespace gltfx::prove
