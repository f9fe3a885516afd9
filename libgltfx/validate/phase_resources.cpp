// SPDX-License-Identifier: Apache-2.0
// What buffers and images refer to. Files are opened only inside the root and only mapped; their
// content is the business of later phases.
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/resolve_fault.hpp"
#include "container/uri.hpp"
#include "validate/phases.hpp"

namespace gltfx::validate {
namespace {

using container::ResolveFault;

struct Resource {
  const Context& context;
  Sink& sink;
  FileReport& report;
  const Path& path;  // of the buffer or image
  json::NodeId object;

  void find(std::string_view code, std::string_view member, std::string message,
            std::string help = {}) const {
    Finding finding;
    finding.code = code;
    finding.message = std::move(message);
    finding.help = std::move(help);
    finding.span = member_span(context.document, object, member);
    if (member.empty()) {
      sink.report(path, std::move(finding));
    } else {
      sink.report(Path(path, member), std::move(finding));
    }
  }
};

std::string_view code_of(ResolveFault fault) {
  switch (fault) {
    case ResolveFault::outside_root:
      return "URI_OUTSIDE_ROOT";
    case ResolveFault::not_regular:
      return "RESOURCE_NOT_A_FILE";
    case ResolveFault::no_root:
      return "RESOURCE_NOT_CHECKED";
    default:
      return "IO_ERROR";
  }
}

void report_fault(const Resource& resource, const container::Resolved& resolved,
                  const container::Uri& uri) {
  resource.find(code_of(resolved.fault), "uri",
                container::describe(resolved.fault, uri.normalized, resolved.problem),
                std::string(container::remedy(resolved.fault)));
}

void report_lfs_pointer(const Resource& resource, const container::Uri& uri) {
  ++resource.report.unverified;
  resource.find("GIT_LFS_POINTER", "uri",
                fmt::format("{} is a Git-LFS pointer; its content is not here.",
                            gltfx::quoted(uri.normalized)),
                "fetch it with 'git lfs pull'");
}

// The bytes behind a URI member; an empty `size` when there is nothing to measure.
std::optional<std::uint64_t> resource_size(const Resource& resource, const std::string& text) {
  const container::Uri uri = container::classify_uri(text);
  if (uri.kind == container::UriKind::data) {
    const auto split = container::split_data_uri(text);
    if (!split) return std::nullopt;
    const auto bytes = container::decode_payload(*split);
    return bytes ? std::optional<std::uint64_t>(bytes->size()) : std::nullopt;
  }
  if (uri.kind != container::UriKind::relative_path) return std::nullopt;
  const container::Resolved resolved = resource.context.resolver.open(uri.path);
  if (resolved.fault != ResolveFault::none) {
    report_fault(resource, resolved, uri);
    return std::nullopt;
  }
  if (resolved.git_lfs_pointer) {
    report_lfs_pointer(resource, uri);
    return std::nullopt;
  }
  return resolved.bytes.size();
}

void check_length(const Resource& resource, std::uint64_t size) {
  const json::Document& document = resource.context.document;
  const json::NodeId member = document.find(resource.object, "byteLength");
  if (member == json::kNoNode) return;
  const auto declared = document.unsigned_integer(member);
  if (!declared || size >= *declared) return;
  Finding finding;
  finding.code = "BUFFER_BYTE_LENGTH_MISMATCH";
  finding.message =
      fmt::format("The buffer declares {} bytes, but only {} are there.", *declared, size);
  finding.span = document.span(member);
  resource.sink.report(resource.path, std::move(finding));
}

// Buffer 0 of a GLB without a uri is the BIN chunk.
void check_glb_buffer(const Resource& resource) {
  const auto& bin = resource.context.container.bin;
  if (!bin) {
    resource.find("BUFFER_MISSING_GLB_DATA", "",
                  "The buffer has no uri, so it is the BIN chunk, but the file has none.");
    return;
  }
  check_length(resource, bin->length);
  const json::Document& document = resource.context.document;
  const json::NodeId member = document.find(resource.object, "byteLength");
  const auto declared = member == json::kNoNode ? std::nullopt : document.unsigned_integer(member);
  if (!declared || *declared == 0 || bin->length <= *declared) return;
  const std::uint64_t padding = bin->length - *declared;
  if (padding <= (4 - *declared % 4) % 4) return;
  resource.find("BUFFER_GLB_CHUNK_TOO_BIG", "",
                fmt::format("The BIN chunk has {} bytes more than the buffer and its padding.",
                            padding - (4 - *declared % 4) % 4));
}

void check_buffer(const Resource& resource, std::size_t index) {
  const json::Document& document = resource.context.document;
  const json::NodeId uri = document.find(resource.object, "uri");
  if (uri == json::kNoNode) {
    const bool glb = resource.context.container.format == container::Format::glb;
    if (glb && index == 0) check_glb_buffer(resource);
    return;
  }
  if (!document.is_string(uri)) return;
  const auto size = resource_size(resource, document.string(uri));
  if (size) check_length(resource, *size);
}

void check_image(const Resource& resource) {
  const json::Document& document = resource.context.document;
  const json::NodeId uri = document.find(resource.object, "uri");
  if (uri != json::kNoNode && document.is_string(uri)) {
    resource_size(resource, document.string(uri));
  }
}

}  // namespace

void check_resources(const Context& context, Sink& sink, FileReport& report) {
  const Path root;
  const Path buffers(root, "buffers");
  const auto& buffer_objects = context.asset.elements(model::RootArray::buffers);
  for (std::size_t i = 0; i < buffer_objects.size(); ++i) {
    if (buffer_objects[i] == json::kNoNode) continue;
    const Path path(buffers, i);
    check_buffer({context, sink, report, path, buffer_objects[i]}, i);
  }
  const Path images(root, "images");
  const auto& image_objects = context.asset.elements(model::RootArray::images);
  for (std::size_t i = 0; i < image_objects.size(); ++i) {
    if (image_objects[i] == json::kNoNode) continue;
    const Path path(images, i);
    check_image({context, sink, report, path, image_objects[i]});
  }
}

}  // namespace gltfx::validate
