// SPDX-License-Identifier: Apache-2.0
#include "change/companions.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>

#include "base/replace_file.hpp"
#include "base/temporary_file.hpp"
#include "base/text.hpp"
#include "container/bytes.hpp"
#include "container/file.hpp"
#include "container/uri.hpp"
#include "model/external_places.hpp"

namespace gltfx::change {
namespace {

namespace fs = std::filesystem;
using Pieces = std::vector<container::Bytes>;

bool names_file(std::string_view member) { return member == "uri" || member.ends_with("Uri"); }

std::optional<Error> copy(const std::string& path, const container::Resolver& resolver,
                          const fs::path& folder) {
  if (container::leads_out(path)) {
    return Error{fmt::format("{} is outside the asset's folder and would be missing in the new one",
                             quoted(path, 200))};
  }
  const container::Resolved resolved = resolver.open(path);
  // A path that is not a file is a broken reference in the old asset, too.
  if (resolved.error == container::ResolveError::not_found ||
      resolved.error == container::ResolveError::not_regular) {
    return std::nullopt;
  }
  if (resolved.error != container::ResolveError::none) {
    return Error{container::describe(resolved.error, path, resolved.problem)};
  }
  const fs::path target = folder / path;
  if (auto trouble = make_folder(target.parent_path())) return trouble;
  return put_file(target, {resolved.bytes});
}

std::optional<Error> create(const fs::path& target, const Pieces& pieces) {
  FileDraft draft(target, std::nullopt);
  if (auto trouble = container::write_pieces(draft, pieces)) return trouble;
  if (auto trouble = draft.finish()) return trouble;
  return draft.publish();
}

}  // namespace

bool has_bytes(const fs::path& file, const Pieces& pieces) {
  const container::Loaded present =
      container::load_file(container::open_regular(AT_FDCWD, file.c_str()));
  return present.error == container::ResolveError::none &&
         container::same_bytes(pieces, present.bytes);
}

std::optional<Error> put_file(const fs::path& target, const Pieces& pieces) {
  remove_stale_files(target);
  std::error_code error;
  std::optional<Error> trouble;
  if (!fs::exists(target, error)) {
    trouble = create(target, pieces);
    if (!trouble) return std::nullopt;
  }
  if (fs::exists(target, error) && has_bytes(target, pieces)) return std::nullopt;
  if (trouble) return trouble;
  return Error{fmt::format("{} is there already with other bytes", quoted(target.native(), 200))};
}

std::set<std::string> referred_paths(const json::Document& document) {
  std::set<std::string> paths;
  for (const auto& file : referred_files(document)) paths.insert(file.second);
  return paths;
}

std::map<json::NodeId, std::string> referred_files(const json::Document& document) {
  std::map<json::NodeId, std::string> paths;
  const json::KeyId extras = document.key_id("extras");
  for (json::NodeId id = 0; id < document.node_count();) {
    const json::Node& node = document.node(id);
    if (node.kind == json::Kind::key && node.next == extras) {
      id = document.next(id + 1);
      continue;
    }
    if (node.kind == json::Kind::key && document.is_string(id + 1) &&
        names_file(document.key(node.next))) {
      // Some readers treat a backslash as a slash: the files that they find are copied, too.
      std::string text = document.string(id + 1);
      std::replace(text.begin(), text.end(), '\\', '/');
      container::Uri reference = container::classify_uri(text);
      if (reference.kind == container::UriKind::relative_path) {
        paths.emplace(id + 1, std::move(reference.path));
      }
    }
    ++id;
  }
  return paths;
}

std::set<std::string> paths_of_external_assets(const model::OpenedAsset& asset) {
  std::set<std::string> paths;
  model::for_each_external_asset(asset, [&paths](const model::OpenedAsset& child) {
    const container::Resolver& resolver = child.resolver();
    for (const auto& [value, path] : referred_files(child.document())) {
      if (resolver.aliased(child.document().string(value)) != nullptr) continue;
      paths.insert(resolver.place_of(path));
    }
  });
  return paths;
}

std::optional<Error> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return std::nullopt;
  return Error{fmt::format("cannot create {}: {}", quoted(folder.native(), 200), error.message())};
}

std::optional<Error> copy_companions(const std::set<std::string>& paths,
                                     const container::Resolver& resolver, const fs::path& folder) {
  for (const std::string& path : paths) {
    if (auto trouble = copy(path, resolver, folder)) return trouble;
  }
  return std::nullopt;
}

}  // namespace gltfx::change
