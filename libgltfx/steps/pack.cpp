// SPDX-License-Identifier: Apache-2.0
// One GLB: buffers are merged, references to them follow, and images get separate buffer views.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/buffer_layout.hpp"
#include "container/uri.hpp"
#include "graph/renumber.hpp"
#include "image/header.hpp"
#include "model/asset_bytes.hpp"
#include "model/fields.hpp"
#include "model/meshopt_view.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;
using model::RootArray;
using model::Storage;

constexpr std::uint64_t kMostBytes = UINT32_MAX;
constexpr const char* kNoFirst = "buffer 0 has no data, but the BIN chunk of a GLB is its data";

/// A buffer that becomes a part of the BIN chunk.
struct Packed {
  std::uint64_t index;
  std::uint64_t base;  ///< its offset in the chunk
};

class Packer {
 public:
  explicit Packer(const StepInput& input)
      : input_(input),
        document_(input.asset.document()),
        elements_(document_),
        bytes_(elements_, input.asset.container(), input.asset.resolver()),
        editor_(document_) {
    outcome_.change.additions = change::Additions(document_);
  }

  Result<StepOutcome> run() {
    take_buffers();
    take_images();
    const bool is_glb = input_.asset.container().format == container::Format::glb;
    if (is_glb && moved_ == 0) return std::move(outcome_);
    if (size_ > kMostBytes - std::min<std::uint64_t>(kMostBytes, document_.text().size())) {
      return Error{"a GLB has at most 4 GiB; use --to gltf for separate files"};
    }
    outcome_.change.format = container::Format::glb;
    if (size_ > 0) {
      const auto& bin = input_.asset.container().bin;
      if (bin && bin->length > 0 && bytes_.buffer_storage(0) != Storage::bin_chunk) {
        return Error{kUnusedChunk};
      }
      outcome_.change.bin.whole = std::move(data_);
      declare_buffer();
    }
    outcome_.change.edits = editor_.take();
    if (!is_glb) keep_line_break();
    outcome_.row.what =
        describe_moves(is_glb ? "the rest into the GLB" : "one GLB", moved_ - images_, images_);
    return std::move(outcome_);
  }

 private:
  json::NodeId buffer(std::uint64_t index) const {
    return elements_.elements(RootArray::buffers)[index];
  }
  std::uint64_t count() const { return elements_.count(RootArray::buffers); }

  void refuse(std::string_view array, std::uint64_t index, std::string reason) {
    outcome_.row.refused.push_back({fmt::format("/{}/{}", array, index), std::move(reason)});
  }

  // Returns the offset of the bytes.
  std::uint64_t append(Bytes bytes) {
    const std::uint64_t begin = aligned(size_);
    if (begin > size_) data_.push_back(Bytes::from_string(std::string(begin - size_, '\0')));
    size_ = begin + bytes.size();
    data_.push_back(std::move(bytes));
    return begin;
  }

  // The declared bytes of a buffer; the rest of its file is not part of the asset. Nothing: the
  // buffer is not changed.
  std::optional<Bytes> bytes_of(std::uint64_t index) {
    if (bytes_.buffer_storage(index) == Storage::nowhere) return std::nullopt;
    auto bytes = bytes_.buffer(index);
    if (!bytes) {
      refuse("buffers", index, half_sentence(bytes.error().message));
      return std::nullopt;
    }
    const auto declared = model::unsigned_member(document_, buffer(index), "byteLength");
    if (!declared) {
      refuse("buffers", index, "its byteLength is missing");
      return std::nullopt;
    }
    if (bytes->size() < *declared) {
      refuse("buffers", index, fmt::format("its data has only {} bytes", bytes->size()));
      return std::nullopt;
    }
    const std::uint64_t more = bytes->size() - *declared;
    if (bytes_.buffer_storage(index) == Storage::bin_chunk) {
      return bytes->part(0, chunk_data_length(*declared, bytes->size()));
    }
    if (more > 0) {
      outcome_.row.left.push_back(
          {fmt::format("/buffers/{}", index),
           fmt::format("{} after its byteLength", report::counted(more, "byte"))});
    }
    return bytes->part(0, *declared);
  }

