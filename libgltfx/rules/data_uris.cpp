// SPDX-License-Identifier: Apache-2.0
#include "rules/data_uris.hpp"

#include <utility>
namespace gltfx::validate {
namespace {

Result<container::Bytes> decode(const container::DataUri& uri, container::UriReading reading) {
  auto decoded = container::decode_payload(uri, reading);
  if (!decoded) return decoded.error();
  return container::Bytes::from_string(*std::move(decoded));
}

Result<DataUriContent> read(std::string_view text, container::UriReading reading) {
  const auto uri = container::split_data_uri(text);
  if (!uri) return uri.error();
  return DataUriContent{uri->media_type, decode(*uri, reading)};
}

}  // namespace

const Result<DataUriContent>& DataUris::get(json::NodeId value, std::string_view text) {
  const auto found = known_.find(value);
  if (found != known_.end()) return found->second;
  return known_.emplace(value, read(text, reading_)).first->second;
}

}  // namespace gltfx::validate
