// SPDX-License-Identifier: Apache-2.0
#include "base/file_state.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "base/temporary_file.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return static_cast<std::int64_t>(time.tv_sec) * kSecond + time.tv_nsec;
}

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;

constexpr mode_t kPermissions = 07777;
constexpr std::string_view kAccessList = "system.posix_acl_access";
constexpr std::array<std::string_view, 2> kHashes{"security.ima", "security.evm"};

bool is_unknown(int error) { return error == ENOTSUP || error == ENODATA; }

// The result of a call of the getxattr family: called for its size first, and again if that grows.
template <typename Call>
std::optional<std::string> fetch(const Call& call) {
  for (;;) {
    const ssize_t size = call(nullptr, 0);
    if (size < 0) return std::nullopt;
    std::string value(static_cast<std::size_t>(size), '\0');
    if (value.empty()) return value;
    const ssize_t got = call(value.data(), value.size());
    if (got < 0 && errno == ERANGE) continue;
    if (got < 0) return std::nullopt;
    value.resize(static_cast<std::size_t>(got));
    return value;
  }
}

Error attribute_error(std::string_view action, std::string_view name, const fs::path& path,
                      int error) {
  return file_error(fmt::format("{} the extended attribute {} of", action, quoted(name, 200)), path,
                    error);
}

// The access control list last: it widens the permissions.
std::vector<std::string> names_of(std::string_view list) {
  std::vector<std::string> names;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find('\0'), list.size());
    const std::string_view name = list.substr(0, end);
    const bool is_hash = std::find(kHashes.begin(), kHashes.end(), name) != kHashes.end();
    if (!is_hash) names.emplace_back(name);
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name != kAccessList; });
  return names;
}

Trouble keep_attribute(int fd, const std::string& name, const fs::path& old) {
  const char* key = name.c_str();
  const auto value =
      fetch([&](char* to, std::size_t size) { return ::getxattr(old.c_str(), key, to, size); });
  if (!value && errno == ENODATA) return std::nullopt;  // removed meanwhile
  if (!value) return attribute_error("read", name, old, errno);
  // A label that every file of the folder gets exists already, and setting it may be forbidden.
  const auto present =
      fetch([&](char* to, std::size_t size) { return ::fgetxattr(fd, key, to, size); });
  if (present == value || ::fsetxattr(fd, key, value->data(), value->size(), 0) == 0) {
    return std::nullopt;
  }
  return attribute_error("keep", name, old, errno);
}

Trouble drop_inherited_list(int fd, const fs::path& old) {
  if (::fremovexattr(fd, kAccessList.data()) == 0 || is_unknown(errno)) return std::nullopt;
  return attribute_error("remove", kAccessList, old, errno);
}

Trouble keep_extended(int fd, const fs::path& old) {
  const auto list =
      fetch([&](char* to, std::size_t size) { return ::listxattr(old.c_str(), to, size); });
  if (!list && !is_unknown(errno)) return file_error("read the attributes of", old, errno);
  const std::vector<std::string> names = names_of(list.value_or(""));
  if (names.empty() || names.back() != kAccessList) {
    if (auto trouble = drop_inherited_list(fd, old)) return trouble;
  }
  for (const std::string& name : names) {
    if (auto trouble = keep_attribute(fd, name, old)) return trouble;
  }
  return std::nullopt;
}

Trouble keep_owner(int fd, const fs::path& old, const struct stat& status) {
  struct stat own {};
  if (::fstat(fd, &own) != 0) return file_error("examine", old, errno);
  const bool same = own.st_uid == status.st_uid && own.st_gid == status.st_gid;
  if (same || ::fchown(fd, status.st_uid, status.st_gid) == 0) return std::nullopt;
  return file_error("keep the owner of", old, errno);
}

}  // namespace

FileState state_of(const struct stat& status) {
  FileState state;
  state.device = status.st_dev;
  state.inode = status.st_ino;
  state.size = static_cast<std::uint64_t>(status.st_size);
  state.modified = nanoseconds(status.st_mtim);
  state.status_change = nanoseconds(status.st_ctim);
  return state;
}

FileIdentity identity_of(const FileState& state, std::string_view path) {
  return {state.device, state.inode, state.inode == 0 ? std::string(path) : std::string()};
}

Result<FileState> file_state(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return file_error("examine", path, errno);
  if (S_ISREG(status.st_mode)) return state_of(status);
  return Error{fmt::format("{} is not a regular file", quoted(path.native(), 200))};
}

// The owner first: changing it clears special mode bits and capabilities.
Trouble keep_attributes(int fd, const fs::path& old, const struct stat& status) {
  if (auto trouble = keep_owner(fd, old, status)) return trouble;
  if (auto trouble = keep_extended(fd, old)) return trouble;
  if (::fchmod(fd, status.st_mode & kPermissions) == 0) return std::nullopt;
  return file_error("keep the mode of", old, errno);
}

}  // namespace gltfx
