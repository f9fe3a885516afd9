// SPDX-License-Identifier: Apache-2.0
#include "codec/decode.hpp"

#include <cstring>
#include <exception>
#include <new>

namespace gltfx::codec {
namespace {

DecodeError out_of_memory() {
  return {ErrorKind::out_of_memory, "Decoding exceeds the memory limit."};
}

}  // namespace

Answer decode_safely(const Decode& decode, const Job& job, std::span<const std::byte> bytes,
                     const Output& output) {
  try {
    return decode(job, bytes, output);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  } catch (const std::exception& error) {
    return DecodeError{ErrorKind::malformed, error.what()};
  }
}

Answer hand_over(std::span<const std::byte> file, const Output& output) {
  const std::span<std::byte> to = output(file.size());
  if (to.size() < file.size() || file.empty()) return out_of_memory();
  std::memcpy(to.data(), file.data(), file.size());
  EncodedImage image;
  image.size = file.size();
  return image;
}

}  // namespace gltfx::codec
