// SPDX-License-Identifier: Apache-2.0
// JSON text: the data of a GLB and of data URIs goes into files, or all data into data URIs.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/bin_cut.hpp"
#include "change/companions.hpp"
#include "container/base64.hpp"
#include "container/near_files.hpp"
#include "graph/renumber.hpp"
#include "image/header.hpp"
#include "json/writer.hpp"
#include "model/asset_bytes.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "steps/file_names.hpp"
#include "steps/glb_chunks.hpp"
#include "steps/json_edits.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;
using model::RootArray;
using model::Storage;
using Pieces = std::vector<Bytes>;

constexpr std::uint64_t kMostText = UINT32_MAX;
constexpr std::string_view kOctets = "application/octet-stream";

class TextStorage {
 public:
  explicit TextStorage(const StepInput& input)
      : input_(input),
        document_(input.asset.document()),
        elements_(document_),
        bytes_(elements_, input.asset.container(), input.asset.resolver()),
        names_(taken_names(input)),
        embeds_(input.options.to == StoredAs::embedded),
        editor_(document_) {}

  Result<StepOutcome> run() {
    if (auto why = find_chunk_obstacle()) return *std::move(why);
    if (embeds_ && !fits_in_text()) {
      return Error{"JSON text has at most 4 GiB; use --to glb or --to gltf"};
    }
    const std::vector<std::uint64_t> chunks = in_chunks();
    if (!embeds_ && !chunks.empty() && has_images_in_views()) {
      split_chunks();
    } else {
      for (const std::uint64_t i : chunks) name_buffer(i, {chunk(i)});
    }
    for (std::uint64_t i = 0; i < count(RootArray::buffers); ++i) store_buffer(i);
    for (std::uint64_t i = 0; i < count(RootArray::images); ++i) store_image(i);
    outcome_.change.edits = editor_.take();
    if (is_glb() || buffers_ + images_ > 0) {
      outcome_.change.format = container::Format::gltf;
      outcome_.row.what = describe_moves(embeds_ ? "data URIs" : "files", buffers_, images_);
    }
    return std::move(outcome_);
  }

 private:
  const container::Container& container() const { return input_.asset.container(); }
  bool is_glb() const { return container().format == container::Format::glb; }
  std::uint64_t count(RootArray array) const { return elements_.count(array); }
  json::NodeId element(RootArray array, std::uint64_t index) const {
    return elements_.elements(array)[index];
  }
  // Whether the text can hold all data, checked before any is encoded: many may refer to one file.
  bool fits_in_text() {
    std::uint64_t text = document_.text().size();
    const auto add = [&](RootArray array, std::uint64_t index) {
      const bool buffer = array == RootArray::buffers;
      const Storage storage = buffer ? bytes_.buffer_storage(index) : bytes_.image_storage(index);
      if (storage != Storage::file && storage != Storage::bin_chunk) return true;  // does not move
      const Result<Bytes> bytes = buffer ? bytes_.buffer(index) : bytes_.image(index);
      if (bytes) text += (bytes->size() + 2) / 3 * 4;
      return text <= kMostText;
    };
    for (const RootArray array : {RootArray::buffers, RootArray::images}) {
      for (std::uint64_t i = 0; i < count(array); ++i) {
        if (!add(array, i)) return false;
      }
    }
    return true;
  }
  // The buffers that are BIN chunks.
  std::vector<std::uint64_t> in_chunks() const {
    std::vector<std::uint64_t> found;
    for (std::uint64_t i = 0; i < count(RootArray::buffers); ++i) {
      if (bytes_.buffer_storage(i) == Storage::bin_chunk) found.push_back(i);
    }
    return found;
  }
  // The data of a buffer in its chunk.
  Bytes chunk(std::uint64_t index) const {
    const container::Chunk bin = *bytes_.buffer_chunk(index);
    const auto declared =
        model::unsigned_member(document_, element(RootArray::buffers, index), "byteLength");
    return container().bytes.part(bin.offset,
                                  chunk_data_length(declared.value_or(bin.length), bin.length));
  }

  // Finds chunks of a GLB that a .gltf cannot hold.
  std::optional<Error> find_chunk_obstacle() const {
    if (!is_glb()) return std::nullopt;
    const std::set<std::uint64_t> used = used_chunks(bytes_);
    const auto& bin = container().bin;
    bool has_unused = false;
    for (const container::Chunk& other : container().chunks) {
      if (used.contains(other.offset) || other.offset == container().json_offset) continue;
      const bool is_bin = other.type == container::kChunkBin && other.encoding == 0 &&
                          (container().glb_version == 3U || (bin && other.offset == bin->offset));
      if (!is_bin) return Error{"a .gltf cannot hold the chunk " + chunk_type(other)};
      has_unused = has_unused || other.length > 0;
    }
    if (has_unused) return Error{kUnusedChunk};
    return std::nullopt;
  }

