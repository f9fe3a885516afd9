// SPDX-License-Identifier: Apache-2.0
/// Opens the resource of a buffer, an image or another object, and reports failures.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <string>
#include <string_view>

#include "container/bytes.hpp"
#include "model/resource_data.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// A buffer or image that is being opened. Lives on the stack of the loop over all of them.
struct Resource {
  const Context& context;
  Sink& sink;
  FileReport& report;  ///< its `unverified` is incremented
  const Path& path;    ///< of the buffer or image
  json::NodeId object = json::kNoNode;
  ResourceInfo& info;                   ///< storage and uri are set
  std::string_view uri_member = "uri";  ///< member of the object with the name of the file

  /// Reports a finding on the object, or on its member if one is named.
  void find(Code code, std::string_view where, std::string message, std::string help = {},
            std::optional<Severity> severity = {}) const;
};

/// Reports the form of the URI of a resource that is neither a buffer nor an image, whose URIs are
/// checked with their other members.
void check_resource_uri(const Resource& resource);

/// The bytes of `resource.uri_member`: mapped, copied or decoded. Nothing if there is no such
/// member, it is malformed, or the file cannot be read, which is reported here.
std::optional<container::Bytes> fetch_uri(const Resource& resource);

/// The bytes of the URI or of the member `bufferView`. The buffers of `data` must be loaded.
std::optional<container::Bytes> fetch_uri_or_view(const Resource& resource,
                                                  const model::ResourceData& data);

}  // namespace gltfx::validate
