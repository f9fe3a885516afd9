// SPDX-License-Identifier: Apache-2.0
/// The elements of an accessor as plain arrays, block by block: strides, padded columns of matrices
/// and sparse replacements are resolved (specification section 3.6.2.3).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "container/mapped_files.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// Effect of a malformed member: it makes the data unusable, or it counts as absent as for the
/// Khronos validator, which rounds a stride down to whole components.
enum class Malformed : std::uint8_t { unusable, absent };

/// Packed numbers of one component type, and their count.
struct PackedNumbers {
  container::Bytes bytes;
  ComponentType type = ComponentType::none;
  /// Precondition: `at` numbers fit into the bytes; the type is that of sparse indices.
  std::uint32_t index(std::uint64_t at) const;
};

/// The indices of a sparse accessor, or nothing when some are missing or not aligned. They may be
/// outside their buffer view, as long as the buffer has them.
std::optional<PackedNumbers> sparse_indices(const Asset& asset, const Views& views,
                                            const ResourceData& resources, const Sparse& sparse);

/// Reads the elements of one accessor. Every range has been checked against the available bytes.
/// Keeps those alive; independent of the resources.
class AccessorData {
 public:
  /// Nothing when the accessor has no data, or data that cannot be read: unknown format, missing,
  /// too few or unaligned bytes, a stride below the element's size, more sparse elements than
  /// elements.
  static std::optional<AccessorData> open(const Asset& asset, const Views& views,
                                          const ResourceData& resources, const Accessor& accessor,
                                          Malformed malformed);

  /// Packed elements, as from a decoder: `count` of that format, without padding of columns. `step`
  /// is the distance of quantised values, 0 when they are exact. Nothing when there are fewer
  /// bytes, or the component is not one of glTF 2.0 itself.
  static std::optional<AccessorData> packed(const Format& format, std::uint64_t count,
                                            container::Bytes bytes, double step);

  const Format& format() const { return format_; }
  /// The step of packed() elements; nothing for elements in a buffer.
  const std::optional<double>& step() const { return step_; }
  std::uint64_t count() const { return count_; }
  unsigned components() const { return components_; }
  /// All elements except the sparse ones are zeros without bytes: the size of the file does not
  /// bound the count.
  bool implied() const { return base_.empty(); }

  /// Elements of a block: a multiple of 48, so that triangles and groups of 2, 4, 8 or 16 are not
  /// split.
  std::size_t block_elements() const { return kBlockValues / std::max(components_, 1U) / 48 * 48; }

  /// Copies elements [first, first + count) packed to `to`, which has room for them. `next` is 0
  /// for the first call and then kept by the caller; reads must go forward.
  void read(std::byte* to, std::uint64_t first, std::size_t count, std::uint64_t& next) const {
    copy(to, first, count);
    replace(to, first, count, next);
  }

  /// Copies any one element. Precondition: `index` is below count().
  void read_one(std::byte* to, std::uint64_t index) const;

  /// Calls `visit(values, elements, first)` over all elements in order: `values` has
  /// elements * components() numbers and is only valid during the call, `first` is the index of the
  /// first element. T is the component's type. Packed data is not copied.
  template <typename T, typename Visit>
  void visit(Visit&& visit) const;

 private:
  static constexpr std::size_t kBlockValues = 4096;

  bool open_base(const Asset& asset, const Views& views, const ResourceData& resources,
                 const Accessor& accessor, Malformed malformed);
  bool open_sparse(const Asset& asset, const Views& views, const ResourceData& resources,
                   const Accessor& accessor, Malformed malformed);

  template <typename T>
  bool in_place() const {
    const auto address = reinterpret_cast<std::uintptr_t>(base_.view().data());
    return !implied() && sparse_count_ == 0 && rows_ == components_ &&
           stride_ == sizeof(T) * components_ && address % alignof(T) == 0;
  }
  /// Copies elements [first, first + count) of the base.
  void copy(std::byte* to, std::uint64_t first, std::size_t count) const;
  /// Applies sparse replacements to elements [first, first + count). `next` is the first
  /// replacement that has not been used.
  void replace(std::byte* to, std::uint64_t first, std::size_t count, std::uint64_t& next) const;

  Format format_;
  std::uint64_t count_ = 0;
  unsigned components_ = 1;
  unsigned component_size_ = 1;
  unsigned rows_ = 1;  ///< contiguous components: all, or those of a column
  std::uint64_t column_stride_ = 0;
  container::Bytes base_;
  std::uint64_t stride_ = 0;
  std::optional<double> step_;
  std::uint64_t sparse_count_ = 0;
  PackedNumbers sparse_indices_;
  container::Bytes sparse_values_;
};

template <typename T, typename Visit>
void AccessorData::visit(Visit&& visit) const {
  const std::size_t block = block_elements();
  const container::ReadMeter meter(base_);
  if (in_place<T>()) {
    const T* values = reinterpret_cast<const T*>(base_.view().data());
    for (std::uint64_t first = 0; first < count_; first += block) {
      const auto elements =
          static_cast<std::size_t>(std::min<std::uint64_t>(block, count_ - first));
      visit(values + first * components_, elements, first);
      meter.add(elements * sizeof(T) * components_);
    }
    return;
  }
  std::array<T, kBlockValues> buffer{};
  auto* to = reinterpret_cast<std::byte*>(buffer.data());
  std::uint64_t next = 0;
  for (std::uint64_t first = 0; first < count_; first += block) {
    const auto elements = static_cast<std::size_t>(std::min<std::uint64_t>(block, count_ - first));
    read(to, first, elements, next);
    visit(static_cast<const T*>(buffer.data()), elements, first);
    if (!implied()) meter.add(elements * static_cast<std::size_t>(stride_));
  }
}

/// Calls `use` with a value of the components' type in memory. Precondition: one of the six types
/// of glTF 2.0 itself.
template <typename Use>
auto with_component_type(ComponentType type, Use&& use) {
  switch (type) {
    case ComponentType::int8:
      return use(std::int8_t{});
    case ComponentType::uint8:
      return use(std::uint8_t{});
    case ComponentType::int16:
      return use(std::int16_t{});
    case ComponentType::uint16:
      return use(std::uint16_t{});
    case ComponentType::uint32:
      return use(std::uint32_t{});
    default:
      return use(float{});
  }
}

/// The value of a normalized integer, as in the specification's section 3.6.2.2.
template <typename T>
double normalize(T value) {
  constexpr double kMost = static_cast<double>(std::numeric_limits<T>::max());
  return std::max(static_cast<double>(value) / kMost, -1.0);
}

}  // namespace gltfx::model
