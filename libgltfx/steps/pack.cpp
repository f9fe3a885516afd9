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
#include "change/rewrite.hpp"
#include "container/uri.hpp"
#include "image/header.hpp"
#include "model/asset_bytes.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "report/wording.hpp"
#include "steps/glb_chunks.hpp"
#include "steps/json_edits.hpp"
#include "steps/merged_buffers.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;
using model::RootArray;
using model::Storage;

constexpr std::uint64_t kMostBytes = UINT32_MAX;  // of a GLB of version 2
constexpr const char* kNoNumbers = "buffers of glTF 2.0 have no `chunk`; use --glb 2 or --to gltf";
constexpr const char* kNoFirst = "buffer 0 has no data, but the BIN chunk of a GLB is its data";

class Packer {
 public:
  Packer(const StepInput& input, std::uint32_t version)
      : input_(input),
        document_(input.asset.document()),
        elements_(document_),
        bytes_(elements_, input.asset.container(), input.asset.resolver()),
        editor_(document_) {
    made_.version = version;
    made_.leaves_chunks = !input.options.later.gltf.empty() && names_chunks(document_);
    outcome_.change.additions = change::Additions(document_);
  }

  Result<StepOutcome> run() {
    if (made_.leaves_chunks && made_.version == 3) return Error{kNoNumbers};
    if (becomes_other()) note_chunks(glb(), used_chunks(bytes_), made_.version, outcome_.row);
    take_buffers();
    if (takes_files()) take_images();
    if (is_glb() && moved_.files == 0 && !becomes_other()) return std::move(outcome_);
    if (!made_.stuck.empty()) return Error{made_.stuck};
    if (moved_.images == 0) take_lone_chunk();
    if (is_too_large()) {
      return Error{
          "a GLB of version 2 has at most 4 GiB; use --glb 3, or --to gltf for separate files"};
    }
    // The other chunks of a GLB of version 3 may have changed before.
    if (!is_glb() || becomes_other() || made_.version == 2) {
      outcome_.change.format = container::Format::glb;
      outcome_.change.glb_version = made_.version;
    }
    if (auto trouble = store_chunk()) return *std::move(trouble);
    outcome_.change.edits = editor_.take();
    if (!is_glb()) {
      if (auto blanks = blanks_after(document_.text())) {
        outcome_.change.edits.push_back(*std::move(blanks));
      }
    }
    describe();
    return std::move(outcome_);
  }

  bool is_too_large() const {
    std::uint64_t size = document_.text().size() + size_;
    for (const container::Chunk& chunk : glb().chunks) {
      if (change::is_copied(glb(), chunk, made_.version)) size += chunk.length;
    }
    return made_.version == 2 && size > kMostBytes;
  }

 private:
  json::NodeId buffer(std::uint64_t index) const {
    return elements_.elements(RootArray::buffers)[index];
  }
  std::uint64_t count() const { return elements_.count(RootArray::buffers); }
  const container::Container& glb() const { return input_.asset.container(); }
  bool is_glb() const { return glb().format == container::Format::glb; }
  // Whether no chunk stays as it is: another version, or buffers that cannot name theirs.
  bool becomes_other() const {
    return is_glb() && (glb().glb_version != made_.version || made_.leaves_chunks);
  }
  bool is_in_chunk(std::uint64_t index) const {
    return bytes_.buffer_storage(index) == Storage::bin_chunk;
  }
  // Whether files and data URIs go into the GLB.
  bool takes_files() const { return input_.options.to == StoredAs::glb; }

  // Whether a buffer other than the home becomes a part of it. The chunks of a GLB that stays one
  // of version 3 stay apart.
  bool is_merged(std::uint64_t index) const {
    const Storage storage = bytes_.buffer_storage(index);
    if (buffer(index) == json::kNoNode || storage == Storage::nowhere) return false;
    if (storage != Storage::bin_chunk) return takes_files();
    return becomes_other() || made_.version == 2;
  }

  // The buffer that is the BIN chunk: the first one, but in version 3 any may be one.
  std::uint64_t choose_home() const {
    for (std::uint64_t i = 0; is_glb() && !becomes_other() && i < count(); ++i) {
      if (is_in_chunk(i)) return i;
    }
    return 0;
  }

