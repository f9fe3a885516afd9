// SPDX-License-Identifier: Apache-2.0
#include "pipeline/thumbnail.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "change/place.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "pipeline/edit_asset.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/picture_file.hpp"
#include "prove/findings.hpp"
#include "rules/validated_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;

/// One file that gets a thumbnail.
class Embedding {
 public:
  Embedding(EditedAsset opened, const SchemaSet& schemas, std::string png)
      : state_(opened.state),
        schemas_(schemas),
        before_(std::move(opened.asset), validate::default_validation(schemas)),
        png_(std::make_shared<const std::string>(std::move(png))) {}

  Result<Draft> run(const EditOptions& options) {
    if (auto trouble = find_trouble()) return *std::move(trouble);
    graph_.emplace(document(), *schemas_);
    auto change = make_change();
    if (!change) return Error{"the asset is put together in a way that leaves no room"};
    FolderIndex folders;
    EditOutcome outcome;
    auto draft = carry_out(
        {before_.asset(), state_, options, schemas_, folders}, *std::move(change),
        [this](const ValidatedAsset& after) { return find_error(after); }, outcome);
    if (!draft) return Error{outcome.error};
    return *std::move(draft);
  }

 private:
  std::optional<Error> find_trouble() const {
    const OpenedAsset& asset = before_.asset();
    if (auto obstacle = find_obstacle(asset)) return obstacle;
    if (!asset.parsed().ok()) return Error{"its JSON has errors that make an edit ambiguous"};
    return std::nullopt;
  }

  std::optional<std::string> find_error(const ValidatedAsset& after) const {
    if (auto why = find_false_user(after.asset().document())) return why;
    const prove::NewFindings found = prove::new_findings(before_, after, schemas_);
    if (found.error.empty()) return std::nullopt;
    return fmt::format("the new file would have the new error {}", found.error);
  }

  const json::Document& document() const { return before_.asset().document(); }
  json::NodeId root_member(std::string_view name) const {
    return document().find(document().root(), name);
  }
  static std::uint64_t count(const json::Document& document, std::string_view array) {
    const json::NodeId list = document.find(document.root(), array);
    return list == json::kNoNode ? 0 : document.array_size(list);
  }

  // Nothing where there is no room.
  Result<change::Change> make_change() const {
    const json::NodeId asset = root_member("asset");
    if (asset == json::kNoNode || !document().is_object(asset)) return Error{};
    const json::NodeId old = document().find(asset, "thumbnail");
    const auto replaced = replaceable(old);
    change::Change change;
    change.additions = change::Additions(document());
    const std::string index = std::to_string(change.additions.add_image({png_, {}, replaced}));
    json::Editor editor(document());
    if (old == json::kNoNode) {
      editor.append_member(asset, "thumbnail", index);
    } else if (!replaced) {
      editor.replace(asset, old, index);
    }
    change.edits = editor.take();
    return change::place(std::move(change), before_.asset(), nullptr);
  }

  // The image that is the thumbnail so far, and surely nothing else.
  std::optional<std::uint64_t> replaceable(json::NodeId thumbnail) const {
    if (thumbnail == json::kNoNode || !document().is_number(thumbnail)) return std::nullopt;
    const auto index = document().unsigned_integer(thumbnail);
    if (!index || *index >= count(document(), "images")) return std::nullopt;
    const json::NodeId image = graph_->tree().element(root_member("images"), *index);
    const bool only = image != json::kNoNode && graph_->users(image).size() <= 1 &&
                      graph_->unknown_extensions().empty();
    return only && is_plain(image) ? index : std::nullopt;
  }

  // What leads nowhere now must not lead to the thumbnail.
  std::optional<std::string> find_false_user(const json::Document& now) const {
    for (const std::string_view array : {"buffers", "bufferViews", "images"}) {
      const std::uint64_t index = count(document(), array);
      if (count(now, array) == index) continue;
      const auto& uses = graph_->indices();
      const auto leads_there = [&](const graph::IndexUse& use) {
        return use.index == index && use.array == fmt::format("/{}", array);
      };
      if (std::none_of(uses.begin(), uses.end(), leads_there)) continue;
      return fmt::format("an index of {} leads nowhere, and would lead to the thumbnail: {}", array,
                         index);
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

  const FileState state_;
  const SchemaSet& schemas_;
  const ValidatedAsset before_;
  std::optional<graph::Graph> graph_;
  const std::shared_ptr<const std::string> png_;
};

}  // namespace

Result<Draft> embed_thumbnail(EditedAsset asset, const BakedPixels& pixels,
                              const EditOptions& options) {
  auto png = encode_png({pixels.width, pixels.height, pixels.channels, pixels.bytes, {}});
  if (!png) return png.error();
  const SchemaSet schemas = options.schemas ? options.schemas : schema::builtin_set();
  return Embedding(std::move(asset), schemas, *std::move(png)).run(options);
}

std::optional<Error> embed_thumbnail(const std::string& path, const BakedPixels& pixels,
                                     const BakeOptions& options) {
  auto opened = open_to_edit(path, AssetBounds::of(options));
  if (!opened) return opened.error();
  EditOptions in_place;
  in_place.in_place = true;
  in_place.schemas = options.schemas;
  const auto draft = embed_thumbnail(*std::move(opened), pixels, in_place);
  return draft ? std::nullopt : std::optional<Error>(draft.error());
}

}  // namespace gltfx
