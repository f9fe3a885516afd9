// SPDX-License-Identifier: Apache-2.0
/// Storage of the bytes of a written model: files, data URIs, the BIN chunk.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "interop/model_text.hpp"

namespace gltfx::interop {

/// How an asset is written.
struct StorageForm {
  std::string name;  ///< of the asset; the base of generated file names
  bool glb = false;
  bool embed = false;  ///< data URIs instead of files
};

class StoredBytes {
 public:
  /// Encodes pixels and chooses all names. Two buffers with one `uri` share a file when the shorter
  /// one is its beginning; otherwise notes fail.
  StoredBytes(const tinygltf::Model& model, const StorageForm& form, Notes& notes);

  const std::vector<Storage>& buffers() const { return buffers_; }
  const std::vector<Storage>& images() const { return images_; }
  /// By path from the asset's folder.
  std::map<std::string, std::string> take_files() { return std::move(files_); }
  std::string take_bin() { return std::move(bin_); }

 private:
  void place_buffer(const tinygltf::Model& model, std::size_t index);
  void place_image(const tinygltf::Model& model, std::size_t index);
  std::string own_name(std::size_t index, std::string_view ending) const;
  /// The URI of the bytes. `wanted` may be empty.
  std::string keep(std::string_view wanted, std::string_view media_type, std::string_view bytes,
                   const std::string& pointer);
  void add_file(const std::string& path, std::string_view bytes, const std::string& pointer);

  const StorageForm& form_;
  Notes& notes_;
  std::vector<Storage> buffers_, images_;
  std::map<std::string, std::string> files_;
  std::string bin_;
};

}  // namespace gltfx::interop
