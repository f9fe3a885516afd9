// SPDX-License-Identifier: Apache-2.0
#include "base/directory.hpp"

#include <cerrno>
#include <string_view>

#include <fcntl.h>
#include <sys/stat.h>

namespace gltfx {

DirectoryReader::DirectoryReader(const std::string& path)
    : stream_(::opendir(path.empty() ? "." : path.c_str())) {
  if (stream_ == nullptr) error_.assign(errno, std::generic_category());
}

DirectoryReader::DirectoryReader(UniqueFd folder) : stream_(::fdopendir(folder.get())) {
  if (stream_ == nullptr) {
    error_.assign(errno, std::generic_category());
  } else {
    folder.release();
  }
}

DirectoryReader::~DirectoryReader() {
  if (stream_ != nullptr) ::closedir(stream_);
}

const char* DirectoryReader::next() {
  if (stream_ == nullptr) return nullptr;
  do {
    errno = 0;
    entry_ = ::readdir(stream_);  // NOLINT(concurrency-mt-unsafe): no other thread uses the stream
    if (entry_ == nullptr) {
      error_.assign(errno, std::generic_category());
      return nullptr;
    }
  } while (entry_->d_name == std::string_view(".") || entry_->d_name == std::string_view(".."));
  return entry_->d_name;
}

// Some file systems do not report the type of an entry, and the C library of Emscripten reports
// pipes and sockets as files.
bool DirectoryReader::is_file() const {
#ifndef __EMSCRIPTEN__
  if (entry_->d_type == DT_REG) return true;
#endif
  if (entry_->d_type != DT_REG && entry_->d_type != DT_LNK && entry_->d_type != DT_UNKNOWN) {
    return false;
  }
  struct stat status {};
  return ::fstatat(::dirfd(stream_), entry_->d_name, &status, 0) == 0 && S_ISREG(status.st_mode);
}

bool DirectoryReader::is_directory() const {
  if (entry_->d_type != DT_UNKNOWN) return entry_->d_type == DT_DIR;
  struct stat status {};
  return ::fstatat(::dirfd(stream_), entry_->d_name, &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISDIR(status.st_mode);
}

}  // namespace gltfx
