// SPDX-License-Identifier: Apache-2.0
/// A change of an asset as plain data: steps make a Change, place() finds room for additions,
/// apply() makes the new asset, and commit() writes it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/file_state.hpp"
#include "change/additions.hpp"
#include "container/bytes.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// Bytes [begin, end).
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// New bytes in place of as many old ones.
struct BytePatch {
  std::uint64_t offset = 0;
  std::string bytes;
};

/// Changes of the BIN chunk.
struct BinChange {
  std::string more;            ///< appended to its data; a chunk is created if there is none
  std::vector<ByteRange> cut;  ///< of its data, in order, without overlaps; removed
  bool drop = false;           ///< remove the whole chunk; all other members are empty
  /// Patches of its data, in order, without overlaps with each other or a cut.
  std::vector<BytePatch> patches = {};
  bool empty() const { return more.empty() && cut.empty() && patches.empty() && !drop; }
};

/// A new file that the asset refers to.
struct NewFile {
  std::string path;  ///< from the asset's folder, '/' separated, as Uri::path
  std::shared_ptr<const std::string> bytes;

  /// The bytes, which keep their memory.
  container::Bytes content() const { return {std::as_bytes(std::span(*bytes)), bytes}; }
};

/// A file that the asset refers to, with new bytes.
struct ReplacedFile {
  std::string path;         ///< as NewFile::path
  FileState state;          ///< when it was read
  container::Bytes before;  ///< the old bytes
  container::Bytes after;   ///< the new bytes
};

/// Whole contents by the index of the buffer. They may be longer than the old ones, never shorter.
using BufferContents = std::map<std::uint32_t, std::string>;

/// Owns all its data.
struct Change {
  std::vector<json::Edit> edits = {};  ///< of the text, as json::Editor::take() gives them
  BinChange bin = {};
  std::vector<ReplacedFile> replaced = {};  ///< files with other bytes than before
  std::vector<NewFile> files = {};
  /// Each chunk of a GLB gets a length that is a multiple of 4, and zeros after the last one are
  /// removed.
  bool sound_chunks = false;
  /// Input of place(), which turns it into the members above: new objects, and new contents of
  /// buffers.
  Additions additions = {};
  BufferContents contents = {};

  bool empty() const {
    return edits.empty() && bin.empty() && replaced.empty() && files.empty() && !sound_chunks &&
           additions.empty() && contents.empty();
  }
};

}  // namespace gltfx::change
