// SPDX-License-Identifier: Apache-2.0
// Buffers: the source of their bytes, and whether there are enough of them.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "container/content.hpp"
#include "container/mapped_files.hpp"
#include "container/opened_files.hpp"
#include "container/uri.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"
#include "rules/phases.hpp"
#include "rules/resource_fetch.hpp"

namespace gltfx::validate {
namespace {

using container::Bytes;

// Whether an extension declares that a buffer is only needed by readers without the extension, and
// may be missing.
bool is_fallback(const Context& context, json::NodeId buffer) {
  const json::Document& document = context.document;
  const json::NodeId extensions = model::object_member(document, buffer, "extensions");
  if (extensions == json::kNoNode || context.deviations.unsupported_extensions_are_skipped) {
    return false;
  }
  for (const auto extension : document.members(extensions)) {
    if (!document.is_object(extension.value)) continue;
    if (model::true_member(document, extension.value, "fallback")) return true;
  }
  return false;
}

bool names_chunk(const Resource& resource) {
  return model::chunk_member(resource.context.document, resource.object,
                             resource.context.version) != json::kNoNode;
}

// The member `chunk` of a buffer: an index of a BIN chunk, over all chunks. An index of a wrong
// form is reported by the walk.
void check_chunk(const Resource& resource) {
  const container::Container& glb = resource.context.container;
  const json::Document& document = resource.context.document;
  const auto index = document.unsigned_integer(
      model::chunk_member(document, resource.object, resource.context.version));
  const auto find = [&](std::string message, std::optional<Severity> severity = {}) {
    resource.find(Code::BUFFER_CHUNK_INVALID, "chunk", std::move(message), {}, severity);
  };
  if (!index) return;
  if (document.holds(resource.object, "uri")) {
    return find("The buffer has a uri and a chunk; its data is that of the uri.",
                Severity::warning);
  }
  if (glb.format != container::Format::glb) {
    return find(fmt::format("The buffer is chunk {}, but a .gltf file has no chunks.", *index));
  }
  if (*index >= glb.chunks.size()) {
    if (glb.cut_short) return;
    return find(
        fmt::format("The buffer is chunk {}, but the GLB has only {}.", *index, glb.chunks.size()));
  }
  if (glb.chunks[*index].type != container::kChunkBin) {
    return find(fmt::format("The buffer is chunk {}, which is not a BIN chunk.", *index));
  }
  if (glb.glb_version == 3U) return;
  find("The buffer names its chunk, which readers expect in GLBs of version 3 only.",
       Severity::warning);
}

std::uint64_t padded(std::uint64_t length) { return length + (4 - length % 4) % 4; }

// By index of buffers: whether each byte of its chunk after its length is one of no buffer.
std::vector<bool> ends_last(const Context& context) {
  const auto& buffers = context.asset.elements(model::RootArray::buffers);
  const auto length_of = [&](std::size_t i) {
    return model::unsigned_member(context.document, buffers[i], "byteLength").value_or(0);
  };
  const auto chunk = [&](std::size_t i) {
    if (buffers[i] == json::kNoNode) return std::optional<std::uint64_t>();
    return model::chunk_number(context.document, buffers[i], i, context.version);
  };
  std::map<std::uint64_t, std::uint64_t> longest;  // by number of the chunk
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (const auto number = chunk(i)) {
      std::uint64_t& length = longest[*number];
      length = std::max(length, length_of(i));
    }
  }
  std::vector<bool> last(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto number = chunk(i);
    last[i] = number && length_of(i) == longest[*number];
  }
  return last;
}

// Padding of the chunk follows the bytes of the buffer.
void check_bin_padding(const Resource& resource, std::string_view chunk, std::uint64_t declared) {
  if (chunk.size() <= declared || chunk.size() > padded(declared)) return;
  const std::size_t at = chunk.find_first_not_of('\0', static_cast<std::size_t>(declared));
  if (at == std::string_view::npos) return;
  resource.find(Code::GLB_BIN_PADDING, "",
                fmt::format("The BIN chunk is padded with 0x{:02x}; it must be padded with zeros.",
                            static_cast<unsigned char>(chunk[at])));
}

// A buffer of a GLB without a uri is the BIN chunk that it names, or the one of buffer 0.
std::optional<Bytes> glb_bytes(const Resource& resource, std::size_t index, bool ends_last,
                               std::uint64_t declared) {
  const container::Container& glb = resource.context.container;
  resource.info.storage = "glb";
  const auto bin = model::chunk_of(glb, resource.context.document, resource.object, index,
                                   resource.context.version);
  if (!bin) {
    const bool encoded = glb.chunks.size() > 1 && glb.chunks[1].encoding != 0;  // reported there
    if (!glb.cut_short && !encoded && !names_chunk(resource)) {
      resource.find(Code::BUFFER_MISSING_GLB_DATA, "",
                    "The buffer has no uri and the GLB has no BIN chunk.");
    }
    return std::nullopt;
  }
  if (bin->length > padded(declared)) {
    resource.find(Code::BUFFER_GLB_CHUNK_TOO_BIG, "",
                  fmt::format("The BIN chunk is {} bytes longer than the padded buffer.",
                              bin->length - padded(declared)));
  }
  Bytes chunk =
      glb.bytes.part(static_cast<std::size_t>(bin->offset), static_cast<std::size_t>(bin->length));
  if (ends_last) check_bin_padding(resource, chunk.text(), declared);
  return chunk;
}

// By index of buffers: whether extensions store the bytes of all its views elsewhere, as those of
// compressed data do.
std::vector<bool> stored_elsewhere(const Context& context) {
  const auto& views = context.asset.elements(model::RootArray::buffer_views);
  const std::size_t count = context.asset.elements(model::RootArray::buffers).size();
  std::vector<bool> extended(count);
  std::vector<bool> plain(count);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto buffer = context.views.buffer_views[i].buffer;
    if (views[i] == json::kNoNode || !buffer || *buffer >= count) continue;
    const bool has =
        model::object_member(context.document, views[i], "extensions") != json::kNoNode;
    (has ? extended : plain)[*buffer] = true;
  }
  for (std::size_t i = 0; i < count; ++i) extended[i] = extended[i] && !plain[i];
  return extended;
}

