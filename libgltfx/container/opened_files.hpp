// SPDX-License-Identifier: Apache-2.0
/// Files of an asset, each opened once however many objects name it.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "container/resolver.hpp"
#include "container/uri.hpp"

namespace gltfx::container {

/// Keeps what it opened, and what it failed to open. The resolver must live as long. Not for
/// several threads at once.
class OpenedFiles {
 public:
  explicit OpenedFiles(const Resolver& resolver) : resolver_(resolver) {}

  const Resolver& resolver() const { return resolver_; }
  /// Resolver::open(const Uri&), asked once for each path.
  const Resolved& open(const Uri& uri);

 private:
  const Resolver& resolver_;
  std::map<std::string, Resolved, std::less<>> files_;  ///< by path, or by URI where any is read
};

/// Decodes a data URI or opens the file of a relative path inside of the resolver's root. The Error
/// is one sentence, with or without its full stop; `error` gets what the resolver says of a file.
Result<Bytes> fetch(OpenedFiles& files, std::string_view uri, ResolveError* error = nullptr);
/// The same for a single file.
Result<Bytes> fetch(const Resolver& resolver, std::string_view uri, ResolveError* error = nullptr);

}  // namespace gltfx::container
