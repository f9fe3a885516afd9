// SPDX-License-Identifier: Apache-2.0
/// A sequence of numbers and texts in a frame.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gltfx::codec {

class FieldWriter {
 public:
  template <typename T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.resize(bytes_.size() + sizeof value);
    std::memcpy(bytes_.data() + bytes_.size() - sizeof value, &value, sizeof value);
  }
  template <typename Enum>
  void name(Enum value) {
    number(static_cast<std::uint8_t>(value));
  }
  /// At most 65535 bytes.
  void text(std::string_view text) {
    number(static_cast<std::uint16_t>(text.size()));
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), data, data + text.size());
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Returns zeros after a field that was missing or out of range; check `sound()`.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename T>
  T number() {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    T value{};
    if (bytes_.size() < sizeof value) {
      fail();
      return value;
    }
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  /// A value of an enumeration that ends with `last`.
  template <typename Enum>
  Enum name(Enum last) {
    const auto value = number<std::uint8_t>();
    if (value <= static_cast<std::uint8_t>(last)) return static_cast<Enum>(value);
    fail();
    return Enum{};
  }
  bool flag() { return check_at_most<std::uint8_t>(number<std::uint8_t>(), 1) == 1; }
  std::string text(std::size_t most) {
    const auto size = number<std::uint16_t>();
    if (size > most || size > bytes_.size()) {
      fail();
      return {};
    }
    std::string text(reinterpret_cast<const char*>(bytes_.data()), size);
    bytes_ = bytes_.subspan(size);
    return text;
  }
  template <typename T>
  T check_at_most(T value, T most) {
    if (value > most) fail();
    return value > most ? T{} : value;
  }
  void require(bool holds) {
    if (!holds) fail();
  }
  /// Whether all fields were complete and nothing is left.
  bool complete() const { return sound_ && bytes_.empty(); }
  bool sound() const { return sound_; }

 private:
  void fail() {
    sound_ = false;
    bytes_ = {};
  }

  std::span<const std::byte> bytes_;
  bool sound_ = true;
};

}  // namespace gltfx::codec