  std::optional<Error> store_chunk() {
    const auto& bin = glb().bin;
    const auto chunk = bytes_.buffer_chunk(made_.home);
    std::size_t position = bin ? model::position_of(glb(), *bin) : change::kNewBin;
    if (packed_.empty() && moved_.images == 0) {
      if (data_.empty()) return std::nullopt;
      forget_chunk();
    } else if (chunk) {
      position = model::position_of(glb(), *chunk);
      if (moved_.files + moved_.chunks == 0)
        data_ = {glb().bytes.part(chunk->offset, chunk->length)};
      declare_buffer();
    } else {
      if (size_ == 0) return std::nullopt;
      if (bin && bin->length > 0 && moved_.chunks == 0) return Error{kUnusedChunk};
      declare_buffer();
    }
    outcome_.change.bins[position].whole = std::move(data_);
    return std::nullopt;
  }

  void describe() {
    std::string form = "one GLB";
    if (becomes_other()) {
      if (glb().glb_version != made_.version) {
        form = fmt::format("GLB version {} -> {}", *glb().glb_version, made_.version);
      }
      const std::uint64_t joined = moved_.chunks + (is_in_chunk(made_.home) ? 1U : 0U);
      if (joined > 1) form += fmt::format(", {} BIN chunks joined", joined);
    } else if (is_glb()) {
      form = "the rest into the GLB";
    } else if (made_.version == 3) {
      form = "one GLB of version 3";
    }
    outcome_.row.what = describe_moves(form, moved_.files - moved_.images, moved_.images);
  }

