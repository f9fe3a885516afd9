// SPDX-License-Identifier: Apache-2.0
/// Files are changed whole or not at all: a path has the old bytes or the new ones, also after a
/// power failure, and a change by another program is never overwritten.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include <sys/stat.h>

#include "base/file_state.hpp"
#include "base/result.hpp"
#include "base/temporary_file.hpp"
#include "base/unique_fd.hpp"

namespace gltfx {

/// A file that is written beside its final path: write() as often as needed, then finish(), then
/// publish(). Deleted by the destructor unless published. The calls give nothing on success, else
/// an Error; the first call also reports when the draft could not be created. Until finish(), only
/// the user of the program may read it if it replaces or copies a file. Not thread-safe.
class FileDraft {
 public:
  /// Replaces the file that was `seen`, or creates one. A symbolic link stays; its target is
  /// replaced. Refused when the file changed since it was seen, has other hard links or is
  /// read-only.
  FileDraft(const std::filesystem::path& path, const std::optional<FileState>& seen);
  /// Creates a file with owner, permissions and extended attributes of `like`.
  FileDraft(const std::filesystem::path& path, const std::filesystem::path& like);

  std::optional<Error> write(std::string_view bytes);
  /// Lets the disk begin with what was written; finish() has less to wait for.
  void begin_sync() const;
  /// Gives the draft what the file has beside its bytes, and makes it durable.
  std::optional<Error> finish();
  /// Replaces the file, durably, unless another program changed it meanwhile.
  std::optional<Error> publish();
  /// The draft open for reading.
  UniqueFd reader() const;

 private:
  void look_at(const std::filesystem::path& like);

  std::filesystem::path target_;
  std::filesystem::path like_;  ///< file whose attributes it gets; empty: those of any new file
  struct stat old_ {};          ///< of `like_` or the replaced file
  std::optional<FileState> seen_;
  std::optional<Error> trouble_;
  std::optional<TemporaryFile> file_;  ///< nothing after an error
};

/// Replaces the content of the file that was `seen` by `bytes`: a temporary file in the same folder
/// gets them, then owner, permissions and extended attributes of the old one, is made durable and
/// renamed; the folder is made durable too. A symbolic link stays; its target is replaced. Refused
/// when the file changed since it was seen, has other hard links, is read-only, or has an attribute
/// that cannot be kept. Nothing when the new bytes are durable, else why they are not.
std::optional<Error> replace_file(const std::filesystem::path& path, std::string_view bytes,
                                  const FileState& seen);

/// Why replace_file() would refuse now; nothing when it would try.
std::optional<Error> check_replaceable(const std::filesystem::path& path, const FileState& seen);

/// The same for a file that must not exist yet.
std::optional<Error> create_file(const std::filesystem::path& path, std::string_view bytes);

/// The state of the file at `path`, or nothing if it does not exist.
Result<std::optional<FileState>> state_if_there(const std::filesystem::path& path);

/// Creates the file, or replaces its current state.
std::optional<Error> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace gltfx
