// SPDX-License-Identifier: Apache-2.0
/// Files are changed whole or not at all: what stands at a path is the old bytes or the new ones,
/// also when the power fails, and a change by somebody else is never overwritten.
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

/// Written beside its place: write() as often as needed, then finish(), then publish(). Gone at the
/// end of its life unless it was published. The calls give nothing when they succeed, else why they
/// did not; the first of them also says when there can be no draft. Until finish() only the user
/// who runs the program may read what replaces or copies a file. Not thread-safe.
class FileDraft {
 public:
  /// In the place of the file that was `seen`, or where nothing is. A symbolic link stays; what it
  /// leads to is replaced. Refused when the file is not as it was seen, has other hard links or is
  /// read-only.
  FileDraft(const std::filesystem::path& path, const std::optional<FileState>& seen);
  /// Where nothing is, with owner, permissions and extended attributes of `like`.
  FileDraft(const std::filesystem::path& path, const std::filesystem::path& like);

  std::optional<Error> write(std::string_view bytes);
  /// Gives the draft what the file has beside its bytes, and makes it durable.
  std::optional<Error> finish();
  /// Takes the place, durably, unless somebody else changed the file meanwhile.
  std::optional<Error> publish();
  /// The draft open for reading.
  UniqueFd reader() const;

 private:
  void look_at(const std::filesystem::path& like);

  std::filesystem::path target_;
  std::filesystem::path like_;  ///< whose attributes it gets; empty: those of any new file
  struct stat old_ {};          ///< of that
  std::optional<FileState> seen_;
  std::optional<Error> trouble_;
  std::optional<TemporaryFile> file_;  ///< nothing when there is trouble
};

/// Puts `bytes` in the place of the file that was `seen`: a temporary file in the same folder gets
/// them, then owner, permissions and extended attributes of the old one, is made durable and
/// renamed; the folder is made durable too. A symbolic link stays; what it leads to is replaced.
/// Refused when the file is not as it was seen, has other hard links, is read-only, or has an
/// attribute that cannot be kept. Nothing when the new bytes are durable, else why they are not.
std::optional<Error> replace_file(const std::filesystem::path& path, std::string_view bytes,
                                  const FileState& seen);

/// Why replace_file() would refuse now; nothing when it would try.
std::optional<Error> check_replaceable(const std::filesystem::path& path, const FileState& seen);

/// The same for a file that must not exist yet.
std::optional<Error> create_file(const std::filesystem::path& path, std::string_view bytes);

/// What replaces a file or creates one: the state of the file at `path`, nothing where there is
/// none.
Result<std::optional<FileState>> state_if_there(const std::filesystem::path& path);

/// Creates the file, or replaces it as it is now.
std::optional<Error> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace gltfx
