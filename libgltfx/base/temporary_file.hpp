// SPDX-License-Identifier: Apache-2.0
/// Files that are written beside their final path and moved there when complete, scratch files, and
/// what killed processes have left of both.
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
/// created until it is moved or deleted. There is room for a fixed number; further names, and those
/// longer than a path may be, are not kept.
class TemporaryName {
 public:
  explicit TemporaryName(const std::string& path);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  std::size_t slot_;
};

/// A file that the destructor deletes unless it was moved to its final path; remove_temporaries()
/// deletes it too. The calls give nothing on success, else an Error. Not thread-safe.
class TemporaryFile {
 public:
  /// Creates a file in the target's folder and deletes files there that killed processes have left;
  /// the first write() reports a failure. Links are not followed: `target` itself is replaced.
  /// `mode` is that of open().
  explicit TemporaryFile(std::filesystem::path target, unsigned mode = 0666);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::optional<Error> write(std::string_view bytes);
  /// Lets the system write to the disk what it has of the file, and does not wait.
  void begin_sync() const;
  /// Makes the bytes durable, where the file system can. They cannot be read or written any more.
  std::optional<Error> make_durable();
  /// Moves the file to the target, durably, and replaces what is there.
  std::optional<Error> move_over();
  /// The same, but fails if the target exists.
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

/// Writes all of `bytes` to a descriptor. False with errno on failure.
bool write_all(int fd, std::string_view bytes);

/// "cannot <action> '<path>': " and the system's text for `error`, a value of errno.
Error file_error(std::string_view action, const std::filesystem::path& path, int error);

/// Deletes the temporary files of this process. For signal handlers of a program that is about to
/// end: async-signal-safe, keeps errno. The library installs no handler.
void remove_temporaries() noexcept;

/// The name of a temporary file beside `target`: its name and marks of the process. `number`
/// distinguishes those of one process.
std::string temporary_name(const std::filesystem::path& target, int number);

/// Deletes temporary files, of any target, that ended processes have left in the folder of
/// `target`. The folder may be shared with other machines, whose process ids are unknown: their
/// files are deleted when they were not written to for a day. A folder is read once in the life of
/// a process. Thread-safe.
void remove_stale_files(const std::filesystem::path& target);

}  // namespace gltfx
