// SPDX-License-Identifier: Apache-2.0
#include "upgrade/settlement.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "container/base64.hpp"
#include "container/uri.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "upgrade/image_cache.hpp"

namespace gltfx::upgrade {
namespace {

using model::RootArray;
using File = std::shared_ptr<const std::string>;

constexpr std::uint64_t kAlignment = 4;

std::uint64_t aligned(std::uint64_t size) {
  return (size + kAlignment - 1) / kAlignment * kAlignment;
}

std::string data_uri(std::string_view type, std::string_view bytes) {
  return fmt::format("data:{};base64,{}", type, container::encode_base64(bytes));
}

// A URI with another name behind its last '/': the old stem, a mark, and an ending.
std::string renamed(std::string_view uri, std::string_view mark, std::string_view ending) {
  const std::size_t name = uri.rfind('/') == std::string_view::npos ? 0 : uri.rfind('/') + 1;
  const std::size_t dot = uri.find_last_of('.');
  const bool has_ending = dot != std::string_view::npos && dot > name;
  return fmt::format("{}-{}{}", uri.substr(0, has_ending ? dot : uri.size()), mark, ending);
}

class ResourcePlacer {
 public:
  ResourcePlacer(const Additions& additions, const container::Container& container,
                 const AssetBytes& bytes, const IsFree& is_free)
      : additions_(additions),
        document_(bytes.asset().document()),
        container_(container),
        bytes_(bytes),
        is_free_(is_free),
        editor_(document_),
        views_(additions.old_count("bufferViews")) {
    find_bin();
  }

  Result<Settlement> run(const std::vector<File>& images) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (!add_image(additions_.images()[i], images[i])) return no_name();
    }
    for (const Additions::Texture& texture : additions_.textures()) add_texture(texture);
    if (!additions_.accessors().empty() && !add_accessors()) return no_name();
    for (const auto& [array, elements] : additions_.elements()) {
      for (const std::string& json : elements) append(array, json);
    }
    settle_bin();
    if (!put_arrays()) return Error{"a root array has the wrong type"};
    settlement_.edits = editor_.take();
    return std::move(settlement_);
  }

 private:
  static Error no_name() { return {"all names for a new file are taken"}; }

  void append(const std::string& array, std::string json) {
    arrays_[array].push_back(std::move(json));
  }

  // Bytes of the BIN chunk that buffer 0 is, or a new buffer 0 may be; nothing: it is something
  // else, or this is no GLB.
  void find_bin() {
    if (container_.format != container::Format::glb) return;
    const std::uint64_t length = container_.bin ? container_.bin->length : 0;
    if (additions_.old_count("buffers") == 0) {
      bin_begin_ = length;
    } else if (bytes_.buffer_storage(0) == Storage::bin_chunk) {
      const json::NodeId buffer = bytes_.asset().elements(RootArray::buffers)[0];
      const auto declared = model::unsigned_member(document_, buffer, "byteLength");
      if (declared && *declared <= length) bin_begin_ = length;
    }
  }

  // Gives the offset in the BIN chunk.
  std::uint64_t add_to_bin(std::string_view bytes) {
    std::string& bin = settlement_.bin;
    const std::uint64_t offset = aligned(*bin_begin_ + bin.size());
    bin.resize(offset - *bin_begin_);
    bin += bytes;
    return offset;
  }

  std::uint64_t add_view(std::uint64_t buffer, std::uint64_t offset, std::uint64_t length) {
    append("bufferViews", fmt::format(R"({{"buffer":{},"byteOffset":{},"byteLength":{}}})", buffer,
                                      offset, length));
    return views_++;
  }

  bool add_image(const ImageJob& job, const File& file) {
    if (bin_begin_) {
      const std::uint64_t view = add_view(0, add_to_bin(*file), file->size());
      append("images", fmt::format(R"({{"bufferView":{},"mimeType":"image/png"}})", view));
      return true;
    }
    const std::string old = bytes_.image_file_uri(job.first_image());
    const bool beside = container_.format == container::Format::gltf && !old.empty();
    const std::string uri = beside ? add_file(old, ".png", file) : data_uri("image/png", *file);
    std::string json = R"({"uri":)";
    json::append_string(json, uri);
    append("images", json.append(1, '}'));
    return !uri.empty();
  }

