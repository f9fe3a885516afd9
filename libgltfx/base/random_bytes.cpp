// SPDX-License-Identifier: Apache-2.0
#include "base/random_bytes.hpp"

#include <chrono>
#include <cstdint>
#include <exception>
#include <random>

namespace gltfx {

void fill_with_random(std::span<unsigned char> bytes) {
  const auto now = static_cast<std::uint64_t>(
      std::chrono::high_resolution_clock::now().time_since_epoch().count());
  std::mt19937_64 generator(now ^ reinterpret_cast<std::uintptr_t>(&now) << 16);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(generator());
  try {
    std::random_device device;
    for (unsigned char& byte : bytes) byte ^= static_cast<unsigned char>(device());
  } catch (const std::exception&) {  // there is no source of entropy
  }
}

}  // namespace gltfx
