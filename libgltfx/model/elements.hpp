// SPDX-License-Identifier: Apache-2.0
/// Elements of accessors as arrays of single precision numbers, from any stored format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/accessor_data.hpp"

namespace gltfx::model {

template <std::size_t N>
using Vectors = std::vector<std::array<float, N>>;

/// A component as a number (specification section 3.6.2.2): integers that are not normalized keep
/// their value.
template <typename T>
float to_float(T value, bool normalized) {
  if constexpr (std::is_integral_v<T>) {
    if (normalized) return static_cast<float>(normalize(value));
  }
  return static_cast<float>(value);
}

/// Calls `use(index, component, value)` for all components of the first `count` elements.
template <typename Use>
void for_each_component(const AccessorData& data, std::size_t count, Use use) {
  const bool normalized = data.format().normalized;
  const unsigned components = data.components();
  with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t first) {
      if (first >= count) return;
      elements = std::min<std::size_t>(elements, count - static_cast<std::size_t>(first));
      for (std::size_t i = 0; i < elements; ++i) {
        for (unsigned k = 0; k < components; ++k) {
          use(static_cast<std::size_t>(first) + i, k,
              to_float(values[i * components + k], normalized));
        }
      }
    });
  });
}

/// Overwrites the elements of `to`, which has as many; components that an element does not have are
/// not changed. Precondition: elements have at most N components.
template <std::size_t N>
void read_elements(const AccessorData& data, Vectors<N>& to) {
  for_each_component(data, to.size(),
                     [&](std::size_t i, unsigned k, float value) { to[i][k] = value; });
}

/// Adds `weight` times the elements to the first components of `to`; extra components are left out.
template <std::size_t N>
void add_elements(const AccessorData& data, float weight, unsigned components, Vectors<N>& to) {
  for_each_component(data, to.size(), [&](std::size_t i, unsigned k, float value) {
    if (k < components) to[i][k] += weight * value;
  });
}

/// Reads elements block by block, so that several accessors can be walked side by side.
class ElementBlocks {
 public:
  explicit ElementBlocks(AccessorData data) : data_(std::move(data)) {}
  const AccessorData& data() const { return data_; }

  /// Reads elements [first, first + to.size()), as read_elements() does. Blocks come in order.
  template <std::size_t N>
  void read(std::uint64_t first, Vectors<N>& to) {
    const unsigned components = data_.components();
    with_component_type(data_.format().component, [&](auto zero) {
      using T = decltype(zero);
      std::vector<T> values(to.size() * components);
      data_.read(reinterpret_cast<std::byte*>(values.data()), first, to.size(), next_);
      for (std::size_t i = 0; i < values.size(); ++i) {
        to[i / components][i % components] = to_float(values[i], data_.format().normalized);
      }
    });
  }

 private:
  AccessorData data_;
  std::uint64_t next_ = 0;
};

/// One index of unsigned scalars, at any position that exists. Nothing: they have another format.
inline std::optional<std::uint64_t> index_at(const AccessorData& data, std::uint64_t at) {
  std::optional<std::uint64_t> index;
  if (at >= data.count() || data.components() != 1) return index;
  with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_unsigned_v<T>) {
      T value = 0;
      data.read_one(reinterpret_cast<std::byte*>(&value), at);
      index = value;
    }
  });
  return index;
}

/// One element at any position: for curves, of which few elements are read. Empty when it does not
/// exist.
inline std::vector<float> element_at(const AccessorData& data, std::uint64_t index) {
  if (index >= data.count()) return {};
  std::vector<float> element(data.components());
  with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    std::array<T, 16> values{};
    data.read_one(reinterpret_cast<std::byte*>(values.data()), index);
    for (unsigned k = 0; k < data.components(); ++k) {
      element[k] = to_float(values[k], data.format().normalized);
    }
  });
  return element;
}

}  // namespace gltfx::model
