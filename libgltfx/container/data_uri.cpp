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
    return Error{last ? "';base64' in the data URI must be lower case."
                      : "';base64' must be directly before the comma of the data URI."};
  }
  return Error{
      fmt::format("The parameter {} of the data URI has no value; it must have the form "
                  "';charset=utf-8', or be ';base64'.",
                  quoted(part))};
}

}  // namespace

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
