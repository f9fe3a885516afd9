// SPDX-License-Identifier: Apache-2.0
/// Seals by a secret key: who does not know the key can neither make one nor move one to other
/// bytes. A message authentication code, BLAKE2b with a key, by libsodium.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace gltfx {

/// Bytes that a secret has at least.
inline constexpr std::size_t kShortestSecret = 32;

/// Safe to use from several threads.
class Seal {
 public:
  using Tag = std::array<unsigned char, 16>;

  /// Of any bytes that are kept secret.
  explicit Seal(std::string_view secret);

  /// Of all parts together. Only the last may differ in length from one call to the next.
  Tag of(std::initializer_list<std::string_view> parts) const;
  /// Whether a tag is that of these parts; takes as long for one that is nearly right.
  bool fits(const Tag& tag, std::initializer_list<std::string_view> parts) const;
  /// Tells keys apart without giving them away.
  const Tag& name() const { return name_; }

 private:
  std::array<unsigned char, 32> key_{};
  Tag name_{};
};

/// The secret that seals the results of this user, from $XDG_STATE_HOME/gltfx/cache.key or
/// ~/.local/state/gltfx/cache.key; made there when it is not there, for this user only. An Error
/// when that cannot be done, or when others can read or write the file.
Result<std::string> users_secret();

}  // namespace gltfx
