// SPDX-License-Identifier: Apache-2.0
/// Replaces the bytes of images in their buffer view, data URI or file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/asset.hpp"
#include "model/asset_bytes.hpp"
#include "steps/file_names.hpp"
#include "steps/new_buffer.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Images that share their bytes: one file or one buffer view.
struct ImageGroup {
  std::vector<std::uint32_t> images;
  model::Storage storage = model::Storage::nowhere;
  json::NodeId view = json::kNoNode;  ///< in a buffer view
  std::string path;                   ///< in a file, as container::Uri::path
};

/// All images of an asset, in the order of the first image of each group.
std::vector<ImageGroup> group_images(const model::Asset& asset, const model::AssetBytes& bytes);

/// The bytes of an image file. `same_format`: the format does not change.
struct NewImage {
  std::string bytes;
  std::string_view media_type;  ///< static storage
  bool same_format = false;
};

/// Stores new images. A file keeps its name except for the ending. If the ending does not change
/// either, the file keeps its name in another folder. In the folder of the old asset, or in a
/// folder for several new assets, the name gets a hash of the content, because other assets may
/// refer to the old file. Keeps references to all constructor arguments.
class ImageStore {
 public:
  ImageStore(const StepInput& input, const model::Asset& elements, const graph::Graph& graph,
             json::Editor& editor);

  /// Why the bytes of a group cannot be replaced, half a sentence; empty: they can.
  std::string find_obstacle(const ImageGroup& group) const;
  /// Precondition: find_obstacle() is empty. On an Error (half a sentence), nothing changes.
  std::optional<Error> store(const ImageGroup& group, NewImage image);
  /// Adds new files, views and bytes to a change. Call it last.
  void add_to(change::Change& change);

 private:
  void store_in_view(const ImageGroup& group, NewImage image);
  std::optional<Error> store_in_file(const ImageGroup& group, NewImage image);
  std::string new_path(const ImageGroup& group, const NewImage& image,
                       const container::Bytes& bytes);
  bool may_replace(const ImageGroup& group) const;
  std::string uri_for(json::NodeId image, const std::string& old_path,
                      const std::string& path) const;
  void set(json::NodeId object, std::string_view name, const std::string& json, bool add);

  const StepInput& input_;
  const json::Document& document_;
  const model::Asset& elements_;
  const graph::Graph& graph_;
  json::Editor& editor_;
  FileNames names_;
  const std::map<std::string, std::size_t> referred_;  ///< number of references, by path
  const bool keeps_names_;
  NewBuffer buffer_;
  change::Change change_;
};

}  // namespace gltfx::steps
