// SPDX-License-Identifier: Apache-2.0
/// The bytes that an asset reads of each file, which must be known before a file is changed.
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

/// A file that an asset refers to, under any number of names.
struct FileRead {
  std::set<std::string> paths;         ///< as in container::Uri
  std::vector<std::uint32_t> buffers;  ///< indices of the buffers with this file
  /// It is also read as something other than a buffer, such as an image, or is the asset itself.
  bool otherwise = false;
};

/// A table of Fixing.
class FilesRead {
 public:
  explicit FilesRead(Fixing& fixing);

  const std::map<FileIdentity, FileRead>& files() const { return files_; }
  /// The reads of the buffer with this index.
  const change::FileReads& reads_of(std::uint32_t buffer) const { return reads_[buffer]; }
  /// The reads of a file by all objects that name it.
  change::FileReads reads_of(const FileRead& file) const;

 private:
  void find_files(Fixing& fixing);
  void find_reads(Fixing& fixing);

  std::map<FileIdentity, FileRead> files_;
  std::vector<change::FileReads> reads_;
};

/// Merges the content of buffers that share a file, under the index of one of them. The Error gives
/// the reason for a refusal: bytes that would change have another reader.
std::optional<Error> unite_buffers(Fixing& fixing, change::BufferContents& contents);

/// Adds the other names of the files that are already changed.
void add_other_names(Fixing& fixing, std::vector<change::ReplacedFile>& files);

}  // namespace gltfx::validate
