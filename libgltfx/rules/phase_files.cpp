// SPDX-License-Identifier: Apache-2.0
// Files of an asset (glTF 2.1): whether they exist, and fit their media types; their aliases, and
// the external assets among them.
#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "container/content.hpp"
#include "image/header.hpp"
#include "model/fields.hpp"
#include "rules/external_assets.hpp"
#include "rules/finding.hpp"
#include "rules/phases.hpp"
#include "rules/resource_fetch.hpp"

namespace gltfx::validate {
namespace {

using container::Bytes;

constexpr std::string_view kTextOfGltf = "model/gltf+json";
constexpr std::string_view kBinaryOfGltf = "model/gltf-binary";
constexpr std::string_view kAnyJson = "application/json";
constexpr std::size_t kLongestFileName = 200;

bool is_gltf_type(std::string_view type) { return type == kTextOfGltf || type == kBinaryOfGltf; }

bool is_image_type(std::string_view type) {
  constexpr std::array kFormats{image::Format::png, image::Format::jpeg, image::Format::webp,
                                image::Format::avif, image::Format::ktx2};
  return std::any_of(kFormats.begin(), kFormats.end(),
                     [&](image::Format format) { return image::media_type(format) == type; });
}

// The media type that the first bytes show; empty: they may be a text.
std::string_view shown_type(const Bytes& bytes) {
  if (bytes.text().starts_with("glTF")) return kBinaryOfGltf;
  const image::Sniffed sniffed = image::sniff(bytes.view());
  return sniffed.known ? image::media_type(sniffed.format) : std::string_view();
}

// The first character of a text that is not white space.
std::string_view first_character_of(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  return at == std::string_view::npos ? std::string_view() : text.substr(at, 1);
}

// Whether the bytes can be of a media type. Types that are not known here are not judged.
bool can_be(std::string_view type, const Bytes& bytes) {
  const std::string_view shown = shown_type(bytes);
  if (type == kBinaryOfGltf || is_image_type(type)) return shown == type;
  if (type != kTextOfGltf && type != kAnyJson) return true;
  const std::string_view first = first_character_of(bytes.text());
  if (!shown.empty() || first.empty()) return false;
  return type == kTextOfGltf
             ? first == "{"
             : std::string_view("{[\"-0123456789tfn").find(first) != std::string_view::npos;
}

std::string describe_file(const Bytes& bytes) {
  if (bytes.empty()) return "empty";
  if (const std::string_view shown = shown_type(bytes); !shown.empty()) return std::string(shown);
  const container::Content content = container::name_content(bytes.text());
  if (!content.name.empty()) return std::string(content.name);
  return first_character_of(bytes.text()) == "{" ? "a text of JSON" : "not of that type";
}

// The media type of a data URI, or empty.
std::string type_of_uri(const Resource& file) {
  if (file.info.storage != "data-uri") return {};
  const json::NodeId member = file.context.document.find(file.object, "uri");
  std::string unescaped;
  const auto& uri =
      file.context.data_uris->get(member, file.context.document.string(member, unescaped));
  return uri ? uri->media_type : std::string();
}

void check_media_type(const Resource& file, const Bytes& bytes) {
  const std::string type = model::string_member(file.context.document, file.object, "mimeType");
  const std::string_view wrong = can_be(type, bytes) ? "" : "mimeType";
  const std::string stated = type_of_uri(file);
  if (!wrong.empty()) {
    file.find(Code::FILE_MIME_TYPE_MISMATCH, "",
              fmt::format("mimeType is {}, but the file is {}.", gltfx::quoted(type),
                          describe_file(bytes)));
  } else if (!can_be(stated, bytes)) {
    file.find(Code::FILE_MIME_TYPE_MISMATCH, "",
              fmt::format("The media type of the data URI is {}, but the file is {}.",
                          gltfx::quoted(stated), describe_file(bytes)));
  }
}

void report_alias(const Context& context, Sink& sink, const Path& file_path, json::NodeId entry,
                  std::uint64_t index, std::string message, std::string help,
                  std::optional<Severity> severity = {}) {
  const Path list(file_path, "aliases");
  report_member(sink, context, Path(list, index), entry, "alias", Code::ALIAS_WITHOUT_EFFECT,
                std::move(message), std::move(help), severity);
}

// The elements of a member that is an array; none where it is not.
std::span<const json::NodeId> entries_of(const json::Document& document, model::ArrayLookup& arrays,
                                         json::NodeId object, std::string_view member) {
  const json::NodeId list = document.find(object, member);
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return {};
  return arrays.elements(list);
}

void check_aliases(const Resource& file) {
  const json::Document& document = file.context.document;
  model::ArrayLookup arrays(document);
  const auto entries = entries_of(document, arrays, file.object, "aliases");
  if (entries.empty()) return;
  const std::string type = model::string_member(document, file.object, "mimeType");
  if (!is_gltf_type(type)) {
    file.find(
        Code::ALIAS_WITHOUT_EFFECT, "aliases",
        fmt::format("The file has aliases, but {} is no media type of glTF.", gltfx::quoted(type)),
        "remove the aliases, or write the media type of the file");
    return;
  }
  std::set<std::string> known;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!document.is_object(entries[i])) continue;
    const json::NodeId alias = document.find(entries[i], "alias");
    if (alias == json::kNoNode || !document.is_string(alias)) continue;
    std::string text = document.string(alias);
    if (known.insert(text).second) continue;
    report_alias(file.context, file.sink, file.path, entries[i], i,
                 fmt::format("An earlier alias of the file is {}, too, and is the one that counts.",
                             gltfx::quoted(text, kLongestFileName)),
                 "remove one of the two");
  }
}

}  // namespace

