// SPDX-License-Identifier: Apache-2.0
#include "schema/source.hpp"

#include <algorithm>
#include <unordered_map>

#include "base/text.hpp"
#include "json/lines.hpp"
#include "json/parse.hpp"

namespace gltfx::schema {
namespace {

std::string_view error_text(json::SyntaxError error) {
  using json::SyntaxError;
  switch (error) {
    case SyntaxError::unexpected_end:
      return "the text ends inside a value";
    case SyntaxError::invalid_utf8:
      return "invalid UTF-8";
    case SyntaxError::control_character:
      return "a raw control character in a string";
    case SyntaxError::bad_escape:
      return "an invalid escape";
    case SyntaxError::bad_number:
      return "not a JSON number";
    case SyntaxError::bad_literal:
      return "not a JSON value";
    case SyntaxError::too_deep:
      return "nested too deeply";
    case SyntaxError::too_large:
      return "the text is too large";
    case SyntaxError::trailing_data:
      return "data after the value";
    case SyntaxError::byte_order_mark:
      return "a byte order mark before the text";
    case SyntaxError::trailing_comma:
      return "a comma before a closing bracket";
    case SyntaxError::missing_comma:
      return "a comma is missing";
    case SyntaxError::duplicate_key:
      return "a duplicate key";
    case SyntaxError::lone_surrogate:
      return "an unpaired surrogate";
    case SyntaxError::number_out_of_range:
      return "a number out of range of a double";
    default:
      return "JSON does not allow this here";
  }
}

// Adds every error of a file's JSON, recoverable or not: schema files must be valid.
void add_json_errors(const SourceFile& file, const json::Parsed& parsed,
                     std::vector<SchemaError>& errors) {
  const json::LineIndex lines(file.text);
  for (const json::ParseError& error : parsed.errors) {
    const Location at = lines.locate(error.span);
    errors.push_back({file.name, at.line, at.column, "", json_mistake(error)});
  }
}

std::string too_long(std::size_t size) {
  return "the file has " + std::to_string(size) + " bytes; a schema file has at most " +
         std::to_string(kLongestFile);
}

constexpr std::string_view kCore = "gltfx:core/";

// A file in place of one of core would switch off what that one checks.
void add_core_error(const SourceFile& file, const Source& source,
                    std::vector<SchemaError>& errors) {
  const json::NodeId id = source.document.find(source.document.root(), "$id");
  const Location at = json::LineIndex(file.text).locate(source.document.span(id));
  errors.push_back({file.name, at.line, at.column, source.document.pointer_of(id),
                    quoted(source.id) +
                        " cannot be replaced: its checks would no longer run; write a rule of your "
                        "own, which adds to them: 'gltfx rules --new ACME_MESH_NAME --on mesh' "
                        "makes one"});
}

std::vector<Keyword> keywords_of(const json::Document& document) {
  std::vector<Keyword> keywords(document.key_count());
  for (json::KeyId key = 0; key < keywords.size(); ++key)
    keywords[key] = keyword_of(document.key(key));
  return keywords;
}

std::string id_of(const json::Document& document) {
  const json::NodeId id = document.find(document.root(), "$id");
  return id != json::kNoNode && document.is_string(id) ? document.string(id) : std::string();
}

}  // namespace

std::string json_mistake(const json::ParseError& error) {
  std::string message(error_text(error.error));
  if (!error.detail.empty()) message += ": " + error.detail;
  return message;
}

std::string_view Source::short_name() const {
  const std::size_t slash = id.find('/');
  return slash == std::string::npos ? std::string_view() : std::string_view(id).substr(slash + 1);
}

void ErrorList::add(Site at, std::string message) {
  if (is_full()) return;
  const Source& source = (*sources_)[at.source];
  const json::Document& document = source.document;
  const bool is_key = document.kind(at.node) == json::Kind::key;
  const Span span = document.span(at.node);
  const Location place = json::LineIndex(document.text()).locate(span);
  errors_.push_back({at.source,
                     span.begin,
                     {source.name, place.line, place.column,
                      document.pointer_of(is_key ? at.node + 1 : at.node), std::move(message)}});
}

std::vector<SchemaError> ErrorList::take() {
  std::stable_sort(errors_.begin(), errors_.end(), [](const Entry& a, const Entry& b) {
    return a.source != b.source ? a.source < b.source : a.begin < b.begin;
  });
  std::vector<SchemaError> errors;
  for (Entry& entry : errors_) errors.push_back(std::move(entry.error));
  errors_.clear();
  return errors;
}

std::vector<Source> load_sources(const std::vector<SourceFile>& files,
                                 std::vector<SchemaError>& errors) {
  std::vector<Source> sources;
  std::unordered_map<std::string, std::size_t> by_id;
  sources.reserve(files.size());
  for (const SourceFile& file : files) {
    if (file.from_user && file.text.size() > kLongestFile) {
      errors.push_back({file.name, 1, 1, "", too_long(file.text.size())});
      continue;
    }
    json::Parsed parsed = json::parse(file.text);
    if (!parsed.ok()) add_json_errors(file, parsed, errors);
    if (parsed.document.empty()) continue;
    Source source{file.name, file.from_user, std::move(parsed.document), {}, {}};
    source.id = id_of(source.document);
    if (file.from_user && source.id.starts_with(kCore)) {
      add_core_error(file, source, errors);
      continue;
    }
    source.keywords = keywords_of(source.document);
    const auto [place, is_new] = by_id.emplace(source.id, sources.size());
    if (is_new || source.id.empty() || !source.from_user) {
      sources.push_back(std::move(source));
    } else {
      sources[place->second] = std::move(source);
    }
  }
  return sources;
}

std::string SchemaError::text() const {
  std::string place = file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": ";
  return place + (pointer.empty() ? message : pointer + ": " + message);
}

}  // namespace gltfx::schema
