// SPDX-License-Identifier: Apache-2.0
#include "model/elements.hpp"

namespace gltfx::model {

std::vector<float> element_at(const AccessorData& data, std::uint64_t index) {
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
