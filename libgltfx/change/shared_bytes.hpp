// SPDX-License-Identifier: Apache-2.0
/// One new content of a file that several buffers read: each of them has its own idea of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "change/change.hpp"

namespace gltfx::change {

/// `count` times `size` bytes, each `stride` after the one before.
struct ByteRead {
  std::uint64_t begin = 0, size = 0, stride = 0, count = 0;
};

/// Which bytes of a file are read.
struct FileReads {
  bool all = false;             ///< any, as far as anybody can tell
  std::vector<ByteRead> parts;  ///< where it is not all

  void add(const FileReads& more);
};

/// Those of `ranges`, which are in order and do not overlap, in which bytes are read. Where that
/// would take long, all of them.
std::vector<ByteRange> ranges_read(const FileReads& reads, std::vector<ByteRange> ranges);

/// Those of `ranges` that have a byte in common with one of `other`; both as in ranges_read().
std::vector<ByteRange> ranges_touching(std::vector<ByteRange> ranges,
                                       const std::vector<ByteRange>& other);

/// Adds ranges to a list of them; the list stays in order and without overlaps.
void add_ranges(std::vector<ByteRange>& list, const std::vector<ByteRange>& more);

/// Where two contents of a file differ, in order. Bytes that one of them lacks differ.
std::vector<ByteRange> differences(std::string_view one, std::string_view other);

/// Somebody who reads a file.
struct FileUser {
  std::string_view wanted;  ///< what the file should hold, as far as this user reads it
  FileReads reads;
  bool changes = true;  ///< what is wanted is to be written; false: this user only looks on
};

/// What becomes of a file.
struct MergedFile {
  std::string content;  ///< with the changes of all; to be written where there is no conflict
  /// Bytes on which users do not agree.
  struct Conflict {
    std::size_t user;  ///< that would read bytes which it does not want, by position
    std::vector<ByteRange> ranges;
  };
  std::vector<Conflict> conflicts;
};

/// Puts the changes of all users together. A change is in conflict where another user reads the
/// same bytes and does not want them so.
MergedFile merge_changes(std::string_view before, const std::vector<FileUser>& users);

}  // namespace gltfx::change
