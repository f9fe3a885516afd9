// SPDX-License-Identifier: Apache-2.0
#include "container/uri_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/percent.hpp"

namespace gltfx::container {
namespace {

using Position = std::string_view::size_type;
constexpr Position kNowhere = std::string_view::npos;

constexpr bool is_slash(char c) { return c == '/' || c == '\\'; }

// Removes and returns the part before `end`, or all of it.
std::string_view take_until(std::string_view& rest, Position end) {
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(taken.size());
  return taken;
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

// Up to 4 hexadecimal digits.
bool is_group(std::string_view text) {
  return !text.empty() && text.size() <= 4 &&
         std::all_of(text.begin(), text.end(), [](char c) { return hex_value(c) >= 0; });
}

bool is_ipv4(std::string_view text) {
  unsigned parts = 0;
  for (std::string_view rest = text; parts < 4; ++parts) {
    const std::string_view part = take_until(rest, rest.find('.'));
    const bool digits = std::all_of(part.begin(), part.end(), is_digit);
    if (part.empty() || part.size() > 3 || !digits || std::stoi(std::string(part)) > 255) break;
    if (rest.empty()) return parts == 3;
    rest.remove_prefix(1);
  }
  return false;
}

// RFC 3986 section 3.2.2: eight groups, some of which one "::" may replace.
bool is_ipv6(std::string_view text) {
  const Position gap = text.find("::");
  unsigned groups = 0;
  const auto count = [&](std::string_view rest) {
    while (!rest.empty()) {
      const std::string_view group = take_until(rest, rest.find(':'));
      const bool last_ipv4 = rest.empty() && is_ipv4(group);
      if (!last_ipv4 && !is_group(group)) return false;
      groups += last_ipv4 ? 2 : 1;
      if (rest.size() == 1) return false;  // a ':' at the end
      if (!rest.empty()) rest.remove_prefix(1);
    }
    return true;
  };
  if (gap == kNowhere) return count(text) && groups == 8;
  return count(text.substr(0, gap)) && count(text.substr(gap + 2)) && groups < 8;
}

std::string lower_but_escapes(std::string_view host) {
  std::string out = normalize_escapes(host);
  for (Position i = 0; i < out.size(); ++i) {
    if (out[i] == '%') {
      i += 2;
    } else {
      out[i] = ascii_lower(out[i]);
    }
  }
  return out;
}

// A host in brackets, up to its ']'; empty if that is missing or the content is not an address.
std::string_view bracketed(std::string_view text) {
  const Position end = text.find(']');
  if (end == kNowhere || !is_ipv6(text.substr(1, std::min(end, text.find('%')) - 1))) return {};
  return text.substr(0, end + 1);
}

std::string read_authority(std::string_view text, UriParts& parts) {
  const Position at = text.rfind('@');
  std::string out;
  if (at != kNowhere) out = normalize_escapes(text.substr(0, at)) + '@';
  std::string_view port = at == kNowhere ? text : text.substr(at + 1);
  if (port.starts_with('[')) {
    const std::string_view host = bracketed(port);
    if (host.empty()) parts.problem = "has an invalid address in brackets";
    out += lower_case(host);
    port.remove_prefix(host.size());
  } else {
    const std::string_view host = take_until(port, port.find(':'));
    if (host.find_first_of("[]") != kNowhere) parts.problem = "has a bracket in its host";
    out += lower_but_escapes(host);
  }
  if (port.empty() || !parts.problem.empty()) return out;
  const bool digits = std::all_of(port.begin() + 1, port.end(), is_digit);
  if (port.front() != ':' || !digits) parts.problem = "has an invalid port";
  const bool usual = (parts.scheme == "http" && port == ":80") ||
                     (parts.scheme == "https" && port == ":443") || port == ":";
  if (!usual) out += port;
  return out;
}

// RFC 3986 section 5.2.4 for a path that is not relative.
std::string remove_dots(const std::string& path) {
  if (!path.starts_with('.') && path.find("/.") == std::string::npos) return path;
  std::vector<std::string_view> segments;
  bool folder = false;
  for (Position begin = 0; begin <= path.size();) {
    const Position end = std::min(path.find('/', begin), path.size());
    const std::string_view segment = std::string_view(path).substr(begin, end - begin);
    folder = segment == "." || segment == "..";
    if (segment == ".." && !segments.empty()) {
      segments.pop_back();
      if (segments.empty()) segments.emplace_back();  // the front of "/"
    }
    if (!folder) segments.push_back(segment);
    begin = end + 1;
  }
  if (folder) segments.emplace_back();
  return fmt::format("{}", fmt::join(segments, "/"));
}

}  // namespace

std::string UriParts::text() const {
  std::string out = scheme.empty() ? std::string() : scheme + ':';
  if (authority) out += "//" + *authority;
  out += path;
  if (query) out += '?' + *query;
  if (fragment) out += '#' + *fragment;
  return out;
}

UriParts split_uri(std::string_view uri) {
  UriParts parts;
  const Position end = uri.find_first_of(":/\\?#");
  if (end != kNowhere && uri[end] == ':') {
    parts.problem = scheme_problem(uri.substr(0, end));
    if (!parts.problem.empty()) return parts;
    parts.scheme = lower_case(uri.substr(0, end));
    uri.remove_prefix(end + 1);
  }
  if (uri.size() > 1 && is_slash(uri[0]) && is_slash(uri[1])) {
    uri.remove_prefix(2);
    parts.authority = read_authority(take_until(uri, uri.find_first_of("/\\?#")), parts);
    if (!parts.problem.empty()) return parts;
  }
  parts.path = normalize_escapes(take_until(uri, uri.find_first_of("?#")));
  if (parts.scheme == "file") {
    parts.authority = parts.authority.value_or("");
    if (!parts.path.starts_with('/')) parts.path.insert(0, 1, '/');
  }
  if (parts.has_place()) parts.path = remove_dots(parts.path);
  if (uri.starts_with('?')) {
    const std::string_view query = take_until(uri, uri.find('#'));
    parts.query = normalize_escapes(query.substr(1), "?", '\\');
  }
  if (uri.starts_with('#')) parts.fragment = normalize_escapes(uri.substr(1), "?", '\\');
  return parts;
}

}  // namespace gltfx::container
