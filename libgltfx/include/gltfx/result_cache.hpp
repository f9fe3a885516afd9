// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results of earlier runs, so that what did not change is not checked or drawn again.
#pragma once

#include <memory>
#include <string>

namespace gltfx {

class ResultStore;

/// Reports, and what pictures were written, are kept by the bytes of the asset and of the files it
/// refers to, by all options that bear on them, and by the build of the program. A file whose size,
/// times and inode are as they were is not read to find that out. A result is not kept when a file
/// that belongs to it could not be read or changed meanwhile.
///
/// Several runs may use one folder at once, on several machines too. Whoever can write into the
/// folder can make reports say anything. Safe to use from several threads.
class ResultCache {
 public:
  /// Creates the folder when it is not there. Null when that fails, and why in `problem`.
  static std::shared_ptr<ResultCache> open(const std::string& folder, std::string& problem);
  ~ResultCache();
  ResultCache(const ResultCache&) = delete;
  ResultCache& operator=(const ResultCache&) = delete;

  /// Ends the use of the cache: puts small files together, and says why reports could not be kept;
  /// an empty text when all were.
  std::string finish();

  /// For the library itself.
  ResultStore& store() { return *store_; }
  /// The working folder, that relative paths start from.
  const std::string& folder() const { return folder_; }

 private:
  ResultCache(std::unique_ptr<ResultStore> store, std::string folder);

  std::unique_ptr<ResultStore> store_;
  std::string folder_;
};

}  // namespace gltfx
