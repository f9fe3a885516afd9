// SPDX-License-Identifier: Apache-2.0
// References to files (glTF 2.0, "URIs"): relative paths of RFC 3986 or RFC 3987.
#include "rules/core/uri_form.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "container/resolver.hpp"
#include "container/uri.hpp"
#include "json/writer.hpp"
#include "rules/core/missing_files.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

struct UriPlace {
  const Context& context;
  Sink& sink;
  json::NodeId value;
  const Path& path;
};

void report(const UriPlace& place, Code code, std::string message, std::string help = {},
            std::optional<Severity> severity = {}) {
  Finding finding(code);
  finding.message = std::move(message);
  finding.help = std::move(help);
  finding.severity = severity;
  finding.span = place.context.document.span(place.value);
  place.sink.report(place.path, std::move(finding));
}

// "a space", "'['" and so on, as a list.
std::string characters_text(std::string_view characters) {
  std::vector<std::string> names;
  for (const char c : characters) {
    names.push_back(c == ' ' ? "a space" : gltfx::quoted(std::string_view(&c, 1)));
  }
  return join_and(names);
}

// A '#' or '?' in a file name changes the file that the URI refers to.
void check_suffix(const UriPlace& place, std::string_view text) {
  const std::string_view suffix = text.substr(text.find_first_of("?#"));
  const bool query = suffix.front() == '?';
  report(place, Code::NON_RELATIVE_URI,
         fmt::format("{} has the {} {}; it must be a path alone.", gltfx::quoted(text),
                     query ? "query" : "fragment", gltfx::quoted(suffix)),
         fmt::format("write a '{}' in a file name as '%{}', or remove {}", suffix.front(),
                     query ? "3F" : "23", gltfx::quoted(suffix)),
         Severity::error);
}

void check_relative(const UriPlace& place, std::string_view text) {
  const container::Unescaped found = container::find_unescaped(text);
  if (found.characters.empty()) return;
  report(
      place, Code::URI_NOT_ENCODED,
      fmt::format("{} has {}; it must be percent-encoded.", gltfx::quoted(text),
                  characters_text(found.characters)),
      fmt::format("write {}", gltfx::quoted(container::escape_characters(text, found.characters))),
      found.reserved ? std::optional(Severity::error) : std::nullopt);
}

std::string_view kind_of_place(const container::Uri& uri, std::string_view text) {
  if (text.find(':') == 1) return "a path on a Windows drive";
  if (uri.suffixed) return "a path out of the folder of the asset";
  return uri.local ? "an absolute path" : "an absolute URI";
}

void check_non_relative(const UriPlace& place, const container::Uri& uri, std::string_view text) {
  const bool outside = uri.local && !place.context.deviations.refused_files_have_no_code;
  if (uri.suffixed && !outside) return check_suffix(place, text);
  report(
      place, outside ? Code::URI_OUTSIDE_ROOT : Code::NON_RELATIVE_URI,
      fmt::format("{} is {}; it must be a relative path.", gltfx::quoted(text),
                  kind_of_place(uri, text)),
      outside ? missing_file_help(place.context, container::ResolveError::outside_root, text) : "");
}

// --- Fixes ---

bool is_there(const Fixing& fixing, const std::string& path) {
  std::uint64_t size = 0;
  return fixing.opened().resolver().stat(path, size) == container::ResolveError::none;
}

// Writes a URI if it names a file, and that file is the one that is meant.
bool write_uri(Fixing& fixing, json::NodeId value, const std::string& uri) {
  const container::Uri sound = container::classify_uri(uri);
  if (sound.kind != container::UriKind::relative_path || !is_there(fixing, sound.path))
    return false;
  std::string text;
  json::append_string(text, uri);
  return fixing.replace_scalar(value, std::move(text));
}

std::string uri_of(const Fixing& fixing, const Subject& subject) {
  const bool string = subject.value != json::kNoNode && fixing.document().is_string(subject.value);
  return string ? fixing.document().string(subject.value) : std::string();
}

// The BIN chunk is the data of a first buffer that has no uri.
bool remove_empty_uri(Fixing& fixing, const Subject& uri) {
  return fixing.opened().container().bin &&
         fixing.index(model::RootArray::buffers, uri.owner) == 0U &&
         fixing.remove_member(uri.value);
}

// A URI that lenient readers resolve to a file is encoded so that all readers find that file.
bool encode_uri(Fixing& fixing, const Subject& subject) {
  const std::string text = uri_of(fixing, subject);
  if (text.empty()) return remove_empty_uri(fixing, subject);
  const container::Uri uri = container::classify_uri(text);
  return uri.lenient_path && container::classify_uri(uri.normalized).path == uri.path &&
         write_uri(fixing, subject.value, uri.normalized);
}

// All readers that find the file by the unescaped name also find it by this one.
bool escape_uri(Fixing& fixing, const Subject& subject) {
  const std::string text = uri_of(fixing, subject);
  const std::string characters = container::find_unescaped(text).characters;
  std::string json;
  json::append_string(json, container::escape_characters(text, characters));
  return !characters.empty() && fixing.replace_scalar(subject.value, std::move(json));
}

// The file whose name contains '#' or '?', or the file without the suffix; not if both exist.
bool escape_suffix(Fixing& fixing, const Subject& subject) {
  const std::string text = uri_of(fixing, subject);
  if (!container::classify_uri(text).suffixed) return false;
  const std::string whole = container::escape_characters(text, "?#");
  const std::string cut = text.substr(0, text.find_first_of("?#"));
  if (is_there(fixing, container::classify_uri(whole).path)) {
    return !is_there(fixing, container::classify_uri(cut).path) &&
           write_uri(fixing, subject.value, whole);
  }
  return write_uri(fixing, subject.value, cut);
}

constexpr FixEntry kFormFixes[] = {{Code::INVALID_URI, encode_uri, FixStage::files},
                                   {Code::NON_RELATIVE_URI, escape_suffix, FixStage::files},
                                   {Code::URI_NOT_ENCODED, escape_uri}};

}  // namespace

void check_uri_form(const Context& context, Sink& sink, json::NodeId value, const Path& path) {
  std::string unescaped;
  const std::string_view text = context.document.string(value, unescaped);
  const container::Uri uri = container::classify_uri(text, context.uri_reading());
  const UriPlace place{context, sink, value, path};
  if (uri.kind == container::UriKind::relative_path) check_relative(place, text);
  if (uri.kind == container::UriKind::non_relative) check_non_relative(place, uri, text);
  if (uri.kind != container::UriKind::invalid) return;
  report(place, Code::INVALID_URI,
         text.empty()
             ? "The URI is empty; it must name a file."
             : fmt::format("{} is not a valid URI: it {}.", gltfx::quoted(text), uri.problem));
}

const RuleGroup& uri_form_rules() {
  static constexpr RuleGroup group{.fixes = kFormFixes};
  return group;
}

}  // namespace gltfx::validate
