// SPDX-License-Identifier: Apache-2.0
/// Opens what a buffer or image names, and says why it cannot.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <string>
#include <string_view>

#include "container/bytes.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// A buffer or image that is being opened. Lives on the stack of the loop over all of them.
struct Resource {
  const Context& context;
  Sink& sink;
  FileReport& report;  ///< its `unverified` is counted up
  const Path& path;    ///< of the buffer or image
  json::NodeId object = json::kNoNode;
  ResourceInfo& info;  ///< storage and uri are filled in

  /// A finding on the object, or on its member where one is named.
  void find(std::string_view code, std::string_view member, std::string message,
            std::string help = {}, std::optional<Severity> severity = {}) const;
};

/// The bytes that the member `uri` names: mapped, copied or decoded. Nothing when there is no such
/// member, it is malformed, or the file cannot be had, which is reported here.
std::optional<container::Bytes> fetch_uri(const Resource& resource);

}  // namespace gltfx::validate
