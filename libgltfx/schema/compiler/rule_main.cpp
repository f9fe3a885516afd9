// SPDX-License-Identifier: Apache-2.0
// Build step: reads the pages of schema/rules/, so that a mistake in one fails the build with its
// place, and writes the C++ file that embeds them.
//
//   gltfx_rule_compiler OUT.cpp PAGE...      in the order of enum Code
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "schema/compiler/embed.hpp"
#include "schema/compiler/rule_page.hpp"

namespace {

using gltfx::Fix;
using gltfx::schema::RulePage;

int fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return 1;
}

const char* fix_value(Fix fix) {
  if (fix == Fix::none) return "Fix::none";
  if (fix == Fix::upgrade) return "Fix::upgrade";
  return fix == Fix::safe ? "Fix::safe" : "Fix::unsafe";
}

std::string severity_value(gltfx::Severity value) {
  return " static_cast<Severity>(" + std::to_string(static_cast<int>(value)) + ")";
}

std::string row(const RulePage& page) {
  // With their lengths: a compiler that counts the characters of so much text exceeds its limit of
  // constexpr.
  const auto text = [](const std::string& value) {
    return gltfx::schema::cpp_literal(value) + "sv,";
  };
  const auto flag = [](bool value) { return value ? "true" : "false"; };
  return "  {" + text(page.code) + severity_value(page.severity) + "," + text(page.summary) +
         text(page.why) + text(page.help) + text(page.section) + text(page.link) + text(page.bad) +
         text(page.good) + text(page.fix_does) + text(page.fixed) + " " + fix_value(page.fix) +
         ", " + flag(page.khronos) + ", " + flag(page.pixels) + ", " + flag(page.picture) + "," +
         severity_value(page.khronos_severity.value_or(page.severity)) + "},\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return fail("usage: gltfx_rule_compiler OUT.cpp PAGE...");
  std::string out =
      "// Written by gltfx_rule_compiler from schema/rules/.\n#include <gltfx/validate.hpp>\n\n"
      "#include <string_view>\n\n#include \"base/codes.hpp\"\n#include "
      "\"rules/context.hpp\"\n\nnamespace gltfx {\nnamespace "
      "{\n\nusing "
      "namespace std::string_view_literals;\n\n"
      "constexpr RuleDescription kRules[]{\n";
  std::string checks;
  std::string strict;
  for (int i = 2; i < argc; ++i) {
    const std::filesystem::path path = argv[i];
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file) return fail(path.string() + ": cannot be read");
    std::string mistake;
    const RulePage page = gltfx::schema::read_rule_page(path.stem().string(), text, mistake);
    if (!mistake.empty()) return fail(path.string() + ":" + mistake);
    out += row(page);
    strict += severity_value(page.strict_severity.value_or(page.severity)) + ",\n";
    checks += "static_assert(static_cast<int>(Code::" + page.code +
              ") == " + std::to_string(i - 2) + ");\n";
  }
  out += "};\n\nconstexpr Severity kStrictSeverities[]{\n" + strict + "};\n\n" + checks +
         "\n}  // namespace\n\nstd::span<const RuleDescription> rules() { return kRules; }\n\n"
         "Severity validate::strict_severity(Code code) {\n"
         "  return kStrictSeverities[static_cast<std::size_t>(code)];\n}\n\n"
         "}  // namespace gltfx\n";
  std::ofstream file(argv[1], std::ios::binary);
  file << out;
  return file.flush() ? 0 : fail(std::string(argv[1]) + ": cannot be written");
}