void load_files(const Context& context, Sink& sink, FileReport& report, Resources& resources) {
  const json::Document& document = context.document;
  if (context.version <= schema::kVersion2) return;
  model::ArrayLookup arrays(document);
  const Path root;
  const Path array(root, "files");
  std::uint64_t index = 0;
  for (const json::NodeId object : entries_of(document, arrays, document.root(), "files")) {
    const Path path(array, index++);
    if (!document.is_object(object)) continue;
    ResourceInfo info;
    info.pointer = path.pointer();
    const Resource file{context, sink, report, path, object, info};
    const auto bytes = fetch_uri_or_view(file, resources.data);
    info.mime_type = model::string_member(document, object, "mimeType");
    if (bytes) {
      info.byte_length = bytes->size();
      check_media_type(file, *bytes);
    }
    check_aliases(file);
    resources.listed.push_back(std::move(info));
  }
}

void report_external_assets(const Context& context, const ExternalLinks& links, Sink& sink) {
  const json::Document& document = context.document;
  model::ArrayLookup arrays(document);
  const Path root;
  const Path array(root, "externalAssets");
  const auto objects = entries_of(document, arrays, document.root(), "externalAssets");
  for (const ExternalLink& link : links.links) {
    const json::NodeId object = objects[link.index];
    const Path path(array, std::uint64_t{link.index});
    if (!link.closed_circle.empty()) {
      sink.report(path, finding_on(context, object, Code::EXTERNAL_ASSET_CYCLE,
                                   fmt::format("The external asset leads into a cycle: {}.",
                                               link.closed_circle)));
    } else if (!link.not_opened.empty()) {
      report_member(sink, context, path, object, "file", Code::EXTERNAL_ASSET_INVALID,
                    fmt::format("The external asset is not checked: {}.", link.not_opened), {},
                    Severity::warning);
    } else if (link.errors > 0) {
      report_member(sink, context, path, object, "file", Code::EXTERNAL_ASSET_INVALID,
                    fmt::format("The external asset {} has {} error{}.",
                                gltfx::quoted(link.name, kLongestFileName), link.errors,
                                link.errors == 1 ? "" : "s"));
    }
  }
  const Path file_array(root, "files");
  const auto file_objects = entries_of(document, arrays, document.root(), "files");
  for (const auto& [file, alias] : links.unused_aliases) {
    const Path path(file_array, std::uint64_t{file});
    const json::NodeId entry = entries_of(document, arrays, file_objects[file], "aliases")[alias];
    report_alias(context, sink, path, entry, alias,
                 "No URI in the file equals the alias, character for character.",
                 "write the URI as it is in the file, or remove the alias", Severity::hint);
  }
}

}  // namespace gltfx::validate
