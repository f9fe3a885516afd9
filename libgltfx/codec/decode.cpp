// SPDX-License-Identifier: Apache-2.0
#include "codec/decode.hpp"

#include <exception>
#include <new>

namespace gltfx::codec {

Answer decode_safely(const Decode& decode, const Job& job, std::span<const std::byte> bytes,
                     const Output& output) {
  try {
    return decode(job, bytes, output);
  } catch (const std::bad_alloc&) {
    return DecodeError{ErrorKind::out_of_memory, "Decoding exceeds the memory limit."};
  } catch (const std::exception& error) {
    return DecodeError{ErrorKind::malformed, error.what()};
  }
}

}  // namespace gltfx::codec
