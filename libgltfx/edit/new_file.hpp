// SPDX-License-Identifier: Apache-2.0
/// Files that are written beside an asset.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "base/file_state.hpp"
#include "container/bytes.hpp"

namespace gltfx::edit {

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

}  // namespace gltfx::edit
