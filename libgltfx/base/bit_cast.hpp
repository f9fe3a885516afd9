// SPDX-License-Identifier: Apache-2.0
/// std::bit_cast, which the standard library of WebAssembly's compiler does not have.
#pragma once

#include <type_traits>

namespace gltfx {

template <typename To, typename From>
constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

}  // namespace gltfx
