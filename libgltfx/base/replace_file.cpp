// SPDX-License-Identifier: Apache-2.0
#include "base/replace_file.hpp"

#include <cerrno>
#include <string>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_draft.hpp"
#include "base/temporary_file.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;

constexpr mode_t kWritable = 0222;

Error refusal(const fs::path& path, std::string_view why) {
  return {fmt::format("{} {}", quoted(path.native(), 200), why)};
}

// Why a file must not be replaced, or nothing.
Trouble objection(const fs::path& path, const struct stat& status, const FileState& seen) {
  if (!S_ISREG(status.st_mode)) return refusal(path, "is not a regular file");
  if (!(state_of(status) == seen)) {
    return refusal(path, "was changed by another program since it was read; run again");
  }
  if (status.st_nlink > 1) {
    return refusal(path, "has other hard links, which would keep the old bytes; copy it first");
  }
  if ((status.st_mode & kWritable) == 0 || ::access(path.c_str(), W_OK) != 0) {
    return refusal(path, "is read-only");
  }
  return std::nullopt;
}

std::optional<Error> put(FileDraft& draft, std::string_view bytes) {
  if (auto trouble = draft.write(bytes)) return trouble;
  if (auto trouble = draft.finish()) return trouble;
  return draft.publish();
}

}  // namespace

std::optional<Error> check_replaceable(const fs::path& path, const FileState& seen) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return file_error("look at", path, errno);
  return objection(path, status, seen);
}

std::optional<Error> replace_file(const fs::path& path, std::string_view bytes,
                                  const FileState& seen) {
  FileDraft draft(path, seen);
  return put(draft, bytes);
}

std::optional<Error> create_file(const fs::path& path, std::string_view bytes) {
  FileDraft draft(path, std::nullopt);
  return put(draft, bytes);
}

Result<std::optional<FileState>> state_if_there(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 && errno == ENOENT) return std::optional<FileState>();
  const auto seen = file_state(path);
  if (!seen) return seen.error();
  return std::optional(*seen);
}

std::optional<Error> write_file(const fs::path& path, std::string_view bytes) {
  const auto seen = state_if_there(path);
  if (!seen) return seen.error();
  FileDraft draft(path, *seen);
  return put(draft, bytes);
}

}  // namespace gltfx
