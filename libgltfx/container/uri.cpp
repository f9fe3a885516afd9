// SPDX-License-Identifier: Apache-2.0
#include "container/uri.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/uri_characters.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t npos = std::string_view::npos;

void append_escaped(std::string& out, char c) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  out += '%';
  out += kDigits[byte >> 4U];
  out += kDigits[byte & 15U];
}

/// RFC 3986 section 6.2.2, and as lenient readers do: '\' is '/', what may not stand there is
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

/// RFC 3986 section 5.2.4 for a relative path: ".." stays only in front, a folder keeps its '/'.
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

std::size_t find_bad_escape(std::string_view text) {
  std::size_t at = text.find('%');
  while (at != npos && is_escape(text, at)) at = text.find('%', at + 3);
  return at;
}

bool has_data_scheme(std::string_view uri) {
  return uri.size() >= kDataScheme.size() &&
         std::equal(kDataScheme.begin(), kDataScheme.end(), uri.begin(),
                    [](char a, char b) { return a == ascii_lower(b); });
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
  const std::string normalized = remove_dot_segments(normalize_escapes(uri));
  out.normalized = hide_colons(normalized);
  // Again, because an escaped slash may have hidden a dot segment.
  out.path = remove_dot_segments(percent_decode(normalized));
  if (!leads_up(out.path)) {
    if (std::string out_of = way_out(percent_decode(normalize_escapes(uri))); !out_of.empty())
      out.path = std::move(out_of);
  }
  if (out.path.find('\0') != npos) out.path.clear();
  out.lenient_path = out.kind == UriKind::invalid && !out.path.empty();
  return out;
}

}  // namespace gltfx::container
