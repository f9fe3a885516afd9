// SPDX-License-Identifier: Apache-2.0
/// A change of an asset as plain data: steps make a Change, place() finds room for additions,
/// apply() makes the new asset, and commit() writes it.
#pragma once

#include <cstddef>
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

/// New bytes that replace the same number of old bytes.
struct BytePatch {
  std::uint64_t offset = 0;
  std::string bytes;
};

/// Changes of a BIN chunk.
struct BinChange {
  /// New data of the chunk, or data of a new chunk, as consecutive pieces. There are no other
  /// changes of the chunk.
  std::optional<std::vector<container::Bytes>> whole = std::nullopt;
  std::string more = {};            ///< appended to its data
  std::vector<ByteRange> cut = {};  ///< removed ranges of its data, in order, without overlaps
  bool drop = false;  ///< the whole chunk is removed; there are no other changes of it
  /// Ranges of its data, in order, without overlaps with each other or with a cut.
  std::vector<BytePatch> patches = {};
  bool empty() const { return !whole && more.empty() && cut.empty() && patches.empty() && !drop; }
};

/// Changes of BIN chunks by the position of the chunk.
using BinChanges = std::map<std::size_t, BinChange>;
/// The position of a BIN chunk that does not exist yet. It becomes the chunk after the first one.
inline constexpr std::size_t kNewBin = SIZE_MAX;

/// A new file that the asset refers to.
struct NewFile {
  std::string path;  ///< relative to the asset's folder, '/' separated, as in container::Uri
  std::vector<container::Bytes> pieces;  ///< consecutive pieces of its content
};

/// A file that the asset refers to, with new bytes.
struct ReplacedFile {
  std::string path;         ///< as NewFile::path
  FileState state;          ///< from when it was read
  container::Bytes before;  ///< the old bytes
  container::Bytes after;   ///< the new bytes
};

/// New contents by the index of the buffer. They are as long as the old ones or longer.
using BufferContents = std::map<std::uint32_t, std::string>;

/// Owns all its data.
struct Change {
  std::vector<json::Edit> edits = {};  ///< edits of the text, as from json::Editor::take()
  /// The new container, gltf or glb; nothing: unchanged. Other chunks of a GLB than JSON and BIN do
  /// not go into a .gltf.
  std::optional<container::Format> format = std::nullopt;
  /// The version of the new GLB; nothing: that of the old one, or 2. With another version `bins`
  /// has the data of the only BIN chunk, which replaces all BIN chunks with a known encoding when
  /// the new version is 2, and otherwise that of the asset.
  std::optional<std::uint32_t> glb_version = std::nullopt;
  BinChanges bins = {};                     ///< none of them is empty
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
    return edits.empty() && !format && bins.empty() && replaced.empty() && files.empty() &&
           !sound_chunks && additions.empty() && contents.empty();
  }
};

}  // namespace gltfx::change