  void take_buffers() {
    if (count() == 0 || buffer(0) == json::kNoNode) return;
    auto first = bytes_of(0);
    if (!first) {
      for (std::uint64_t i = 1; i < count(); ++i) {
        if (bytes_.buffer_storage(i) == Storage::nowhere) continue;
        refuse("buffers", i, kNoFirst);
      }
      return;
    }
    const bool in_chunk = bytes_.buffer_storage(0) == Storage::bin_chunk;
    put(0, *std::move(first));
    moved_ += in_chunk ? 0U : 1U;
    if (count() > 1) merge();
  }

  // Buffers with the same file share its bytes.
  void put(std::uint64_t index, Bytes bytes) {
    const std::string file = path_of(buffer(index));
    const auto known = files_.find(file);
    if (!file.empty() && known != files_.end() &&
        bytes.size() <= known->second.end - known->second.begin) {
      packed_.push_back({index, known->second.begin});
      return;
    }
    const std::uint64_t length = bytes.size();
    const std::uint64_t base = append(std::move(bytes));
    if (!file.empty()) files_[file] = {base, base + length};
    packed_.push_back({index, base});
  }

  // Merges all buffers with data into the first one.
  void merge() {
    const graph::Graph graph(document_, input_.schemas);
    const auto users = change::buffer_users(graph);
    std::string doubt = find_doubt(graph, "buffers");
    if (doubt.empty()) doubt = users ? find_overrun(graph, *users) : users.error().message;
    for (std::uint64_t i = 1; i < count(); ++i) {
      const json::NodeId object = buffer(i);
      if (object == json::kNoNode || bytes_.buffer_storage(i) == Storage::nowhere) continue;
      if (is_plain_copy(object)) {
        outcome_.row.left.push_back(
            {fmt::format("/buffers/{}", i),
             "it is the plain copy of compressed buffer views, which readers may skip"});
        continue;
      }
      const std::string why = doubt.empty() ? find_lost_member(object) : doubt;
      if (!why.empty()) {
        refuse("buffers", i, why);
      } else if (auto bytes = bytes_of(i)) {
        if (document_.find(object, "name") != json::kNoNode) {
          outcome_.row.losses.push_back({fmt::format("the name of /buffers/{}", i), 0, 0, {}});
        }
        put(i, *std::move(bytes));
        ++moved_;
      }
    }
    if (packed_.size() > 1) move_users(graph, *users);
  }

  // An object that refers to bytes after the end of its buffer, which would be those of another one
  // after merging; empty: there is none.
  std::string find_overrun(const graph::Graph& graph,
                           const std::vector<change::BufferUser>& users) const {
    for (const change::BufferUser& user : users) {
      if (bytes_.buffer_storage(user.buffer) == Storage::nowhere) continue;
      const auto declared = model::unsigned_member(document_, buffer(user.buffer), "byteLength");
      if (user.bytes.end <= declared.value_or(0)) continue;
      return fmt::format("{} refers to bytes after the end of its buffer",
                         printable(graph.tree().pointer(user.object)));
    }
    return {};
  }

  // Whether readers that support compressed views need not load the buffer
  // (EXT_meshopt_compression, "fallback").
  bool is_plain_copy(json::NodeId object) const {
    const json::NodeId extensions = document_.find(object, "extensions");
    return std::any_of(model::kMeshoptExtensions.begin(), model::kMeshoptExtensions.end(),
                       [&](std::string_view name) {
                         return model::true_member(document_, document_.find(extensions, name),
                                                   "fallback");
                       });
  }