  void refuse(std::string_view array, std::uint64_t index, std::string reason) {
    std::string pointer = fmt::format("/{}/{}", array, index);
    // The bytes of a chunk that is not joined would be lost.
    if (array == "buffers" && becomes_other() && is_in_chunk(index)) {
      made_.stuck = fmt::format("{}: {}", pointer, reason);
    }
    outcome_.row.refused.push_back({std::move(pointer), std::move(reason)});
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

  // A chunk that stays the only one is copied with its padding.
  void take_lone_chunk() {
    const auto own = bytes_.buffer_chunk(made_.home);
    const auto chunk = own ? own : lone_bin(glb());
    if (!becomes_other() || !packed_.empty() || !chunk) return;
    data_ = {glb().bytes.part(chunk->offset, chunk->length)};
    size_ = chunk->length;
  }

  void take_buffers() {
    made_.home = choose_home();
    if (count() == 0 || buffer(made_.home) == json::kNoNode) return;
    std::vector<std::uint64_t> merged;
    for (std::uint64_t i = 0; i < count(); ++i) {
      if (i != made_.home && is_merged(i)) merged.push_back(i);
    }
    if (!takes_files() && merged.empty()) return;
    auto first = bytes_of(made_.home);
    if (!first) {
      for (const std::uint64_t i : merged) refuse("buffers", i, kNoFirst);
      return;
    }
    put(made_.home, *std::move(first));
    moved_.files += is_in_chunk(made_.home) ? 0U : 1U;
    if (!merged.empty()) merge(merged);
  }

  // Buffers with the same file or chunk share its bytes.
  void put(std::uint64_t index, Bytes bytes) {
    std::string file = path_of(buffer(index));
    if (const auto chunk = bytes_.buffer_chunk(index)) file = fmt::format("/{}", chunk->offset);
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

  // Merges buffers with data into the home.
  void merge(const std::vector<std::uint64_t>& merged) {
    const graph::Graph graph(document_, input_.schemas);
    const auto users = change::buffer_users(graph);
    std::string doubt = find_doubt(graph, "buffers");
    if (doubt.empty()) doubt = users ? find_overrun(graph, bytes_, *users) : users.error().message;
    for (const std::uint64_t i : merged) {
      const json::NodeId object = buffer(i);
      if (!is_in_chunk(i) && is_plain_copy(document_, object)) {
        outcome_.row.left.push_back(
            {fmt::format("/buffers/{}", i),
             "it is the plain copy of compressed buffer views, which readers may skip"});
        continue;
      }
      const std::string why = doubt.empty() ? find_lost_member(document_, object) : doubt;
      if (!why.empty()) {
        refuse("buffers", i, why);
      } else if (auto bytes = bytes_of(i)) {
        if (document_.find(object, "name") != json::kNoNode) {
          outcome_.row.losses.push_back({fmt::format("the name of /buffers/{}", i), 0, 0, {}});
        }
        put(i, *std::move(bytes));
        ++(is_in_chunk(i) ? moved_.chunks : moved_.files);
      }
    }
    if (packed_.size() > 1) move_users(graph, *users, packed_, editor_);
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
      ++moved_.images;
      ++moved_.files;
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
    return outcome_.change.additions.add_element(
        "bufferViews", view_json({.buffer = home_position(), .offset = begin, .length = length}));
  }

  void refer(json::NodeId image, std::uint64_t view, std::string_view media_type) {
    const json::NodeId uri = document_.find(image, "uri");
    editor_.rename(uri - 1, "bufferView");
    editor_.replace_scalar(uri, std::to_string(view));
    if (media_type.empty()) return;
    editor_.append_member(image, "mimeType", fmt::format("\"{}\"", media_type));
  }

  // The index of the home without the buffers that are merged into it.
  std::uint64_t home_position() const {
    const auto before = std::count_if(packed_.begin(), packed_.end(), [&](const Packed& packed) {
      return packed.index < made_.home;
    });
    return made_.home - static_cast<std::uint64_t>(before);
  }

  // In version 2 the chunk of the home has no number.
  void forget_chunk() {
    if (count() == 0 || !becomes_other() || made_.version == 3 || !is_in_chunk(made_.home)) return;
    const json::NodeId chunk =
        model::chunk_member(document_, buffer(made_.home), schema::stated_version(document_));
    if (chunk != json::kNoNode) editor_.remove(buffer(made_.home), chunk - 1);
  }

  // The home is the whole chunk.
  void declare_buffer() {
    const std::string length = std::to_string(size_);
    if (count() == 0) {
      outcome_.change.additions.add_element("buffers",
                                            fmt::format(R"({{"byteLength":{}}})", length));
      return;
    }
    const json::NodeId first = buffer(made_.home);
    const json::NodeId uri = document_.find(first, "uri");
    if (uri != json::kNoNode) editor_.remove(first, uri - 1);
    forget_chunk();
    const bool grew = packed_.size() > 1 || moved_.images > 0;
    if (grew) editor_.replace_scalar(document_.find(first, "byteLength"), length);
  }

  const StepInput& input_;
  const json::Document& document_;
  const model::Asset elements_;
  model::AssetBytes bytes_;
  json::Editor editor_;
  StepOutcome outcome_;
  std::vector<Packed> packed_;  ///< in the order of the chunk; the first is the home
  std::vector<Bytes> data_;     ///< data of the chunk
  std::uint64_t size_ = 0;      ///< size of this data
  std::map<std::string, change::ByteRange> files_;  ///< files in the chunk, by path
  /// The new GLB.
  struct {
    std::uint32_t version = 2;
    std::uint64_t home = 0;      ///< the buffer that becomes the BIN chunk
    bool leaves_chunks = false;  ///< the asset becomes one of glTF 2.0
    std::string stuck;           ///< why a chunk cannot be joined; empty: all can be
  } made_;
  /// Numbers of what was in other places.
  struct {
    std::uint64_t files = 0;   ///< buffers and images
    std::uint64_t images = 0;  ///< images among them
    std::uint64_t chunks = 0;  ///< BIN chunks that become a part of another one
  } moved_;
};

}  // namespace

Result<StepOutcome> pack(const StepInput& input) {
  const container::Container& old = input.asset.container();
  const bool keeps = !input.options.later.glb_version && old.glb_version == 3U;
  const bool is_asked = input.options.later.glb_version == GlbVersion::three;
  Packer packer(input, keeps || is_asked ? 3 : 2);
  auto outcome = packer.run();
  const bool may_be_larger = input.options.later.glb_version != GlbVersion::two;
  if (outcome || !may_be_larger || !packer.is_too_large()) return outcome;
  return Packer(input, 3).run();
}

}  // namespace gltfx::steps
