// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/metadata/value_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "rules/payload/element_kernels.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataComponent;
using model::MetadataProperty;

constexpr std::size_t kBlockBytes = std::size_t{32} << 10U;

// Integers of values of an enum, most of them in a window covered by one table.
template <typename T>
class EnumTable {
 public:
  explicit EnumTable(const model::MetadataEnum& source) : source_(source) {
    if (source.values.empty()) return;
    // Sorted as unsigned: negative numbers come after all others.
    first_ = source.values.front();
    if constexpr (std::is_signed_v<T>) {
      const auto negative =
          std::lower_bound(source.values.begin(), source.values.end(), std::uint64_t{1} << 63U);
      if (negative != source.values.end()) first_ = *negative;
    }
    for (const std::uint64_t value : source.values) {
      const std::uint64_t at = value - first_;
      if (at >= kWindow) {
        window_.clear();
        return;
      }
      if (at >= window_.size()) window_.resize(static_cast<std::size_t>(at) + 1);
      window_[static_cast<std::size_t>(at)] = 1;
    }
  }

  bool contains(T value) const {
    const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    if (window_.empty()) return source_.has_value(bits);
    const std::uint64_t at = bits - first_;
    return at < window_.size() && window_[static_cast<std::size_t>(at)] != 0;
  }

 private:
  static constexpr std::uint64_t kWindow = 65536;
  const model::MetadataEnum& source_;
  std::uint64_t first_ = 0;
  std::vector<std::uint8_t> window_;  // empty: the values are too far apart
};

// Smallest and greatest value of each component of rows of any width.
template <typename T>
class RowExtremes {
 public:
  explicit RowExtremes(std::size_t width) : width_(width) {
    constexpr std::array<std::size_t, 7> kFast{1, 2, 3, 4, 8, 9, 16};
    if (std::find(kFast.begin(), kFast.end(), width) == kFast.end()) return;
    const auto components = static_cast<unsigned>(width);
    fast_.emplace_back(components, false);
    fast_.emplace_back(components, true);
  }

  void add(const T* values, std::size_t rows) {
    any_ = any_ || rows != 0;
    for (auto& each : fast_) each.add(values, rows);
    if (!fast_.empty()) return;
    if (least_.empty() && rows != 0) {
      least_.assign(values, values + width_);
      most_ = least_;
    }
    for (std::size_t row = 0; row < rows; ++row, values += width_) {
      for (std::size_t i = 0; i < width_; ++i) {
        least_[i] = std::min(least_[i], values[i]);
        most_[i] = std::max(most_[i], values[i]);
      }
    }
  }

  void copy_to(std::vector<double>& least, std::vector<double>& most) const {
    for (std::size_t i = 0; any_ && i < width_; ++i) {
      const auto component = static_cast<unsigned>(i);
      least.push_back(static_cast<double>(fast_.empty() ? least_[i] : fast_[0].of(component)));
      most.push_back(static_cast<double>(fast_.empty() ? most_[i] : fast_[1].of(component)));
    }
  }

 private:
  std::size_t width_;
  bool any_ = false;
  std::vector<kernels::Extremes<T>> fast_;  // smallest, greatest
  std::vector<T> least_, most_;             // for widths that the fast ones do not support
};

template <typename T>
bool is_finite(T value) {
  if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
  return true;
}

// Precondition: in the range of the component type, whose greatest 64-bit numbers are not doubles.
template <typename T>
T stored_as(double number) {
  constexpr double kBeyond = static_cast<double>(std::numeric_limits<T>::max());
  if constexpr (std::is_integral_v<T>) {
    if (number >= kBeyond) return std::numeric_limits<T>::max();
  }
  return static_cast<T>(number);
}

template <typename T>
class TypedScan final : public ValueScan {
 public:
  TypedScan(const MetadataProperty& property, const ValueLimits& limits, std::size_t width)
      : width_(width), extremes_(width), bounded_(limits.any()) {
    if (property.type == model::MetadataType::enumeration) table_.emplace(*property.enumeration);
    for (const double number : limits.no_data) no_data_.push_back(stored_as<T>(number));
    block_rows_ = std::max(kBlockBytes / sizeof(T) / width / 16 * 16, std::size_t{16});
  }

  void add(std::span<const std::byte> bytes, std::uint64_t rows) override {
    const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
    const bool aligned = address % alignof(T) == 0;
    const std::size_t row_bytes = width_ * sizeof(T);
    if (!aligned) buffer_.resize(block_rows_ * width_);
    for (std::uint64_t done = 0; done < rows;) {
      const auto some = static_cast<std::size_t>(std::min<std::uint64_t>(block_rows_, rows - done));
      const std::byte* at = bytes.data() + done * row_bytes;
      if (!aligned) std::memcpy(buffer_.data(), at, some * row_bytes);
      block(aligned ? reinterpret_cast<const T*>(at) : buffer_.data(), some);
      done += some;
      row_ += some;
    }
  }

