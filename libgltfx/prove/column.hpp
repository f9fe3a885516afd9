// SPDX-License-Identifier: Apache-2.0
/// Elements of accessors as numbers, independent of their format, and the distance of two lists.
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

/// The difference of two numbers; 0 if both are NaN, infinite if only one is.
double apart(double a, double b);

/// How the distance of two elements is measured.
enum class Metric : std::uint8_t {
  component,  ///< the greatest difference of a component
  euclidean,  ///< of the first three components
  /// The angle in degrees between those; infinite where another component differs, or only one of
  /// the two has a direction.
  direction,
};
double distance(Metric metric, const Element& a, const Element& b, unsigned components);

/// The elements of an accessor, or of an attribute in a bitstream; zeros if there is no stored
/// data. Normalized integers are rounded to single precision, as in a file with floats.
class Column {
 public:
  /// Nothing if they cannot be read, or if there are too many for their bytes.
  static std::optional<Column> open(const Side& side, std::uint32_t accessor);
  static std::optional<Column> open(const Side& side, const model::PrimitiveData& data,
                                    const model::Attribute& attribute);
  /// Of a morph target, which no bitstream holds.
  static std::optional<Column> open_target(const Side& side, const model::Attribute& attribute);

  std::uint64_t count() const { return count_; }
  unsigned components() const { return model::component_count(format_.type); }
  const model::Format& format() const { return format_; }

  /// One element at any position. Precondition: `index` is below count().
  Element at(std::uint64_t index) const;
  /// Copies elements [first, first + count) packed, in their stored format. `next` as for
  /// AccessorData::read().
  void read(std::byte* to, std::uint64_t first, std::size_t count, std::uint64_t& next) const;
  /// Bytes of one element in the output of read().
  std::size_t packed_size() const;
  Element decode(const std::byte* from) const;

 private:
  static std::optional<Column> make(const Side& side, std::uint32_t accessor,
                                    std::optional<model::AccessorData> data);

  model::Format format_;
  std::uint64_t count_ = 0;
  std::optional<model::AccessorData> data_;  ///< none: zeros
};

struct Farthest {
  double distance = 0;
  std::uint64_t at = 0;  ///< the first element at that distance
};

/// Compares all elements in order. Precondition: equal numbers of elements and components.
Farthest farthest(Metric metric, const Column& a, const Column& b);

/// All numbers of a column. Precondition: its components are unsigned integers.
std::vector<std::uint32_t> read_indices(const Column& column);

}  // namespace gltfx::prove
