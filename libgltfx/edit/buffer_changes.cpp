// SPDX-License-Identifier: Apache-2.0
#include "edit/buffer_changes.hpp"

#include <utility>

#include "container/base64.hpp"
#include "container/uri.hpp"
#include "json/writer.hpp"

namespace gltfx::edit {
namespace {

using container::Bytes;

const Error kMissing{"the bytes of a buffer are missing"};

/// One asset's buffers.
class Buffers {
 public:
  Buffers(const json::Document& document, const container::Container& container,
          const container::Resolver& resolver, json::Editor& editor)
      : document_(document), container_(container), resolver_(resolver), editor_(editor) {
    const json::NodeId list = document.find(document.root(), "buffers");
    if (list == json::kNoNode || document.kind(list) != json::Kind::array) return;
    for (const json::NodeId element : document.elements(list)) buffers_.push_back(element);
  }

  std::optional<Error> change(std::uint32_t index, std::string content, ChangedBuffers& changed) {
    if (index >= buffers_.size()) return kMissing;
    const json::NodeId value = document_.find(buffers_[index], "uri");
    if (value == json::kNoNode) return change_chunk(index, std::move(content), changed);
    if (!document_.is_string(value)) return kMissing;
    const std::string text = document_.string(value);
    const container::Uri uri = container::classify_uri(text);
    if (uri.kind == container::UriKind::data) return change_data_uri(value, text, content);
    return change_file(uri, std::move(content), changed);
  }

 private:
  std::optional<Error> change_chunk(std::uint32_t index, std::string content,
                                    ChangedBuffers& changed) const {
    if (index != 0 || !container_.bin || content.size() < container_.bin->length) return kMissing;
    changed.bin.more = content.substr(container_.bin->length);
    content.resize(container_.bin->length);
    changed.bin.patches = {{0, std::move(content)}};
    return std::nullopt;
  }

  std::optional<Error> change_data_uri(json::NodeId value, const std::string& text,
                                       const std::string& content) {
    const auto uri = container::split_data_uri(text);
    if (!uri) return uri.error();
    std::string next = text.substr(0, text.find(','));
    if (!uri->base64) next += ";base64";
    next.append(1, ',').append(container::encode_base64(content));
    std::string json;
    json::append_string(json, next);
    editor_.replace_scalar(value, std::move(json));
    return std::nullopt;
  }

  std::optional<Error> change_file(const container::Uri& uri, std::string content,
                                   ChangedBuffers& changed) const {
    container::Resolved file = resolver_.open(uri);
    if (file.error != container::ResolveError::none || content.size() < file.bytes.size()) {
      return kMissing;
    }
    for (const ReplacedFile& other : changed.files) {
      if (other.path == uri.path) return Error{"two buffers are one file"};
    }
    changed.files.push_back(
        {uri.path, file.state, std::move(file.bytes), Bytes::from_string(std::move(content))});
    return std::nullopt;
  }

  const json::Document& document_;
  const container::Container& container_;
  const container::Resolver& resolver_;
  json::Editor& editor_;
  std::vector<json::NodeId> buffers_;
};

}  // namespace

Result<ChangedBuffers> change_buffers(const json::Document& document,
                                      const container::Container& container,
                                      const container::Resolver& resolver, BufferContents contents,
                                      json::Editor& editor) {
  ChangedBuffers changed;
  Buffers buffers(document, container, resolver, editor);
  for (auto& change : contents) {
    auto error = buffers.change(change.first, std::move(change.second), changed);
    if (error) return *std::move(error);
  }
  return changed;
}

}  // namespace gltfx::edit
