// SPDX-License-Identifier: Apache-2.0
/// Whether the tests are built with AddressSanitizer. It keeps freed memory, so that the memory of
/// a process is meaningless, and everything takes several times as long: tests of large input take
/// less.
#pragma once

namespace gltfx {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace gltfx
