// SPDX-License-Identifier: Apache-2.0
/// The new bytes of a file, whole and checked before they take their place.
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

}  // namespace gltfx