// An extension of the buffer may declare where its data is, or that it has none.
void report_missing_data(const Resource& resource, std::size_t index) {
  const json::Document& document = resource.context.document;
  if (model::object_member(document, resource.object, "extensions") != json::kNoNode) return;
  const bool text = resource.context.container.format != container::Format::glb;
  if (!text && resource.context.version > schema::kVersion2) {
    return resource.find(Code::BUFFER_WITHOUT_DATA, "",
                         "The buffer has neither a uri nor a chunk; only the first buffer of a GLB "
                         "can be a BIN chunk without naming it.",
                         "add the index of its BIN chunk as chunk, or the name of a file as uri");
  }
  resource.find(Code::BUFFER_WITHOUT_DATA, "",
                text && index == 0
                    ? "The buffer has no uri; a .gltf file has no BIN chunk that could be its data."
                    : "The buffer has no uri; only the first buffer of a GLB can be the BIN chunk.",
                "write the data to a file and add its name as uri");
}

std::optional<Bytes> long_enough(const Resource& resource, Bytes bytes, std::uint64_t declared,
                                 bool cut_short) {
  resource.info.byte_length = bytes.size();
  if (bytes.size() >= declared) return bytes;
  if (cut_short) return std::nullopt;  // reported for the container
  const json::NodeId member = resource.context.document.find(resource.object, "byteLength");
  Finding finding(Code::BUFFER_BYTE_LENGTH_MISMATCH);
  finding.message =
      fmt::format("byteLength is {}, but the data has only {} bytes.", declared, bytes.size());
  finding.span = resource.context.document.span(member);
  if (const auto found = container::name_content(bytes.text()).name;
      !found.empty() && resource.info.storage == "external") {
    finding.help = fmt::format("replace the file: it is {}", found);
  }
  resource.sink.report(resource.path, std::move(finding));
  const bool kept =
      resource.context.deviations.short_data_uris_are_kept && resource.info.storage == "data-uri";
  return kept ? std::optional(std::move(bytes)) : std::nullopt;
}