  ValueFindings finish() const override {
    ValueFindings found = found_;
    if (bounded_ && found.infinite.count == 0) extremes_.copy_to(found.least, found.most);
    return found;
  }

 private:
  void block(const T* values, std::size_t rows) {
    if constexpr (std::is_floating_point_v<T>) {
      if (kernels::count_non_finite(values, rows * width_) != 0) {
        note_all(values, rows, found_.infinite, [](T value) { return is_finite(value); });
      }
    }
    if (table_) note_unlisted(values, rows);
    if (!bounded_) return;
    if (no_data_.size() != width_) return extremes_.add(values, rows);
    add_without_no_data(values, rows);
  }

  void note_unlisted(const T* values, std::size_t rows) {
    bool all = true;
    for (std::size_t i = 0; i < rows * width_; ++i) all &= table_->contains(values[i]);
    if (all) return;
    note_all(values, rows, found_.unlisted, [this](T value) { return table_->contains(value); });
  }

  template <typename Good>
  void note_all(const T* values, std::size_t rows, ValueFindings::Tally& tally, Good good) {
    for (std::size_t i = 0; i < rows * width_; ++i) {
      if (good(values[i])) continue;
      if (tally.count++ != 0) continue;
      tally.row = row_ + i / width_;
      tally.value = fmt::format("{}", values[i]);
    }
  }

  // Rows with the noData value are left out: later rows move up.
  void add_without_no_data(const T* values, std::size_t rows) {
    if (compact_.size() < rows * width_) compact_.resize(block_rows_ * width_);
    T* to = compact_.data();
    if (width_ == 1) {
      const T none = no_data_[0];
      for (std::size_t i = 0; i < rows; ++i) {
        *to = values[i];
        to += values[i] != none ? 1 : 0;
      }
    } else {
      for (std::size_t row = 0; row < rows; ++row, values += width_) {
        if (std::equal(values, values + width_, no_data_.begin())) continue;
        to = std::copy_n(values, width_, to);
      }
    }
    pend(static_cast<std::size_t>(to - compact_.data()) / width_);
  }

  // Extremes need whole blocks of 16, except for the last one; so the last row is repeated to fill
  // it.
  void pend(std::size_t rows) {
    if (rows == 0) return;
    const std::size_t padded = std::min((rows + 15) / 16 * 16, block_rows_);
    const T* last = compact_.data() + (rows - 1) * width_;
    T* to = compact_.data() + rows * width_;
    for (std::size_t i = rows; i < padded; ++i) to = std::copy_n(last, width_, to);
    extremes_.add(compact_.data(), std::max(padded, rows));
  }

  std::size_t width_;
  std::size_t block_rows_ = 0;
  std::vector<T> buffer_;   // for unaligned data
  std::vector<T> compact_;  // rows without noData
  std::vector<T> no_data_;
  std::optional<EnumTable<T>> table_;
  RowExtremes<T> extremes_;
  bool bounded_;
  std::uint64_t row_ = 0;
  ValueFindings found_;
};

// Whether a value that is not in the table must still be searched for.
bool is_open(const MetadataProperty& property) {
  return property.enumeration != nullptr && property.enumeration->sound;
}

}  // namespace

std::unique_ptr<ValueScan> make_value_scan(const MetadataProperty& property,
                                           const ValueLimits& limits, std::uint64_t width) {
  const bool floats = !is_integer(property.component);
  const bool listed = property.type == model::MetadataType::enumeration && is_open(property);
  if (!floats && !listed && !limits.any()) return nullptr;
  if (width == 0 || width > kMostWidth) return nullptr;
  const auto make = [&](auto zero) -> std::unique_ptr<ValueScan> {
    using T = decltype(zero);
    return std::make_unique<TypedScan<T>>(property, limits, static_cast<std::size_t>(width));
  };
  switch (property.component) {
    case MetadataComponent::int8:
      return make(std::int8_t{});
    case MetadataComponent::uint8:
      return make(std::uint8_t{});
    case MetadataComponent::int16:
      return make(std::int16_t{});
    case MetadataComponent::uint16:
      return make(std::uint16_t{});
    case MetadataComponent::int32:
      return make(std::int32_t{});
    case MetadataComponent::uint32:
      return make(std::uint32_t{});
    case MetadataComponent::int64:
      return make(std::int64_t{});
    case MetadataComponent::uint64:
      return make(std::uint64_t{});
    case MetadataComponent::float32:
      return make(float{});
    case MetadataComponent::float64:
      return make(double{});
    case MetadataComponent::none:
      break;
  }
  return nullptr;
}

}  // namespace gltfx::validate
