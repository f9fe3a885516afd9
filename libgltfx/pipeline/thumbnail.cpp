// SPDX-License-Identifier: Apache-2.0
#include "pipeline/thumbnail.hpp"

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "container/base64.hpp"
#include "container/bytes.hpp"
#include "container/container.hpp"
#include "edit/rewrite.hpp"
#include "json/edit.hpp"
#include "json/parse.hpp"
#include "model/fields.hpp"
#include "pipeline/picture_file.hpp"

namespace gltfx {
namespace {

constexpr std::uint64_t kAlignment = 4;

/// One file that gets a thumbnail.
class Embedding {
 public:
  explicit Embedding(const std::string& path) : path_(path) {}

  std::optional<Error> run(const BakedPixels& pixels) {
    const bake::Picture picture{pixels.width, pixels.height, pixels.channels, pixels.bytes, {}};
    const auto encoded = encode_picture(picture, codec::EncodedFormat::png);
    if (!encoded) return encoded.error();
    png_ = {reinterpret_cast<const char*>(encoded->bytes.data()), encoded->bytes.size()};
    if (auto trouble = open()) return trouble;
    json::Editor editor(parsed_.document);
    if (!edit(editor)) return Error{"the asset is put together in a way that leaves no room"};
    const auto pieces = edit::rewrite(
        container_, share_text(json::apply_edits(*container_.json, editor.take())), {more_, {}});
    return pieces ? replace(*pieces) : pieces.error();
  }

 private:
  std::optional<Error> replace(const std::vector<container::Bytes>& pieces) const {
    FileDraft draft(path_, state_);
    if (auto trouble = container::write_pieces(draft, pieces)) return trouble;
    if (auto trouble = draft.finish()) return trouble;
    return draft.publish();
  }

  std::optional<Error> open() {
    const auto state = file_state(path_);
    if (!state) return state.error();
    state_ = *state;
    auto opened = container::open_file(path_);
    if (!opened) return opened.error();
    container_ = *std::move(opened);
    parsed_ = json::parse(container_.json);
    if (!parsed_.ok()) return Error{"its JSON has errors that make an edit ambiguous"};
    if (const auto obstacle = edit::find_glb_obstacle(container_);
        obstacle && container_.format == container::Format::glb) {
      return Error{"it cannot be written anew: " + *obstacle};
    }
    return std::nullopt;
  }

  const json::Document& document() const { return parsed_.document; }
  json::NodeId root_member(std::string_view name) const {
    return document().find(document().root(), name);
  }
  std::uint64_t count(std::string_view array) const {
    const json::NodeId list = root_member(array);
    return list == json::kNoNode ? 0 : document().array_size(list);
  }

  bool edit(json::Editor& editor) {
    const json::NodeId asset = root_member("asset");
    if (asset == json::kNoNode || !document().is_object(asset)) return false;
    const json::NodeId old = document().find(asset, "thumbnail");
    const auto replaced = replaceable(old);
    const auto image = new_image(editor);
    if (!image) return false;
    if (replaced) {
      editor.replace(root_member("images"), *replaced, *image);
      return true;
    }
    const std::string index = std::to_string(count("images"));
    if (old == json::kNoNode) {
      editor.append_member(asset, "thumbnail", index);
    } else {
      editor.replace(asset, old, index);
    }
    return append(editor, "images", *image);
  }

  // The image that is the thumbnail so far, when no texture shows it.
  std::optional<json::NodeId> replaceable(json::NodeId thumbnail) const {
    if (thumbnail == json::kNoNode || !document().is_number(thumbnail)) return std::nullopt;
    const auto index = document().unsigned_integer(thumbnail);
    if (!index || *index >= count("images") || is_shown(*index)) return std::nullopt;
    std::uint64_t at = 0;
    for (const json::NodeId image : document().elements(root_member("images"))) {
      if (at++ == *index) return image;
    }
    return std::nullopt;
  }

  // Textures name their image as "source", and so do extensions of them.
  bool is_shown(std::uint64_t image) const {
    const json::NodeId textures = root_member("textures");
    if (textures == json::kNoNode) return false;
    for (json::NodeId at = textures; at < document().next(textures); ++at) {
      if (document().kind(at) != json::Kind::object) continue;
      const json::NodeId source = document().find(at, "source");
      if (source == json::kNoNode || !document().is_number(source)) continue;
      if (document().unsigned_integer(source) == image) return true;
    }
    return false;
  }

  std::optional<std::string> new_image(json::Editor& editor) {
    if (container_.format == container::Format::glb && has_bin_buffer()) {
      if (!append_bytes(editor)) return std::nullopt;
      return fmt::format(R"({{"bufferView":{},"mimeType":"image/png"}})", count("bufferViews"));
    }
    return fmt::format(R"({{"uri":"data:image/png;base64,{}"}})", container::encode_base64(png_));
  }

  // Whether buffer 0 is the BIN chunk, or may become it.
  bool has_bin_buffer() const {
    const json::NodeId buffers = root_member("buffers");
    if (buffers == json::kNoNode) return !container_.bin;
    if (document().kind(buffers) != json::Kind::array) return false;
    const json::NodeId first = *document().elements(buffers).begin();
    const auto length = model::unsigned_member(document(), first, "byteLength");
    return container_.bin && !document().holds(first, "uri") && length &&
           *length <= container_.bin->length;
  }

  bool append_bytes(json::Editor& editor) {
    const std::uint64_t end = container_.bin ? container_.bin->length : 0;
    const std::uint64_t offset = (end + kAlignment - 1) / kAlignment * kAlignment;
    more_.assign(offset - end, '\0');
    more_ += png_;
    const std::string length = std::to_string(offset + png_.size());
    const json::NodeId buffers = root_member("buffers");
    if (buffers == json::kNoNode) {
      append(editor, "buffers", fmt::format(R"({{"byteLength":{}}})", length));
    } else {
      const json::NodeId first = *document().elements(buffers).begin();
      editor.replace_scalar(document().find(first, "byteLength"), length);
    }
    return append(
        editor, "bufferViews",
        fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", offset, png_.size()));
  }

  bool append(json::Editor& editor, std::string_view array, const std::string& json) const {
    const json::NodeId list = root_member(array);
    if (list == json::kNoNode) {
      editor.append_member(document().root(), array, fmt::format("[{}]", json));
      return true;
    }
    if (document().kind(list) != json::Kind::array) return false;
    editor.append_element(list, json);
    return true;
  }

  const std::string& path_;
  FileState state_;
  container::Container container_;
  json::Parsed parsed_;
  std::string png_;
  std::string more_;  // behind the BIN chunk
};

}  // namespace

std::optional<Error> embed_thumbnail(const std::string& path, const BakedPixels& pixels) {
  return Embedding(path).run(pixels);
}

}  // namespace gltfx
