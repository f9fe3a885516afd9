// SPDX-License-Identifier: Apache-2.0
#include "change/place.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "change/buffer_layout.hpp"
#include "container/base64.hpp"
#include "container/uri.hpp"
#include "json/writer.hpp"
#include "model/asset_bytes.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using model::RootArray;
using model::Storage;
using File = std::shared_ptr<const std::string>;
using Trouble = std::optional<Error>;

std::uint64_t aligned(std::uint64_t size) { return (size + 3) / 4 * 4; }

// A URI with a new name after its last '/': the old stem, a mark, and an ending.
std::string renamed(std::string_view uri, std::string_view mark, std::string_view ending) {
  const std::size_t name = uri.rfind('/') == std::string_view::npos ? 0 : uri.rfind('/') + 1;
  const std::size_t dot = uri.find_last_of('.');
  const bool has_ending = dot != std::string_view::npos && dot > name;
  return fmt::format("{}-{}{}", uri.substr(0, has_ending ? dot : uri.size()), mark, ending);
}

// They keep the content alive.
Bytes bytes_of(const File& file) { return {std::as_bytes(std::span(*file)), file}; }

Error missing() { return {"the bytes of a buffer are missing"}; }

/// One change of one asset.
class Placement {
 public:
  Placement(Change& change, const model::OpenedAsset& asset, const IsFree& is_free)
      : change_(change),
        asset_(asset),
        elements_(asset.document()),
        bytes_(elements_, asset.container(), asset.resolver()),
        is_free_(is_free),
        editor_(asset.document()) {}

  Trouble run() {
    for (auto& [buffer, content] : change_.contents) {
      if (auto trouble = put_content(buffer, std::move(content))) return trouble;
    }
    if (!change_.additions.empty()) {
      if (auto trouble = put_additions()) return trouble;
    }
    auto edits = editor_.take();
    if (!edits.empty()) {
      change_.edits = json::merge_edits(std::move(change_.edits), std::move(edits));
    }
    change_.additions = {};
    change_.contents = {};
    return std::nullopt;
  }

 private:
  const json::Document& document() const { return asset_.document(); }
  const container::Container& container() const { return asset_.container(); }

  Trouble put_additions() {
    const Additions& additions = change_.additions;
    find_bin();
    for (const Additions::Image& image : additions.images()) {
      if (!add_image(image)) return no_name();
    }
    if (!additions.accessors().empty() && !add_accessors()) return no_name();
    for (const auto& [array, elements] : additions.elements()) {
      for (const std::string& json : elements) append(array, json);
    }
    const auto bin = home_.begin ? change_.bins.find(home_.position) : change_.bins.end();
    if (bin != change_.bins.end() && !bin->second.more.empty()) {
      set_length_of_bin(bin->second.more.size());
    }
    return put_arrays() ? Trouble() : Error{"a root array has the wrong type"};
  }

  static Error no_name() { return {"all names for a new file are taken"}; }

  // Returns the index.
  std::uint64_t append(const std::string& array, std::string json) {
    arrays_[array].push_back(std::move(json));
    return change_.additions.old_count(array) + arrays_[array].size() - 1;
  }

  // Finds the first buffer that is a BIN chunk, or the chunk that can be a new buffer 0. Other
  // chunks of a GLB of version 3 keep their positions, so a new BIN chunk must be the last one.
  void find_bin() {
    if (container().format != container::Format::glb) return;
    const auto& bin = container().bin;
    if (change_.additions.old_count("buffers") == 0) {
      const bool has_room = container().glb_version != 3U || container().chunks.size() == 1;
      if (bin) home_ = {0, model::position_of(container(), *bin), bin->length};
      if (!bin && has_room) home_ = {0, kNewBin, 0};
      return;
    }
    for (std::uint64_t i = 0; i < elements_.count(RootArray::buffers); ++i) {
      const auto chunk = bytes_.buffer_chunk(i);
      if (!chunk) continue;
      const json::NodeId buffer = elements_.elements(RootArray::buffers)[i];
      const auto declared = model::unsigned_member(document(), buffer, "byteLength");
      if (!declared || *declared > chunk->length) return;
      home_ = {i, model::position_of(container(), *chunk), chunk->length};
      return;
    }
  }

