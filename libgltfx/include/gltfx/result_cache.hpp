// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results of earlier runs, so that what did not change is not checked or drawn again.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace gltfx {

class ResultStore;

/// Reports, and records of written pictures, are kept by the bytes of the asset and of the files it
/// refers to, by all options that affect them, and by the build of the program. A file whose size,
/// times and inode are unchanged is not read again. A result is not kept when a file that belongs
/// to it could not be read or changed meanwhile.
///
/// Each record is sealed with a secret key; records with another key are not read. So the folder
/// may be shared (a cache of a build server, a shared disk): a user who can write to it can make
/// runs slower, but cannot forge reports without the key.
///
/// Several runs may use one folder at once, on several machines too. Safe to use from several
/// threads.
class ResultCache {
 public:
  /// Creates the folder if it does not exist. The key is that of the user, from
  /// $XDG_STATE_HOME/gltfx/cache.key or ~/.local/state/gltfx/cache.key, made at first use; files of
  /// other users are not read. Null on failure, with the reason in `problem`.
  static std::shared_ptr<ResultCache> open(const std::string& folder, std::string& problem);
  /// The same with a key that runs of several users or machines share: any text of 32 bytes or more
  /// that cannot be guessed.
  static std::shared_ptr<ResultCache> open(const std::string& folder, const std::string& key,
                                           std::string& problem);
  ~ResultCache();
  ResultCache(const ResultCache&) = delete;
  ResultCache& operator=(const ResultCache&) = delete;

  /// Ends the use of the cache: combines small files. Returns why reports could not be kept, or an
  /// empty text.
  std::string finish();

  /// Files in the folder that are not read: sealed with another key, or of another user.
  std::size_t foreign_files() const;

  /// For the library itself.
  ResultStore& store() { return *store_; }
  /// The working folder, from which relative paths start.
  const std::string& folder() const { return folder_; }

 private:
  static std::shared_ptr<ResultCache> open_with(const std::string& folder, std::string_view secret,
                                                bool shared, std::string& problem);
  ResultCache(std::unique_ptr<ResultStore> store, std::string folder);

  std::unique_ptr<ResultStore> store_;
  std::string folder_;
};

}  // namespace gltfx
