// SPDX-License-Identifier: Apache-2.0
#include "model/accessor_writer.hpp"

#include <cmath>
#include <type_traits>

#include "model/accessor_data.hpp"

namespace gltfx::model {

double AccessorWriter::get(std::uint64_t element, unsigned component) const {
  return with_component_type(format_.component, [&](auto value) {
    std::memcpy(&value, content_->data() + at(element, component), sizeof(value));
    return static_cast<double>(value);
  });
}

void AccessorWriter::set(std::uint64_t element, unsigned component, double number) {
  with_component_type(format_.component, [&](auto value) {
    using T = decltype(value);
    value =
        std::is_floating_point_v<T> ? static_cast<T>(number) : static_cast<T>(std::llround(number));
    std::memcpy(content_->data() + at(element, component), &value, sizeof(value));
  });
}

std::string AccessorWriter::bytes(std::uint64_t element) const {
  return content_->substr(at(element, 0), std::size_t{components_} * component_size_);
}

void AccessorWriter::set_bytes(std::uint64_t element, std::string_view bytes) {
  std::memcpy(content_->data() + at(element, 0), bytes.data(), bytes.size());
}

}  // namespace gltfx::model
