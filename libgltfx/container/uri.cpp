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

namespace gltfx::container {
namespace {

constexpr std::string_view kDataScheme = "data:";

constexpr bool is_alpha(char c) { return ascii_lower(c) >= 'a' && ascii_lower(c) <= 'z'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
// RFC 3986 section 2.3: means the same escaped or not.
constexpr bool is_unreserved(char c) {
  return is_alpha(c) || is_digit(c) || c == '-' || c == '.' || c == '_' || c == '~';
}
// RFC 3986 section 3.3: may stand in a path as it is, '/' included.
constexpr bool is_path_character(char c) {
  return is_unreserved(c) || std::string_view("!$&'()*+,;=:@/").find(c) != std::string_view::npos;
}
// C0 controls and DEL.
constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

// 0 to 15, or -1.
constexpr int hex_value(char c) {
  if (is_digit(c)) return c - '0';
  const char low = ascii_lower(c);
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : -1;
}

// Whether `text` has a whole percent escape at `at`.
constexpr bool is_escape(std::string_view text, std::size_t at) {
  return text[at] == '%' && text.size() - at > 2 && hex_value(text[at + 1]) >= 0 &&
         hex_value(text[at + 2]) >= 0;
}
// The byte that the escape at `at` stands for.
constexpr char escaped_byte(std::string_view text, std::size_t at) {
  return static_cast<char>(hex_value(text[at + 1]) * 16 + hex_value(text[at + 2]));
}

// Whether it begins with "data:", in whatever case.
bool has_data_scheme(std::string_view uri) {
  return uri.size() >= kDataScheme.size() &&
         std::equal(kDataScheme.begin(), kDataScheme.end(), uri.begin(),
                    [](char a, char b) { return a == ascii_lower(b); });
}

constexpr std::size_t npos = std::string_view::npos;

// Where the first '%' stands that begins no escape, or npos.
std::size_t find_bad_escape(std::string_view text) {
  std::size_t at = text.find('%');
  while (at != npos && is_escape(text, at)) at = text.find('%', at + 3);
  return at;
}

void append_escaped(std::string& out, char c) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  out += '%';
  out += kDigits[byte >> 4U];
  out += kDigits[byte & 15U];
}

// RFC 3986 section 6.2.2, and as lenient readers do: '\' is '/', what may not stand there is
/// escaped. `kept` are further characters that stay as they are.
std::string normalize_escapes(std::string_view text, std::string_view kept = {}) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i] == '\\' ? '/' : text[i];
    if (is_escape(text, i)) {
      const char byte = escaped_byte(text, i);
      is_unreserved(byte) ? out.push_back(byte) : append_escaped(out, byte);
      i += 2;
    } else if (is_path_character(c) || kept.find(c) != npos) {
      out += c;
    } else {
      append_escaped(out, c);
    }
  }
  return out;
}

// RFC 3986 section 5.2.4 for a relative path: ".." stays only in front, a folder keeps its '/'.
std::string remove_dot_segments(std::string_view path) {
  std::vector<std::string_view> segments;
  std::size_t parents = 0;  // leading ".." in `segments`
  bool folder = false;      // the last segment is no name, so a '/' follows what is left
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view segment = path.substr(begin, end - begin);
    // ".//a" names "a", not "/a".
    const bool hollow = segment.empty() && segments.empty() && begin != 0;
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
  if (segments.empty()) return "./";
  std::string out;
  for (const std::string_view segment : segments) out.append(segment).push_back('/');
  if (!folder) out.pop_back();
  return out;
}

bool leads_up(std::string_view path) { return path == ".." || path.starts_with("../"); }

/// Where readers end up that take a decoded path for one of the file system: doubled slashes are
/// one, '\\' may be a slash, and nothing is above "/". Only told where it leads out of the folder;
/// empty otherwise.
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

/// What no URI may hold, as the end of a sentence; empty when there is nothing.
std::string find_problem(std::string_view uri) {
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

/// Where the ':' of a scheme stands: in the first segment, or npos.
std::size_t scheme_end(std::string_view uri) {
  const std::size_t end = uri.find_first_of(":/\\?#");
  return end != npos && uri[end] == ':' ? end : npos;
}

std::string scheme_problem(std::string_view scheme) {
  if (scheme.empty()) return "starts with ':'";
  const auto allowed = [](char c) {
    return is_alpha(c) || is_digit(c) || c == '+' || c == '-' || c == '.';
  };
  if (is_alpha(scheme.front()) && std::all_of(scheme.begin(), scheme.end(), allowed)) return {};
  return fmt::format("has the invalid scheme {}; write a ':' in a file name as '%3A'",
                     quoted(scheme));
}

Uri absolute(std::string_view uri, std::size_t scheme) {
  Uri out;
  out.problem = scheme_problem(uri.substr(0, scheme));
  if (!out.problem.empty()) return out;
  out.kind = UriKind::non_relative;
  out.normalized = normalize_escapes(uri, "?#[]");
  for (std::size_t i = 0; i < scheme; ++i) out.normalized[i] = ascii_lower(out.normalized[i]);
  out.local = scheme == 1 || out.normalized.starts_with("file:");  // a drive's letter is no scheme
  return out;
}

constexpr std::string_view kBase64 = "base64";

/// Cuts the part before the next ';' off the front.
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

std::string percent_decode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = is_escape(text, i);
    out += escape ? escaped_byte(text, i) : text[i];
    if (escape) i += 2;
  }
  return out;
}

Uri classify_uri(std::string_view uri) {
  Uri out;
  if (has_data_scheme(uri)) {
    out.kind = UriKind::data;
    return out;
  }
  const std::size_t scheme = scheme_end(uri);
  if (scheme != npos) return absolute(uri, scheme);
  const bool rooted = !uri.empty() && (uri.front() == '/' || uri.front() == '\\');
  const std::size_t path_end = std::min(uri.find_first_of("?#"), uri.size());
  if (rooted || path_end < uri.size()) {
    out.kind = UriKind::non_relative;
    out.normalized = normalize_escapes(uri, "?#");
    const bool host = uri.starts_with("//") && !uri.starts_with("///");
    out.local = rooted ? !host : leads_up(classify_uri(uri.substr(0, path_end)).path);
    return out;
  }
  out.problem = find_problem(uri);
  out.kind = out.problem.empty() ? UriKind::relative_path : UriKind::invalid;
  const std::string escaped = normalize_escapes(uri);
  const std::string normalized = remove_dot_segments(escaped);
  out.normalized = hide_colons(normalized);
  // Again, because an escaped slash may have hidden a dot segment.
  out.path = remove_dot_segments(percent_decode(normalized));
  // Readers decode before or after they follow dot segments.
  for (const std::string* each : {&escaped, &normalized}) {
    if (leads_up(out.path) || out.path.starts_with('/')) break;
    std::string found = way_out(percent_decode(*each));
    if (!found.empty()) out.path = std::move(found);
  }
  if (out.path.find('\0') != npos) out.path.clear();
  out.lenient_path = out.kind == UriKind::invalid && !out.path.empty();
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
  if (!type.empty() && type.find('/') == std::string_view::npos) {
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

Result<std::string> decode_payload(const DataUri& uri) {
  if (uri.base64) return decode_base64(uri.payload);
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
