// SPDX-License-Identifier: Apache-2.0
/// Combines the findings of all phases into a report: severities, filters, folding, order, places.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/shared_text.hpp"
#include "base/sink.hpp"
#include "base/span.hpp"
#include "json/document.hpp"
#include "json/lines.hpp"
#include "model/fields.hpp"
#include "rules/broken_places.hpp"
#include "rules/fix_entry.hpp"
#include "rules/khronos/deviations.hpp"
#include "rules/suppressions.hpp"
#include "schema/version.hpp"

namespace gltfx::validate {

struct LaterSeverity;

class ChangedLines {
 public:
  /// `lines` in any order; lines after the end of the text are ignored. Lines end as in
  /// json::LineIndex. Time is linear in the text.
  ChangedLines(const std::vector<LineRange>& lines, std::string_view text);

  /// Whether a span of the text touches a changed line. A finding without a place (an empty span at
  /// 0) counts as touched when any line changed.
  bool touches(Span span) const;

 private:
  bool any_ = false;
  bool last_line_ = false;   ///< whether the last line is changed
  std::uint32_t size_ = 0;   ///< size of the text
  std::vector<Span> spans_;  ///< sorted, disjoint
};

/// The order of a report. Within a phase, findings are in the order in which they were found.
enum class Phase : std::uint8_t {
  container,
  json,
  schema,
  reference,
  container_end,
  resources,
  own_rules
};
inline constexpr std::size_t kPhaseCount = 7;
static_assert(kPhaseCount <= Suppressions::kMostPhases);

/// Whether the options include findings of that code and severity.
bool accepts(const ValidateOptions& options, Code code, Severity severity);

/// Whether findings of a rule are reported at the severity of its table or of the options: a
/// disabled rule need not be computed.
bool is_enabled(const ValidateOptions& options, Code code);

/// Findings of one asset. A finding on conflicting objects without help of its own gets the rule's
/// help. A repeat of a code at the same place, array indices aside, is folded into the first
/// finding (unless Deviations::each_finding_is_listed), so a million errors cost a counter; the
/// first thousands of repeats are kept with it, unless max_issues asks for fewer. Findings of one
/// code at different places are also folded once very many are listed.
class Collector {
 public:
  explicit Collector(const ValidateOptions& options);
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  /// The sink of a phase; lives as long as the collector.
  Sink& sink(Phase phase) { return phases_[static_cast<std::size_t>(phase)].sink; }
  /// A finding that depends on more of the text than it marks. `extent`: all of that; empty: the
  /// whole text.
  void report(Phase phase, const Path& path, Finding finding, Span extent);
  /// A finding on the container, at a byte of the file.
  void report_offset(Phase phase, std::uint64_t offset, Finding finding);
  /// A finding without a value: about the whole file, or about its text.
  void report_file(Phase phase, Finding finding);
  /// Keeps the JSON text that spans refer to; call it before findings come. May be null.
  void keep_text(SharedText text);
  /// The version of glTF that decides on severities from now on.
  void judge_by(const schema::Version& version) { version_ = version; }
  /// Suppressions of the asset from now on; null: none. Outlives the collector's phases.
  void suppress(Suppressions* suppressions) { suppressions_ = suppressions; }
  /// Where errors of form and references are noted from now on. Outlives the collector's phases.
  void note_broken(BrokenPlaces* places) { broken_ = places; }

  /// Whether an error was reported, whatever options and suppressions make of it. Call it while no
  /// phase runs.
  bool has_errors() const;
  /// The places of findings whose rules have a fix, of all phases; the first million of each rule.
  Sites take_sites();

  /// Moves everything into `report`: diagnostics in order, counts, and for those with a place in
  /// the text its line, column, excerpt and name. `document` may be empty. `json_offset` is the
  /// offset of the text in the file. Call once.
  void finish(FileReport& report, const json::Document& document, std::uint64_t json_offset);

 private:
  static constexpr std::size_t kMostPlaces = 1000;
  static constexpr std::size_t kMostRepeats = 5000;

  struct Entry {
    Diagnostic diagnostic;
    Span span;
    std::vector<Entry> repeats = {};  ///< the first findings that are folded into it
  };
  /// The entries of a code at one severity, by path without array indices.
  struct Places {
    std::size_t count = 0;
    std::size_t last = 0;  ///< the last listed one: position in entries of its phase
  };
  class PhaseSink final : public Sink {
   public:
    void bind(Collector& collector, Phase phase);
    void report(const Path& path, Finding finding) override;

   private:
    Collector* collector_ = nullptr;
    Phase phase_ = Phase::schema;
  };

  struct PhaseFindings {
    PhaseSink sink;
    Sites sites;
    std::vector<Entry> entries;
    bool has_errors = false;
    Counts left_out;                                        ///< omitted because of max_issues
    std::unordered_map<std::uint64_t, std::size_t> listed;  ///< positions in entries by fold key
    std::unordered_map<std::uint64_t, Places> places;       ///< by code and severity
  };

  void add(Phase phase, const Path& path, Finding finding, Span extent);
  void note_broken(Phase phase, const Path& path, const Finding& finding);
  bool wants(const Finding& finding, Severity severity, Span extent);
  /// Whatever the options make of it.
  bool is_error(const Finding& finding) const;
  void note_error(Phase phase, const Finding& finding);
  void keep_site(Phase phase, Severity severity, const Finding& finding);
  bool leave_out(Phase phase, Severity severity, const Finding& finding);
  bool fold(Phase phase, Severity severity, const Path& path, Finding& finding);
  Severity severity_of(const Finding& finding) const;
  const LaterSeverity* later(Code code) const;
  Entry entry_of(Phase phase, Severity severity, Finding finding, std::string pointer) const;
  void store(Phase phase, Severity severity, Finding finding, std::string pointer,
             std::optional<std::uint64_t> offset);
  void move_to(FileReport& report, std::vector<Entry>& entries) const;
  void locate(std::vector<Entry>& entries, const json::Document& document,
              std::uint64_t json_offset);
  void locate(Entry& entry, const json::Document& document, std::uint64_t json_offset);
  std::size_t last_place() const;

  const ValidateOptions& options_;
  const Deviations& deviations_;
  schema::Version version_ = schema::kVersion2;
  std::array<PhaseFindings, kPhaseCount> phases_;
  SharedText text_;
  std::optional<ChangedLines> changed_;
  std::uint64_t unchanged_ = 0;   ///< findings on other lines than `changed_`
  std::size_t repeats_kept_ = 0;  ///< number of repeats in all entries
  Suppressions* suppressions_ = nullptr;
  BrokenPlaces* broken_ = nullptr;
  std::optional<json::LineIndex> lines_;
  std::optional<model::ArrayLookup> arrays_;
};

}  // namespace gltfx::validate