  void add_texture(const Additions::Texture& texture) {
    const std::string sampler =
        texture.sampler ? fmt::format(R"("sampler":{},)", *texture.sampler) : std::string();
    append("textures", fmt::format(R"({{{}"source":{}}})", sampler, texture.image));
  }

  // Whether another new file has the name.
  bool is_taken(const std::string& path, std::string_view bytes) const {
    return std::any_of(
        settlement_.files.begin(), settlement_.files.end(),
        [&](const edit::NewFile& file) { return file.path == path && *file.bytes != bytes; });
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
      settlement_.files.push_back({std::move(path), file});
      return uri;
    }
    return {};
  }

  // Without a BIN chunk all of them share a new buffer.
  bool add_accessors() {
    std::string own;
    const std::uint64_t buffer = bin_begin_ ? 0 : additions_.old_count("buffers");
    for (const Additions::Accessor& accessor : additions_.accessors()) {
      std::uint64_t offset = aligned(own.size());
      if (bin_begin_) {
        offset = add_to_bin(accessor.bytes);
      } else {
        own.resize(offset);
        own += accessor.bytes;
      }
      const std::uint64_t view = add_view(buffer, offset, accessor.bytes.size());
      append("accessors", fmt::format(R"({{"bufferView":{},{})", view, accessor.members.substr(1)));
    }
    return bin_begin_ || add_buffer(std::make_shared<const std::string>(std::move(own)));
  }

  // Beside the first buffer that is a file, else a data URI.
  bool add_buffer(const File& file) {
    std::string old;
    for (std::uint64_t i = 0; i < additions_.old_count("buffers") && old.empty(); ++i) {
      if (bytes_.buffer_storage(i) != Storage::file) continue;
      old = model::string_member(document_, bytes_.asset().elements(RootArray::buffers)[i], "uri");
    }
    const bool beside = container_.format == container::Format::gltf && !old.empty();
    const std::string uri =
        beside ? add_file(old, ".bin", file) : data_uri("application/octet-stream", *file);
    std::string json = fmt::format(R"({{"byteLength":{},"uri":)", file->size());
    json::append_string(json, uri);
    append("buffers", json.append(1, '}'));
    return !uri.empty();
  }

  void settle_bin() {
    if (settlement_.bin.empty()) return;
    const std::string length = std::to_string(*bin_begin_ + settlement_.bin.size());
    if (additions_.old_count("buffers") == 0) {
      append("buffers", fmt::format(R"({{"byteLength":{}}})", length));
      return;
    }
    const json::NodeId buffer = bytes_.asset().elements(RootArray::buffers)[0];
    editor_.replace_scalar(document_.find(buffer, "byteLength"), length);
  }

  bool put_arrays() {
    for (const auto& [array, elements] : arrays_) {
      const json::NodeId list = document_.find(document_.root(), array);
      if (list == json::kNoNode) {
        editor_.append_member(document_.root(), array,
                              fmt::format("[{}]", fmt::join(elements, ",")));
        continue;
      }
      if (document_.kind(list) != json::Kind::array) return false;
      for (const std::string& json : elements) editor_.append_element(list, json);
    }
    return true;
  }

  const Additions& additions_;
  const json::Document& document_;
  const container::Container& container_;
  const AssetBytes& bytes_;
  const IsFree& is_free_;
  json::Editor editor_;
  std::uint64_t views_;
  std::optional<std::uint64_t> bin_begin_;  ///< where new bytes of the BIN chunk begin
  std::map<std::string, std::vector<std::string>> arrays_;
  Settlement settlement_;
};

}  // namespace

Result<Settlement> settle(const Additions& additions, const std::vector<File>& images,
                          const container::Container& container, const AssetBytes& bytes,
                          const IsFree& is_free) {
  return ResourcePlacer(additions, container, bytes, is_free).run(images);
}

}  // namespace gltfx::upgrade
