// SPDX-License-Identifier: Apache-2.0
/// Opens what a buffer, an image or another object names, and says why it cannot.
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
  FileReport& report;  ///< its `unverified` is counted up
  const Path& path;    ///< of the buffer or image
  json::NodeId object = json::kNoNode;
  ResourceInfo& info;                   ///< storage and uri are filled in
  std::string_view uri_member = "uri";  ///< of the object, that names the file

  /// A finding on the object, or on its member where one is named.
  void find(Code code, std::string_view where, std::string message, std::string help = {},
            std::optional<Severity> severity = {}) const;
};

/// Reports the form of the URI of a resource that is neither a buffer nor an image: theirs is
/// checked with their other members.
void check_resource_uri(const Resource& resource);

/// The bytes that `resource.uri_member` names: mapped, copied or decoded. Nothing when there is no
/// such member, it is malformed, or the file cannot be had, which is reported here.
std::optional<container::Bytes> fetch_uri(const Resource& resource);

/// The same, or what the member `bufferView` names. The buffers of `data` have been loaded.
std::optional<container::Bytes> fetch_uri_or_view(const Resource& resource,
                                                  const model::ResourceData& data);

}  // namespace gltfx::validate
