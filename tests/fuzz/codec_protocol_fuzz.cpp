// SPDX-License-Identifier: Apache-2.0
// Frames of workers: whatever comes, what is read is in range and reads the same when it is written
// again; a result lies inside the memory that it is said to fill.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "codec/packet.hpp"
#include "codec/protocol.hpp"

namespace {

using namespace gltfx::codec;

void require(bool holds) {
  if (!holds) std::abort();
}

// Attaches a result to memory of exactly its size and touches its ends.
template <typename Result>
void touch(Result result) {
  constexpr std::uint64_t kMost = 1U << 20U;
  const auto size = result_size(result);
  if (!size || *size > kMost) return;
  const std::vector<std::uint64_t> memory((*size + 7) / 8);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(memory));
  if (*size > 0) require(!attach(result, bytes.first(static_cast<std::size_t>(*size - 1))));
  if (!attach(result, bytes)) return;
  if constexpr (std::is_same_v<Result, DracoMesh>) {
    for (const DracoAttribute& attribute : result.attributes) {
      if (!attribute.values.empty()) require(attribute.values.back() == std::byte{0});
    }
  } else if (!result.pixels.empty()) {
    require(result.pixels.back() == std::byte{0});
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto frame = std::as_bytes(std::span(data, size));
  if (const auto job = read_job(frame)) require(read_job(write_job(*job)) == job);
  if (const auto hello = read_hello(frame)) require(read_hello(write_hello(*hello)) == hello);
  if (const auto control = read_control(frame)) {
    require(read_control(write_control(*control)) == control);
  }
  const auto answer = read_answer(frame);
  if (!answer) return 0;
  const Frame written = write_answer(*answer);
  require(written.size() == size && std::equal(written.begin(), written.end(), frame.begin()));
  if (const auto* mesh = std::get_if<DracoMesh>(&*answer)) touch(*mesh);
  if (const auto* image = std::get_if<Image>(&*answer)) touch(*image);
  return 0;
}
