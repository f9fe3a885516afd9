// SPDX-License-Identifier: Apache-2.0
#include "rules/collector.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <system_error>
#include <utility>

#include "base/codes.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {
namespace {

std::vector<LineRange> merged(std::vector<LineRange> lines) {
  std::sort(lines.begin(), lines.end(),
            [](const LineRange& a, const LineRange& b) { return a.first < b.first; });
  std::vector<LineRange> apart;
  for (const LineRange& range : lines) {
    if (!apart.empty() && range.first <= apart.back().last) {
      apart.back().last = std::max(apart.back().last, range.last);
    } else {
      apart.push_back(range);
    }
  }
  return apart;
}

// One past the end of the line that begins at `at`.
std::size_t line_end(std::string_view text, std::size_t at) {
  const std::size_t end = text.find_first_of("\r\n", at);
  if (end == std::string_view::npos) return text.size();
  return end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
}

// Mixes one step into a fold key. Collisions would only merge two findings of one code; with 64
// bits they do not happen by accident, and a crafted one hides nothing from the counts.
std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ULL + (hash << 6) + (hash >> 2);
  return hash * 0xff51afd7ed558ccdULL;
}

// Hash of a code at one severity, so that an error is never folded into an info.
std::uint64_t code_key(const Finding& finding, Severity severity) {
  return mix(static_cast<std::uint64_t>(finding.code), static_cast<std::uint64_t>(severity));
}

// Hash of code, severity, `about` and the path with every array index made equal.
std::uint64_t fold_key(const Path& path, const Finding& finding, Severity severity) {
  std::uint64_t hash =
      mix(code_key(finding, severity), std::hash<std::string_view>{}(finding.about));
  for (const Path* step = &path; step->parent() != nullptr; step = step->parent()) {
    hash = mix(hash, step->is_index() ? 1 : std::hash<std::string_view>{}(step->key()));
  }
  return hash;
}

// The name of the element of a root array that a pointer leads into: artists identify objects by
// it.
std::string nearest_name(model::ArrayLookup& arrays, const json::Document& document,
                         std::string_view pointer) {
  const std::size_t second = pointer.find('/', 1);
  if (document.empty() || second == std::string_view::npos) return {};
  const std::string_view position = pointer.substr(second + 1);
  std::size_t index = 0;
  const auto read = std::from_chars(position.data(), position.data() + position.size(), index);
  const json::NodeId array = document.find(document.root(), pointer.substr(1, second - 1));
  if (read.ec != std::errc() || array == json::kNoNode) return {};
  const auto& elements = arrays.elements(array);
  if (index >= elements.size()) return {};
  const json::NodeId name = document.find(elements[index], "name");
  return name != json::kNoNode && document.is_string(name) ? document.string(name) : std::string();
}

// The help of a rule in the style of other help: no capital, and no full stop after a single
// sentence.
std::string as_help(std::string_view text) {
  std::string help(text);
  const bool word = help.size() > 1 && help[1] >= 'a' && help[1] <= 'z';
  if (word && help[0] >= 'A' && help[0] <= 'Z') help[0] = static_cast<char>(help[0] + 32);
  if (help.find(". ") == std::string::npos && !help.empty() && help.back() == '.') help.pop_back();
  return help;
}

}  // namespace

ChangedLines::ChangedLines(const std::vector<LineRange>& lines, std::string_view text)
    : any_(!lines.empty()) {
  size_ = static_cast<std::uint32_t>(text.size());
  std::size_t at = 0;
  std::uint64_t line = 1;
  for (const LineRange& range : merged(lines)) {
    for (; line < range.first && at < text.size(); ++line) at = line_end(text, at);
    const std::size_t begin = at;
    for (; line <= range.last && at < text.size(); ++line) at = line_end(text, at);
    if (begin < at) {
      last_line_ = at == text.size();
      spans_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at)});
    }
  }
}

