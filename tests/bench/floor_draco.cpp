// SPDX-License-Identifier: Apache-2.0
// Floor of a check of compressed geometry: maps a GLB and decodes every Draco bitstream in it.
//
//   floor_draco FILE.glb THREADS
#include <atomic>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include <draco/compression/decode.h>

#include "mapped.hpp"

namespace {

// Each from its first byte to that of the next one.
std::vector<std::string_view> bitstreams(std::string_view file) {
  std::vector<std::string_view> found;
  for (std::size_t at = file.find("DRACO\2"); at != std::string_view::npos;) {
    const std::size_t next = file.find("DRACO\2", at + 1);
    found.push_back(file.substr(at, next - at));
    at = next;
  }
  return found;
}

bool decode(std::string_view bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  return decoder.DecodeMeshFromBuffer(&buffer).ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string_view file = gltfx::bench::mapped(argv[1]);
  if (file.empty()) return 3;
  const auto all = bitstreams(file);
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
