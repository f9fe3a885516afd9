# SPDX-License-Identifier: Apache-2.0
# Build step: puts styles and scripts into a page, with the hashes by which its policy lets in these
# and no others, and writes it as C++: NAME_begin() and NAME_end(), which are before and after its data.
#
#   cmake -DOUT=page_source.cpp -DNAME=page -DFILES=page.html,page.css,dom.js,page.js -DFOLDER=report/page
#     -P embed.cmake
string(REPLACE "," ";" FILES "${FILES}")
set(style "")
set(script "")
foreach(file ${FILES})
  file(READ ${FOLDER}/${file} text)
  if(file MATCHES "\\.html$")
    set(page "${text}")
  elseif(file MATCHES "\\.css$")
    string(APPEND style "${text}")
  else()
    string(APPEND script "${text}")
  endif()
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
string(REPLACE "@DATA@" ")page\";\nconstexpr std::string_view kEnd_${NAME} = R\"page(" page "${page}")
file(WRITE ${OUT} "// Written by embed.cmake from report/page/.
#include \"report/page_source.hpp\"

namespace gltfx::report {
namespace {

constexpr std::string_view kBegin_${NAME} = R\"page(${page})page\";

}  // namespace

std::string_view ${NAME}_begin() { return kBegin_${NAME}; }
std::string_view ${NAME}_end() { return kEnd_${NAME}; }

}  // namespace gltfx::report
")
