// SPDX-License-Identifier: Apache-2.0
#include "base/replace_file.hpp"

#include <cerrno>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/temporary_file.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;

constexpr mode_t kPermissions = 07777;
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

// The owner first: changing it takes special bits of the mode away.
Trouble dress_as(TemporaryFile& file, const struct stat& old) {
  if (auto trouble = file.set_owner(old.st_uid, old.st_gid)) return trouble;
  return file.set_mode(old.st_mode & kPermissions);
}

}  // namespace

std::optional<Error> check_replaceable(const fs::path& path, const FileState& seen) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return file_error("look at", path, errno);
  return objection(path, status, seen);
}

std::optional<Error> replace_file(const fs::path& path, std::string_view bytes,
                                  const FileState& seen) {
  std::error_code fault;
  const fs::path target = fs::canonical(path, fault);
  if (fault) return file_error("look at", path, fault.value());
  struct stat old {};
  if (::stat(target.c_str(), &old) != 0) return file_error("look at", path, errno);
  if (auto trouble = objection(target, old, seen)) return trouble;
  TemporaryFile file(target);
  if (auto trouble = file.write(bytes)) return trouble;
  if (auto trouble = dress_as(file, old)) return trouble;
  if (auto trouble = file.make_durable()) return trouble;
  // Writing takes time in which somebody else may have saved the file.
  if (auto trouble = check_replaceable(target, seen)) return trouble;
  return file.move_over();
}

std::optional<Error> create_file(const fs::path& path, std::string_view bytes) {
  TemporaryFile file(path);
  if (auto trouble = file.write(bytes)) return trouble;
  if (auto trouble = file.make_durable()) return trouble;
  return file.move_to_free_place();
}

std::optional<Error> write_file(const fs::path& path, std::string_view bytes) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 && errno == ENOENT) return create_file(path, bytes);
  const auto seen = file_state(path);
  if (!seen) return seen.error();
  return replace_file(path, bytes, *seen);
}

}  // namespace gltfx
