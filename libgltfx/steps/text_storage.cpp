// SPDX-License-Identifier: Apache-2.0
// JSON text: what a GLB or a data URI holds goes into files, or all of it into data URIs.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/text.hpp"
#include "change/bin_cut.hpp"
#include "change/companions.hpp"
#include "container/base64.hpp"
#include "container/near_files.hpp"
#include "graph/renumber.hpp"
#include "graph/unknown_indices.hpp"
#include "image/header.hpp"
#include "json/writer.hpp"
#include "model/asset_bytes.hpp"
#include "model/fields.hpp"
#include "report/wording.hpp"
#include "steps/file_names.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;
using model::RootArray;
using model::Storage;
using Pieces = std::vector<Bytes>;

constexpr std::uint64_t kMostText = UINT32_MAX;
constexpr std::string_view kOctets = "application/octet-stream";

// Without the cut ranges, and only the first `length` bytes of what is left.
Pieces without(const Bytes& bytes, const std::vector<change::ByteRange>& cut,
               std::uint64_t length) {
  Pieces pieces;
  std::uint64_t at = 0;
  const auto keep_to = [&](std::uint64_t end) {
    const std::uint64_t size = std::min(end - at, length);
    if (size > 0) pieces.push_back(bytes.part(at, size));
    length -= size;
  };
  for (const change::ByteRange& range : cut) {
    keep_to(range.begin);
    at = range.end;
  }
  keep_to(bytes.size());
  return pieces;
}

std::string json_string(std::string_view text) {
  std::string json;
  json::append_string(json, text);
  return json;
}

class TextStorage {
 public:
  explicit TextStorage(const StepInput& input)
      : input_(input),
        document_(input.asset.document()),
        elements_(document_),
        bytes_(elements_, input.asset.container(), input.asset.resolver()),
        names_(change::referred_paths(document_)),
        embeds_(input.options.to == StoredAs::embedded),
        editor_(document_) {}

