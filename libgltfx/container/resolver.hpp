// SPDX-License-Identifier: Apache-2.0
/// Opens files that an asset names, and nothing outside the folder it is trusted with.
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

/// Gives the bytes behind a URI, or nothing when there are none.
using ReadUri = std::function<std::optional<Bytes>(const std::string& uri)>;

/// How a ReadUri is asked: for any Uri::normalized, or for each Uri::path that stays in the folder.
enum class ReadNames : std::uint8_t { uris, paths };

/// What a Resolver was asked for, and what it found. Safe to use from several threads.
class LookupLog {
 public:
  struct Lookup {
    std::string path;
    ResolveError error = ResolveError::none;
  };
  void add(Lookup lookup);
  /// In the order they were asked for; not while a Resolver may still add some.
  const std::vector<Lookup>& lookups() const { return lookups_; }

 private:
  std::mutex mutex_;
  std::vector<Lookup> lookups_;
};

/// What a folder holds: a file or a link, or a folder.
struct FolderEntry {
  std::string name;
  bool folder = false;
};

/// Opens `path` for reading as long as it lies in `folder` when all links are followed.
File open_within(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Confined to `root`; relative references are resolved against `base`, which lies inside the root.
/// The root is opened once, by the constructor, and every look-up starts from that descriptor: a
/// folder renamed or replaced meanwhile cannot lead elsewhere. Copies share the descriptor.
/// Safe to use from several threads.
class Resolver {
 public:
  /// No root: every look-up answers `no_root`.
  Resolver() = default;
  Resolver(const std::filesystem::path& root, const std::filesystem::path& base,
           Confinement confinement = Confinement::automatic);

  /// Looks nothing up on a disk, but asks `read`.
  explicit Resolver(ReadUri read, ReadNames names = ReadNames::uris)
      : read_(std::move(read)), names_(names) {}

  /// Whether names are looked up on a disk.
  bool looks_on_disk() const { return unusable_ != ResolveError::no_root; }
  /// Whether it knows URIs that are not relative.
  bool reads_any_uri() const { return read_ != nullptr && names_ == ReadNames::uris; }
  /// Opens what a URI names that is a relative path, or any but a data URI where reads_any_uri().
  Resolved open(const Uri& uri) const;
  /// Opens `path` (percent-decoded, '/' separated). A path may leave the root as far as it names
  /// the folders on the way back in ("../A/x" in "A"). Symbolic links are followed while they stay
  /// inside the root; only regular files are opened, without blocking.
  Resolved open(std::string_view path) const;
  /// From now on open() gives these bytes for a path, spelled as container::Uri has it, whatever is
  /// on the disk: files that are about to be written. `state` is that of the file which they are to
  /// replace, if any. Copies that were made before do not know it.
  void add(const std::string& path, Bytes bytes, const FileState& state = {});
  /// From now on look-ups on the disk are recorded, those of later copies as well.
  void record(std::shared_ptr<LookupLog> log) { log_ = std::move(log); }
  /// Null: they are not.
  const std::shared_ptr<LookupLog>& log() const { return log_; }
  /// That of all bytes below the root, and of the asset itself. Without a root it is one of its
  /// own.
  const Origin& origin() const { return origin_; }
  /// Whether open() would find a file, without reading it. Size in bytes in `size`.
  ResolveError stat(std::string_view path, std::uint64_t& size) const;
  /// What a folder below the base holds ("" or with '/' at the end), in no order; of large folders
  /// a part, and nothing where it cannot be read or the way leads through "..", or a link.
  std::vector<FolderEntry> list(const std::string& folder) const;

 private:
  Resolved read(const Uri& uri) const;
  ResolveError open_at(std::string_view path, File& file) const;

  std::shared_ptr<const UniqueFd> root_;  ///< null: no root, or it could not be opened
  std::string base_;  ///< of the base, relative to the root; empty or ends in '/'
  ResolveError unusable_ = ResolveError::no_root;  ///< why every look-up fails, or none
  std::string problem_;
  Confinement confinement_ = Confinement::automatic;
  struct Added {
    Bytes bytes;
    FileState state;
  };
  std::map<std::string, Added, std::less<>> added_;
  ReadUri read_;  ///< null: files are looked up
  ReadNames names_ = ReadNames::uris;
  std::shared_ptr<LookupLog> log_;  ///< may be null
  Origin origin_ = new_origin();
};

}  // namespace gltfx::container
