// SPDX-License-Identifier: Apache-2.0
/// Whether the tests are built with AddressSanitizer, which keeps what was freed: then the memory
/// of a process says nothing.
#pragma once

namespace gltfx::program {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace gltfx::program
