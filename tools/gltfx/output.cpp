// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kNewFile = 0666;

// The place a chain of links ends at, which may not exist yet.
std::string resolved(const std::string& path) {
  std::error_code fault;
  const fs::path real = fs::weakly_canonical(path, fault);
  return fault ? path : real.native();
}

}  // namespace

bool write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

Output::Output(std::string path) : path_(std::move(path)) {
  if (path_.empty()) {
    fd_ = STDOUT_FILENO;
  } else {
    open();
  }
}

Output::Output(Output&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      problem_(std::move(other.problem_)),
      fd_(std::exchange(other.fd_, -1)),
      reader_gone_(other.reader_gone_) {}

Output::~Output() {
  if (fd_ > STDERR_FILENO) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void Output::open() {
  target_ = resolved(path_);
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (!exists || S_ISREG(status.st_mode)) {
    open_beside();
    if (exists && fd_ >= 0) static_cast<void>(::fchmod(fd_, status.st_mode & 07777U));
    return;
  }
  fd_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (fd_ < 0) fail("open", errno);
}

void Output::open_beside() {
  for (int attempt = 0; attempt < 100 && fd_ < 0; ++attempt) {
    temporary_ = fmt::format("{}.{}-{}.part", target_, ::getpid(), attempt);
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFile);
    if (fd_ < 0 && errno != EEXIST) break;
  }
  if (fd_ >= 0) return;
  temporary_.clear();
  fail("create", errno);
}

void Output::fail(std::string_view action, int error) {
  if (!problem_.empty()) return;
  const std::string name = path_.empty() ? std::string("standard output") : quoted(path_, 200);
  problem_ = fmt::format("cannot {} {}: {}", action, name,
                         std::error_code(error, std::generic_category()).message());
}

void Output::write(std::string_view text) {
  if (!problem_.empty() || reader_gone_ || text.empty()) return;
  if (write_all(fd_, text)) return;
  if (errno == EPIPE) {
    reader_gone_ = true;
  } else {
    fail("write to", errno);
  }
}

void Output::finish() {
  if (temporary_.empty() || !problem_.empty()) return;
  if (::fsync(fd_) != 0 && errno != EINVAL) {
    fail("write to", errno);
  } else if (std::rename(temporary_.c_str(), target_.c_str()) != 0) {
    fail("create", errno);
  } else {
    temporary_.clear();
  }
}

}  // namespace gltfx::tool