// The content of a data URI is kept even if the buffer declares no length, but not listed.
std::optional<Bytes> undeclared_bytes(const Resource& resource) {
  const json::Document& document = resource.context.document;
  const std::string uri = model::string_member(document, resource.object, "uri");
  if (!resource.context.deviations.short_data_uris_are_kept ||
      container::classify_uri(uri).kind != container::UriKind::data) {
    return std::nullopt;
  }
  ResourceInfo unlisted = resource.info;
  return fetch_uri(
      {resource.context, resource.sink, resource.report, resource.path, resource.object, unlisted});
}

/// What buffers say about each other.
struct BufferFacts {
  explicit BufferFacts(const Context& context)
      : elsewhere(stored_elsewhere(context)), last(ends_last(context)) {}
  std::vector<bool> elsewhere;
  std::vector<bool> last;
};

std::optional<Bytes> load_buffer(const Resource& resource, std::size_t index,
                                 const BufferFacts& facts) {
  const json::Document& document = resource.context.document;
  resource.info.mime_type = "application/gltf-buffer";
  const bool has_uri = document.holds(resource.object, "uri");
  const container::Container& container = resource.context.container;
  const bool named = names_chunk(resource);
  const bool glb = !has_uri && (index == 0 || named) && container.format == container::Format::glb;
  if (named) check_chunk(resource);
  if (!has_uri && !glb && !named && !facts.elsewhere[index]) {
    report_missing_data(resource, index);
  }
  const auto declared = model::unsigned_member(document, resource.object, "byteLength");
  if (!declared || *declared == 0) return undeclared_bytes(resource);
  if (glb && !named && !container.bin && is_fallback(resource.context, resource.object)) {
    return std::nullopt;
  }
  auto bytes = glb ? glb_bytes(resource, index, facts.last[index], *declared) : fetch_uri(resource);
  if (!bytes) return std::nullopt;
  return long_enough(resource, *std::move(bytes), *declared, glb && container.cut_short);
}

void load_buffers(const Context& context, Sink& sink, FileReport& report, Resources& resources) {
  const Path root;
  const Path array(root, "buffers");
  const auto& objects = context.asset.elements(model::RootArray::buffers);
  resources.data.buffers.resize(objects.size());
  const BufferFacts facts(context);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] == json::kNoNode) continue;
    const Path path(array, static_cast<std::uint64_t>(i));
    ResourceInfo info;
    info.pointer = path.pointer();
    resources.data.buffers[i] =
        load_buffer({context, sink, report, path, objects[i], info}, i, facts);
    resources.listed.push_back(std::move(info));
  }
}

// The content of a bufferView is truncated with its buffer.
bool is_truncated_file(const Context& context, json::NodeId object, bool buffer,
                       const std::optional<Bytes>& bytes) {
  if (!bytes || !container::is_truncated(*bytes)) return false;
  return buffer || context.document.find(object, "uri") != json::kNoNode;
}

void report_truncated(const Context& context, model::RootArray array, std::size_t index,
                      Sink& sink) {
  report_element(
      sink, context, array, index, Code::IO_ERROR,
      "The file became shorter while it was read; the missing bytes are treated as zeros.");
}

// --- Fixes ---

// The BIN chunk of a buffer; nothing if it has none.
std::optional<container::Chunk> chunk_for(Fixing& fixing, json::NodeId buffer) {
  const auto index = fixing.index(model::RootArray::buffers, buffer);
  if (!index) return std::nullopt;
  return model::chunk_of(fixing.opened().container(), fixing.document(), buffer, *index,
                         schema::stated_version(fixing.document()));
}

