// SPDX-License-Identifier: Apache-2.0
#include "pipeline/thumbnail.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "container/base64.hpp"
#include "container/container.hpp"
#include "edit/references.hpp"
#include "edit/rewrite.hpp"
#include "json/edit.hpp"
#include "model/fields.hpp"
#include "pipeline/edit_asset.hpp"
#include "pipeline/new_findings.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/picture_file.hpp"
#include "schema/compile.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;

constexpr std::uint64_t kAlignment = 4;

/// One file that gets a thumbnail.
class Embedding {
 public:
  Embedding(EditedAsset opened, const SchemaSet& schemas, std::string png)
      : state_(opened.state),
        schemas_(schemas),
        before_(std::move(opened.asset), default_judgement(schemas)),
        png_(std::move(png)) {}

  std::optional<Error> run() {
    const OpenedAsset& asset = before_.asset();
    if (auto trouble = find_trouble()) return trouble;
    references_.emplace(document(), *schemas_);
    json::Editor editor(document());
    if (!edit(editor)) return Error{"the asset is put together in a way that leaves no room"};
    if (auto trouble = find_false_user()) return trouble;
    const auto pieces = edit::rewrite(
        container(), share_text(json::apply_edits(*container().json, editor.take())), {more_, {}});
    if (!pieces) return pieces.error();
    FolderIndex folders;
    EditOptions options;
    options.in_place = true;
    EditOutcome outcome;
    const bool done = write_edited(
        asset, state_, {*pieces}, options,
        [this](container::Container on_disk) { return find_error(std::move(on_disk)); }, folders,
        outcome);
    return done ? std::nullopt : std::optional<Error>(Error{outcome.error});
  }

 private:
  std::optional<Error> find_trouble() const {
    const OpenedAsset& asset = before_.asset();
    if (auto obstacle = find_obstacle(asset)) return obstacle;
    if (!asset.parsed().ok()) return Error{"its JSON has errors that make an edit ambiguous"};
    const auto obstacle = edit::find_glb_obstacle(container());
    if (!obstacle || container().format != container::Format::glb) return std::nullopt;
    return Error{"it cannot be written anew: " + *obstacle};
  }

  std::optional<std::string> find_error(container::Container changed) const {
    const OpenedAsset& old = before_.asset();
    const ValidatedAsset after({old.name(), std::move(changed), old.resolver()},
                               default_judgement(schemas_));
    const NewFindings found = new_findings(before_, after, schemas_);
    if (found.error.empty()) return std::nullopt;
    return fmt::format("the new file would have the new error {}", found.error);
  }

  const container::Container& container() const { return before_.asset().container(); }
  const json::Document& document() const { return before_.asset().document(); }
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

  // The image that is the thumbnail so far, and surely nothing else.
  std::optional<json::NodeId> replaceable(json::NodeId thumbnail) const {
    if (thumbnail == json::kNoNode || !document().is_number(thumbnail)) return std::nullopt;
    const auto index = document().unsigned_integer(thumbnail);
    if (!index || *index >= count("images") || is_used(*index)) return std::nullopt;
    std::uint64_t at = 0;
    for (const json::NodeId image : document().elements(root_member("images"))) {
      if (at++ == *index && is_plain(image)) return image;
    }
    return std::nullopt;
  }

  // By others than `asset`, or maybe so.
  bool is_used(std::uint64_t image) const {
    return users("images", image) > 1 || !references_->unknown_extension().empty();
  }

  std::ptrdiff_t users(std::string_view array, std::uint64_t index) const {
    const auto& all = references_->to(array);
    return std::count_if(all.begin(), all.end(), [index](const edit::Reference& reference) {
      return reference.index == index;
    });
  }

  // What leads nowhere now must not lead to the thumbnail.
  std::optional<Error> find_false_user() const {
    for (const std::string_view array : appended_) {
      const std::uint64_t index = count(array);
      if (users(array, index) == 0) continue;
      return Error{fmt::format("an index of {} leads nowhere, and would lead to the thumbnail: {}",
                               array, index)};
    }
    return std::nullopt;
  }

  // A name, extras and extensions would be lost.
  bool is_plain(json::NodeId image) const {
    for (const auto member : document().members(image)) {
      const std::string_view name = document().key(member.key_id);
      if (name != "uri" && name != "bufferView" && name != "mimeType") return false;
    }
    return true;
  }

  std::optional<std::string> new_image(json::Editor& editor) {
    if (container().format == container::Format::glb && has_bin_buffer()) {
      if (!append_bytes(editor)) return std::nullopt;
      return fmt::format(R"({{"bufferView":{},"mimeType":"image/png"}})", count("bufferViews"));
    }
    return fmt::format(R"({{"uri":"data:image/png;base64,{}"}})", container::encode_base64(png_));
  }

  // Whether buffer 0 is the BIN chunk, or may become it.
  bool has_bin_buffer() const {
    const json::NodeId buffers = root_member("buffers");
    if (buffers == json::kNoNode) return !container().bin;
    if (document().kind(buffers) != json::Kind::array || count("buffers") == 0) return false;
    const json::NodeId first = *document().elements(buffers).begin();
    const auto length = model::unsigned_member(document(), first, "byteLength");
    return container().bin && !document().holds(first, "uri") && length &&
           *length <= container().bin->length;
  }

  bool append_bytes(json::Editor& editor) {
    const std::uint64_t end = container().bin ? container().bin->length : 0;
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

  bool append(json::Editor& editor, std::string_view array, const std::string& json) {
    appended_.push_back(array);
    const json::NodeId list = root_member(array);
    if (list == json::kNoNode) {
      editor.append_member(document().root(), array, fmt::format("[{}]", json));
      return true;
    }
    if (document().kind(list) != json::Kind::array) return false;
    editor.append_element(list, json);
    return true;
  }

  const FileState state_;
  const SchemaSet& schemas_;
  const ValidatedAsset before_;
  std::optional<edit::References> references_;
  const std::string png_;
  std::string more_;                        // behind the BIN chunk
  std::vector<std::string_view> appended_;  // root arrays with a new element
};

}  // namespace

std::optional<Error> embed_thumbnail(const std::string& path, const BakedPixels& pixels,
                                     const BakeOptions& options) {
  const preview::Picture picture{pixels.width, pixels.height, pixels.channels, pixels.bytes, {}};
  const auto encoded = encode_picture(picture, codec::EncodedFormat::png);
  if (!encoded) return encoded.error();
  std::string png(reinterpret_cast<const char*>(encoded->bytes.data()), encoded->bytes.size());
  auto opened = open_to_edit(path, AssetBounds::of(options));
  if (!opened) return opened.error();
  const SchemaSet schemas = options.schemas ? options.schemas : schema::builtin_set();
  return Embedding(*std::move(opened), schemas, std::move(png)).run();
}

}  // namespace gltfx
