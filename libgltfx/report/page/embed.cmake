# SPDX-License-Identifier: Apache-2.0
# Build step: puts style and scripts into the page, with the hashes by which its policy lets in these
# and no others, and writes it as C++.
#
#   cmake -DOUT=page_source.cpp -DFOLDER=report/page -P embed.cmake
file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/page.css style)
set(script "")
foreach(name dom requirements details page)
  file(READ ${FOLDER}/${name}.js text)
  string(APPEND script "${text}")
endforeach()

# base64_of_hash(TEXT RESULT): SHA-256 as a policy wants it, of CMake's 64 hexadecimal digits.
function(base64_of_hash text result)
  string(SHA256 digits "${text}")
  set(alphabet ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  string(APPEND digits 00)  # to a multiple of three bytes
  set(out "")
  foreach(at RANGE 0 60 6)
    string(SUBSTRING ${digits} ${at} 6 group)
    foreach(shift 18 12 6 0)
      math(EXPR index "0x${group} >> ${shift} & 63")
      string(SUBSTRING ${alphabet} ${index} 1 letter)
      string(APPEND out ${letter})
    endforeach()
  endforeach()
  string(SUBSTRING ${out} 0 43 out)
  set(${result} ${out}= PARENT_SCOPE)
endfunction()

base64_of_hash("${style}" style_hash)
base64_of_hash("${script}" script_hash)
string(REPLACE "@STYLE_HASH@" "${style_hash}" page "${page}")
string(REPLACE "@SCRIPT_HASH@" "${script_hash}" page "${page}")
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
string(REPLACE "@DATA@" ")page\";\nconstexpr std::string_view kEnd = R\"page(" page "${page}")
file(WRITE ${OUT} "// Written by embed.cmake from report/page/.
#include \"report/page_source.hpp\"

namespace gltfx::report {
namespace {

constexpr std::string_view kBegin = R\"page(${page})page\";

}  // namespace

std::string_view page_begin() { return kBegin; }
std::string_view page_end() { return kEnd; }

}  // namespace gltfx::report
")
