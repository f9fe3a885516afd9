// SPDX-License-Identifier: Apache-2.0
/// Files that are written beside their place and take it when they are whole, others that are only
/// there meanwhile, and what processes that were killed have left behind of both.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "base/unique_fd.hpp"

namespace gltfx {

/// Keeps the name of a temporary file where remove_temporaries() finds it, from before the file is
/// created until its place is taken or it is gone. There is room for a fixed number; names beyond,
/// and those longer than a path may be, are not kept.
class TemporaryName {
 public:
  explicit TemporaryName(const std::string& path);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  std::size_t slot_;
};

/// Gone at the end of its life unless it was moved to its place; remove_temporaries() knows it. The
/// calls give nothing when they succeed, else why they did not. Not thread-safe.
class TemporaryFile {
 public:
  /// Creates a file in the target's folder, where those go that killed processes have left; the
  /// first write() says when that failed. Links are not followed: `target` is
  /// the place that is taken. `mode` as open() takes it.
  explicit TemporaryFile(std::filesystem::path target, unsigned mode = 0666);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::optional<Error> write(std::string_view bytes);
  /// Makes the bytes durable, where the file system can. They cannot be read or written any more.
  std::optional<Error> make_durable();
  /// Takes the place of what is at the target, durably.
  std::optional<Error> move_over();
  /// The same where there must be nothing yet.
  std::optional<Error> move_to_free_place();
  /// The file open for reading.
  UniqueFd reader() const;
  int fd() const { return fd_.get(); }

 private:
  Result<UniqueFd> open_folder() const;
  std::optional<Error> sync(const UniqueFd& folder) const;

  const std::filesystem::path target_;
  std::string name_;
  std::optional<TemporaryName> kept_;
  UniqueFd fd_;
  int error_ = 0;
  bool is_there_ = false;  ///< created, and not moved yet
};

/// Writes all of `bytes` to a descriptor. False with errno when it cannot be done.
bool write_all(int fd, std::string_view bytes);

/// "cannot <action> '<path>': " and what the system says of `error`, a value of errno.
Error file_error(std::string_view action, const std::filesystem::path& path, int error);

/// Deletes the temporary files of this process. For signal handlers of a program that is about to
/// end: async-signal-safe, keeps errno. The library installs no handler.
void remove_temporaries() noexcept;

/// The name of a temporary file beside `target`: that, and what tells whose it is. `number` tells
/// those of one process apart.
std::string temporary_name(const std::filesystem::path& target, int number);

/// Deletes temporary files that processes which no longer run have left in the folder of `target`,
/// whatever they were to become. Numbers of processes say nothing of other machines, which may
/// share the folder: what they have left is deleted when nobody wrote to it for a day. A folder is
/// read once in the life of a process. Any number of threads may call.
void remove_stale_files(const std::filesystem::path& target);

}  // namespace gltfx
