// SPDX-License-Identifier: Apache-2.0
// People edit and merge baselines, so errors in one are reported with their place.
#include "report/baseline.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "json/writer.hpp"

namespace gltfx::report {
namespace {

// A text as it is after writing and reading JSON, so that keys match.
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

// A baseline counts the repeats of a folded finding: which of them are new is unknown.
void keep_new_ones(Diagnostic& finding, std::uint64_t known) {
  const std::uint64_t all = finding.count;
  finding.count -= known;
  if (!finding.help.empty()) finding.help += "; ";
  finding.help += fmt::format("the baseline knows {} of the {} like this, from {} to {}", known,
                              all, finding.pointer, finding.last_pointer);
  if (finding.count == 1) finding.last_pointer.clear();
}

const nlohmann::json* member(const nlohmann::json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found != object.end() ? &*found : nullptr;
}

const std::string* text_member(const nlohmann::json& object, const char* name) {
  const nlohmann::json* value = member(object, name);
  return value != nullptr ? value->get_ptr<const std::string*>() : nullptr;
}

std::optional<std::uint64_t> count_member(const nlohmann::json& object) {
  const nlohmann::json* value = member(object, "count");
  const auto* count = value != nullptr ? value->get_ptr<const std::uint64_t*>() : nullptr;
  if (count == nullptr || *count == 0) return std::nullopt;
  return *count;
}

Error wrong_entry(std::size_t index) {
  return {fmt::format(
      "findings[{}] of the baseline is not a finding: 'path', 'code' and 'pointer' must be strings "
      "and 'count' a whole number above 0.",
      index)};
}

// How many of each finding are known. Those of the mildest severity come first: a finding that is
// worse than those before it is new.
std::vector<std::uint64_t> known_of(const FileReport& report, const FindingCounts& baseline) {
  const std::string path = plain_path(report.path);
  const std::vector<Diagnostic>& findings = report.diagnostics;
  std::vector<std::size_t> order(findings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return findings[a].severity > findings[b].severity;
  });
  std::vector<std::uint64_t> known(findings.size());
  FindingCounts used;
  for (const std::size_t i : order) {
    FindingKey key = key_of(path, findings[i]);
    const auto entry = baseline.find(key);
    if (entry == baseline.end()) continue;
    std::uint64_t& spent = used[std::move(key)];
    known[i] = std::min(findings[i].count, entry->second - spent);
    spent += known[i];
  }
  return known;
}

void add(FindingCounts& counts, FindingKey key, std::uint64_t count) {
  std::uint64_t& sum = counts[std::move(key)];
  const std::uint64_t room = std::numeric_limits<std::uint64_t>::max() - sum;
  sum += count < room ? count : room;
}

}  // namespace

void Baseline::apply(FileReport& report) const {
  if (!report.readable) return;
  const std::vector<std::uint64_t> all_known = known_of(report, known_);
  std::vector<Diagnostic> fresh;
  std::vector<Repeat> repeats;
  auto repeat = report.repeats.begin();
  for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
    Diagnostic& finding = report.diagnostics[i];
    const std::uint64_t known = all_known[i];
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

Result<Baseline> Baseline::parse(std::string_view text) {
  const nlohmann::json root = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (root.is_discarded()) {
    return Error{"The baseline is not valid JSON; write it anew with --write-baseline."};
  }
  const nlohmann::json* format = member(root, "gltfx-baseline");
  if (format == nullptr) return Error{"The file has no 'gltfx-baseline': it is not a baseline."};
  if (*format != 1) {
    return Error{"The baseline is in a format that this version of gltfx does not know."};
  }
  const nlohmann::json* findings = member(root, "findings");
  if (findings == nullptr || !findings->is_array()) {
    return Error{"The baseline has no list 'findings'."};
  }
  Baseline baseline;
  for (std::size_t i = 0; i < findings->size(); ++i) {
    const nlohmann::json& entry = (*findings)[i];
    const std::string* path = text_member(entry, "path");
    const std::string* code = text_member(entry, "code");
    const std::string* pointer = text_member(entry, "pointer");
    const std::optional<std::uint64_t> count = count_member(entry);
    if (path == nullptr || code == nullptr || pointer == nullptr || !count) return wrong_entry(i);
    add(baseline.known_, {*path, *code, *pointer}, *count);
  }
  return baseline;
}

}  // namespace gltfx::report