bool ChangedLines::touches(Span span) const {
  if (span.end == 0) return any_;
  const auto next =
      std::upper_bound(spans_.begin(), spans_.end(), span.begin,
                       [](std::uint32_t byte, const Span& one) { return byte < one.end; });
  if (next != spans_.end()) return next->begin < std::max(span.end, span.begin + 1);
  return last_line_ && span.begin >= size_;  // something is missing at the end of the text
}

bool accepts(const ValidateOptions& options, Code code, Severity severity) {
  const RuleDescription& rule = description(options, code);
  if (!options.select.empty() && !options.select.contains(rule.code)) return false;
  if (options.ignore.contains(rule.code)) return false;
  if (options.profile == Profile::khronos) return rule.khronos;
  // Hints are opt-in: by profile, by name, or by a severity of their own.
  return severity != Severity::hint || options.profile == Profile::strict ||
         options.select.contains(rule.code);
}

bool is_enabled(const ValidateOptions& options, Code code) {
  const RuleDescription& rule = description(options, code);
  const auto wanted = options.severity.find(rule.code);
  return accepts(options, code, wanted != options.severity.end() ? wanted->second : rule.severity);
}

Collector::Collector(const ValidateOptions& options)
    : options_(options), deviations_(deviations_of(options.profile)) {
  if (options_.changed_lines) changed_.emplace(*options_.changed_lines, std::string_view());
  for (std::size_t i = 0; i < kPhaseCount; ++i) phases_[i].sink.bind(*this, static_cast<Phase>(i));
}

void Collector::PhaseSink::bind(Collector& collector, Phase phase) {
  collector_ = &collector;
  phase_ = phase;
}

void Collector::PhaseSink::report(const Path& path, Finding finding) {
  const Span span = finding.span;
  // What is measured is made of many lines.
  const bool measured = description(collector_->options_, finding.code).code.starts_with("BUDGET_");
  collector_->add(phase_, path, std::move(finding), measured ? Span() : span);
}

void Collector::report(Phase phase, const Path& path, Finding finding, Span extent) {
  add(phase, path, std::move(finding), extent);
}

Severity Collector::severity_of(const Finding& finding) const {
  const RuleDescription& rule = description(options_, finding.code);
  const auto wanted = options_.severity.find(rule.code);
  if (wanted != options_.severity.end()) return wanted->second;
  if (deviations_.severity_follows_code) return rule.khronos_severity;
  if (options_.lfs == LfsPolicy::error && finding.code == Code::GIT_LFS_POINTER)
    return Severity::error;
  if (finding.severity) return *finding.severity;
  if (const LaterSeverity* now = later(finding.code); now != nullptr && now->severity) {
    return *now->severity;
  }
  if (rule.own || options_.profile != Profile::strict) return rule.severity;
  return strict_severity(finding.code);
}

// Where findings are not folded, those beyond max_issues are only counted.
bool Collector::leave_out(Phase phase, Severity severity, const Finding& finding) {
  PhaseFindings& findings = phases_[static_cast<std::size_t>(phase)];
  if (!deviations_.each_finding_is_listed || options_.max_issues == 0) return false;
  if (findings.entries.size() < options_.max_issues) return false;
  findings.left_out.add(severity, finding.count);
  return true;
}

// Takes the text of the finding when it returns true.
bool Collector::fold(Phase phase, Severity severity, const Path& path, Finding& finding) {
  if (deviations_.each_finding_is_listed) return false;
  PhaseFindings& findings = phases_[static_cast<std::size_t>(phase)];
  const std::uint64_t key = fold_key(path, finding, severity);
  const auto listed = findings.listed.find(key);
  std::size_t position = findings.entries.size();
  if (listed != findings.listed.end()) {
    position = listed->second;
  } else {
    Places& places = findings.places[code_key(finding, severity)];
    if (places.count < kMostPlaces) {
      ++places.count;
      places.last = position;
      findings.listed.emplace(key, position);
      return false;
    }
    position = places.last;
  }
  Entry& first = findings.entries[position];
  first.diagnostic.count += finding.count;
  first.diagnostic.last_pointer = path.pointer();
  if (options_.max_issues != 0 || repeats_kept_ >= kMostRepeats) return true;
  ++repeats_kept_;
  first.repeats.push_back(entry_of(phase, severity, std::move(finding), path.pointer()));
  return true;
}

