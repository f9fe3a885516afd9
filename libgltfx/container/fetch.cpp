// SPDX-License-Identifier: Apache-2.0
#include "container/fetch.hpp"

#include <utility>

#include <fmt/format.h>

#include "container/uri.hpp"

namespace gltfx::container {
namespace {

Result<Bytes> decode(std::string_view uri) {
  const auto split = split_data_uri(uri);
  if (!split) return split.error();
  auto decoded = decode_payload(*split);
  if (!decoded) return decoded.error();
  return Bytes::from_string(*std::move(decoded));
}

}  // namespace

Result<Bytes> fetch(const Resolver& resolver, std::string_view uri, ResolveError* error) {
  const Uri reference = classify_uri(uri);
  if (reference.kind == UriKind::data) return decode(uri);
  if (reference.kind != UriKind::relative_path) return Error{"its URI is not a relative path"};
  Resolved file = resolver.open(reference.path);
  if (error != nullptr) *error = file.error;
  if (file.error != ResolveError::none) {
    return Error{describe(file.error, reference.normalized, file.problem)};
  }
  if (file.git_lfs_pointer) {
    return Error{fmt::format("{} is a Git LFS pointer; run 'git lfs pull'", reference.normalized)};
  }
  return std::move(file.bytes);
}

}  // namespace gltfx::container
