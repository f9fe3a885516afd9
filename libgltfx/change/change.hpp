// SPDX-License-Identifier: Apache-2.0
/// What is to become of an asset, as plain data: steps make a Change, place() finds room for what
/// it adds, apply() makes the new asset of it, and commit() writes that.
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

/// Bytes in the place of as many others.
struct BytePatch {
  std::uint64_t offset = 0;
  std::string bytes;
};

/// What becomes of the BIN chunk.
struct BinChange {
  std::string more;            ///< behind its data; a chunk is made when there is none
  std::vector<ByteRange> cut;  ///< of its data, in order, none overlaps; taken out
  bool drop = false;           ///< the whole chunk goes; nothing else is to be done with it
  /// Of its data, in order; none overlaps another or a cut.
  std::vector<BytePatch> patches = {};
  bool empty() const { return more.empty() && cut.empty() && patches.empty() && !drop; }
};

/// A file that the asset refers to from now on.
struct NewFile {
  std::string path;  ///< from the asset's folder, '/' separated, as container::Uri has it
  std::shared_ptr<const std::string> bytes;

  /// The bytes, which keep their memory.
  container::Bytes content() const { return {std::as_bytes(std::span(*bytes)), bytes}; }
};

/// A file that the asset refers to and that gets other bytes.
struct ReplacedFile {
  std::string path;         ///< as NewFile::path
  FileState state;          ///< when it was read
  container::Bytes before;  ///< what was read
  container::Bytes after;   ///< what takes its place
};

/// Whole contents by the index of the buffer. They may be longer than the old ones, never shorter.
using BufferContents = std::map<std::uint32_t, std::string>;

/// Owns all it is made of; refers to nothing.
struct Change {
  std::vector<json::Edit> edits = {};  ///< of the text, as json::Editor::take() gives them
  BinChange bin = {};
  std::vector<ReplacedFile> replaced = {};  ///< files with other bytes than before
  std::vector<NewFile> files = {};
  /// Each chunk of a GLB gets a length that is a multiple of 4, and zeros behind the last one go.
  bool sound_chunks = false;
  /// What place() turns into the above: new objects, and new contents of buffers.
  Additions additions = {};
  BufferContents contents = {};

  bool empty() const {
    return edits.empty() && bin.empty() && replaced.empty() && files.empty() && !sound_chunks &&
           additions.empty() && contents.empty();
  }
};

}  // namespace gltfx::change
