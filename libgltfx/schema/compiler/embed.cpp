// SPDX-License-Identifier: Apache-2.0
#include "schema/compiler/embed.hpp"

namespace gltfx::schema {
namespace {

std::string byte_list(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    out += std::to_string(static_cast<unsigned char>(bytes[i]));
    out += i % 24 == 23 ? ",\n" : ",";
  }
  return out;
}

}  // namespace

std::string cpp_literal(std::string_view text) {
  std::string out = "\n    \"";
  std::size_t column = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\' || c == '?') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte >= 0x7F) {
      const char digits[] = {'\\', static_cast<char>('0' + (byte >> 6)),
                             static_cast<char>('0' + ((byte >> 3) & 7)),
                             static_cast<char>('0' + (byte & 7))};
      out.append(digits, 4);
    } else {
      out += c;
    }
    if (++column == 100) {
      out += "\"\n    \"";
      column = 0;
    }
  }
  return out + "\"";
}

std::string minified(const std::string& json) {
  std::string out;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (in_string || !blank) out += c;
    if (in_string && c == '\\' && i + 1 < json.size()) {
      out += json[++i];
    } else if (c == '"') {
      in_string = !in_string;
    }
  }
  return out;
}

std::string embed(const std::vector<SourceFile>& files, const std::string& image) {
  std::string names;
  std::string texts;
  for (const SourceFile& file : files) {
    names += cpp_literal(file.name) + ",";
    texts += cpp_literal(file.text) + ",";
  }
  return "// Written by gltfx_schema_compiler from schema/.\n#include \"schema/embedded.hpp\"\n\n"
         "namespace gltfx::schema {\nnamespace {\nconstexpr std::string_view kNames[]{" +
         names + "};\nconstexpr std::string_view kTexts[]{" + texts +
         "};\nalignas(8) constexpr unsigned char kImage[]{" + byte_list(image) +
         "};\n}  // namespace\n\n"
         "Texts embedded_names() { return kNames; }\n\n"
         "Texts embedded_texts() { return kTexts; }\n\n"
         "std::string_view embedded_set() {\n"
         "  return {reinterpret_cast<const char*>(kImage), sizeof kImage};\n}\n\n"
         "}  // namespace gltfx::schema\n";
}

}  // namespace gltfx::schema
