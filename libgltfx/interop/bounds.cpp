// SPDX-License-Identifier: Apache-2.0
#include "interop/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include <tiny_gltf.h>

#include "model/accessor_data.hpp"

namespace gltfx::interop {
namespace {

struct Bounds {
  std::vector<double> least, greatest;
};

template <class T>
Bounds bounds_of(const unsigned char* from, std::size_t stride, std::size_t count,
                 std::size_t components) {
  Bounds bounds{std::vector<double>(components, HUGE_VAL),
                std::vector<double>(components, -HUGE_VAL)};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < components; ++k) {
      T value;
      std::memcpy(&value, from + i * stride + k * sizeof(T), sizeof(T));
      bounds.least[k] = std::min(bounds.least[k], static_cast<double>(value));
      bounds.greatest[k] = std::max(bounds.greatest[k], static_cast<double>(value));
    }
  }
  return bounds;
}

// Compares bounds in single precision.
bool agree(const std::vector<double>& stated, const std::vector<double>& found) {
  return std::equal(
      stated.begin(), stated.end(), found.begin(), found.end(),
      [](double a, double b) { return static_cast<float>(a) == static_cast<float>(b); });
}

bool restate(std::vector<double>& stated, std::vector<double>& found) {
  if (stated.empty() || agree(stated, found)) return false;
  stated = std::move(found);
  return true;
}

}  // namespace

bool restate_bounds(const tinygltf::Model& model, tinygltf::Accessor& accessor) {
  const auto type = static_cast<std::uint32_t>(accessor.type);
  const auto component = static_cast<std::uint32_t>(accessor.componentType);
  const int components = tinygltf::GetNumComponentsInType(type);
  const int size = tinygltf::GetComponentSizeInBytes(component);
  const bool padded =
      accessor.type >= TINYGLTF_TYPE_MAT2 && accessor.type <= TINYGLTF_TYPE_MAT4 && size < 4;
  if (accessor.sparse.isSparse || padded || components < 1 || size < 1) return false;
  const tinygltf::BufferView& view =
      model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const std::size_t packed = static_cast<std::size_t>(components) * static_cast<std::size_t>(size);
  const std::size_t stride = view.byteStride == 0 ? packed : view.byteStride;
  const auto& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const unsigned char* from = bytes.data() + view.byteOffset + accessor.byteOffset;
  Bounds bounds = model::with_component_type(
      static_cast<model::ComponentType>(accessor.componentType), [&](auto zero) {
        return bounds_of<decltype(zero)>(from, stride, accessor.count,
                                         static_cast<std::size_t>(components));
      });
  const bool least = restate(accessor.minValues, bounds.least);
  return restate(accessor.maxValues, bounds.greatest) || least;
}

}  // namespace gltfx::interop
