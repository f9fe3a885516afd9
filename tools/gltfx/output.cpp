// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_state.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "commands.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOwnerOnly = 0600;
constexpr mode_t kAnyNewFile = 0666;

// The target of a chain of links, which may not exist yet.
std::string resolved(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  return error ? path : real.native();
}

}  // namespace

bool same_place(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a == b;
  return fs::path(a).lexically_normal() == fs::path(b).lexically_normal();
}

Output::Output(std::string path, bool folders) : path_(std::move(path)) {
  if (path_.empty()) {
    fd_ = STDOUT_FILENO;
  } else {
    open(folders);
  }
}

void Output::open(bool folders) {
  const std::string target = resolved(path_);
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  const fs::path folder = fs::path(path_).parent_path();
  if (!exists && !folder.empty()) {
    std::error_code error;
    if (folders) note(change::make_folder(folder));
    if (problem_.empty() && !fs::is_directory(folder, error)) {
      problem_ = fmt::format("cannot write {}: there is no folder {}", quoted(path_, 200),
                             quoted(folder.native(), 200));
    }
    if (!problem_.empty()) return;
  }
  if (!exists || S_ISREG(status.st_mode)) {
    file_ = std::make_unique<TemporaryFile>(target, exists ? kOwnerOnly : kAnyNewFile);
    note(file_->write({}));
    if (exists && problem_.empty()) note(keep_attributes(file_->fd(), target, status));
    return;
  }
  opened_ = UniqueFd(::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  fd_ = opened_.get();
  if (fd_ < 0) fail("open", errno);
}

void Output::note(const std::optional<Error>& trouble) {
  if (trouble && problem_.empty()) problem_ = trouble->message;
}

void Output::fail(std::string_view action, int error) {
  if (!problem_.empty()) return;
  const std::string name = path_.empty() ? std::string("standard output") : quoted(path_, 200);
  problem_ = fmt::format("cannot {} {}: {}", action, name,
                         std::error_code(error, std::generic_category()).message());
}

void Output::write(std::string_view text) {
  if (!problem_.empty() || reader_gone_ || text.empty()) return;
  if (file_) return note(file_->write(text));
  if (write_all(fd_, text)) return;
  if (errno == EPIPE) {
    reader_gone_ = true;
  } else {
    fail("write to", errno);
  }
}

void Output::finish() {
  if (!file_ || !problem_.empty()) return;
  note(file_->make_durable());
  if (problem_.empty()) note(file_->move_over());
}

ExitCode print(std::string_view text) {
  Output out{std::string()};
  out.write(text);
  if (out.problem().empty()) return ExitCode::ok;
  complain(out.problem());
  return ExitCode::internal;
}

void complain(std::string_view message) {
  std::string line = "gltfx: ";
  line.append(message).append("\n");
  static_cast<void>(write_all(STDERR_FILENO, line));
}

}  // namespace gltfx::tool
