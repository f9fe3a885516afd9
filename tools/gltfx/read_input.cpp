// SPDX-License-Identifier: Apache-2.0
#include "read_input.hpp"

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18U;

Result<std::string> read_all(int fd) {
  std::string text;
  std::vector<char> chunk(kChunk);
  while (true) {
    const ssize_t got = ::read(fd, chunk.data(), chunk.size());
    if (got == 0) return text;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return Error{std::error_code(errno, std::generic_category()).message()};
    text.append(chunk.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

Result<std::string> read_stdin() { return read_all(STDIN_FILENO); }

Result<std::string> read_text_file(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  Result<std::string> text =
      fd < 0 ? Error{std::error_code(errno, std::generic_category()).message()} : read_all(fd);
  if (fd >= 0) ::close(fd);
  if (text) return text;
  return Error{fmt::format("cannot read {}: {}", quoted(path, 200), text.error().message)};
}

}  // namespace gltfx::tool
