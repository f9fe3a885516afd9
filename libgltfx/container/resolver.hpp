// SPDX-License-Identifier: Apache-2.0
/// Opens files that an asset names, and nothing outside its folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/origin.hpp"
#include "base/result.hpp"
#include "container/bytes.hpp"
#include "container/file.hpp"
#include "container/resolve_error.hpp"
#include "container/uri.hpp"

namespace gltfx::container {

struct Resolved {
  ResolveError error = ResolveError::none;
  Bytes bytes;  ///< mapped; valid when error is none
  bool git_lfs_pointer = false;
  std::string problem;  ///< printable detail of the error
  FileState state;      ///< of a file on the disk
};

/// Gives the bytes of a URI, or nothing when there are none.
using ReadUri = std::function<std::optional<Bytes>(const std::string& uri)>;

/// The argument of a ReadUri: any Uri::normalized, or each Uri::path that stays in the folder.
enum class ReadNames : std::uint8_t { uris, paths };

/// Records the look-ups of a Resolver and their results. Thread-safe.
class LookupLog {
 public:
  struct Lookup {
    std::string path;
    ResolveError error = ResolveError::none;
  };
  void add(Lookup lookup);
  /// In the order of the calls. Do not call it while a Resolver may still add look-ups.
  const std::vector<Lookup>& lookups() const { return lookups_; }

 private:
  std::mutex mutex_;
  std::vector<Lookup> lookups_;
};

/// An entry of a folder: a file or a link, or a folder.
struct FolderEntry {
  std::string name;
  bool folder = false;
};

/// Opens `path` for reading if it is in `folder` after all links are followed.
File open_within(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Confined to `root`; relative references are resolved against `base`, which is inside the root.
/// The root is opened once, by the constructor, and every look-up starts from that descriptor: a
/// folder renamed or replaced meanwhile cannot lead elsewhere. Copies share the descriptor. Safe to
/// use from several threads.
class Resolver {
 public:
  /// No root: every look-up gives `no_root`.
  Resolver() = default;
  Resolver(const std::filesystem::path& root, const std::filesystem::path& base,
           Confinement confinement = Confinement::automatic);

  /// Calls `read` and looks nothing up on a disk.
  explicit Resolver(ReadUri read, ReadNames names = ReadNames::uris)
      : read_(std::move(read)), names_(names) {}

  /// Whether names are looked up on a disk.
  bool looks_on_disk() const { return unusable_ != ResolveError::no_root; }
  /// Whether it resolves URIs that are not relative.
  bool reads_any_uri() const { return read_ != nullptr && names_ == ReadNames::uris; }
  /// Opens a relative path or, if reads_any_uri(), any URI except a data URI.
  Resolved open(const Uri& uri) const;
  /// Opens `path` (percent-decoded, '/' separated). A path may leave the root if it comes back in
  /// by name ("../A/x" in "A"). Symbolic links are followed while they stay inside the root; only
  /// regular files are opened, without blocking.
  Resolved open(std::string_view path) const;
  /// From now on, open() gives these bytes for a path in the form of Uri::path, whatever is on the
  /// disk: for files that will be written. `state` is that of the file that they will replace, if
  /// any. Earlier copies of the resolver are not changed.
  void add(const std::string& path, Bytes bytes, const FileState& state = {});
  /// A resolver of the references in the file at `path`, which open() found: its base is the folder
  /// of that file. It has the same root, origin, log and added files, and no aliases.
  Resolver in_folder_of(std::string_view path) const;
  /// The path as it would be below the first base, for a file that has no other identity.
  std::string place_of(std::string_view path) const;
  /// From now on aliased() gives these bytes for a URI of exactly these characters (glTF 2.1).
  void add_alias(const std::string& uri, Bytes bytes) {
    aliases_.insert_or_assign(uri, std::move(bytes));
  }
  /// The bytes of an alias, or null. fetch() asks this first.
  const Bytes* aliased(std::string_view uri) const;
  /// A copy that has no aliases.
  Resolver without_aliases() const;
  /// From now on look-ups on the disk are recorded, those of later copies as well.
  void record(std::shared_ptr<LookupLog> log) { log_ = std::move(log); }
  /// Null: look-ups are not recorded.
  const std::shared_ptr<LookupLog>& log() const { return log_; }
  /// The origin of all bytes below the root, and of the asset itself. Without a root, a unique one.
  const Origin& origin() const { return origin_; }
  /// Whether open() would find a file, without reading it. Size in bytes in `size`.
  ResolveError stat(std::string_view path, std::uint64_t& size) const;
  /// The state of a file that open() would find; of other files, and of those in memory without a
  /// state, the default.
  FileState state(std::string_view path) const;
  /// The entries of a folder below the base ("" or with '/' at the end), in no order; a part of
  /// them in large folders, and none if the folder cannot be read or its path contains ".." or a
  /// link.
  std::vector<FolderEntry> list(const std::string& folder) const;

 private:
  Resolved read(const Uri& uri) const;
  std::optional<Resolved> find_added(std::string_view path) const;
  ResolveError open_at(std::string_view path, File& file) const;

  std::shared_ptr<const UniqueFd> root_;  ///< null: no root, or it could not be opened
  std::string base_;                      ///< the base relative to the root; empty or ends in '/'
  std::string folder_;                    ///< the base relative to the first base; likewise
  ResolveError unusable_ = ResolveError::no_root;  ///< why every look-up fails, or none
  std::string problem_;
  Confinement confinement_ = Confinement::automatic;
  struct Added {
    Bytes bytes;
    FileState state;
  };
  std::map<std::string, Added, std::less<>> added_;  ///< by place_of()
  std::map<std::string, Bytes, std::less<>> aliases_;
  ReadUri read_;  ///< null: files are looked up
  ReadNames names_ = ReadNames::uris;
  std::shared_ptr<LookupLog> log_;  ///< may be null
  Origin origin_ = new_origin();
};

}  // namespace gltfx::container