  // Makes files of the BIN chunks, and files of the images in them.
  void split_chunks() {
    const graph::Graph graph(document_, input_.schemas);
    const std::map<std::uint64_t, Bytes> images = images_in_chunks(graph);
    std::map<json::NodeId, std::string> uris;  // by view
    std::set<json::NodeId> gone, moved;
    for (const auto& [index, bytes] : images) {
      const json::NodeId image = element(RootArray::images, index);
      const json::NodeId member = document_.find(image, "bufferView");
      const json::NodeId view = view_of(image);
      const auto [uri, is_new] = uris.try_emplace(view);
      if (is_new) uri->second = image_file(index, bytes);
      name_file(image, member, uri->second);
      moved.insert(member);
      gone.insert(view);
      ++images_;
    }
    // Views with other users stay.
    std::erase_if(gone, [&](json::NodeId view) {
      const auto users = graph.users(view);
      return !std::all_of(users.begin(), users.end(),
                          [&](const graph::Use& use) { return moved.contains(use.at.node); });
    });
    for (const json::NodeId view : gone) {
      if (document_.find(view, "name") == json::kNoNode) continue;
      outcome_.row.losses.push_back(
          {fmt::format("the name of /bufferViews/{}", graph.tree().position(view)), 0, 0, {}});
    }
    std::map<std::uint64_t, std::vector<change::BufferUser>> users;
    if (const auto all = change::buffer_users(graph)) {
      for (const change::BufferUser& user : *all) users[user.buffer].push_back(user);
    }
    std::set<json::NodeId> emptied;
    for (const std::uint64_t i : in_chunks()) {
      const json::NodeId buffer = element(RootArray::buffers, i);
      const auto cut = change::cut_bin(
          graph.tree(), users[i], [&](json::NodeId object) { return gone.contains(object); },
          chunk(i).size(), editor_);
      if (holds_nothing_but(graph, buffer, gone)) {
        emptied.insert(buffer);
      } else {
        name_buffer(i, change::without(chunk(i), cut));
      }
    }
    take_out(graph, gone, moved, emptied);
  }

  // Replaces the buffer view of an image by a URI. An image with a buffer view may have an empty
  // one.
  void name_file(json::NodeId image, json::NodeId member, const std::string& uri) {
    const json::NodeId old = document_.find(image, "uri");
    if (old == json::kNoNode) {
      editor_.rename(member - 1, "uri");
      editor_.replace_scalar(member, json::string_value(uri));
    } else {
      editor_.remove(image, member - 1);
      editor_.replace(image, old, json::string_value(uri));
    }
  }

  bool has_images_in_views() const {
    for (std::uint64_t i = 0; i < count(RootArray::images); ++i) {
      if (bytes_.image_storage(i) == Storage::buffer_view) return true;
    }
    return false;
  }

  // The images that go into files, by index.
  std::map<std::uint64_t, Bytes> images_in_chunks(const graph::Graph& graph) {
    std::map<std::uint64_t, Bytes> found;
    const std::string doubt = find_doubt(graph, "buffer views");
    for (std::uint64_t i = 0; i < count(RootArray::images); ++i) {
      if (bytes_.image_storage(i) != Storage::buffer_view) continue;
      const json::NodeId image = element(RootArray::images, i);
      const auto buffer = elements_.index(view_of(image), "buffer", RootArray::buffers);
      if (!buffer || bytes_.buffer_storage(*buffer) != Storage::bin_chunk) continue;
      std::string why = doubt;
      for (const std::string_view name : free_members(document_, view_of(image))) {
        if (name != "name" && why.empty()) {
          why = fmt::format("the {} of its buffer view would be lost", gltfx::quoted(name));
        }
      }
      auto bytes = why.empty() ? bytes_.image(i) : Result<Bytes>(Error{why});
      if (bytes) {
        found.emplace(i, *std::move(bytes));
      } else {
        outcome_.row.left.push_back(
            {fmt::format("/images/{}", i), half_sentence(bytes.error().message)});
      }
    }
    return found;
  }

  json::NodeId view_of(json::NodeId image) const {
    const auto view = elements_.index(image, "bufferView", RootArray::buffer_views);
    return view ? element(RootArray::buffer_views, *view) : json::kNoNode;
  }

  // Whether a buffer has only these views as users, at least one, and no other members.
  bool holds_nothing_but(const graph::Graph& graph, json::NodeId buffer,
                         const std::set<json::NodeId>& views) const {
    const auto users = graph.users(buffer);
    const std::size_t places = chunk_member(buffer) == json::kNoNode ? 0 : 1;
    return !users.empty() && document_.object_size(buffer) == 1 + places &&
           std::all_of(users.begin(), users.end(), [&](const graph::Use& use) {
             return views.contains(graph.tree().parent(use.at.node));
           });
  }

  // Removes elements, or their list if it would be empty.
  void remove(const graph::Tree& tree, const std::set<json::NodeId>& elements) {
    const json::NodeId list = tree.parent(*elements.begin());
    if (elements.size() == tree.size(list)) return editor_.remove(document_.root(), list - 1);
    for (const json::NodeId element : elements) editor_.remove(list, element);
  }

