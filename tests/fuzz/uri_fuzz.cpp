// SPDX-License-Identifier: Apache-2.0
// Whatever a URI says, its path is relative text without NUL and ".." only in front, and printing
// is stable: the normalized form is a plain URI that normalizes to itself.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "container/uri.hpp"

namespace {

using namespace gltfx::container;

void require(bool promise) {
  if (!promise) std::abort();
}

void check_path(const std::string& path) {
  require(path.find('\0') == std::string::npos);
  bool in_front = true;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string segment = path.substr(begin, end - begin);
    require(segment != ".." || in_front);
    in_front = in_front && segment == "..";
    begin = end + 1;
  }
}

void check_normalized(const Uri& uri) {
  for (const char c : uri.normalized) require(c > ' ' && c < '\x7f' && c != '\\');
  const Uri again = classify_uri(uri.normalized);
  require(again.kind == uri.kind);
  require(again.normalized == uri.normalized);
  // Where a path leads out only for some readers, it is theirs.
  const bool leads_out = uri.path.starts_with("..") || uri.path.starts_with('/');
  require(leads_out || again.path == uri.path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Uri uri = classify_uri({reinterpret_cast<const char*>(data), size});
  check_path(uri.path);
  require((uri.kind == UriKind::invalid) == !uri.problem.empty());
  if (uri.kind == UriKind::relative_path) check_normalized(uri);
  return 0;
}
