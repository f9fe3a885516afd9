// SPDX-License-Identifier: Apache-2.0
/// Values by hash in the files of a folder that several runs may use at once.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/fork.hpp"
#include "base/hash.hpp"
#include "base/result.hpp"
#include "base/unique_fd.hpp"
#include "pipeline/seal.hpp"

namespace gltfx {

/// A run reads what is there when it begins and writes to a file of its own, one write a value, so
/// that what was added is kept however the run ends. Values that cannot be read back whole, or are
/// not sealed with the same secret, are not there. Safe to use from several threads.
class ResultStore {
 public:
  struct Value {
    Hash128 key;
    std::string bytes;
  };

  /// Whose secret it is: with one that users share, their files are read as well.
  enum class Owner : std::uint8_t { user, shared };

  /// Creates the folder when it is not there. Files of other runs beyond 1 GiB in all are taken
  /// away, the one that was of no use for the longest time first.
  static Result<std::unique_ptr<ResultStore>> open(const std::string& folder,
                                                   std::string_view secret, Owner owner);
  ~ResultStore();
  ResultStore(const ResultStore&) = delete;
  ResultStore& operator=(const ResultStore&) = delete;

  /// What was there under the key when the run began.
  std::optional<std::string> find(const Hash128& key) const;
  /// All of them at once. What cannot be written is lost, and problem() says why.
  void add(std::span<const Value> values);
  /// The hash of bytes that nobody can predict who does not know the secret.
  Hash128 hash(std::string_view bytes) const;
  /// Files in the folder that were sealed with other secrets or belong to other users.
  std::size_t foreign_files() const { return foreign_files_; }
  /// Why values were lost, or nothing.
  std::optional<Error> problem() const;
  /// Puts many small files together. The store is not to be used after it.
  void tidy();

 private:
  struct Segment {
    std::string path;
    UniqueFd fd;
    std::uint64_t size = 0;
    std::int64_t last_use = 0;  ///< nanoseconds since 1970
    bool foreign = false;       ///< nothing of it is read
    mutable bool used = false;
  };
  // Where a value lies; slots without offset are free.
  struct Slot {
    std::uint64_t key = 0;  ///< Hash128::low
    std::uint64_t offset = 0;
    std::uint32_t segment = 0;
  };

  ResultStore(std::string folder, std::string_view secret, Owner owner);
  std::string head() const;
  std::optional<Error> load();
  void drop_oldest();
  void index(std::uint32_t segment);
  void index(std::uint64_t key, std::uint32_t segment, std::uint64_t offset);
  void grow();
  std::optional<std::string> read(const Slot& slot, const Hash128& key) const;
  bool create_own();

  const std::string folder_;
  const Seal seal_;
  const KeyedHash hash_;
  const Owner owner_;
  std::size_t foreign_files_ = 0;
  std::vector<Segment> segments_;  ///< oldest first: of a value in several the last counts
  std::vector<Slot> slots_;        ///< open addressing; the size is a power of two
  std::size_t filled_ = 0;
  mutable ForkMutex mutex_;
  UniqueFd own_;  ///< invalid before the first value
  std::optional<Error> problem_;
};

}  // namespace gltfx
