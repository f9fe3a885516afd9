// SPDX-License-Identifier: Apache-2.0
/// URIs of buffers and images: data URIs (RFC 2397), relative references (RFC 3986 section 4.2).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "container/bytes.hpp"

namespace gltfx::container {

enum class UriKind : std::uint8_t {
  data,           ///< data:...
  relative_path,  ///< a path to resolve against the asset's folder
  non_relative,   ///< scheme, authority, absolute path, query or fragment: never fetched
  invalid,        ///< not a URI: bad percent escape, forbidden character
};

struct Uri {
  UriKind kind = UriKind::invalid;
  /// relative_path: percent-decoded, '/' separated, "." and ".." segments removed (RFC 3986 section
  /// 5.2.4) except ".." at the front. Where readers differ, as for "a//../../b", it is the path
  /// that leads out of the folder. It never holds a NUL.
  std::string path;
  /// As reports print it: characters that a URI must not contain are percent-encoded, escapes of
  /// letters and digits are decoded, hexadecimal digits are upper case.
  std::string normalized;
  std::string problem;  ///< invalid: why, as the printable end of a sentence ("it ... at byte 3")
  /// non_relative: names a place of this machine or its network, such as "/etc", "//host/share",
  /// "C:\\a", "file:" or "../a?b".
  bool local = false;
  bool suffixed = false;  ///< non_relative: a relative path with a query or a fragment
  /// invalid: a lenient reader still accepts it as a relative path, which is in `path` and
  /// `normalized` ('\\' read as '/', a stray '%' as itself). False if no reader can.
  bool lenient_path = false;
};

enum class UriReading : std::uint8_t {
  strict,
  /// As the Khronos validator does: only scheme, host and port can be invalid. A '\\' is '/', and
  /// forbidden characters count as escaped. ".//a" is "/a".
  lenient,
};

/// Never fails: errors are in `kind` and `problem`. Data URIs are not decoded here.
Uri classify_uri(std::string_view uri, UriReading reading = UriReading::strict);

/// Characters that a relative path must escape (glTF 2.0, "URIs"; RFC 3986 section 3.3). An IRI may
/// contain non-ASCII characters.
struct Unescaped {
  std::string characters;  ///< each once
  bool reserved = false;   ///< '[' or ']' is among them
};
Unescaped find_unescaped(std::string_view uri);

/// Whether a path, as of Uri::path, leads out of its folder.
bool leads_out(std::string_view path);

/// The URI with each of `characters` percent-encoded, and no others.
std::string escape_characters(std::string_view uri, std::string_view characters);

struct DataUri {
  std::string media_type;  ///< lower case, without parameters; "text/plain" when none is given
  bool base64 = false;
  std::string_view payload;  ///< points into the URI
};

/// Splits "data:[type][;parameter]*[;base64],payload". Case of the scheme and
/// type does not matter; "base64" is lower case, which every reader accepts. An Error when there is
/// no comma, the type has no '/', or a parameter no '='.
Result<DataUri> split_data_uri(std::string_view uri);

/// Decodes the payload: base64 strictly (RFC 4648: alphabet, padding, no whitespace, zero spare
/// bits), otherwise percent escapes. The Error names the first bad byte. If `reading` is lenient,
/// base64 may use the URL alphabet, lack padding and have escapes, and a '%' need not begin an
/// escape.
Result<std::string> decode_payload(const DataUri& uri, UriReading reading = UriReading::strict);

}  // namespace gltfx::container
