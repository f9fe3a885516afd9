// SPDX-License-Identifier: Apache-2.0
// Files are only opened inside the root, and only mapped.
#include "rules/resource_fetch.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "container/resolve_error.hpp"
#include "container/uri.hpp"
#include "image/header.hpp"
#include "rules/core/missing_files.hpp"
#include "rules/core/uri_form.hpp"

namespace gltfx::validate {
namespace {

using container::ResolveError;

Code code_of(ResolveError error) {
  switch (error) {
    case ResolveError::outside_root:
      return Code::URI_OUTSIDE_ROOT;
    case ResolveError::not_regular:
      return Code::RESOURCE_NOT_A_FILE;
    case ResolveError::no_root:
      return Code::RESOURCE_NOT_CHECKED;
    default:
      return Code::IO_ERROR;
  }
}

void report_lfs_pointer(const Resource& resource, const container::Uri& uri) {
  ++resource.report.unverified;
  resource.find(
      Code::GIT_LFS_POINTER, resource.uri_member,
      fmt::format("{} is a Git LFS pointer, not the file itself.", gltfx::quoted(uri.normalized)),
      "run 'git lfs pull'");
}

std::optional<container::Bytes> open_file(const Resource& resource, const container::Uri& uri) {
  resource.info.storage = "external";
  resource.info.uri = uri.normalized;
  const container::Resolved& resolved = resource.context.files.open(uri);
  if (resolved.error != ResolveError::none) {
    const bool same = resource.context.deviations.refused_files_have_no_code;
    resource.find(same ? Code::IO_ERROR : code_of(resolved.error), resource.uri_member,
                  container::describe(resolved.error, uri.normalized, resolved.problem),
                  missing_file_help(resource.context, resolved.error, uri.path));
    return std::nullopt;
  }
  if (resolved.git_lfs_pointer && !resource.context.deviations.lfs_pointers_are_data) {
    report_lfs_pointer(resource, uri);
    return std::nullopt;
  }
  return resolved.bytes;
}

// Whether the data of a URI is kept: a wrong media type is already reported.
bool acceptable(const Resource& resource, const std::string& media_type,
                const container::Bytes& bytes) {
  if (!resource.context.deviations.mistyped_data_uris_are_dropped) return true;
  if (resource.info.mime_type == "application/gltf-buffer") {
    return media_type == "application/octet-stream" || media_type == "application/gltf-buffer";
  }
  const image::Sniffed sniffed = image::sniff(bytes.view());
  return sniffed.known && media_type == image::media_type(sniffed.format);
}

std::optional<container::Bytes> data_of(const Resource& resource, json::NodeId member,
                                        std::string_view text) {
  const auto& content = resource.context.data_uris->get(member, text);
  if (!content || !content->decoded) return std::nullopt;
  if (!acceptable(resource, content->media_type, *content->decoded)) return std::nullopt;
  resource.info.storage = "data-uri";
  return *content->decoded;
}

}  // namespace

void Resource::find(Code code, std::string_view where, std::string message, std::string help,
                    std::optional<Severity> severity) const {
  Finding finding(code);
  finding.message = std::move(message);
  finding.help = std::move(help);
  finding.severity = severity;
  finding.span = member_span(context.document, object, where);
  if (where.empty()) {
    sink.report(path, std::move(finding));
  } else {
    sink.report(Path(path, where), std::move(finding));
  }
}

void check_resource_uri(const Resource& resource) {
  const json::NodeId value = resource.context.document.find(resource.object, resource.uri_member);
  if (value == json::kNoNode || !resource.context.document.is_string(value)) return;
  check_uri_form(resource.context, resource.sink, value, Path(resource.path, resource.uri_member));
}

std::optional<container::Bytes> fetch_uri(const Resource& resource) {
  const json::Document& document = resource.context.document;
  const json::NodeId member = document.find(resource.object, resource.uri_member);
  if (member == json::kNoNode || !document.is_string(member)) return std::nullopt;
  std::string buffer;
  const std::string_view text = document.string(member, buffer);
  if (const auto* const aliased = resource.context.files.resolver().aliased(text)) {
    resource.info.storage = "external";
    resource.info.uri = std::string(text);
    return *aliased;
  }
  const container::Uri uri = container::classify_uri(text, resource.context.uri_reading());
  if (uri.kind == container::UriKind::data) return data_of(resource, member, text);
  const bool non_relative = uri.kind == container::UriKind::non_relative;
  if (non_relative) {
    resource.info.storage = "external";
    resource.info.uri = uri.normalized;
  }
  const bool readable = non_relative ? resource.context.files.resolver().reads_any_uri()
                                     : uri.kind == container::UriKind::relative_path;
  return readable ? open_file(resource, uri) : std::nullopt;
}

std::optional<container::Bytes> fetch_uri_or_view(const Resource& resource,
                                                  const model::ResourceData& data) {
  const Context& context = resource.context;
  auto bytes = fetch_uri(resource);
  if (bytes || !resource.info.storage.empty()) return bytes;
  const auto view =
      context.asset.index(resource.object, "bufferView", model::RootArray::buffer_views);
  if (!view) return std::nullopt;
  resource.info.storage = "buffer-view";
  const model::BufferView& source = context.views.buffer_views[*view];
  return data.part(context.document, source, 0, source.byte_length.value_or(0));
}

}  // namespace gltfx::validate
