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
#include "container/container.hpp"
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
  /// Data in the place of the old, or of a chunk that is made: one piece behind the other. Nothing
  /// else is to be done with the chunk.
  std::optional<std::vector<container::Bytes>> whole = std::nullopt;
  std::string more = {};            ///< behind its data; a chunk is made when there is none
  std::vector<ByteRange> cut = {};  ///< of its data, in order, none overlaps; taken out
  bool drop = false;                ///< the whole chunk goes; nothing else is to be done with it
  /// Of its data, in order; none overlaps another or a cut.
  std::vector<BytePatch> patches = {};
  bool empty() const { return !whole && more.empty() && cut.empty() && patches.empty() && !drop; }
};

/// A new file that the asset refers to.
struct NewFile {
  std::string path;  ///< from the asset's folder, '/' separated, as container::Uri has it
  std::vector<container::Bytes> pieces;  ///< of its content, one behind the other
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
  /// The container that it gets, gltf or glb; nothing: the one that it has. Chunks of a GLB beside
  /// JSON and BIN do not go into a .gltf.
  std::optional<container::Format> format = std::nullopt;
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
    return edits.empty() && !format && bin.empty() && replaced.empty() && files.empty() &&
           !sound_chunks && additions.empty() && contents.empty();
  }
};

}  // namespace gltfx::change