  // Returns the offset in the BIN chunk.
  std::uint64_t append_bytes(std::string_view bytes) {
    std::string& bin = change_.bins[home_.position].more;
    const std::uint64_t offset = aligned(*home_.begin + bin.size());
    bin.resize(offset - *home_.begin);
    bin += bytes;
    return offset;
  }

  std::uint64_t add_view(std::uint64_t buffer, std::uint64_t offset, std::uint64_t length) {
    return append("bufferViews", fmt::format(R"({{"buffer":{},"byteOffset":{},"byteLength":{}}})",
                                             buffer, offset, length));
  }

  bool add_image(const Additions::Image& image) {
    std::string json;
    if (home_.begin) {
      const std::uint64_t view =
          add_view(home_.buffer, append_bytes(*image.png), image.png->size());
      json = fmt::format(R"({{"bufferView":{},"mimeType":"image/png"}})", view);
    } else {
      const std::string uri = new_uri(image.beside, ".png", "image/png", image.png);
      if (uri.empty()) return false;
      json = R"({"uri":)";
      json::append_string(json, uri);
      json += '}';
    }
    if (image.place) {
      const json::NodeId list = document().find(document().root(), "images");
      editor_.replace(list, elements_.elements(RootArray::images)[*image.place], json);
    } else {
      append("images", std::move(json));
    }
    return true;
  }

  // The URI of a new file, or a data URI if there is no file beside which it can be; empty: there
  // is no free name.
  std::string new_uri(const std::string& beside, std::string_view ending, std::string_view type,
                      const File& file) {
    const bool is_file = container().format == container::Format::gltf && !beside.empty();
    return is_file ? add_file(beside, ending, file) : container::data_uri(type, *file);
  }

  // Whether another new file has the name.
  bool is_taken(const std::string& path, std::string_view bytes) const {
    return std::any_of(change_.files.begin(), change_.files.end(), [&](const NewFile& file) {
      return file.path == path &&
             !container::same_bytes(
                 file.pieces, {std::as_bytes(std::span(bytes.data(), bytes.size())), nullptr});
    });
  }

  // The URI of a new file named after an old one; empty when all names are taken.
  std::string add_file(std::string_view old, std::string_view ending, const File& file) {
    const std::string hash = fmt::format("{:016x}", content_hash(*file));
    for (unsigned attempt = 0; attempt < 100; ++attempt) {
      std::string mark = attempt == 0 ? hash.substr(0, 8) : hash;
      if (attempt > 1) fmt::format_to(std::back_inserter(mark), "-{}", attempt);
      std::string uri = renamed(old, mark, ending);
      std::string path = container::classify_uri(uri).path;
      if (path.empty() || is_taken(path, *file) || !is_free_(path, *file)) continue;
      change_.files.push_back({std::move(path), {bytes_of(file)}});
      return uri;
    }
    return {};
  }

  // Without a BIN chunk all of them share a new buffer.
  bool add_accessors() {
    std::string own;
    const std::uint64_t buffer =
        home_.begin ? home_.buffer : change_.additions.old_count("buffers");
    for (const Additions::Accessor& accessor : change_.additions.accessors()) {
      std::uint64_t offset = aligned(own.size());
      if (home_.begin) {
        offset = append_bytes(accessor.bytes);
      } else {
        own.resize(offset);
        own += accessor.bytes;
      }
      const std::uint64_t view = add_view(buffer, offset, accessor.bytes.size());
      append("accessors", fmt::format(R"({{"bufferView":{},{})", view, accessor.members.substr(1)));
    }
    return home_.begin || add_buffer(std::make_shared<const std::string>(std::move(own)));
  }

