// SPDX-License-Identifier: Apache-2.0
#include "container/resolver.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "base/directory.hpp"
#include "container/content.hpp"
#include "container/near_files.hpp"
#include "container/uri.hpp"

namespace gltfx::container {
namespace {

constexpr int kFolder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

std::filesystem::path or_current(const std::filesystem::path& path) {
  return path.empty() ? std::filesystem::path(".") : path;
}

/// `base` relative to `root`, both without links; empty when they are one folder.
std::string relative_base(const std::filesystem::path& root, const std::filesystem::path& base,
                          ResolveError& error) {
  if (root == base) return {};
  std::error_code failure;
  const auto real_root = std::filesystem::canonical(root, failure);
  const auto real_base = failure ? base : std::filesystem::canonical(base, failure);
  if (failure) {
    error = error_of_errno(failure.value());
    return {};
  }
  const std::filesystem::path relative = real_base.lexically_relative(real_root);
  if (relative == ".") return {};
  if (relative.empty() || *relative.begin() == "..") {
    error = ResolveError::outside_root;
    return {};
  }
  return relative.native() + '/';
}

/// The components of a path, without empty ones and ".".
std::vector<std::string_view> components(std::string_view path) {
  std::vector<std::string_view> names;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view name = path.substr(begin, end - begin);
    if (!name.empty() && name != ".") names.push_back(name);
    begin = end + 1;
  }
  return names;
}

// The rest of `path` after `folder`, if it begins with that and has no ".."; else empty.
std::string_view below(std::string_view folder, std::string_view path) {
  if (!path.starts_with(folder)) return {};
  path.remove_prefix(folder.size());
  if (!folder.empty() && !folder.ends_with('/')) {
    if (!path.starts_with('/')) return {};
    path.remove_prefix(1);
  }
  const auto names = components(path);
  const bool leaves = path.starts_with('/') || std::count(names.begin(), names.end(), "..") > 0;
  return leaves ? std::string_view() : path;
}

// The current path of an open folder; empty if the system does not report it.
std::string path_of(int folder) {
  std::error_code error;
  return std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", folder), error).native();
}

// `path` relative to the root. If it leaves the root and comes back through the root's own folders,
// that part is removed; the result is still opened beneath the root.
std::string from_root(int root, const std::string& base, std::string_view path) {
  std::string whole = base + std::string(path);
  std::size_t up = 0;
  const std::vector<std::string_view> names = components(path);
  while (up < names.size() && names[up] == "..") ++up;
  const std::size_t depth = components(base).size();
  if (up <= depth) return whole;
  const std::size_t above = up - depth;
  const std::string own_path = path_of(root);
  const std::vector<std::string_view> own = components(own_path);
  if (above > own.size() || above > names.size() - up) return whole;
  const auto back = names.begin() + static_cast<std::ptrdiff_t>(up);
  if (!std::equal(own.end() - static_cast<std::ptrdiff_t>(above), own.end(), back)) return whole;
  std::string inside;
  for (auto name = back + static_cast<std::ptrdiff_t>(above); name != names.end(); ++name) {
    inside.append(inside.empty() ? "" : "/").append(*name);
  }
  if (inside.empty()) return ".";
  return path.ends_with('/') ? inside + '/' : inside;
}

}  // namespace

