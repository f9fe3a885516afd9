// SPDX-License-Identifier: Apache-2.0
/// Merges the new contents of a file that several buffers read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "change/change.hpp"

namespace gltfx::change {

/// `count` times `size` bytes, each `stride` after the previous one.
struct ByteRead {
  std::uint64_t begin = 0, size = 0, stride = 0, count = 0;
};

/// The bytes of a file that are read.
struct FileReads {
  bool all = false;             ///< any byte may be read
  std::vector<ByteRead> parts;  ///< if not `all`

  void add(const FileReads& more);
};

/// The ranges, of sorted ranges without overlaps, in which bytes are read. All of them if the
/// search would take long.
std::vector<ByteRange> ranges_read(const FileReads& reads, std::vector<ByteRange> ranges);

/// The ranges in `ranges` that have a byte in common with one of `other`; both as in ranges_read().
std::vector<ByteRange> ranges_touching(std::vector<ByteRange> ranges,
                                       const std::vector<ByteRange>& other);

/// Adds ranges to a list; the list stays sorted and without overlaps.
void add_ranges(std::vector<ByteRange>& list, const std::vector<ByteRange>& more);

/// Ranges in which two contents of a file differ, in order. Bytes that only one of them has differ.
std::vector<ByteRange> differences(std::string_view one, std::string_view other);

/// A user of a file, such as a buffer.
struct FileUser {
  std::string_view wanted;  ///< content that this user needs, in the bytes that it reads
  FileReads reads;
  bool changes = true;  ///< the content will be written; false: this user only reads
};

/// The merged content of a file.
struct MergedFile {
  std::string content;  ///< with the changes of all users; to be written if there is no conflict
  /// Bytes on which users do not agree.
  struct Conflict {
    std::size_t user;  ///< user that would read bytes other than it needs, by position
    std::vector<ByteRange> ranges;
  };
  std::vector<Conflict> conflicts;
};

/// Merges the changes of all users. A change conflicts if another user reads the same bytes and
/// needs other values.
MergedFile merge_changes(std::string_view before, const std::vector<FileUser>& users);

}  // namespace gltfx::change
