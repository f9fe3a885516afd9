// SPDX-License-Identifier: Apache-2.0
#include "report/file_uri.hpp"

#include <filesystem>
#include <iterator>

#include <fmt/format.h>

namespace gltfx::report {
namespace {

namespace fs = std::filesystem;

bool is_unreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '.' || c == '_' || c == '~';
}

std::string percent_encoded(std::string_view path) {
  std::string out;
  for (const char c : path) {
    if (is_unreserved(c) || c == '/') {
      out += c;
    } else {
      fmt::format_to(std::back_inserter(out), "%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

bool leads_out(const fs::path& path) { return !path.empty() && *path.begin() == ".."; }

}  // namespace

std::string path_below(std::string_view path, std::string_view folder) {
  fs::path plain = fs::path(path).lexically_normal();
  if (!folder.empty() && (plain.is_absolute() || leads_out(plain))) {
    plain = (fs::path(folder) / plain).lexically_normal();
    const fs::path below = plain.lexically_relative(fs::path(folder).lexically_normal());
    if (!below.empty() && !leads_out(below)) plain = below;
  }
  return plain.native();
}

FileUri file_uri(std::string_view path, std::string_view folder) {
  const std::string plain = path_below(path, folder);
  if (plain.starts_with('/')) return {"file://" + percent_encoded(plain), false};
  return {percent_encoded(plain), true};
}

std::string folder_uri(std::string_view folder) {
  std::string uri = "file://" + percent_encoded(fs::path(folder).lexically_normal().native());
  if (uri.back() != '/') uri += '/';
  return uri;
}

}  // namespace gltfx::report
