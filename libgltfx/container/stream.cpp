// SPDX-License-Identifier: Apache-2.0
#include "container/stream.hpp"

#include <array>
#include <cerrno>
#include <exception>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "container/resolve_error.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t kPiece = 65536;  // what a pipe holds

ssize_t read_waiting(int fd, std::array<char, kPiece>& piece) {
  for (;;) {
    const ssize_t got = ::read(fd, piece.data(), piece.size());
    if (got >= 0) return got;
    if (errno == EAGAIN) {
      pollfd waited{fd, POLLIN, 0};
      ::poll(&waited, 1, -1);
    } else if (errno != EINTR) {
      return got;
    }
  }
}

bool append(std::string& text, const char* piece, std::size_t length) {
  try {
    text.append(piece, length);
  } catch (const std::exception&) {  // bad_alloc, length_error
    return false;
  }
  return true;
}

}  // namespace

Result<Bytes> read_stream(int fd, std::uint64_t max_bytes) {
  std::string text;
  const auto piece = std::make_unique<std::array<char, kPiece>>();
  for (;;) {
    const ssize_t got = read_waiting(fd, *piece);
    if (got < 0) return Error{fmt::format("The stream cannot be read: {}.", errno_text(errno))};
    if (got == 0) return Bytes::from_string(std::move(text));
    const auto length = static_cast<std::size_t>(got);
    if (length > max_bytes - text.size()) {
      return Error{fmt::format(
          "The stream exceeds the limit of {} bytes; pass the asset as a path or raise the limit.",
          max_bytes)};
    }
    if (!append(text, piece->data(), length)) {
      return Error{
          fmt::format("There is not enough memory for the stream ({} bytes read so far); pass the "
                      "asset as a path.",
                      text.size())};
    }
  }
}

}  // namespace gltfx::container
