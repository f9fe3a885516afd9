// SPDX-License-Identifier: Apache-2.0
/// References from textures to images, and the formats that they allow: the `source` of a texture,
/// or that of an extension for a format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/asset.hpp"
#include "steps/image_use.hpp"

namespace gltfx::steps {

/// Whether core glTF allows the format.
constexpr bool is_core_type(std::string_view media_type) {
  return media_type == "image/png" || media_type == "image/jpeg";
}

/// Keeps references to all constructor arguments.
class ImageSources {
 public:
  ImageSources(const model::Asset& asset, const graph::Graph& graph, const OtherUsers& others);

  /// Whether all references to an image allow this media type; empty: a format without a media
  /// type.
  bool allow(std::uint32_t image, std::string_view media_type) const;
  /// Why an image cannot change to a media type, half a sentence; empty: it can.
  std::string find_obstacle(std::uint32_t image, std::string_view media_type) const;

  /// Makes all textures refer to the image as one of this type. Precondition: find_obstacle() is
  /// empty.
  void set_type(std::uint32_t image, std::string_view media_type);

  /// Whether a texture extension is for images of this media type.
  bool is_format_of(std::string_view extension, std::string_view media_type) const;
  /// Whether each texture that refers to an image through an extension has a `source` of its own.
  bool has_fallbacks(std::uint32_t image) const;
  /// Textures with a `source` of their own no longer refer to an image through an extension.
  void unlink(std::uint32_t image);
  /// Images that lost their last texture, and the image that one of these has in its place.
  std::map<std::uint32_t, std::uint32_t> stand_ins() const;
  /// The extension is no longer required if each texture has a `source` of its own.
  void unrequire(std::string_view extension) { unrequired_.emplace(extension); }

  /// Adds the edits of textures and of the lists of extensions.
  void edit(json::Editor& editor) const;

 private:
  /// A reference from a texture to an image.
  struct Source {
    std::uint32_t texture;
    std::uint32_t image;
    json::NodeId number;
    json::NodeId key = json::kNoNode;  ///< of the extension; kNoNode: `source` of the texture
    const schema::Extension* extension = nullptr;  ///< null: none, or no schema
    bool is_core() const { return key == json::kNoNode; }
  };
  /// The changes of one texture.
  struct Move {
    std::vector<json::NodeId> removed;             ///< keys of extensions
    bool loses_own = false;                        ///< its own `source` is removed
    std::optional<std::uint32_t> own;              ///< image of its new `source`
    const schema::Extension* extension = nullptr;  ///< new extension
    std::uint32_t image = 0;                       ///< image of the new extension
  };

  void read(std::uint32_t texture, json::NodeId object);
  void add(Source source);
  const schema::Extension* extension_for(std::string_view media_type) const;
  std::string find_obstacle(const Source& source, const schema::Extension* extension) const;
  bool has_other(const Source& source, bool own_too) const;
  void edit_texture(std::uint32_t texture, const Move& move, json::Editor& editor) const;
  void edit_lists(json::Editor& editor) const;
  std::optional<std::uint32_t> own_image(std::uint32_t texture) const;
  bool is_unlinked(const Source& source) const;

  const model::Asset& asset_;
  const graph::Graph& graph_;
  const OtherUsers& others_;
  std::vector<Source> sources_;
  std::vector<std::vector<std::size_t>> by_image_;
  std::vector<std::vector<std::size_t>> by_texture_;
  std::map<std::uint32_t, Move> moves_;  ///< by texture
  std::set<std::string> unrequired_;     ///< extensions
  std::set<std::uint32_t> unlinked_;     ///< images
};

}  // namespace gltfx::steps
