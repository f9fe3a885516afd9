// SPDX-License-Identifier: Apache-2.0
#include "report/baseline.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/utf8.hpp"
#include "json/writer.hpp"

namespace gltfx::report {
namespace {

// What a text is after it went through a JSON file: a key must find itself again.
std::string as_utf8(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode_utf8(text, at);
    append_utf8(out, point.valid ? point.value : 0xFFFD);
    at += point.size;
  }
  return out;
}

std::string plain_path(const std::string& path) {
  return as_utf8(std::filesystem::path(path).lexically_normal().generic_string());
}

FindingKey key_of(const std::string& path, const Diagnostic& finding) {
  return {path, std::string(finding.code), as_utf8(pointer_pattern(finding.pointer))};
}

void take(Counts& counts, Severity severity, std::uint64_t known) {
  const auto less = [known](std::uint64_t& count) { count -= std::min(count, known); };
  switch (severity) {
    case Severity::error:
      return less(counts.errors);
    case Severity::warning:
      return less(counts.warnings);
    case Severity::info:
      return less(counts.infos);
    case Severity::hint:
      return less(counts.hints);
  }
}

// A baseline counts the repeats of a folded finding: nobody can say which of them is new.
void keep_new_ones(Diagnostic& finding, std::uint64_t known) {
  const std::uint64_t all = finding.count;
  finding.count -= known;
  if (!finding.help.empty()) finding.help += "; ";
  finding.help += fmt::format("the baseline knows {} of the {} like this, from {} to {}", known,
                              all, finding.pointer, finding.last_pointer);
  if (finding.count == 1) finding.last_pointer.clear();
}

}  // namespace

void Baseline::apply(FileReport& report) const {
  if (!report.readable) return;
  const std::string path = plain_path(report.path);
  FindingCounts used;
  std::vector<Diagnostic> fresh;
  std::vector<Repeat> repeats;
  auto repeat = report.repeats.begin();
  for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
    Diagnostic& finding = report.diagnostics[i];
    const FindingKey key = key_of(path, finding);
    const auto entry = known_.find(key);
    std::uint64_t known = 0;
    if (entry != known_.end()) {
      std::uint64_t& spent = used[key];
      known = std::min(finding.count, entry->second - spent);
      spent += known;
    }
    report.suppressed += known;
    take(report.counts, finding.severity, known);
    if (known == finding.count) continue;
    for (; repeat != report.repeats.end() && repeat->finding <= i; ++repeat) {
      if (repeat->finding < i || known > 0) continue;
      repeat->finding = fresh.size();
      repeats.push_back(std::move(*repeat));
    }
    if (known > 0) keep_new_ones(finding, known);
    fresh.push_back(std::move(finding));
  }
  report.diagnostics = std::move(fresh);
  report.repeats = std::move(repeats);
}

void BaselineWriter::add(const FileReport& report) {
  if (!report.readable) return;
  const std::string path = plain_path(report.path);
  for (const Diagnostic& finding : report.diagnostics) {
    counts_[key_of(path, finding)] += finding.count;
  }
}

std::string BaselineWriter::text() const {
  std::string out = "{\n  \"gltfx-baseline\": 1,\n  \"findings\": [";
  std::string_view separator = "\n    ";
  for (const auto& [key, count] : counts_) {
    out.append(separator).append("{\"path\": ");
    json::append_string(out, std::get<0>(key));
    out += ", \"code\": ";
    json::append_string(out, std::get<1>(key));
    out += ", \"pointer\": ";
    json::append_string(out, std::get<2>(key));
    out += fmt::format(", \"count\": {}}}", count);
    separator = ",\n    ";
  }
  return out += counts_.empty() ? "]\n}\n" : "\n  ]\n}\n";
}

}  // namespace gltfx::report
