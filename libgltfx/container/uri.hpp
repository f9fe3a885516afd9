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
  invalid,        ///< no URI at all: bad percent escape, forbidden character
};

struct Uri {
  UriKind kind = UriKind::invalid;
  /// relative_path: percent-decoded, '/' separated, "." and ".." segments removed (RFC 3986 section
  /// 5.2.4) but for ".." at the front. Where readers differ, as about "a//../../b", it is the way
  /// that leads out of the folder. It never holds a NUL.
  std::string path;
  /// As reports print it: what may not stand in a URI is percent-encoded, escapes of letters and
  /// digits are undone, hexadecimal digits are upper case.
  std::string normalized;
  std::string problem;  ///< invalid: why, as the printable end of a sentence ("it ... at byte 3")
  /// non_relative: names a place of this machine or its network, such as "/etc", "//host/share",
  /// "C:\\a", "file:" or "../a?b".
  bool local = false;
  bool suffixed = false;  ///< non_relative: a relative path but for a query or a fragment
  /// invalid: a lenient reader still takes it for a relative path, which `path` and `normalized`
  /// then hold ('\\' read as '/', a stray '%' as itself). False where nobody can.
  bool lenient_path = false;
};

enum class UriReading : std::uint8_t {
  strict,
  /// As the Khronos validator has it: only scheme, host and port can be invalid. A '\\' is '/', and
  /// what no URI may hold is taken as if it were escaped. ".//a" is "/a".
  lenient,
};

/// Never fails: what is wrong is in `kind` and `problem`. Data URIs are not decoded here.
Uri classify_uri(std::string_view uri, UriReading reading = UriReading::strict);

/// What a relative path must escape (glTF 2.0, "URIs"; RFC 3986 section 3.3). Characters outside
/// of ASCII may stand in an IRI.
struct Unescaped {
  std::string characters;  ///< each once
  bool reserved = false;   ///< '[' or ']' is among them
};
Unescaped find_unescaped(std::string_view uri);

/// With each of `characters` percent-encoded, and nothing else.
std::string escape_characters(std::string_view uri, std::string_view characters);

struct DataUri {
  std::string media_type;  ///< lower case, without parameters; "text/plain" when none is given
  bool base64 = false;
  std::string_view payload;  ///< points into the URI
};

/// Splits "data:[type][;parameter]*[;base64],payload". Case of the scheme and
/// type does not matter; "base64" is lower case, as every reader takes it. An Error when there is
/// no comma, the type has no '/', or a parameter no '='.
Result<DataUri> split_data_uri(std::string_view uri);

/// Decodes the payload: base64 strictly (RFC 4648: alphabet, padding, no whitespace, zero spare
/// bits), otherwise percent escapes. The Error names the first bad byte. Where `reading` is
/// lenient, base64 may be that of URLs, lack its padding and have escapes, and a '%' need not begin
/// one.
Result<std::string> decode_payload(const DataUri& uri, UriReading reading = UriReading::strict);

}  // namespace gltfx::container
