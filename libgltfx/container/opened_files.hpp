// SPDX-License-Identifier: Apache-2.0
/// Files of an asset, each opened once, independent of the number of references.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "container/resolver.hpp"
#include "container/uri.hpp"

namespace gltfx::container {

/// Caches opened files and failures. The resolver must outlive it. Not thread-safe.
class OpenedFiles {
 public:
  explicit OpenedFiles(const Resolver& resolver) : resolver_(resolver) {}

  const Resolver& resolver() const { return resolver_; }
  /// Resolver::open(const Uri&), called once for each path.
  const Resolved& open(const Uri& uri);

 private:
  const Resolver& resolver_;
  std::map<std::string, Resolved, std::less<>>
      files_;  ///< by path, or by URI if the resolver reads any URI
};

/// Decodes a data URI or opens the file of a relative path inside of the resolver's root. The Error
/// is one sentence, with or without its full stop; `error` gets the resolver's error for a file.
Result<Bytes> fetch(OpenedFiles& files, std::string_view uri, ResolveError* error = nullptr);
/// The same for a single file.
Result<Bytes> fetch(const Resolver& resolver, std::string_view uri, ResolveError* error = nullptr);

}  // namespace gltfx::container