  // Adds a buffer beside the first buffer that is a file.
  bool add_buffer(const File& file) {
    std::string beside;
    for (std::uint64_t i = 0; i < elements_.count(RootArray::buffers) && beside.empty(); ++i) {
      if (bytes_.buffer_storage(i) != Storage::file) continue;
      beside = model::string_member(document(), elements_.elements(RootArray::buffers)[i], "uri");
    }
    const std::string uri = new_uri(beside, ".bin", "application/octet-stream", file);
    std::string json = fmt::format(R"({{"byteLength":{},"uri":)", file->size());
    json::append_string(json, uri);
    append("buffers", json.append(1, '}'));
    return !uri.empty();
  }

  void set_length_of_bin(std::uint64_t more) {
    const std::string length = std::to_string(*home_.begin + more);
    if (change_.additions.old_count("buffers") == 0) {
      append("buffers", fmt::format(R"({{"byteLength":{}}})", length));
      return;
    }
    const json::NodeId buffer = elements_.elements(RootArray::buffers)[home_.buffer];
    editor_.replace_scalar(document().find(buffer, "byteLength"), length);
  }

  bool put_arrays() {
    for (const auto& [array, elements] : arrays_) {
      const json::NodeId list = document().find(document().root(), array);
      if (list == json::kNoNode) {
        editor_.append_member(document().root(), array,
                              fmt::format("[{}]", fmt::join(elements, ",")));
        continue;
      }
      if (document().kind(list) != json::Kind::array) return false;
      for (const std::string& json : elements) editor_.append_element(list, json);
    }
    return true;
  }

  Trouble put_content(std::uint32_t buffer, std::string content) {
    switch (bytes_.buffer_storage(buffer)) {
      case Storage::bin_chunk:
        return put_in_chunk(*bytes_.buffer_chunk(buffer), std::move(content));
      case Storage::data_uri:
        return put_in_data_uri(uri_of(buffer), content);
      case Storage::file:
        return put_in_file(document().string(uri_of(buffer)), std::move(content));
      default:
        return missing();
    }
  }

  json::NodeId uri_of(std::uint32_t buffer) const {
    return document().find(elements_.elements(RootArray::buffers)[buffer], "uri");
  }

  Trouble put_in_chunk(const container::Chunk& chunk, std::string content) {
    if (content.size() < chunk.length) return missing();
    const auto [bin, is_new] = change_.bins.try_emplace(model::position_of(container(), chunk));
    if (!is_new) return Error{"two buffers are one chunk"};
    bin->second.more = content.substr(chunk.length);
    content.resize(chunk.length);
    bin->second.patches = {{0, std::move(content)}};
    return std::nullopt;
  }

  Trouble put_in_data_uri(json::NodeId value, std::string_view content) {
    const auto uri = with_data(document().string(value), content);
    if (!uri) return uri.error();
    editor_.replace_scalar(value, json::string_value(*uri));
    return std::nullopt;
  }

  Trouble put_in_file(const std::string& text, std::string content) {
    const container::Uri uri = container::classify_uri(text);
    container::Resolved file = asset_.resolver().open(uri);
    if (file.error != container::ResolveError::none || content.size() < file.bytes.size()) {
      return missing();
    }
    for (const ReplacedFile& other : change_.replaced) {
      if (other.path == uri.path) return Error{"two buffers are one file"};
    }
    change_.replaced.push_back(
        {uri.path, file.state, std::move(file.bytes), Bytes::from_string(std::move(content))});
    return std::nullopt;
  }

  Change& change_;
  const model::OpenedAsset& asset_;
  const model::Asset elements_;
  const model::AssetBytes bytes_;
  const IsFree& is_free_;
  json::Editor editor_;
  /// The chunk that gets new bytes.
  struct {
    std::uint64_t buffer = 0;
    std::size_t position = 0;
    std::optional<std::uint64_t> begin;  ///< of new bytes in the chunk; nothing: there is none
  } home_;
  std::map<std::string, std::vector<std::string>> arrays_;
};

}  // namespace

Result<Change> place(Change change, const model::OpenedAsset& asset, const IsFree& is_free) {
  if (change.additions.empty() && change.contents.empty()) return change;
  if (auto trouble = Placement(change, asset, is_free).run()) return *std::move(trouble);
  return change;
}

}  // namespace gltfx::change
