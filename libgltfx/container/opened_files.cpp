// SPDX-License-Identifier: Apache-2.0
#include "container/opened_files.hpp"

#include <utility>

#include <fmt/format.h>

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

const Resolved& OpenedFiles::open(const Uri& uri) {
  const std::string& name = resolver_.reads_any_uri() ? uri.normalized : uri.path;
  const auto known = files_.find(name);
  if (known != files_.end()) return known->second;
  return files_.emplace(name, resolver_.open(uri)).first->second;
}

Result<Bytes> fetch(OpenedFiles& files, std::string_view uri, ResolveError* error) {
  if (const Bytes* const aliased = files.resolver().aliased(uri)) return *aliased;
  const Uri reference = classify_uri(uri);
  if (reference.kind == UriKind::data) return decode(uri);
  if (reference.kind != UriKind::relative_path) return Error{"its URI is not a relative path"};
  const Resolved& file = files.open(reference);
  if (error != nullptr) *error = file.error;
  if (file.error != ResolveError::none) {
    return Error{describe(file.error, reference.normalized, file.problem)};
  }
  if (file.git_lfs_pointer) {
    return Error{fmt::format("{} is a Git LFS pointer; run 'git lfs pull'", reference.normalized)};
  }
  return file.bytes;
}

Result<Bytes> fetch(const Resolver& resolver, std::string_view uri, ResolveError* error) {
  OpenedFiles files(resolver);
  return fetch(files, uri, error);
}

}  // namespace gltfx::container