// The bytes of a buffer, regardless of its declared length; nothing if there are none.
std::optional<Bytes> bytes_of(Fixing& fixing, json::NodeId buffer) {
  const std::string uri = model::string_member(fixing.document(), buffer, "uri");
  if (!uri.empty()) {
    auto bytes = container::fetch(fixing.opened().resolver(), uri);
    return bytes ? std::optional(*std::move(bytes)) : std::nullopt;
  }
  const auto chunk = chunk_for(fixing, buffer);
  if (!chunk) return std::nullopt;
  return fixing.opened().container().bytes.part(chunk->offset, chunk->length);
}

/// The bytes that buffer views need of each buffer.
struct NeededBytes {
  explicit NeededBytes(Fixing& fixing) : of(fixing.elements().count(model::RootArray::buffers)) {
    for (const model::BufferView& view : fixing.views().buffer_views) {
      if (!view.buffer) continue;
      std::uint64_t& needed = of[*view.buffer];
      needed = std::max(needed,
                        saturating_add(view.byte_offset.value_or(0), view.byte_length.value_or(0)));
    }
  }
  std::vector<std::uint64_t> of;
};

// A shorter buffer is enough if no buffer view needs more.
bool declare_actual_length(Fixing& fixing, const Subject& length) {
  const auto buffer = fixing.index(model::RootArray::buffers, length.owner);
  const auto bytes = buffer ? bytes_of(fixing, length.owner) : std::nullopt;
  if (!bytes || bytes->empty()) return false;
  if (fixing.table<NeededBytes>().of[*buffer] > bytes->size()) return false;
  return fixing.replace_scalar(length.value, std::to_string(bytes->size()));
}

bool declare_whole_chunk(Fixing& fixing, const Subject& buffer) {
  const json::NodeId length = fixing.document().find(buffer.value, "byteLength");
  const auto chunk = chunk_for(fixing, buffer.value);
  return length != json::kNoNode && chunk &&
         fixing.replace_scalar(length, std::to_string(chunk->length));
}

bool pad_with_zeros(Fixing& fixing, const Subject& buffer) {
  const auto declared = model::unsigned_member(fixing.document(), buffer.value, "byteLength");
  const auto index = fixing.index(model::RootArray::buffers, buffer.value);
  std::string* const chunk = index ? fixing.content(static_cast<std::uint32_t>(*index)) : nullptr;
  if (!declared || chunk == nullptr || chunk->size() < *declared) return false;
  std::fill(chunk->begin() + static_cast<std::ptrdiff_t>(*declared), chunk->end(), '\0');
  return true;
}

constexpr FixEntry kBufferFixes[] = {{Code::BUFFER_BYTE_LENGTH_MISMATCH, declare_actual_length},
                                     {Code::BUFFER_GLB_CHUNK_TOO_BIG, declare_whole_chunk},
                                     {Code::GLB_BIN_PADDING, pad_with_zeros}};

}  // namespace

const RuleGroup& buffers_rules() {
  static constexpr RuleGroup group{.fixes = kBufferFixes};
  return group;
}

void check_truncated(const Context& context, const model::ResourceData& resources, Sink& sink) {
  const auto& buffers = context.asset.elements(model::RootArray::buffers);
  for (std::size_t i = 0; i < resources.buffers.size(); ++i) {
    if (is_truncated_file(context, buffers[i], true, resources.buffers[i])) {
      report_truncated(context, model::RootArray::buffers, i, sink);
    }
  }
  const auto& images = context.asset.elements(model::RootArray::images);
  for (std::size_t i = 0; i < resources.images.size(); ++i) {
    if (is_truncated_file(context, images[i], false, resources.images[i].bytes)) {
      report_truncated(context, model::RootArray::images, i, sink);
    }
  }
}

Resources load_resources(const Context& context, Sink& sink, FileReport& report) {
  Resources resources;
  resources.data.origin = context.files.resolver().origin();
  load_buffers(context, sink, report, resources);
  load_images(context, sink, report, resources);
  load_files(context, sink, report, resources);
  return resources;
}

}  // namespace gltfx::validate
