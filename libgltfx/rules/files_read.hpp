// SPDX-License-Identifier: Apache-2.0
/// Which bytes of which files an asset reads: what must be known before a file is changed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "change/change.hpp"
#include "change/shared_bytes.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {

/// A file that an asset refers to, under however many names.
struct FileRead {
  std::set<std::string> paths;         ///< as container::Uri has them
  std::vector<std::uint32_t> buffers;  ///< that it is, by index
  /// Something that is no buffer reads it too, such as an image, or it is the asset itself.
  bool otherwise = false;
};

/// A table of Fixing.
class FilesRead {
 public:
  explicit FilesRead(Fixing& fixing);

  const std::map<FileIdentity, FileRead>& files() const { return files_; }
  /// What is read of the buffer with this index.
  const change::FileReads& reads_of(std::uint32_t buffer) const { return reads_[buffer]; }
  /// What is read of a file by all that names it.
  change::FileReads reads_of(const FileRead& file) const;

 private:
  void find_files(Fixing& fixing);
  void find_reads(Fixing& fixing);

  std::map<FileIdentity, FileRead> files_;
  std::vector<change::FileReads> reads_;
};

/// Buffers that are one file get one content, under the index of one of them. The Error says why
/// not: something else reads bytes that would change.
std::optional<Error> unite_buffers(Fixing& fixing, change::BufferContents& contents);

/// Adds the other names of the files that are changed already.
void add_other_names(Fixing& fixing, std::vector<change::ReplacedFile>& files);

}  // namespace gltfx::validate
