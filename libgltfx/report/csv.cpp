// SPDX-License-Identifier: Apache-2.0
// Requirements as comma-separated values (RFC 4180), a row for each limit that was checked, for
// spreadsheets. Text that a spreadsheet would take for a formula begins with an apostrophe, also
// behind a semicolon, which separates cells where the comma is the sign of decimals.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "report/safe_text.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

constexpr std::string_view kHead =
    "path,scope,element,measure,value,op,limit,verdict,from,parameters\r\n";

bool begins_formula(std::string_view text) {
  constexpr std::array<std::string_view, 8> kSigns{"=", "+", "-", "@", "＝", "＋", "－", "＠"};
  text.remove_prefix(std::min(text.find_first_not_of(" \""), text.size()));
  return std::any_of(kSigns.begin(), kSigns.end(),
                     [&](std::string_view sign) { return text.starts_with(sign); });
}

std::string without_formulas(std::string_view text) {
  std::string out;
  while (true) {
    const std::size_t end = text.find(';');
    if (begins_formula(text)) out += '\'';
    out += text.substr(0, end);
    if (end == std::string_view::npos) return out;
    out += ';';
    text.remove_prefix(end + 1);
  }
}

// Neutralised text: no line breaks and no other control characters are left.
std::string text_cell(std::string_view text) {
  const std::string plain = without_formulas(safe(text));
  if (plain.find_first_of(",\"") == std::string::npos) return plain;
  std::string out = "\"";
  for (const char c : plain) out.append(c == '"' ? 2 : 1, c);
  return out += '"';
}

std::string cell_of(const CheckedValue& value) {
  struct Cell {
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(double number) const {
      return std::isfinite(number) ? number_text(number) : std::string();
    }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const std::string& text) const { return text_cell(long_value(text)); }
    std::string operator()(const std::vector<std::string>& texts) const {
      return text_cell(long_value(fmt::format("{}", fmt::join(texts, " | "))));
    }
  };
  return std::visit(Cell(), value);
}

std::string element_of(const Requirement& requirement) {
  std::string element = long_value(requirement.pointer);
  if (requirement.object_name.empty()) return element;
  return fmt::format("{}{}({})", element, element.empty() ? "" : " ",
                     long_value(requirement.object_name));
}

class CsvWriter final : public ReportWriter {
 public:
  void begin(std::string& out) override { out += kHead; }

  void file(const FileReport& report, std::string& out) override {
    const std::string path = text_cell(report.path);
    for (const Requirement& each : report.requirements) {
      out += fmt::format("{},{},{},{},{},{},{},{},{},{}\r\n", path, text_cell(each.on),
                         text_cell(element_of(each)), text_cell(each.measure), cell_of(each.value),
                         text_cell(each.op), cell_of(each.limit), verdict_name(each.verdict),
                         text_cell(each.from), text_cell(each.parameters));
    }
  }

  void end(const RunSummary&, std::string&) override {}
};

}  // namespace

std::unique_ptr<ReportWriter> make_csv_writer() { return std::make_unique<CsvWriter>(); }

}  // namespace gltfx::report
