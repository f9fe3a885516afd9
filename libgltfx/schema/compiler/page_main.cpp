// SPDX-License-Identifier: Apache-2.0
// Build step: reads the pages of schema/rules/ and schema/measures/, so that a mistake in one fails
// the build with its place, and writes the C++ files that embed them. A limit on a measure is a
// rule.
//
//   gltfx_page_compiler RULES.cpp MEASURES.cpp PAGE...      in the order of enum Code
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "schema/compiler/embed.hpp"
#include "schema/compiler/measure_page.hpp"
#include "schema/compiler/rule_page.hpp"

namespace {

using gltfx::Fix;
using gltfx::schema::MeasurePage;
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

// With its length: a compiler that counts the characters of so much text exceeds its limit of
// constexpr.
std::string text(const std::string& value) { return gltfx::schema::cpp_literal(value) + "sv,"; }

std::string row(const RulePage& page) {
  const auto flag = [](bool value) { return value ? "true" : "false"; };
  return "  {" + text(page.code) + severity_value(page.severity) + "," + text(page.summary) +
         text(page.why) + text(page.help) + text(page.section) + text(page.link) + text(page.bad) +
         text(page.good) + text(page.fix_does) + text(page.fixed) + " " + fix_value(page.fix) +
         ", " + flag(page.khronos) + ", " + flag(page.pixels) + ", " + flag(page.picture) + "," +
         severity_value(page.khronos_severity.value_or(page.severity)) + ", " + flag(false) + "," +
         text(page.group) + "},\n";  // no page of the project is an own rule
}

// The row of a rule that depends on the version of glTF.
std::string later_row(const RulePage& page) {
  if (page.later_version.empty()) return {};
  std::string version = page.later_version;
  std::replace(version.begin(), version.end(), '.', ',');
  std::string severity = "std::nullopt";
  constexpr std::array<std::string_view, 4> kNames{"error", "warning", "info", "hint"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (page.later_severity == kNames[i])
      severity = severity_value(static_cast<gltfx::Severity>(i));
  }
  return "  {Code::" + page.code + ", {" + version + "}, " + severity + "},\n";
}

std::string rule_table(const std::vector<RulePage>& pages) {
  std::string rows;
  std::string later;
  std::string checks;
  std::string strict;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    rows += row(pages[i]);
    later += later_row(pages[i]);
    strict += severity_value(pages[i].strict_severity.value_or(pages[i].severity)) + ",\n";
    checks += "static_assert(static_cast<int>(Code::" + pages[i].code +
              ") == " + std::to_string(i) + ");\n";
  }
  return "// Written by gltfx_page_compiler from schema/rules/ and schema/measures/.\n"
         "#include <gltfx/validate.hpp>\n\n#include <string_view>\n\n"
         "#include \"base/codes.hpp\"\n#include \"rules/context.hpp\"\n\n"
         "namespace gltfx {\nnamespace {\n\nusing namespace std::string_view_literals;\n\n"
         "constexpr RuleDescription kRules[]{\n" +
         rows + "};\n\nconstexpr Severity kStrictSeverities[]{\n" + strict +
         "};\n\nconstexpr validate::LaterSeverity kLaterSeverities[]{\n" + later + "};\n\n" +
         checks +
         "\n}  // namespace\n\nstd::span<const RuleDescription> rules() { return kRules; }\n\n"
         "std::span<const validate::LaterSeverity> validate::later_severities() {\n"
         "  return kLaterSeverities;\n}\n\n"
         "Severity validate::strict_severity(Code code) {\n"
         "  return kStrictSeverities[static_cast<std::size_t>(code)];\n}\n\n"
         "}  // namespace gltfx\n";
}

template <class Value>
std::string enumerator(const char* type, Value value) {
  return std::string(" static_cast<") + type + ">(" + std::to_string(static_cast<int>(value)) +
         "),";
}

std::string row(const MeasurePage& page) {
  return "  {" + text(page.name()) + text(page.code()) + text(page.unit) + text(page.summary) +
         text(page.definition) + text(page.help) + text(page.example) + text(page.values) + " " +
         std::to_string(page.on) + "," + enumerator("MeasureScope", page.first) +
         enumerator("MeasureType", page.type) + enumerator("MeasureTotal", page.total) +
         enumerator("MeasureNeeds", page.needs) + "},\n";
}

std::string measure_table(const std::vector<MeasurePage>& pages) {
  std::string rows;
  std::map<std::string, std::string> functions;  // with their measures
  for (const MeasurePage& page : pages) {
    rows += row(page);
    for (const std::string& function : page.by) {
      functions[function] += "Name::" + page.identifier() + ", ";
    }
  }
  std::string declarations;
  std::string lists;
  std::string entries;
  for (const auto& [function, measures] : functions) {
    declarations += "void take_" + function + "(Taking& taking);\n";
    lists += "constexpr Name k_" + function + "[]{" + measures + "};\n";
    entries += "  {take_" + function + ", k_" + function + "},\n";
  }
  return "// Written by gltfx_page_compiler from schema/measures/.\n#include <string_view>\n\n"
         "#include \"measure/take.hpp\"\n\nnamespace gltfx::measure {\n\n" +
         declarations +
         "\nnamespace {\n\nusing namespace std::string_view_literals;\n\n"
         "constexpr MeasureDescription kMeasures[]{\n" +
         rows + "};\n\n" + lists + "constexpr TakeEntry kEntries[]{\n" + entries +
         "};\n\n}  // namespace\n\n"
         "std::span<const TakeEntry> take_entries() { return kEntries; }\n\n"
         "}  // namespace gltfx::measure\n\n"
         "std::span<const gltfx::MeasureDescription> gltfx::measures() {\n"
         "  return measure::kMeasures;\n}\n";
}

bool write(const char* path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return fail("usage: gltfx_page_compiler RULES.cpp MEASURES.cpp PAGE...");
  std::vector<RulePage> rules;
  std::vector<MeasurePage> measures;
  for (int i = 3; i < argc; ++i) {
    const std::filesystem::path path = argv[i];
    std::ifstream file(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    if (!file) return fail(path.string() + ": cannot be read");
    std::string mistake;
    if (path.parent_path().filename() == "measures") {
      measures.push_back(gltfx::schema::read_measure_page(path.stem().string(), content, mistake));
      rules.push_back(measures.back().rule());
    } else {
      rules.push_back(gltfx::schema::read_rule_page(path.stem().string(), content, mistake));
    }
    if (!mistake.empty()) return fail(path.string() + ":" + mistake);
  }
  std::sort(measures.begin(), measures.end(),
            [](const MeasurePage& a, const MeasurePage& b) { return a.stem < b.stem; });
  if (!write(argv[1], rule_table(rules))) return fail(std::string(argv[1]) + ": cannot be written");
  if (!write(argv[2], measure_table(measures))) {
    return fail(std::string(argv[2]) + ": cannot be written");
  }
  return 0;
}
