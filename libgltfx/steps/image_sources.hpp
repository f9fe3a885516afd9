// SPDX-License-Identifier: Apache-2.0
/// Which textures refer to which images, and the formats that they allow: a `source` of their own,
/// or that of an extension for a format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/asset.hpp"
#include "steps/image_use.hpp"

namespace gltfx::steps {

/// Whether glTF has the format without an extension.
constexpr bool is_core_type(std::string_view media_type) {
  return media_type == "image/png" || media_type == "image/jpeg";
}

/// Keeps references to all constructor arguments.
class ImageSources {
 public:
  ImageSources(const model::Asset& asset, const graph::Graph& graph, const OtherUsers& others);

  /// Whether all that refers to an image may have one of that type. Types without a name are empty.
  bool allow(std::uint32_t image, std::string_view media_type) const;
  /// Why an image cannot get another type, half a sentence; empty: it can.
  std::string find_obstacle(std::uint32_t image, std::string_view media_type) const;

  /// Lets all textures of an image refer to it as one of that type. Precondition: there is no
  /// obstacle.
  void set_type(std::uint32_t image, std::string_view media_type);
  /// Adds the edits of textures, and of the lists of extensions.
  void edit(json::Editor& editor) const;

 private:
  /// A reference of a texture.
  struct Source {
    std::uint32_t texture;
    std::uint32_t image;
    json::NodeId number;
    json::NodeId key = json::kNoNode;              ///< of the extension; kNoNode: its own source
    const schema::Extension* extension = nullptr;  ///< null: none, or one without a schema
    bool is_core() const { return key == json::kNoNode; }
  };
  /// What becomes of one texture.
  struct Move {
    std::vector<json::NodeId> removed;             ///< keys of extensions
    bool loses_own = false;                        ///< its own source goes
    std::optional<std::uint32_t> own;              ///< the image of its new source
    const schema::Extension* extension = nullptr;  ///< a new one
    std::uint32_t image = 0;                       ///< of that
  };

  void read(std::uint32_t texture, json::NodeId object);
  void add(Source source);
  const schema::Extension* extension_for(std::string_view media_type) const;
  std::string find_obstacle(const Source& source, const schema::Extension* extension) const;
  bool has_other(const Source& source, bool own_too) const;
  void edit_texture(std::uint32_t texture, const Move& move, json::Editor& editor) const;
  void edit_lists(json::Editor& editor) const;

  const model::Asset& asset_;
  const graph::Graph& graph_;
  const OtherUsers& others_;
  std::vector<Source> sources_;
  std::vector<std::vector<std::size_t>> by_image_;
  std::vector<std::vector<std::size_t>> by_texture_;
  std::map<std::uint32_t, Move> moves_;  ///< by texture
};

}  // namespace gltfx::steps
