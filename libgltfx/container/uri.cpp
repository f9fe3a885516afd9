// SPDX-License-Identifier: Apache-2.0
#include "container/uri.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/base64.hpp"
#include "container/percent.hpp"
#include "container/uri_parts.hpp"

namespace gltfx::container {
namespace {

constexpr std::string_view kDataScheme = "data:";

// C0 controls and DEL.
constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

// Whether it begins with "data:", in any case.
bool has_data_scheme(std::string_view uri) {
  return uri.size() >= kDataScheme.size() &&
         std::equal(kDataScheme.begin(), kDataScheme.end(), uri.begin(),
                    [](char a, char b) { return a == ascii_lower(b); });
}

constexpr std::size_t npos = std::string_view::npos;

// Position of the first '%' that does not begin an escape, or npos.
std::size_t find_bad_escape(std::string_view text) {
  std::size_t at = text.find('%');
  while (at != npos && is_escape(text, at)) at = text.find('%', at + 3);
  return at;
}

// RFC 3986 section 5.2.4 for a relative path: ".." stays only in front, a folder keeps its '/'.
// ".//a" names "a", or "/a" where `hollow_count`.
std::string remove_dot_segments(std::string_view path, bool hollow_count = false) {
  std::vector<std::string_view> segments;
  std::size_t parents = 0;  // leading ".." in `segments`
  bool folder = false;      // the last segment is not a name, so a '/' ends the result
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view segment = path.substr(begin, end - begin);
    const bool hollow = !hollow_count && segment.empty() && segments.empty() && begin != 0;
    begin = end + 1;
    folder = segment == "." || segment == ".." || hollow;
    if (segment == "..") {
      if (segments.size() > parents) {
        segments.pop_back();
      } else {
        segments.push_back(segment);
        ++parents;
      }
    } else if (segment != "." && !hollow) {
      segments.push_back(segment);
    }
  }
  if (segments.empty() || (segments.size() == 1 && segments.front().empty())) return "./";
  std::string out;
  for (const std::string_view segment : segments) out.append(segment).push_back('/');
  if (!folder) out.pop_back();
  return out;
}

bool leads_up(std::string_view path) { return path == ".." || path.starts_with("../"); }

/// The path for readers that treat a decoded path as one of the file system: double slashes are
/// one, '\\' may be a slash, and nothing is above "/". Empty unless it leads out of the folder.
std::string way_out(std::string_view decoded) {
  std::string path;
  for (const char c : decoded) {
    const char next = c == '\\' ? '/' : c;
    if (next != '/' || !path.ends_with('/')) path += next;
  }
  const bool rooted = path.starts_with('/');
  path = remove_dot_segments(rooted ? std::string_view(path).substr(1) : path);
  if (!rooted) return leads_up(path) ? path : std::string();
  std::string_view rest = path;
  while (leads_up(rest)) rest.remove_prefix(std::min<std::size_t>(3, rest.size()));
  return fmt::format("/{}", rest);
}

/// A ':' in the first segment would read as the end of a scheme.
std::string hide_colons(std::string path) {
  const std::size_t end = std::min(path.find('/'), path.size());
  for (std::size_t at = path.rfind(':', end); at != npos; at = path.rfind(':', at)) {
    path.replace(at, 1, "%3A");
    if (at == 0) break;
    --at;
  }
  return path;
}

/// The first character that no URI may hold, as the end of a sentence; empty when there is none.
std::string find_problem(std::string_view uri) {
  if (uri.empty()) return "is empty";
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const char c = uri[i];
    const bool escape = is_escape(uri, i);
    if (c == '%' && !escape) {
      return fmt::format(
          "has a '%' at byte {} without two hexadecimal digits after it; write a percent sign as "
          "'%25'",
          i);
    }
    if (is_control(c)) {
      return fmt::format("has the control character U+{:04X} at byte {}",
                         static_cast<unsigned>(static_cast<unsigned char>(c)), i);
    }
    if (escape && is_control(escaped_byte(uri, i))) {
      return fmt::format("has the escaped control character {} at byte {}",
                         quoted(uri.substr(i, 3)), i);
    }
    if (c == '\\') {
      return fmt::format("has a backslash at byte {}; use '/'", i);
    }
  }
  return {};
}

// A URI that does not name a file beside the asset.
Uri elsewhere(const UriParts& parts) {
  Uri out;
  out.kind = UriKind::non_relative;
  out.normalized = parts.text();
  const bool drive = parts.scheme.size() == 1;
  out.local = parts.scheme.empty() || drive || parts.scheme == "file";
  return out;
}

// Hides a ':' that would end a scheme if the path were parsed again.
std::string hide_scheme(std::string path) {
  const std::size_t colon = path.find_first_of(":/");
  if (colon == npos || path[colon] != ':') return path;
  if (colon > 0 && split_uri(path).scheme.empty()) return path;
  return path.replace(colon, 1, "%3A");
}

// The decoded path of a reference; empty if it would hold a NUL.
std::string path_of(const std::string& escaped, const std::string& normalized) {
  // Repeated, because an escaped slash may have hidden a dot segment.
  std::string path =
      normalized.empty() ? normalized : remove_dot_segments(percent_decode(normalized));
  // Some readers decode before they resolve dot segments, others after.
  for (const std::string* each : {&escaped, &normalized}) {
    if (leads_up(path) || path.starts_with('/')) break;
    std::string found = way_out(percent_decode(*each));
    if (!found.empty()) path = std::move(found);
  }
  return path.find('\0') == npos ? path : std::string();
}