  Result<StepOutcome> run() {
    if (auto why = find_chunk_obstacle()) return *std::move(why);
    const bool has_bin =
        count(RootArray::buffers) > 0 && bytes_.buffer_storage(0) == Storage::bin_chunk;
    if (has_bin && !embeds_) {
      split_chunk();
    } else if (has_bin) {
      name_buffer(0, {chunk().part(0, chunk_length())});
    }
    for (std::uint64_t i = 0; i < count(RootArray::buffers); ++i) store_buffer(i);
    for (std::uint64_t i = 0; i < count(RootArray::images); ++i) store_image(i);
    if (text_ > kMostText) return Error{"JSON text has at most 4 GiB; --to glb has no such text"};
    outcome_.change.edits = editor_.take();
    if (is_glb() || buffers_ + images_ > 0) {
      outcome_.change.format = container::Format::gltf;
      describe();
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
  Bytes chunk() const {
    return container().bytes.part(container().bin->offset, container().bin->length);
  }

  // Chunks of a GLB that a .gltf has no place for.
  std::optional<Error> find_chunk_obstacle() const {
    if (!is_glb()) return std::nullopt;
    const auto& bin = container().bin;
    for (std::size_t i = 1; i < container().chunks.size(); ++i) {
      const container::Chunk& other = container().chunks[i];
      if (bin && other.offset == bin->offset) continue;
      const std::string_view type = container().bytes.text().substr(other.header_offset + 4, 4);
      return Error{fmt::format("the chunk {} has no place in a .gltf", gltfx::quoted(type))};
    }
    const bool owned =
        !bin || bin->length == 0 ||
        (count(RootArray::buffers) > 0 && bytes_.buffer_storage(0) == Storage::bin_chunk);
    if (owned) return std::nullopt;
    return Error{"the BIN chunk is the data of no buffer"};
  }

  // A file of the BIN chunk, and files of the images in it.
  void split_chunk() {
    const graph::Graph graph(document_, input_.schemas);
    const std::map<std::uint64_t, Bytes> images = images_in_chunk(graph);
    std::map<json::NodeId, std::string> uris;  // by view
    std::set<json::NodeId> gone, moved;
    for (const auto& [index, bytes] : images) {
      const json::NodeId image = element(RootArray::images, index);
      const json::NodeId member = document_.find(image, "bufferView");
      const json::NodeId view = view_of(image);
      const auto [uri, is_new] = uris.try_emplace(view);
      if (is_new) uri->second = image_file(index, bytes);
      editor_.rename(member - 1, "uri");
      editor_.replace_scalar(member, json_string(uri->second));
      moved.insert(member);
      gone.insert(view);
      ++images_;
    }
    // What something else uses stays, too.
    std::erase_if(gone, [&](json::NodeId view) {
      const auto users = graph.users(view);
      return !std::all_of(users.begin(), users.end(),
                          [&](const graph::Use& use) { return moved.contains(use.at.node); });
    });
    const auto cut = change::cut_bin(
        graph, [&](json::NodeId object) { return gone.contains(object); }, chunk().size(), editor_);
    const bool empties = !gone.empty() && holds_nothing_but(graph, gone);
    take_out(graph, gone, moved, empties);
    if (empties) return;
    const std::uint64_t whole = chunk_length();
    std::uint64_t left = whole;
    for (const change::ByteRange& range : cut) {
      left -= std::min(range.end, whole) - std::min(range.begin, whole);
    }
    name_buffer(0, without(chunk(), cut, left));
  }

  // What of the chunk is data of the buffer: all of it where it is longer than padding explains.
  std::uint64_t chunk_length() const {
    const std::uint64_t length = chunk().size();
    const auto declared =
        model::unsigned_member(document_, element(RootArray::buffers, 0), "byteLength");
    return declared && *declared <= length && length - *declared < 4 ? *declared : length;
  }

  // Those that go into files, by index.
  std::map<std::uint64_t, Bytes> images_in_chunk(const graph::Graph& graph) {
    std::map<std::uint64_t, Bytes> found;
    const auto unknown = graph::unknown_with_integers(graph);
    for (std::uint64_t i = 0; i < count(RootArray::images); ++i) {
      if (bytes_.image_storage(i) != Storage::buffer_view) continue;
      const json::NodeId image = element(RootArray::images, i);
      const auto buffer = elements_.index(view_of(image), "buffer", RootArray::buffers);
      if (!buffer || *buffer != 0) continue;
      const std::string pointer = fmt::format("/images/{}", i);
      if (!unknown.empty()) {
        note(outcome_.row.left, pointer,
             fmt::format("{} may hold indices of buffer views (--schema describes it)",
                         printable(graph.tree().pointer(unknown.front()))));
      } else if (auto bytes = bytes_.image(i)) {
        found.emplace(i, *std::move(bytes));
      } else {
        note(outcome_.row.left, pointer, bytes.error().message);
      }
    }
    return found;
  }

  json::NodeId view_of(json::NodeId image) const {
    const auto view = elements_.index(image, "bufferView", RootArray::buffer_views);
    return view ? element(RootArray::buffer_views, *view) : json::kNoNode;
  }

  // Whether buffer 0 has no use but by those views, and nothing of its own.
  bool holds_nothing_but(const graph::Graph& graph, const std::set<json::NodeId>& views) const {
    const json::NodeId first = element(RootArray::buffers, 0);
    const auto users = graph.users(first);
    return document_.object_size(first) == 1 &&
           std::all_of(users.begin(), users.end(), [&](const graph::Use& use) {
             return views.contains(graph.tree().parent(use.at.node));
           });
  }

  // An element, or its list where that would be empty.
  void remove(const graph::Tree& tree, const std::set<json::NodeId>& elements) {
    const json::NodeId list = tree.parent(*elements.begin());
    if (elements.size() == tree.size(list)) return editor_.remove(document_.root(), list - 1);
    for (const json::NodeId element : elements) editor_.remove(list, element);
  }

  // Buffer views that go, and with them buffer 0 where it is empty then.
  void take_out(const graph::Graph& graph, const std::set<json::NodeId>& gone,
                const std::set<json::NodeId>& moved, bool empties) {
    if (gone.empty()) return;
    const graph::Tree& tree = graph.tree();
    const json::NodeId list = tree.parent(*gone.begin());
    const json::NodeId first = element(RootArray::buffers, 0);
    remove(tree, gone);
    if (empties) remove(tree, {first});
    std::vector<std::uint64_t> positions;
    for (const json::NodeId view : gone) positions.push_back(tree.position(view));
    auto edits = graph::renumber(
        graph,
        [&](json::NodeId array, std::uint64_t index) {
          if (empties && array == tree.parent(first)) return index - 1;
          if (array != list) return index;
          const auto behind = std::lower_bound(positions.begin(), positions.end(), index);
          return index - static_cast<std::uint64_t>(behind - positions.begin());
        },
        [&](graph::Place at) {
          return moved.contains(at.node) || gone.contains(tree.parent(at.node));
        });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
  }

  void store_buffer(std::uint64_t index) {
    const Storage storage = bytes_.buffer_storage(index);
    if (storage != (embeds_ ? Storage::file : Storage::data_uri)) return;
    auto bytes = bytes_.buffer(index);
    if (bytes) return name_buffer(index, {*std::move(bytes)});
    note(outcome_.row.refused, fmt::format("/buffers/{}", index), bytes.error().message);
  }

  void name_buffer(std::uint64_t index, Pieces pieces) {
    const std::string stem = index == 0 ? own_name() : fmt::format("{}-{}", own_name(), index);
    set_uri(element(RootArray::buffers, index),
            embeds_ ? container::data_uri(kOctets, container::join(pieces))
                    : new_file(stem, ".bin", std::move(pieces)));
    ++buffers_;
  }

  void store_image(std::uint64_t index) {
    const Storage storage = bytes_.image_storage(index);
    if (storage != (embeds_ ? Storage::file : Storage::data_uri)) return;
    const json::NodeId image = element(RootArray::images, index);
    const auto bytes = bytes_.image(index);
    if (!bytes) {
      note(outcome_.row.refused, fmt::format("/images/{}", index), bytes.error().message);
      return;
    }
    const std::string declared = model::string_member(document_, image, "mimeType");
    const image::Sniffed sniffed = image::sniff(bytes->view());
    const std::string_view type = sniffed.known      ? image::media_type(sniffed.format)
                                  : declared.empty() ? kOctets
                                                     : std::string_view(declared);
    set_uri(image, embeds_ ? container::data_uri(type, bytes->text()) : image_file(index, *bytes));
    ++images_;
  }

  // Gives the URI.
  std::string image_file(std::uint64_t index, const Bytes& bytes) {
    const json::NodeId image = element(RootArray::images, index);
    const std::string type = model::string_member(document_, image, "mimeType");
    std::string stem = clean_name(model::string_member(document_, image, "name"));
    if (stem.empty()) stem = fmt::format("{}_image{}", own_name(), index);
    if (input_.options.shared_folder) {
      stem += fmt::format("-{:08x}", content_hash(bytes.text()) & UINT32_MAX);
    }
    return new_file(stem, image_ending(bytes, type), {bytes});
  }

  std::string own_name() const {
    std::string name = clean_name(input_.name);
    return name.empty() ? std::string("model") : name;
  }

  std::string new_file(const std::string& stem, std::string_view ending, Pieces pieces) {
    std::string path = names_.take(stem, ending);
    std::string uri = container::uri_of_path(path);
    outcome_.change.files.push_back({std::move(path), std::move(pieces)});
    return uri;
  }

  void set_uri(json::NodeId object, const std::string& uri) {
    std::string json = json_string(uri);
    text_ += json.size();
    const json::NodeId old = document_.find(object, "uri");
    if (old == json::kNoNode) {
      editor_.append_member(object, "uri", json);
    } else {
      editor_.replace_scalar(old, std::move(json));
    }
  }

  void describe() {
    std::string& what = outcome_.row.what;
    what = embeds_ ? "data URIs" : "files";
    if (buffers_ > 0) what += fmt::format(", {}", report::counted(buffers_, "buffer"));
    if (images_ > 0) what += fmt::format(", {}", report::counted(images_, "image"));
  }

  const StepInput& input_;
  const json::Document& document_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  FileNames names_;
  const bool embeds_;
  json::Editor editor_;
  StepOutcome outcome_;
  std::uint64_t buffers_ = 0, images_ = 0;  ///< that were moved
  std::uint64_t text_ = 0;                  ///< bytes of new URIs
};

}  // namespace

Result<StepOutcome> store_as_text(const StepInput& input) { return TextStorage(input).run(); }

}  // namespace gltfx::steps
