// SPDX-License-Identifier: Apache-2.0
/// The entries of a directory.
#pragma once

#include <string>
#include <system_error>

#include <dirent.h>

#include "base/unique_fd.hpp"

namespace gltfx {

/// Reads a directory entry by entry, in the order of the file system, without "." and "..".
///
/// std::filesystem::directory_iterator does the same, but libstdc++ ends the process if memory for
/// an entry is missing.
class DirectoryReader {
 public:
  /// `path` "" is the working directory.
  explicit DirectoryReader(const std::string& path);
  explicit DirectoryReader(UniqueFd folder);
  DirectoryReader(const DirectoryReader&) = delete;
  DirectoryReader& operator=(const DirectoryReader&) = delete;
  ~DirectoryReader();

  /// The next entry's name, valid until the next call; nullptr at the end and after an error.
  const char* next();

  /// Whether the last entry that next() gave is a regular file or a link to one.
  bool is_file() const;
  /// Whether it is a directory and not a link to one.
  bool is_directory() const;

  /// Why the directory cannot be read to its end.
  std::error_code error() const { return error_; }

 private:
  DIR* stream_ = nullptr;
  const dirent* entry_ = nullptr;
  std::error_code error_;
};

}  // namespace gltfx
