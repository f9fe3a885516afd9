// SPDX-License-Identifier: Apache-2.0
#include "change/backup.hpp"

#include <filesystem>
#include <set>
#include <system_error>

#include <fcntl.h>

#include "base/text.hpp"
#include "change/companions.hpp"
#include "container/container.hpp"
#include "container/file.hpp"
#include "container/resolver.hpp"
#include "json/parse.hpp"

namespace gltfx::change {
namespace {

namespace fs = std::filesystem;

// Moves the copy of --backup to the asset; the reason on failure. Links are followed to the asset,
// not to the copy.
std::optional<std::string> restore_file(const std::string& path) {
  std::error_code error;
  const fs::path copy = backup_of(path);
  const fs::file_status found = fs::symlink_status(copy, error);
  if (!fs::exists(found)) return "there is no " + quoted(copy.native(), 200);
  if (!fs::is_regular_file(found)) return quoted(copy.native(), 200) + " is not a regular file";
  const fs::path target = fs::canonical(path, error);
  if (!error) fs::rename(copy, target, error);
  if (error) return "cannot be restored: " + error.message();
  return std::nullopt;
}

// Files below its folder that the asset refers to and that have copies.
std::set<std::string> files_with_copies(const std::string& path) {
  std::set<std::string> files;
  const auto container =
      container::open_file(container::open_regular(AT_FDCWD, path.c_str(), O_NOFOLLOW), path);
  if (!container || !container->json) return files;
  const json::Parsed parsed = json::parse(container->json);
  if (parsed.document.empty()) return files;
  const fs::path named = fs::path(path).parent_path();
  const fs::path folder = named.empty() ? fs::path(".") : named;
  const container::Resolver resolver(folder, folder);
  for (const std::string& file : referred_paths(parsed.document)) {
    std::uint64_t size = 0;
    const std::string copy = backup_of(file);
    if (resolver.stat(copy, size) != container::ResolveError::none) continue;
    // A link that leads elsewhere: its target was never changed.
    if (resolver.stat(file, size) == container::ResolveError::outside_root) continue;
    files.insert((folder / file).native());
  }
  return files;
}

}  // namespace

std::string backup_of(const std::string& path) { return path + ".bak"; }

// The asset comes last: until then it matches the new files.
std::optional<std::string> restore(const std::string& path) {
  for (const std::string& file : files_with_copies(backup_of(path))) {
    if (auto why = restore_file(file)) return why;
  }
  return restore_file(path);
}

}  // namespace gltfx::change