// What the version of the asset makes of a rule; null: nothing else.
const LaterSeverity* Collector::later(Code code) const {
  if (version_ == schema::kVersion2) return nullptr;
  const auto all = later_severities();
  const auto found = std::find_if(all.begin(), all.end(), [&](const LaterSeverity& one) {
    return one.code == code && one.since <= version_;
  });
  return found == all.end() ? nullptr : &*found;
}

bool Collector::wants(const Finding& finding, Severity severity, Span extent) {
  if (!accepts(options_, finding.code, severity)) return false;
  if (const LaterSeverity* now = later(finding.code); now != nullptr && !now->severity) {
    return false;
  }
  if (!changed_ || changed_->touches(extent)) return true;
  unchanged_ += finding.count;
  return false;
}

void Collector::keep_text(SharedText text) {
  text_ = std::move(text);
  if (options_.changed_lines && text_) changed_.emplace(*options_.changed_lines, *text_);
}

// An object of a wrong form, or with a broken reference, whatever the options make of the finding.
void Collector::note_broken(Phase phase, const Path& path, const Finding& finding) {
  if (broken_ == nullptr || (phase != Phase::schema && phase != Phase::reference)) return;
  if (is_error(finding)) broken_->add(path, finding.span);
}

void Collector::add(Phase phase, const Path& path, Finding finding, Span extent) {
  note_error(phase, finding);
  note_broken(phase, path, finding);
  const Severity severity = severity_of(finding);
  if (!wants(finding, severity, extent)) return;
  if (suppressions_ != nullptr &&
      suppressions_->covers(finding.code, path, static_cast<std::size_t>(phase), finding.count)) {
    return;
  }
  keep_site(phase, severity, finding);
  if (leave_out(phase, severity, finding) || fold(phase, severity, path, finding)) return;
  store(phase, severity, std::move(finding), path.pointer(), std::nullopt);
}

void Collector::report_offset(Phase phase, std::uint64_t offset, Finding finding) {
  note_error(phase, finding);
  const Severity severity = severity_of(finding);
  if (!wants(finding, severity, finding.span)) return;
  keep_site(phase, severity, finding);
  store(phase, severity, std::move(finding), {}, offset);
}

void Collector::report_file(Phase phase, Finding finding) {
  note_error(phase, finding);
  const Severity severity = severity_of(finding);
  if (!wants(finding, severity, finding.span)) return;
  keep_site(phase, severity, finding);
  store(phase, severity, std::move(finding), {}, std::nullopt);
}

bool Collector::is_error(const Finding& finding) const {
  if (finding.severity) return *finding.severity == Severity::error;
  if (const LaterSeverity* now = later(finding.code)) return now->severity == Severity::error;
  return description(options_, finding.code).severity == Severity::error;
}

void Collector::note_error(Phase phase, const Finding& finding) {
  if (is_error(finding)) phases_[static_cast<std::size_t>(phase)].has_errors = true;
}

bool Collector::has_errors() const {
  return std::any_of(phases_.begin(), phases_.end(),
                     [](const PhaseFindings& each) { return each.has_errors; });
}

void Collector::keep_site(Phase phase, Severity severity, const Finding& finding) {
  constexpr std::size_t kMostSites = 1U << 20U;
  Sites& sites = phases_[static_cast<std::size_t>(phase)].sites;
  if (sites.size() == kMostSites || find_fix(finding.code) == nullptr) return;
  sites.push_back({finding.code, severity, finding.span});
}

Sites Collector::take_sites() {
  Sites all;
  for (PhaseFindings& findings : phases_) {
    all.insert(all.end(), findings.sites.begin(), findings.sites.end());
    findings.sites = {};
  }
  return all;
}

void Collector::store(Phase phase, Severity severity, Finding finding, std::string pointer,
                      std::optional<std::uint64_t> offset) {
  Entry entry = entry_of(phase, severity, std::move(finding), std::move(pointer));
  entry.diagnostic.offset = offset;
  phases_[static_cast<std::size_t>(phase)].entries.push_back(std::move(entry));
}

