// SPDX-License-Identifier: Apache-2.0
/// Writes elements of an accessor in place; AccessorData reads them.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "model/accessor.hpp"

namespace gltfx::model {

/// Appends a number in the form of a buffer.
template <class T>
void append_number(std::string& bytes, T number) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &number, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

/// Elements of an accessor that is neither sparse nor of matrices.
class AccessorWriter {
 public:
  /// Element i is at `begin` + i * `stride`. Precondition: `content` outlives this and has all
  /// elements; the components are of glTF 2.0.
  AccessorWriter(std::string& content, const Format& format, std::uint64_t count,
                 std::uint64_t begin, std::uint64_t stride)
      : content_(&content),
        format_(format),
        count_(count),
        begin_(begin),
        stride_(stride),
        components_(component_count(format.type)),
        component_size_(component_size(format.component)) {}

  std::uint64_t count() const { return count_; }
  const Format& format() const { return format_; }
  bool is_float() const { return format_.component == ComponentType::float32; }
  unsigned components() const { return components_; }
  double get(std::uint64_t element, unsigned component) const;
  /// Integers are rounded; precondition: they can hold the value.
  void set(std::uint64_t element, unsigned component, double value);
  /// Bytes of one element, packed.
  std::string bytes(std::uint64_t element) const;
  void set_bytes(std::uint64_t element, std::string_view bytes);

 private:
  std::size_t at(std::uint64_t element, unsigned component) const {
    return static_cast<std::size_t>(begin_ + element * stride_ + component * component_size_);
  }

  std::string* content_;
  Format format_;
  std::uint64_t count_, begin_, stride_;
  unsigned components_, component_size_;
};

}  // namespace gltfx::model