constexpr std::string_view kBase64 = "base64";

// The payload as lenient readers accept it: base64 for URLs, without padding or with escapes.
std::string repaired_base64(std::string_view payload) {
  std::string text = percent_decode(payload);
  std::replace(text.begin(), text.end(), '-', '+');
  std::replace(text.begin(), text.end(), '_', '/');
  if (!text.ends_with('=')) text.append((4 - text.size() % 4) % 4, '=');
  return text;
}

/// Removes and returns the part before the next ';'.
std::string_view next_part(std::string_view& rest) {
  const std::size_t end = rest.find(';');
  const std::string_view part = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return part;
}

/// "attribute=value", or "base64" as the last part.
std::optional<Error> take_parameter(std::string_view part, bool last, DataUri& out) {
  if (last && part == kBase64) {
    out.base64 = true;
    return std::nullopt;
  }
  if (part.find('=') != std::string_view::npos) return std::nullopt;
  if (lower_case(part) == kBase64) {
    return Error{last ? "';base64' in the data URI must be lower case."
                      : "';base64' must be directly before the comma of the data URI."};
  }
  return Error{
      fmt::format("The parameter {} of the data URI has no value; it must have the form "
                  "';charset=utf-8', or be ';base64'.",
                  quoted(part))};
}

}  // namespace

Uri classify_uri(std::string_view uri, UriReading reading) {
  Uri out;
  if (has_data_scheme(uri)) {
    out.kind = UriKind::data;
    return out;
  }
  UriParts parts = split_uri(uri);
  out.problem = std::move(parts.problem);
  if (!out.problem.empty()) return out;
  const bool strict = reading == UriReading::strict;
  if (parts.has_place()) return elsewhere(parts);
  const std::string escaped = std::move(parts.path);
  const std::string normalized =
      escaped.empty() ? escaped : remove_dot_segments(escaped, /*hollow_count=*/!strict);
  parts.path = strict ? hide_colons(normalized) : hide_scheme(normalized);
  out.normalized = parts.text();
  if (parts.query || parts.fragment || normalized.starts_with('/')) {
    out.kind = UriKind::non_relative;
    out.suffixed = parts.query || parts.fragment;
    out.local = leads_up(classify_uri(uri.substr(0, uri.find_first_of("?#"))).path);
    return out;
  }
  if (strict) out.problem = find_problem(uri);
  out.kind = out.problem.empty() ? UriKind::relative_path : UriKind::invalid;
  out.path = path_of(escaped, normalized);
  out.lenient_path = out.kind == UriKind::invalid && !out.path.empty();
  return out;
}

Unescaped find_unescaped(std::string_view uri) {
  Unescaped found;
  for (const char c : uri) {
    const bool known = static_cast<unsigned char>(c) >= 0x80 || c == '%' || is_path_character(c);
    if (known || found.characters.find(c) != std::string::npos) continue;
    found.characters += c;
    found.reserved = found.reserved || c == '[' || c == ']';
  }
  return found;
}

bool leads_out(std::string_view path) { return leads_up(path) || path.starts_with('/'); }

std::string escape_characters(std::string_view uri, std::string_view characters) {
  std::string out;
  for (const char c : uri) {
    if (characters.find(c) == npos) {
      out += c;
    } else {
      append_escaped(out, c);
    }
  }
  return out;
}

Result<DataUri> split_data_uri(std::string_view uri) {
  if (!has_data_scheme(uri)) return Error{"The data URI does not start with 'data:'."};
  const std::string_view content = uri.substr(kDataScheme.size());
  const std::size_t comma = content.find(',');
  if (comma == std::string_view::npos) {
    return Error{"The data URI has no comma between the media type and the data."};
  }
  DataUri out;
  out.payload = content.substr(comma + 1);
  std::string_view rest = content.substr(0, comma);
  bool more = rest.find(';') != std::string_view::npos;
  const std::string_view type = next_part(rest);
  if (!type.empty() && std::count(type.begin(), type.end(), '/') != 1) {
    return Error{
        fmt::format("{} is not a media type, such as 'application/octet-stream'.", quoted(type))};
  }
  out.media_type = type.empty() ? "text/plain" : lower_case(type);
  while (more) {
    more = rest.find(';') != std::string_view::npos;
    if (auto error = take_parameter(next_part(rest), !more, out)) return std::move(*error);
  }
  return out;
}

Result<std::string> decode_payload(const DataUri& uri, UriReading reading) {
  const bool strict = reading == UriReading::strict;
  if (uri.base64) return decode_base64(strict ? uri.payload : repaired_base64(uri.payload));
  if (!strict) return percent_decode(uri.payload);
  const std::size_t bad = find_bad_escape(uri.payload);
  if (bad != std::string_view::npos) {
    return Error{
        fmt::format("Byte {} of the data is a '%' without two hexadecimal digits after it; write a "
                    "percent sign as '%25'.",
                    bad + 1)};
  }
  return percent_decode(uri.payload);
}

}  // namespace gltfx::container
