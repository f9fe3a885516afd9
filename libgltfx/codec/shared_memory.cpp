// SPDX-License-Identifier: Apache-2.0
#include "codec/shared_memory.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <new>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace gltfx::codec {
namespace {

constexpr std::uint64_t kMostPopulated = std::uint64_t{64} << 20U;

UniqueFd create_unnamed_file() {
  const char* folder = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): never changed here
  if (folder != nullptr && *folder != '\0') {
    UniqueFd fd(::open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    if (fd) return fd;
  }
  return UniqueFd(::open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
}

bool has_bytes(int fd, std::uint64_t size) {
  const off_t end = ::lseek(fd, 0, SEEK_END);
  return end >= 0 && static_cast<std::uint64_t>(end) >= size;
}

// After this, the memory can neither shrink nor change. The kernel refuses while a writable mapping
// exists.
bool seal(int fd) {
  return ::fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL) == 0;
}

// Reads or writes all of [0, size) in pieces.
template <typename Step>
bool in_pieces(std::size_t size, const Step& step) {
  for (std::size_t at = 0; at < size;) {
    const ssize_t done = step(at, size - at);
    if (done > 0) {
      at += static_cast<std::size_t>(done);
    } else if (done == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

std::optional<Taken> copy_memory(int fd, std::size_t size) {
  std::shared_ptr<std::byte[]> copy(new (std::nothrow) std::byte[size]);
  if (!copy) return std::nullopt;
  const bool all = in_pieces(size, [&](std::size_t at, std::size_t left) {
    return ::pread(fd, copy.get() + at, left, static_cast<off_t>(at));
  });
  if (!all) return std::nullopt;
  return Taken{{copy.get(), size}, copy};
}

}  // namespace

UniqueFd create_memory() {
  UniqueFd fd(::memfd_create("gltfx", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  return fd ? std::move(fd) : create_unnamed_file();
}

Mapping::Mapping(int fd, std::uint64_t size, Access access) {
  if (size == 0 || size > std::numeric_limits<off_t>::max()) return;
  const bool write = access == Access::write;
  if (write && ::ftruncate(fd, static_cast<off_t>(size)) != 0) return;
  if (!write && !has_bytes(fd, size)) return;
  // A private read-only mapping shares the pages; sealed memory cannot be mapped otherwise.
  // Faulting pages one by one doubles the cost, but a large result may never be filled.
  const int sharing =
      (write ? MAP_SHARED : MAP_PRIVATE) | (size <= kMostPopulated ? MAP_POPULATE : 0);
  void* at = ::mmap(nullptr, size, write ? PROT_READ | PROT_WRITE : PROT_READ, sharing, fd, 0);
  if (at != MAP_FAILED) bytes_ = {static_cast<std::byte*>(at), static_cast<std::size_t>(size)};
}

Mapping::Mapping(Mapping&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

Mapping& Mapping::operator=(Mapping&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

Mapping::~Mapping() {
  if (!bytes_.empty()) ::munmap(bytes_.data(), bytes_.size());
}

bool fill_memory(int fd, std::span<const std::byte> bytes) {
  return in_pieces(bytes.size(), [&](std::size_t at, std::size_t left) {
    return ::pwrite(fd, bytes.data() + at, left, static_cast<off_t>(at));
  });
}

std::optional<Taken> take_memory(int fd, std::uint64_t size) {
  if (size == 0) return Taken{};
  if (!has_bytes(fd, size)) return std::nullopt;
  if (!seal(fd)) return copy_memory(fd, static_cast<std::size_t>(size));
  if (!has_bytes(fd, size)) return std::nullopt;  // it may have shrunk just before
  auto mapping = std::make_shared<Mapping>(fd, size, Mapping::Access::read);
  if (mapping->bytes().empty()) return std::nullopt;
  return Taken{mapping->bytes(), mapping};
}

}  // namespace gltfx::codec
