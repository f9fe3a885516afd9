// SPDX-License-Identifier: Apache-2.0
/// The data: URIs of a document, each decoded once.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "base/result.hpp"
#include "container/bytes.hpp"
#include "container/uri.hpp"
#include "json/document.hpp"

namespace gltfx::validate {

/// A data URI whose head could be read.
struct DataUriContent {
  std::string media_type;            ///< lower case
  Result<container::Bytes> decoded;  ///< bytes of the payload
};

/// Keeps decoded data until it is destroyed. Not thread-safe.
class DataUris {
 public:
  explicit DataUris(container::UriReading reading) : reading_(reading) {}

  /// The content of the string at `value`. Decodes it on the first call for that value.
  const Result<DataUriContent>& get(json::NodeId value, std::string_view text);

 private:
  container::UriReading reading_;
  std::unordered_map<json::NodeId, Result<DataUriContent>> known_;
};

}  // namespace gltfx::validate
