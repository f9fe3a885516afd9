// SPDX-License-Identifier: Apache-2.0
#include "rules/core/missing_files.hpp"

#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "container/near_files.hpp"
#include "image/header.hpp"
#include "json/writer.hpp"
#include "model/fields.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

using container::NearFile;
using container::Nearness;
using container::ResolveError;

bool names_asset(std::string_view path) {
  const std::string ending = ending_of(path);
  return ending == ".gltf" || ending == ".glb";
}

std::string near_help(const container::Resolver& resolver, std::string_view path) {
  constexpr std::size_t kMostNames = 3;
  std::vector<NearFile> near = container::find_near_files(resolver, path);
  // A link is listed under its own name, wherever it leads. An asset is no other file.
  std::erase_if(near, [&](const NearFile& file) {
    return file.path == path || names_asset(file.path) != names_asset(path);
  });
  std::vector<std::string> names;
  for (const NearFile& file : near) {
    if (file.nearness == near.front().nearness && names.size() < kMostNames) {
      names.push_back(gltfx::quoted(container::uri_of_path(file.path)));
    }
  }
  if (names.empty()) return {};
  const bool same = near.front().nearness == Nearness::letter_case;
  return fmt::format(
      "write {}{}", join_or(names),
      same ? ": upper and lower case differ" : " if that file is meant, or add the missing one");
}

// --- Fixes ---

/// A reference to a file that cannot be opened.
struct Reference {
  json::NodeId object = json::kNoNode;
  bool buffer = false;
  std::string path;
};

std::optional<Reference> read_reference(Fixing& fixing, const Subject& subject) {
  if (subject.value == json::kNoNode || !fixing.document().is_string(subject.value)) return {};
  Reference found{
      subject.owner, fixing.index(model::RootArray::buffers, subject.owner).has_value(), {}};
  if (!found.buffer && !fixing.index(model::RootArray::images, subject.owner)) return {};
  const std::string text = fixing.document().string(subject.value);
  const container::Uri uri = container::classify_uri(text);
  found.path = uri.kind == container::UriKind::relative_path ? uri.path : text;
  return found;
}

// The file has as many bytes as the buffer declares; one with another name may exceed that only by
// padding.
bool is_wanted_buffer(const Fixing& fixing, const Reference& reference, Nearness nearness,
                      std::uint64_t size) {
  const auto declared = model::unsigned_member(fixing.document(), reference.object, "byteLength");
  if (!declared || size < *declared) return false;
  return nearness == Nearness::letter_case || size - *declared < 4;
}

bool is_wanted_image(const Fixing& fixing, const Reference& reference,
                     const container::Bytes& bytes) {
  const image::HeaderResult result = image::read_header(bytes.view());
  const auto* header = std::get_if<image::Header>(&result);
  if (header == nullptr) return false;
  const std::string_view type = image::media_type(header->format);
  const std::string declared =
      model::string_member(fixing.document(), reference.object, "mimeType");
  if (!declared.empty()) return declared == type;
  const bool core = header->format == image::Format::png || header->format == image::Format::jpeg;
  return core || "." + std::string(type.substr(type.find('/') + 1)) == ending_of(reference.path);
}

/// Paths that the document names, whether they exist or not.
struct Named {
  explicit Named(const Fixing& fixing) : paths(change::referred_paths(fixing.document())) {}
  std::set<std::string> paths;
};

bool is_wanted(Fixing& fixing, const Reference& reference, const NearFile& file) {
  // Another object refers to it already, so this one probably means another file.
  const bool taken = fixing.table<Named>().paths.contains(file.path);
  if (taken && file.nearness != Nearness::letter_case) return false;
  const container::Resolved found = fixing.opened().resolver().open(file.path);
  if (found.error != ResolveError::none || found.git_lfs_pointer) return false;
  return reference.buffer ? is_wanted_buffer(fixing, reference, file.nearness, found.bytes.size())
                          : is_wanted_image(fixing, reference, found.bytes);
}

// The only file with the most similar name that decodes as the expected kind.
bool name_near_file(Fixing& fixing, const Subject& subject) {
  const auto reference = read_reference(fixing, subject);
  if (!reference) return false;
  std::vector<NearFile> near =
      container::find_near_files(fixing.opened().resolver(), reference->path);
  std::erase_if(near, [&](const NearFile& file) { return !is_wanted(fixing, *reference, file); });
  if (near.empty()) return false;
  if (near.size() > 1 && near[1].nearness == near[0].nearness) return false;
  std::string json;
  json::append_string(json, container::uri_of_path(near.front().path));
  return fixing.replace_scalar(subject.value, std::move(json));
}

constexpr FixEntry kMissingFixes[] = {{Code::IO_ERROR, name_near_file, FixStage::files},
                                      {Code::URI_OUTSIDE_ROOT, name_near_file, FixStage::files}};

}  // namespace

const RuleGroup& missing_files_rules() {
  static constexpr RuleGroup group{.fixes = kMissingFixes};
  return group;
}

std::string missing_file_help(const Context& context, ResolveError error, std::string_view path) {
  const bool elsewhere = error == ResolveError::not_found || error == ResolveError::outside_root;
  std::string help = elsewhere ? near_help(context.files.resolver(), path) : std::string();
  if (!help.empty()) return help;
  const bool by_name = path.starts_with("..") || path.starts_with('/');
  if (error == ResolveError::outside_root && !by_name) {
    return "a symbolic link leads out of the folder: replace it by the file, or set a common "
           "parent "
           "folder with --root";
  }
  return std::string(container::help(error));
}

}  // namespace gltfx::validate
