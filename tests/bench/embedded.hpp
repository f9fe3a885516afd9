// SPDX-License-Identifier: Apache-2.0
// Work over all payloads of one kind in a GLB, for floors that only decode.
#pragma once

#include <atomic>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "mapped.hpp"

namespace gltfx::bench {

// Each from its magic to that of the next one.
inline std::vector<std::string_view> payloads(std::string_view file, std::string_view magic) {
  std::vector<std::string_view> found;
  for (std::size_t at = file.find(magic); at != std::string_view::npos;) {
    const std::size_t next = file.find(magic, at + 1);
    found.push_back(file.substr(at, next - at));
    at = next;
  }
  return found;
}

// A floor's main: FILE.glb THREADS. Exit code 0 when `decode` took every payload.
template <typename Decode>
int decode_all(int argc, char** argv, std::string_view magic, Decode decode) {
  if (argc != 3) return 2;
  const std::string_view file = mapped(argv[1]);
  if (file.empty()) return 3;
  const auto all = payloads(file, magic);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> sound = !all.empty();
  const auto work = [&] {
    for (std::size_t i = next++; i < all.size(); i = next++) {
      if (!decode(all[i])) sound = false;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::atoi(argv[2]); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return sound ? 0 : 1;
}

}  // namespace gltfx::bench