  // Removes buffer views and buffers.
  void take_out(const graph::Graph& graph, const std::set<json::NodeId>& views,
                const std::set<json::NodeId>& moved, const std::set<json::NodeId>& buffers) {
    if (views.empty()) return;
    const graph::Tree& tree = graph.tree();
    std::map<json::NodeId, std::vector<std::uint64_t>> gone;  // positions, by list
    for (const auto* elements : {&views, &buffers}) {
      if (!elements->empty()) remove(tree, *elements);
      for (const json::NodeId each : *elements) {
        gone[tree.parent(each)].push_back(tree.position(each));
      }
    }
    auto edits = graph::renumber(
        graph,
        [&](json::NodeId array, std::uint64_t index) {
          const auto positions = gone.find(array);
          if (positions == gone.end()) return index;
          const auto& list = positions->second;
          const auto behind = std::lower_bound(list.begin(), list.end(), index);
          return index - static_cast<std::uint64_t>(behind - list.begin());
        },
        [&](graph::Place at) {
          return moved.contains(at.node) || views.contains(tree.parent(at.node));
        });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
  }

  void refuse(std::string_view array, std::uint64_t index, std::string_view why) {
    outcome_.row.refused.push_back({fmt::format("/{}/{}", array, index), half_sentence(why)});
  }

  void store_buffer(std::uint64_t index) {
    const Storage storage = bytes_.buffer_storage(index);
    if (storage != (embeds_ ? Storage::file : Storage::data_uri)) return;
    auto bytes = bytes_.buffer(index);
    if (bytes) return name_buffer(index, {*std::move(bytes)});
    refuse("buffers", index, bytes.error().message);
  }

  void name_buffer(std::uint64_t index, Pieces pieces) {
    const std::string stem =
        index == 0 ? asset_stem(input_) : fmt::format("{}-{}", asset_stem(input_), index);
    set_uri(element(RootArray::buffers, index),
            embeds_ ? container::data_uri(kOctets, pieces.front().text())
                    : new_file(stem, ".bin", std::move(pieces)));
    ++buffers_;
  }

  void store_image(std::uint64_t index) {
    const Storage storage = bytes_.image_storage(index);
    if (storage != (embeds_ ? Storage::file : Storage::data_uri)) return;
    const json::NodeId image = element(RootArray::images, index);
    const auto bytes = bytes_.image(index);
    if (!bytes) {
      refuse("images", index, bytes.error().message);
      return;
    }
    const std::string declared = model::string_member(document_, image, "mimeType");
    const image::Sniffed sniffed = image::sniff(bytes->view());
    const std::string_view type = sniffed.known             ? image::media_type(sniffed.format)
                                  : is_media_type(declared) ? std::string_view(declared)
                                                            : kOctets;
    set_uri(image, embeds_ ? container::data_uri(type, bytes->text()) : image_file(index, *bytes));
    ++images_;
  }

  json::NodeId chunk_member(json::NodeId buffer) const {
    return model::chunk_member(document_, buffer, schema::stated_version(document_));
  }

  // Returns the URI.
  std::string image_file(std::uint64_t index, const Bytes& bytes) {
    const json::NodeId image = element(RootArray::images, index);
    const std::string type = model::string_member(document_, image, "mimeType");
    std::string stem = clean_name(model::string_member(document_, image, "name"));
    if (!input_.options.targets.empty()) stem = unescaped_name(std::move(stem));
    if (stem.empty()) stem = fmt::format("{}_image{}", asset_stem(input_), index);
    return new_file(stem, image_ending(bytes, type), {bytes});
  }

  // Other assets of a shared folder may have files of the same name.
  std::string new_file(const std::string& stem, std::string_view ending, Pieces pieces) {
    const std::string mark = input_.options.shared_folder ? content_mark(pieces) : std::string();
    std::string path = names_.take(stem, ending, mark);
    std::string uri = container::uri_of_path(path);
    outcome_.change.files.push_back({std::move(path), std::move(pieces)});
    return uri;
  }

  void set_uri(json::NodeId object, const std::string& uri) {
    std::string json = json::string_value(uri);
    const json::NodeId old = document_.find(object, "uri");
    const json::NodeId chunk = chunk_member(object);
    if (old != json::kNoNode) {
      editor_.replace_scalar(old, std::move(json));
    } else if (chunk != json::kNoNode) {
      editor_.rename(chunk - 1, "uri");
      editor_.replace_scalar(chunk, std::move(json));
    } else {
      editor_.append_member(object, "uri", json);
    }
  }

  const StepInput& input_;
  const json::Document& document_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  FileNames names_;
  const bool embeds_;
  json::Editor editor_;
  StepOutcome outcome_;
  std::uint64_t buffers_ = 0, images_ = 0;  ///< numbers of moved ones
};

}  // namespace

Result<StepOutcome> store_as_text(const StepInput& input) { return TextStorage(input).run(); }

}  // namespace gltfx::steps