File open_within(const std::filesystem::path& folder, const std::filesystem::path& path) {
  const UniqueFd root(::open(or_current(folder).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!root) return file_error(errno);
  File file;
  std::string name(below(folder.native(), path.native()));
  if (name.empty()) {
    name = relative_base(folder, or_current(path.parent_path()), file.error);
    if (file.error != ResolveError::none) return file;
    name += path.filename().native();
  }
  return open_beneath(root.get(), name, Confinement::automatic);
}

Resolver::Resolver(const std::filesystem::path& root, const std::filesystem::path& base,
                   Confinement confinement)
    : unusable_(ResolveError::none), confinement_(confinement) {
  const std::filesystem::path folder = or_current(root);
  UniqueFd fd(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!fd) {
    unusable_ = error_of_errno(errno);
    problem_ = "the root folder cannot be opened: " + errno_text(errno);
    return;
  }
  struct stat status {};
  if (::fstat(fd.get(), &status) == 0) origin_ = {status.st_dev, status.st_ino};
  root_ = std::make_shared<const UniqueFd>(std::move(fd));
  base_ = relative_base(folder, or_current(base), unusable_);
  if (unusable_ != ResolveError::none) problem_ = "the asset's folder is not inside the root";
}

ResolveError Resolver::open_at(std::string_view path, File& file) const {
  if (unusable_ != ResolveError::none) {
    file.error = unusable_;
    file.problem = problem_;
  } else if (path.starts_with('/')) {
    file = file_error(EXDEV);
  } else {
    file = open_beneath(root_->get(), from_root(root_->get(), base_, path), confinement_);
  }
  if (log_) log_->add({place_of(path), file.error});
  return file.error;
}

void LookupLog::add(Lookup lookup) {
  const std::lock_guard lock(mutex_);
  lookups_.push_back(std::move(lookup));
}

void Resolver::add(const std::string& path, Bytes bytes, const FileState& state) {
  added_.insert_or_assign(place_of(path), Added{std::move(bytes), state});
}

std::string Resolver::place_of(std::string_view path) const {
  if (folder_.empty()) return std::string(path);
  return classify_uri(uri_of_path(folder_ + std::string(path))).path;
}

Resolver Resolver::in_folder_of(std::string_view path) const {
  Resolver inside = without_aliases();
  const std::size_t slash = path.rfind('/');
  if (slash == std::string_view::npos) return inside;
  const std::string folder(path.substr(0, slash + 1));
  inside.folder_ = place_of(folder);
  if (!looks_on_disk() || root_ == nullptr) return inside;
  inside.base_ = from_root(root_->get(), base_, folder);
  const std::string base = classify_uri(uri_of_path(inside.base_)).path;
  if (!leads_out(base)) inside.base_ = base;
  return inside;
}

const Bytes* Resolver::aliased(std::string_view uri) const {
  const auto alias = aliases_.find(uri);
  return alias == aliases_.end() ? nullptr : &alias->second;
}

Resolver Resolver::without_aliases() const {
  Resolver other = *this;
  other.aliases_.clear();
  return other;
}

std::optional<Resolved> Resolver::find_added(std::string_view path) const {
  const auto added = added_.find(place_of(path));
  if (added == added_.end()) return std::nullopt;
  return Resolved{ResolveError::none, added->second.bytes, false, {}, added->second.state};
}

FileState Resolver::state(std::string_view path) const {
  if (const auto added = find_added(path)) return added->state;
  if (read_) return {};
  File file;
  return open_at(path, file) == ResolveError::none ? file.state : FileState();
}

Resolved Resolver::open(std::string_view path) const {
  if (auto added = find_added(path)) return *std::move(added);
  if (read_) {
    Uri uri = classify_uri(uri_of_path(path));
    uri.path = path;
    return read(uri);
  }
  File file;
  Resolved resolved;
  resolved.error = open_at(path, file);
  resolved.problem = std::move(file.problem);
  if (resolved.error != ResolveError::none) return resolved;
  Loaded loaded = load_file(file);
  resolved.error = loaded.error;
  resolved.problem = std::move(loaded.problem);
  resolved.bytes = std::move(loaded.bytes);
  resolved.state = file.state;
  resolved.git_lfs_pointer = is_git_lfs_pointer(resolved.bytes.text(), resolved.bytes.size());
  return resolved;
}

Resolved Resolver::open(const Uri& uri) const {
  const bool relative = !read_ || find_added(uri.path);
  return relative ? open(uri.path) : read(uri);
}

Resolved Resolver::read(const Uri& uri) const {
  Resolved resolved;
  const bool inside = !folder_.empty() && uri.kind == UriKind::relative_path;
  const std::string path = inside ? place_of(uri.path) : uri.path;
  if (names_ == ReadNames::paths && leads_out(path)) {
    resolved.error = ResolveError::outside_root;
    return resolved;
  }
  const std::string name = inside ? uri_of_path(path) : uri.normalized;
  auto bytes = read_(names_ == ReadNames::uris ? name : path);
  if (!bytes) {
    resolved.error = ResolveError::not_found;
    return resolved;
  }
  resolved.error = ResolveError::none;
  resolved.bytes = *std::move(bytes);
  resolved.git_lfs_pointer = is_git_lfs_pointer(resolved.bytes.text(), resolved.bytes.size());
  return resolved;
}

std::vector<FolderEntry> Resolver::list(const std::string& folder) const {
  constexpr std::size_t kMostEntries = 10'000;
  std::vector<FolderEntry> entries;
  const std::string place = place_of(folder);
  for (const auto& [added, bytes] : added_) {
    if (!added.starts_with(place)) continue;
    const std::string rest = added.substr(place.size());
    entries.push_back({rest.substr(0, rest.find('/')), rest.find('/') != std::string::npos});
  }
  if (unusable_ != ResolveError::none) return entries;
  UniqueFd here(::openat(root_->get(), ".", kFolder));
  const std::string path = base_ + folder;
  for (const std::string_view name : components(path)) {
    if (name == "..") return entries;
    here = UniqueFd(::openat(here.get(), std::string(name).c_str(), kFolder));
  }
  if (!here) return entries;
  DirectoryReader reader(std::move(here));
  for (const char* name = reader.next(); name != nullptr && entries.size() < kMostEntries;
       name = reader.next()) {
    entries.push_back({name, reader.is_directory()});
  }
  return entries;
}

ResolveError Resolver::stat(std::string_view path, std::uint64_t& size) const {
  if (read_ || find_added(path)) {
    const Resolved resolved = open(path);
    size = resolved.bytes.size();
    return resolved.error;
  }
  File file;
  const ResolveError error = open_at(path, file);
  size = file.size;
  return error;
}

}  // namespace gltfx::container