Collector::Entry Collector::entry_of(Phase phase, Severity severity, Finding finding,
                                     std::string pointer) const {
  // The message on objects that conflict seldom implies a fix; that on a wrong value does.
  const bool between_objects = phase == Phase::reference || phase == Phase::resources;
  const bool loud = severity == Severity::error || severity == Severity::warning;
  if (finding.help.empty() && between_objects && loud && !deviations_.each_finding_is_listed) {
    finding.help = as_help(description(options_, finding.code).help);
  }
  Entry entry;
  entry.span = finding.span;
  entry.diagnostic.code = description(options_, finding.code).code;
  entry.diagnostic.severity = severity;
  entry.diagnostic.message = std::move(finding.message);
  entry.diagnostic.help = std::move(finding.help);
  if (finding.count > 1) entry.diagnostic.last_pointer = pointer;
  entry.diagnostic.pointer = std::move(pointer);
  entry.diagnostic.count = finding.count;
  entry.diagnostic.requirement = std::move(finding.requirement);
  return entry;
}

void Collector::finish(FileReport& report, const json::Document& document,
                       std::uint64_t json_offset) {
  for (PhaseFindings& findings : phases_) {
    std::vector<Entry>& entries = findings.entries;
    for (const Entry& entry : entries) {
      report.counts.add(entry.diagnostic.severity, entry.diagnostic.count);
    }
    report.counts += findings.left_out;
    const std::size_t room = options_.max_issues - report.diagnostics.size();
    if (options_.max_issues != 0 && entries.size() > room) {
      entries.resize(room);
      report.truncated = true;
    }
    if (findings.left_out.at_least(Severity::hint) > 0) report.truncated = true;
    // Avoids a lookup of a million lines and names.
    if (!deviations_.each_finding_is_listed && !entries.empty()) {
      locate(entries, document, json_offset);
    }
    move_to(report, entries);
  }
  report.unchanged = unchanged_;
}

void Collector::move_to(FileReport& report, std::vector<Entry>& entries) const {
  for (Entry& entry : entries) {
    for (Entry& one : entry.repeats) {
      Diagnostic& from = one.diagnostic;
      Repeat repeat;
      repeat.finding = report.diagnostics.size();
      repeat.message = std::move(from.message);
      repeat.help = std::move(from.help);
      repeat.pointer = std::move(from.pointer);
      repeat.object_name = std::move(from.object_name);
      repeat.location = from.location;
      repeat.count = from.count;
      repeat.requirement = std::move(from.requirement);
      report.repeats.push_back(std::move(repeat));
    }
    report.diagnostics.push_back(std::move(entry.diagnostic));
  }
}

// The end of the last marked span.
std::size_t Collector::last_place() const {
  std::uint32_t last = 0;
  for (const PhaseFindings& findings : phases_) {
    for (const Entry& entry : findings.entries) {
      last = std::max(last, entry.span.end);
      for (const Entry& repeat : entry.repeats) last = std::max(last, repeat.span.end);
    }
  }
  return last;
}

void Collector::locate(std::vector<Entry>& entries, const json::Document& document,
                       std::uint64_t json_offset) {
  if (!text_) return;
  if (!lines_) lines_.emplace(*text_, last_place());
  if (!arrays_) arrays_.emplace(document);
  for (Entry& entry : entries) {
    locate(entry, document, json_offset);
    if (entry.span.end != 0) entry.diagnostic.excerpt = lines_->excerpt(entry.span);
    for (Entry& repeat : entry.repeats) locate(repeat, document, json_offset);
  }
}

void Collector::locate(Entry& entry, const json::Document& document, std::uint64_t json_offset) {
  entry.diagnostic.object_name = nearest_name(*arrays_, document, entry.diagnostic.pointer);
  // An empty span at 0 means no place; any other is the end of the text, marked after the last
  // character.
  if (entry.span.end != 0) entry.diagnostic.location = lines_->locate(entry.span, json_offset);
}

}  // namespace gltfx::validate