  // The first member of a merged buffer, other than length, place and name, that would be lost.
  std::string find_lost_member(json::NodeId object) const {
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (name == "uri" || name == "byteLength" || name == "name") continue;
      return fmt::format("its {} would be lost in another buffer", gltfx::quoted(name));
    }
    return {};
  }

  void move_users(const graph::Graph& graph, const std::vector<change::BufferUser>& users) {
    std::vector<std::uint64_t> base(count()), position(count());
    std::vector<bool> goes(count());
    for (const Packed& packed : packed_) {
      base[packed.index] = packed.base;
      goes[packed.index] = packed.index > 0;
    }
    std::uint64_t next = 0;
    const json::NodeId list = document_.find(document_.root(), "buffers");
    for (std::uint64_t i = 0; i < count(); ++i) {
      position[i] = goes[i] ? 0 : next++;
      if (goes[i]) editor_.remove(list, buffer(i));
    }
    for (const change::BufferUser& user : users) {
      change::move_user(document_, user, user.bytes.begin + base[user.buffer], editor_);
    }
    auto edits = graph::renumber(
        graph,
        [&](json::NodeId array, std::uint64_t index) {
          return array == list ? position[index] : index;
        },
        [](graph::Place) { return false; });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
  }

  void take_images() {
    std::map<std::string, std::uint64_t> views;  // by path of the file
    for (std::uint64_t i = 0; i < elements_.count(RootArray::images); ++i) {
      const json::NodeId image = elements_.elements(RootArray::images)[i];
      const Storage storage = bytes_.image_storage(i);
      if (storage != Storage::file && storage != Storage::data_uri) continue;
      auto bytes = bytes_.image(i);
      const std::string why =
          bytes ? find_image_obstacle(image) : half_sentence(bytes.error().message);
      if (!why.empty()) {
        refuse("images", i, why);
        continue;
      }
      const image::Sniffed sniffed = image::sniff(bytes->view());
      const bool has_type = document_.find(image, "mimeType") != json::kNoNode;
      if (!sniffed.known && !has_type) {
        refuse("images", i, "its format is not allowed in a buffer view");
        continue;
      }
      const std::string file = path_of(image);
      const auto known = file.empty() ? views.end() : views.find(file);
      const std::uint64_t view = known == views.end() ? add_view(*std::move(bytes)) : known->second;
      if (!file.empty()) views.emplace(file, view);
      refer(image, view, has_type ? "" : image::media_type(sniffed.format));
      ++images_;
      ++moved_;
    }
  }

  std::string find_image_obstacle(json::NodeId image) const {
    if (count() > 0 && packed_.empty()) return kNoFirst;
    const bool both = document_.find(image, "bufferView") != json::kNoNode;
    return both ? "it has both a uri and a bufferView" : "";
  }

  // The path of the file of a buffer or an image; empty: no file.
  std::string path_of(json::NodeId object) const {
    return container::classify_uri(model::string_member(document_, object, "uri")).path;
  }

  std::uint64_t add_view(Bytes bytes) {
    const std::uint64_t length = bytes.size();
    const std::uint64_t begin = append(std::move(bytes));
    return outcome_.change.additions.add_element("bufferViews",
                                                 view_json({.offset = begin, .length = length}));
  }

  void refer(json::NodeId image, std::uint64_t view, std::string_view media_type) {
    const json::NodeId uri = document_.find(image, "uri");
    editor_.rename(uri - 1, "bufferView");
    editor_.replace_scalar(uri, std::to_string(view));
    if (media_type.empty()) return;
    editor_.append_member(image, "mimeType", fmt::format("\"{}\"", media_type));
  }

  // Buffer 0 is the whole chunk.
  void declare_buffer() {
    const std::string length = std::to_string(size_);
    if (count() == 0) {
      outcome_.change.additions.add_element("buffers",
                                            fmt::format(R"({{"byteLength":{}}})", length));
      return;
    }
    const json::NodeId first = buffer(0);
    const json::NodeId uri = document_.find(first, "uri");
    if (uri != json::kNoNode) editor_.remove(first, uri - 1);
    const bool grew = packed_.size() > 1 || images_ > 0;
    if (grew) editor_.replace_scalar(document_.find(first, "byteLength"), length);
  }

  // White space at the end of the JSON would count as padding of the chunk, which may only have
  // blanks, unless it is longer than any padding. Up to three blanks at the end are replaced by new
  // padding.
  void keep_line_break() {
    constexpr std::size_t kEnough = 7;
    const std::string_view text = document_.text();
    const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
    const std::string_view space = text.substr(end);
    if (space.size() >= kEnough || space.find_first_not_of(' ') == space.npos) return;
    const auto size = static_cast<std::uint32_t>(text.size());
    outcome_.change.edits.push_back({{size, size}, std::string(kEnough - space.size(), ' ')});
  }

  const StepInput& input_;
  const json::Document& document_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  json::Editor editor_;
  StepOutcome outcome_;
  std::vector<Packed> packed_;  ///< in the order of the chunk; the first is buffer 0
  std::vector<Bytes> data_;     ///< data of the chunk
  std::uint64_t size_ = 0;      ///< size of this data
  std::map<std::string, change::ByteRange> files_;  ///< files in the chunk, by path
  std::uint64_t moved_ = 0;   ///< buffers and images that were in other places
  std::uint64_t images_ = 0;  ///< images among them
};

}  // namespace

Result<StepOutcome> pack(const StepInput& input) { return Packer(input).run(); }

}  // namespace gltfx::steps
