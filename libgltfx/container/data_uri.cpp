// SPDX-License-Identifier: Apache-2.0
// data: URIs, RFC 2397.
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/base64.hpp"
#include "container/uri.hpp"
#include "container/uri_characters.hpp"

namespace gltfx::container {
namespace {

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
    return Error{last ? "The data URI has to say ';base64' in lower case."
                      : "';base64' has to be the last word before the comma of a data URI."};
  }
  return Error{
      fmt::format("The data URI's parameter {} has no value; parameters look like "
                  "';charset=utf-8', the encoding like ';base64'.",
                  quoted(part))};
}

}  // namespace

Result<DataUri> split_data_uri(std::string_view uri) {
  if (!has_data_scheme(uri)) return Error{"This is no data URI: it does not begin with 'data:'."};
  const std::string_view content = uri.substr(kDataScheme.size());
  const std::size_t comma = content.find(',');
  if (comma == std::string_view::npos) {
    return Error{"The data URI has no comma, which separates the media type from the data."};
  }
  DataUri out;
  out.payload = content.substr(comma + 1);
  std::string_view rest = content.substr(0, comma);
  bool more = rest.find(';') != std::string_view::npos;
  const std::string_view type = next_part(rest);
  if (!type.empty() && type.find('/') == std::string_view::npos) {
    return Error{fmt::format("{} is no media type; one looks like 'application/octet-stream'.",
                             quoted(type))};
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
        fmt::format("Byte {} of the data is a '%' without two hexadecimal digits behind "
                    "it; a percent sign itself is written '%25'.",
                    bad + 1)};
  }
  return percent_decode(uri.payload);
}

}  // namespace gltfx::container
